//! `photon-mapping autograde`: what Gradescope hands over becomes its results.json, whatever it is.
//!
//! `check` and `grade` run as programs of their own, so that one that hangs, crashes or takes all
//! memory costs its part of the result alone.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use clap::Args;
use serde::Deserialize;
use serde_json::{Value, json};

use super::error::CliError;
use super::output::OutputFile;
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
    let mut file = OutputFile::create(&path)?;
    let text = serde_json::to_string_pretty(&results).expect("results have only plain values");
    let written = writeln!(file.file(), "{text}");
    written.map_err(|error| CliError::unwritable(&path, error))?;
    file.persist()?;
    Ok(0)
}

/// A part of the results: that of the C++, or that of the list and the picture.
struct Part {
    /// None where the grader, not the student, is at fault, or where there is nothing to judge.
    score: Option<f64>,
    output: String,
    tests: Vec<Value>,
}

impl Part {
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
        Err(error) => return combined(&[Part::failed("The submission", &error.to_string())], 0.0),
    };
    let mut files = Vec::new();
    gather(&submission, 0, &mut files);
    let has = |kinds: &[&str]| files.iter().any(|path| has_extension(path, kinds));
    let mut parts = Vec::new();
    if has(&SOURCES) {
        parts.push(checked(&submission, arguments, policy.correct));
    }
    // Without C++ every file is worth a look: what a list is called does not matter.
    if has(&RESULTS) || !(files.is_empty() || has(&SOURCES)) {
        parts.push(graded(&submission, arguments));
    }
    if parts.is_empty() {
        let output = "Nothing was handed in: expected PointLight.cpp and \
                      PhotonMappingRenderer.cpp, a photon list (PLY or CSV), or a picture (PNG).\n";
        parts.push(Part { score: None, output: output.to_owned(), tests: Vec::new() });
    }
    combined(&parts, policy.unreadable)
}

/// The first part that has a score decides, or `none` if no part has one.
fn combined(parts: &[Part], none: f64) -> Value {
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

/// What is read of the report of `check`.
#[derive(Deserialize)]
struct Report {
    builds: Builds,
    sections: Vec<Section>,
}

#[derive(Deserialize)]
struct Builds {
    status: String,
    file: Option<String>,
    line: Option<u64>,
    message: Option<String>,
    what: Option<String>,
}

#[derive(Deserialize)]
struct Section {
    section: String,
    status: String,
    faults: Vec<Fault>,
    readings: Vec<String>,
    remarks: Vec<String>,
}

#[derive(Deserialize)]
struct Fault {
    found: String,
    advice: String,
}

fn checked(submission: &Path, arguments: &AutogradeArgs, best: f64) -> Part {
    // A submission that runs too long is a fault of its own, well before the grader's time is up.
    let each = (arguments.timeout / 4).clamp(1, 60).to_string();
    let words = ["check", "--quiet", "--format", "json", "--timeout", &each];
    let words = words.map(OsStr::new);
    let mut reports: Vec<Report> = match run_verb(&words, submission, arguments.timeout) {
        Ok(reports) => reports,
        Err(why) => return Part::failed("The C++", &why),
    };
    let Some(Report { builds, sections }) = reports.pop() else {
        return Part::failed("The C++", "check gave no report");
    };
    if sections.is_empty() {
        let output = format!("C++: {}\n", why_not_run(&builds));
        let test = json!({
            "name": "The C++ builds and runs", "status": "failed", "output": output,
            "output_format": "text", "visibility": "visible",
        });
        return Part { score: None, output, tests: vec![test] };
    }
    let is_right = |section: &Section| section.status.starts_with("right");
    // Whole thousandths: 2.4 must not become 2.4000000000000004.
    let points = |right: usize| (1e3 * best * right as f64 / sections.len() as f64).round() / 1e3;
    let right = sections.iter().filter(|section| is_right(section)).count();
    let test = |section: &Section| {
        json!({
            "name": section.section,
            "score": points(usize::from(is_right(section))), "max_score": points(1),
            "status": if is_right(section) { "passed" } else { "failed" },
            "output": section_in_words(section),
            "output_format": "text", "visibility": "visible",
        })
    };
    let (all, score) = (sections.len(), points(right));
    let output = format!("C++: {right} of {all} sections right, {score} of {best} points\n");
    Part { score: Some(score), output, tests: sections.iter().map(test).collect() }
}

fn why_not_run(builds: &Builds) -> String {
    let file = builds.file.as_deref().unwrap_or("a file");
    match (builds.status.as_str(), &builds.what, &builds.message) {
        ("missing-file", ..) => format!("expected a file {file}, found none"),
        (_, Some(what), _) => format!(
            "the program {what} before any function of the assignment is called: look at static \
             variables and their constructors"
        ),
        (_, _, Some(message)) => match builds.line {
            Some(line) => format!("it does not build: {file}:{line}: {message}"),
            None => format!("it does not build: {message}"),
        },
        _ => "it does not build".to_owned(),
    }
}

fn section_in_words(section: &Section) -> String {
    let mut lines = vec![section.status.replace('-', " ")];
    lines.extend(section.readings.iter().cloned());
    let faults = section.faults.iter();
    lines.extend(faults.flat_map(|fault| [fault.found.clone(), format!("-> {}", fault.advice)]));
    lines.extend(section.remarks.iter().map(|remark| format!("remark: {remark}")));
    lines.join("\n")
}

fn graded(submission: &Path, arguments: &AutogradeArgs) -> Part {
    let mut words = ["grade", "--format", "gradescope"].map(OsString::from).to_vec();
    if let Some(policy) = &arguments.policy {
        // The verb runs in another folder.
        let policy = std::path::absolute(policy).unwrap_or_else(|_| policy.clone());
        words.extend([OsString::from("--policy"), policy.into()]);
    }
    let words: Vec<&OsStr> = words.iter().map(OsString::as_os_str).collect();
    let result: Value = match run_verb(&words, submission, arguments.timeout) {
        Ok(result) => result,
        Err(why) => return Part::failed("The list or picture", &why),
    };
    let tests = result["tests"].as_array().cloned().unwrap_or_default();
    let output = result["output"].as_str().unwrap_or_default().to_owned();
    Part { score: result["score"].as_f64(), output, tests }
}

/// Runs this program with `words` and `submission`, and reads the JSON that it prints.
fn run_verb<T: serde::de::DeserializeOwned>(
    words: &[&OsStr],
    submission: &Path,
    seconds: u64,
) -> Result<T, String> {
    let said = |error: std::io::Error| error.to_string();
    // Files, not pipes: a full pipe would stop the program.
    let folder = tempfile::tempdir().map_err(said)?;
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
