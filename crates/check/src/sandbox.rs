//! Running programs that are not to be trusted.
//!
//! Every program gets an empty environment, no standard input, limits of time, memory and file
//! size, and a process group of its own that ends with it. The limits are set by the shell's
//! `ulimit`, which every POSIX system has: Rust can set them only in unsafe code, or after the
//! program has started. Where the system has one, there is a [`Wall`]. The harness adds a filter of
//! system calls on Linux; see `assets/harness/guard.cpp`.

use std::ffi::OsString;
use std::io::Read;
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::CheckError;
use crate::wall::{BUBBLEWRAP, UNSHARE, Wall, wall};

/// So much of what a program prints is kept.
const MOST_PRINTED: usize = 1 << 20;
/// A program that prints more than this is ended.
pub(crate) const MOST_BYTES: u64 = 32 << 20;

/// How long what may use `processor` time may take on the clock: a busy machine must not make it
/// fail.
pub(crate) fn on_clock(processor: Duration) -> Duration {
    (5 * processor).max(Duration::from_secs(60))
}

/// The limits of one program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How long it may run, on the clock.
    pub time: Duration,
    /// How much processor time each of its processes may use.
    pub processor: Duration,
    /// How much memory it may have, in MiB.
    pub memory: u64,
    /// How large a file may become that it writes, in blocks of 512 bytes.
    pub file_blocks: u64,
}

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exit {
    /// With this exit code.
    Code(i32),
    /// By this signal.
    Signal(i32),
    /// It was ended because it ran too long.
    TimeOut,
    /// It was ended because it printed too much.
    TooMuchOutput,
}

/// What a program left behind.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOutcome {
    /// How it ended.
    pub ending: Exit,
    /// The start of what it printed, to standard output and error.
    pub printed: String,
    /// How many bytes it printed.
    pub printed_bytes: u64,
}

/// A program and what it may see.
#[derive(Clone, Debug)]
pub struct Program {
    /// The program's path or name, and its arguments.
    pub command: Vec<OsString>,
    /// Its working folder, the only one that it may write to, if it may write at all.
    pub folder: PathBuf,
    /// The environment.
    pub environment: Vec<(String, OsString)>,
    /// Whether it may write to its working folder.
    pub writes: bool,
}

/// What the shell does before the program: sets the limits, gives the pipe of standard output the
/// number 3, and lets what is printed go where errors go. A limit that the system does not know is
/// passed over.
const SHELL: &str =
    "{ ulimit -H -t $(($1 + 2)); ulimit -S -t $1; ulimit -v $2; ulimit -f $3; ulimit -c 0
ulimit -s 65536; } 2>/dev/null
shift 3
exec \"$@\" 3>&1 1>&2 </dev/null";

impl Program {
    fn spawn(&self, limits: Limits) -> Result<Child, CheckError> {
        let mut command = Command::new("sh");
        command.args(["-c", SHELL, "sh"]);
        command.arg(limits.processor.as_secs().max(1).to_string());
        command.arg((limits.memory << 10).to_string());
        command.arg(limits.file_blocks.to_string());
        match wall() {
            Wall::Bubblewrap => {
                command.args(BUBBLEWRAP).arg(if self.writes { "--bind" } else { "--ro-bind" });
                command.args([&self.folder, &self.folder]).arg("--chdir").arg(&self.folder);
            }
            Wall::Unshare if !self.writes => drop(command.args(UNSHARE)),
            Wall::Unshare | Wall::None => {}
        }
        command.args(&self.command);
        command.env_clear().envs(self.environment.iter().map(|(name, value)| (name, value)));
        command.current_dir(&self.folder);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.process_group(0);
        command.spawn().map_err(CheckError::io("sh"))
    }

