//! `photon-mapping autograde`: grades any submission that Gradescope provides, and always leaves
//! a results.json.
//!
//! `check` and `grade` run as programs of their own, so that one that hangs, crashes or takes all
//! memory costs its part of the result alone.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::{Value, json};

use super::error::CliError;
use super::output::{temporary_folder, write};
use super::{grade, values};

/// Folders deeper than this are not searched, nor more files than this.
const DEEPEST: usize = 12;
const MOST_FILES: usize = 20_000;
/// What C++ is called.
const SOURCES: [&str; 6] = ["cpp", "cc", "cxx", "h", "hpp", "hh"];
/// What lists and pictures are called.
const RESULTS: [&str; 12] =
    ["ply", "csv", "png", "jpg", "jpeg", "gif", "bmp", "tif", "tiff", "webp", "ppm", "tga"];

/// The options of `autograde`.
#[derive(Debug, Args)]
#[command(after_help = "\
Example: photon-mapping autograde /autograder --policy /autograder/source/policy.json
C++ files are judged by 'check', a list or a picture by 'grade'; the score is that of the C++ if \
it can be run.
Exit codes: 0 there is a results.json, whatever the grade; 2 it could not be written.")]
pub struct AutogradeArgs {
    /// The folder in which submission/ lies, and into which results/results.json is written
    #[arg(value_name = "DIR", default_value = "/autograder")]
    base: PathBuf,
    /// A JSON file with a course's own scores, as for 'grade'
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// How long 'check' and 'grade' may take, each of them
    #[arg(long, value_name = "SECONDS", default_value_t = 300,
          value_parser = values::whole(1_u64, 3600))]
    timeout: u64,
}

/// Grades, and writes results.json.
///
/// # Errors
/// When results.json cannot be written.
pub fn run(arguments: &AutogradeArgs) -> Result<u8, CliError> {
    let results = results(arguments);
    let path = arguments.base.join("results/results.json");
    let text = serde_json::to_string_pretty(&results).expect("results have only plain values");
    write(&path, text + "\n")?;
    Ok(0)
}

/// A part of the results: that of the C++, or that of the list and the picture.
struct ResultsPart {
    /// None where the grader, not the student, is at fault, or where there is nothing to judge.
    score: Option<f64>,
    output: String,
    tests: Vec<Value>,
}

impl ResultsPart {
    fn failed(what: &str, why: &str) -> Self {
        let output = format!("{what} could not be judged: {why}\nPlease tell your instructor.\n");
        let test = json!({
            "name": what, "status": "failed", "output": output,
            "output_format": "text", "visibility": "visible",
        });
        Self { score: None, output, tests: vec![test] }
    }
}

fn results(arguments: &AutogradeArgs) -> Value {
    let submission = arguments.base.join("submission");
    let policy = match grade::policy(arguments.policy.as_deref()) {
        Ok(policy) => policy,
        Err(error) => {
            return combined(&[ResultsPart::failed("The submission", &error.to_string())], 0.0);
        }
    };
    let mut files = Vec::new();
    gather(&submission, 0, &mut files);
    let has = |kinds: &[&str]| files.iter().any(|path| has_extension(path, kinds));
    let mut parts = Vec::new();
    if has(&SOURCES) {
        parts.push(checked(&submission, arguments));
    }
    // Without C++ every file is worth a look: what a list is called does not matter.
    if has(&RESULTS) || !(files.is_empty() || has(&SOURCES)) {
        parts.push(graded(&submission, arguments));
    }
    if parts.is_empty() {
        let output = "Nothing was handed in: expected PointLight.cpp and \
                      PhotonMappingRenderer.cpp, a photon list (PLY or CSV), or a picture (PNG).\n";
        parts.push(ResultsPart { score: None, output: output.to_owned(), tests: Vec::new() });
    }
    combined(&parts, policy.unreadable)
}

