//! The Slurm script of docs/large-runs.md, run on a Slurm of one node: with a task that is
//! requeued, the parts make up the golden list.
#![cfg(unix)]

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{folder, run, stdout};

/// What the tests' Slurm is: no accounting, no control groups, programs that run as they are
/// started.
const CONFIGURATION: &str = "\
ClusterName=one
SlurmctldHost={host}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={base}/munge.sock
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation={base}/state
SlurmdSpoolDir={base}/spool
SlurmctldPidFile={base}/slurmctld.pid
SlurmdPidFile={base}/slurmd.pid
SlurmctldLogFile={base}/slurmctld.log
SlurmdLogFile={base}/slurmd.log
SlurmctldPort={controller}
SlurmdPort={daemon}
MailProg=/bin/true
NodeName={host} CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
";

/// A Slurm of one node, which ends with this value.
struct Slurm {
    base: PathBuf,
}

impl Slurm {
    fn start(base: PathBuf) -> Self {
        for name in ["state", "spool"] {
            fs::create_dir_all(base.join(name)).expect("it can be made");
        }
        // munged asks that nobody else can write to the folders above its socket.
        let slurm = Self { base };
        let base = slurm.base.display().to_string();
        let host = output(Command::new("hostname").arg("-s")).trim().to_owned();
        let port = || {
            let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
            listener.local_addr().expect("it has an address").port().to_string()
        };
        let text = CONFIGURATION.replace("{host}", &host).replace("{base}", &base);
        let text = text.replace("{controller}", &port()).replace("{daemon}", &port());
        fs::write(slurm.base.join("slurm.conf"), text).expect("it can be written");
        let key = slurm.base.join("munge.key");
        fs::write(&key, "a key that no other machine asks for, and long enough").expect("written");
        fs::set_permissions(&key, std::os::unix::fs::PermissionsExt::from_mode(0o400))
            .expect("it is ours");
        let mut munged = Command::new("munged");
        munged.arg("--force");
        let files = ["key-file=munge.key", "socket=munge.sock", "pid-file=munged.pid"];
        for file in files.iter().chain(&["log-file=munged.log", "seed-file=munge.seed"]) {
            let (option, name) = file.split_once('=').expect("an option and a file");
            munged.arg(format!("--{option}={base}/{name}"));
        }
        assert!(munged.status().is_ok_and(|status| status.success()), "munged");
        for daemon in ["slurmctld", "slurmd"] {
            let status = slurm.command(daemon).status();
            assert!(status.is_ok_and(|status| status.success()), "{daemon}");
        }
        slurm.wait("the node is up", || slurm.ask(&["sinfo", "-h", "-o", "%T"]) == "idle");
        slurm
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("SLURM_CONF", self.base.join("slurm.conf"));
        command
    }

    /// What the program of `words` prints.
    fn ask(&self, words: &[&str]) -> String {
        output(self.command(words[0]).args(&words[1..])).trim().to_owned()
    }

    fn wait(&self, what: &str, is_so: impl Fn() -> bool) {
        let start = Instant::now();
        while !is_so() {
            let log = fs::read_to_string(self.base.join("slurmctld.log")).unwrap_or_default();
            assert!(start.elapsed() < Duration::from_secs(120), "waiting until {what}: {log}");
            std::thread::sleep(Duration::from_millis(200));
        }
    }
}

impl Drop for Slurm {
    fn drop(&mut self) {
        for daemon in ["slurmd", "slurmctld", "munged"] {
            if let Ok(number) = fs::read_to_string(self.base.join(format!("{daemon}.pid"))) {
                let _ = Command::new("kill").arg(number.trim()).status();
                // Until it has ended, it writes into the folder that is to go.
                let process = Path::new("/proc").join(number.trim());
                for _ in (0..100).take_while(|_| process.exists()) {
                    std::thread::sleep(Duration::from_millis(100));
                }
            }
        }
    }
}

fn output(command: &mut Command) -> String {
    let output = command.stderr(Stdio::inherit()).output().expect("it can be started");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The script on the page.
fn script() -> String {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/large-runs.md");
    let page = fs::read_to_string(page).expect("the page is there");
    let (_, script) = page.split_once("```sh\n#!/bin/sh\n#SBATCH").expect("it has a script");
    let (script, _) = script.split_once("```").expect("the script has an end");
    format!("#!/bin/sh\n#SBATCH{script}")
}

#[test]
fn the_script_of_the_page_makes_the_golden_list_though_a_task_is_requeued() {
    let has = |program: &str| {
        let mut try_it = Command::new(program);
        try_it.arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
    };
    let is_root = output(Command::new("id").arg("-u")).trim() == "0";
    if !is_root || !["munged", "slurmctld", "slurmd", "sbatch"].into_iter().all(has) {
        eprintln!("skipped: expected root, and the packages slurm-wlm and munge");
        return;
    }
    let folder = folder();
    // A socket's path must be short.
    let base =
        tempfile::Builder::new().prefix("slurm-").tempdir_in("/run").expect("it can be made");
    let slurm = Slurm::start(base.path().to_owned());
    fs::write(folder.path().join("job.sh"), script()).expect("it can be written");
    let program = Path::new(env!("CARGO_BIN_EXE_photon-mapping")).parent().expect("a folder");
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let mut submit = slurm.command("sbatch");
    submit.args(["--parsable", "job.sh"]).current_dir(folder.path()).env("PATH", path);
    let job = output(submit.env("PHOTONS", "1000000")).trim().to_owned();
    let task = format!("{job}_0");
    let state = |of: &str| slurm.ask(&["squeue", "-h", "-r", "-o", "%T", "-j", of]);
    slurm.wait("a task runs", || state(&task) != "PENDING");
    slurm.ask(&["scontrol", "requeue", &task]);
    // Slurm waits two minutes before it starts a task again, unless it is told not to.
    slurm.wait("the task waits again", || state(&task) == "PENDING");
    let pieces = folder.path().join("pieces");
    let _ = fs::remove_dir_all(pieces.join("0"));
    slurm.ask(&["scontrol", "update", &format!("JobId={task}"), "StartTime=now"]);
    slurm.wait("all tasks are done", || state(&job).is_empty() && pieces.join("3").exists());
    let lists = (0..4).map(|number| pieces.join(format!("{number}/photons.ply")));
    let out = folder.path().join("photons.ply");
    let words = ["merge", "--out"].map(PathBuf::from).into_iter().chain([out]).chain(lists);
    let merged = stdout(run(words).success());
    let golden =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden/handout-1000000-sha256.snap");
    let golden = fs::read_to_string(golden).expect("the golden hash is there");
    assert!(merged.contains(golden.lines().last().expect("a line")), "{merged}");
}