    /// Runs the program. `on_bytes` gets what it writes to file descriptor 3, piece by piece, and
    /// answers how long the next piece may take; nothing where all is known, which ends the
    /// program.
    ///
    /// # Errors
    /// When the shell cannot be started.
    pub fn run(
        &self,
        limits: Limits,
        mut on_bytes: impl FnMut(&[u8]) -> Option<Duration>,
    ) -> Result<RunOutcome, CheckError> {
        let start = Instant::now();
        let mut child = self.spawn(limits)?;
        let pipe = child.stdout.take().expect("it is piped");
        let errors = child.stderr.take().expect("it is piped");
        let pieces = read_pieces(pipe);
        let printed = read_pieces(errors);
        let mut output = Printed::default();
        let mut patience = limits.time;
        let mut last = start;
        let mut ended = None;
        let mut is_known = false;
        loop {
            while let Ok(piece) = printed.try_recv() {
                output.add(&piece);
            }
            let now = Instant::now();
            let deadline = (start + limits.time).min(last + patience);
            if output.bytes > MOST_BYTES {
                ended = Some(Exit::TooMuchOutput);
                break;
            }
            if now >= deadline {
                ended = Some(Exit::TimeOut);
                break;
            }
            // Short waits, since what is printed is to be looked at, too.
            match pieces.recv_timeout((deadline - now).min(Duration::from_millis(20))) {
                Ok(piece) => match on_bytes(&piece) {
                    Some(longest) => {
                        last = Instant::now();
                        patience = longest;
                    }
                    None => {
                        is_known = true;
                        break;
                    }
                },
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // The pipe may be closed before the program ends.
        let mut status = None;
        if ended.is_none() && !is_known {
            let closed = Instant::now();
            while status.is_none() {
                status = child.try_wait().map_err(CheckError::io("sh"))?;
                if status.is_none() && closed.elapsed() > Duration::from_secs(5) {
                    break;
                }
                if status.is_none() {
                    std::thread::sleep(Duration::from_millis(1));
                }
            }
        }
        end_group(&child);
        let status = match status {
            Some(status) => status,
            None => child.wait().map_err(CheckError::io("sh"))?,
        };
        while let Ok(piece) = printed.recv_timeout(Duration::from_millis(200)) {
            output.add(&piece);
        }
        let ending = ended.unwrap_or_else(|| ending_of(status));
        let text = String::from_utf8_lossy(&output.start).into_owned();
        Ok(RunOutcome { ending, printed: text, printed_bytes: output.bytes })
    }
}

/// Ends everything that the program started.
fn end_group(child: &Child) {
    let group = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw);
    if let Some(group) = group {
        // It fails when the group has ended already.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
}

fn ending_of(status: ExitStatus) -> Exit {
    match (status.code(), status.signal()) {
        // Shells and bubblewrap report a signal as 128 and its number.
        (Some(code @ 129..=192), _) => Exit::Signal(code - 128),
        (Some(code), _) => Exit::Code(code),
        (None, signal) => Exit::Signal(signal.unwrap_or_default()),
    }
}

#[derive(Default)]
struct Printed {
    start: Vec<u8>,
    bytes: u64,
}

impl Printed {
    fn add(&mut self, piece: &[u8]) {
        self.bytes += piece.len() as u64;
        let room = MOST_PRINTED - self.start.len().min(MOST_PRINTED);
        self.start.extend_from_slice(&piece[..piece.len().min(room)]);
    }
}

/// Reads `from` on a thread of its own. A few pieces at most wait to be looked at.
fn read_pieces(mut from: impl Read + Send + 'static) -> Receiver<Vec<u8>> {
    let (send, receive) = sync_channel(64);
    std::thread::spawn(move || {
        let mut buffer = vec![0; 1 << 16];
        while let Ok(count @ 1..) = from.read(&mut buffer) {
            if send.send(buffer[..count].to_vec()).is_err() {
                break;
            }
        }
    });
    receive
}

/// The programs' search path: the system's own folders, and that of `program`.
pub(crate) fn search_path(program: &Path) -> OsString {
    let mut path = OsString::from("/usr/local/bin:/usr/bin:/bin:/opt/homebrew/bin");
    if let Some(folder) = program.parent().filter(|folder| folder.is_absolute()) {
        path.push(":");
        path.push(folder);
    }
    path
}