/// The first part that has a score decides, or `none` if no part has one.
fn combined(parts: &[ResultsPart], none: f64) -> Value {
    let score = parts.iter().find_map(|part| part.score).unwrap_or(none);
    let outputs: Vec<&str> = parts.iter().map(|part| part.output.as_str()).collect();
    let mut tests: Vec<Value> = parts.iter().flat_map(|part| part.tests.clone()).collect();
    for (at, test) in tests.iter_mut().enumerate() {
        test["number"] = Value::String((at + 1).to_string());
    }
    json!({
        "score": score, "output": outputs.join("\n"), "output_format": "text",
        "visibility": "visible", "stdout_visibility": "hidden", "tests": tests,
    })
}

/// The files in `folder`. Symlinks are not followed: they may lead anywhere.
fn gather(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir() && depth < DEEPEST {
            gather(&entry.path(), depth + 1, files);
        } else if !kind.is_dir() && files.len() < MOST_FILES {
            files.push(entry.path());
        }
    }
}

fn has_extension(path: &Path, kinds: &[&str]) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    kinds.iter().any(|kind| extension == *kind)
}

fn checked(submission: &Path, arguments: &AutogradeArgs) -> ResultsPart {
    // A submission that runs too long is a fault of its own, well before the grader's time is up.
    let each = (arguments.timeout / 4).clamp(1, 60).to_string();
    let words = ["check", "--quiet", "--format", "gradescope", "--timeout", &each];
    judged("The C++", &words, submission, arguments)
}

fn graded(submission: &Path, arguments: &AutogradeArgs) -> ResultsPart {
    let words = ["grade", "--submission", "--format", "gradescope"];
    judged("The list or picture", &words, submission, arguments)
}

/// What the verb in `words` says of `submission`.
fn judged(what: &str, words: &[&str], submission: &Path, arguments: &AutogradeArgs) -> ResultsPart {
    let mut words: Vec<OsString> = words.iter().map(OsString::from).collect();
    if let Some(policy) = &arguments.policy {
        // The verb runs in another folder.
        let policy = std::path::absolute(policy).unwrap_or_else(|_| policy.clone());
        words.extend([OsString::from("--policy"), policy.into()]);
    }
    let result = match run_verb(&words, submission, arguments.timeout) {
        Ok(result) => result,
        Err(why) => return ResultsPart::failed(what, &why),
    };
    let tests = result["tests"].as_array().cloned().unwrap_or_default();
    let output = result["output"].as_str().unwrap_or_default().to_owned();
    let is_unreadable = result["extra_data"]["verdict"] == "unreadable";
    ResultsPart { score: result["score"].as_f64().filter(|_| !is_unreadable), output, tests }
}

/// Runs this program with `words` and `submission`, and reads the JSON that it prints.
fn run_verb(words: &[OsString], submission: &Path, seconds: u64) -> Result<Value, String> {
    let said = |error: std::io::Error| error.to_string();
    // Files, not pipes: a full pipe would stop the program.
    let folder = temporary_folder().map_err(said)?;
    let paths = ["stdout", "stderr"].map(|name| folder.path().join(name));
    let [stdout, stderr] = paths.each_ref().map(File::create);
    let mut child = Command::new(std::env::current_exe().map_err(said)?)
        .args(words)
        // Students read the name, and need not read where Gradescope keeps their files.
        .arg(submission.file_name().unwrap_or_default())
        .current_dir(submission.parent().unwrap_or(submission))
        .stdin(Stdio::null())
        .stdout(stdout.map_err(said)?)
        .stderr(stderr.map_err(said)?)
        .spawn()
        .map_err(said)?;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(said)? {
            break status;
        }
        if start.elapsed() > Duration::from_secs(seconds) {
            // It may have ended just now.
            let _ = child.kill();
            let _ = child.wait();
            return Err(format!("the grader took longer than {seconds} s"));
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    let [printed, error] = paths.map(|path| fs::read(path).unwrap_or_default());
    serde_json::from_slice(&printed).map_err(|_| {
        let error = String::from_utf8_lossy(&error);
        let line = error.lines().next().unwrap_or_default().trim_start_matches("error: ");
        if line.is_empty() { format!("the grader ended with {status}") } else { line.to_owned() }
    })
}
