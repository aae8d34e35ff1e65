//! `photon-mapping compare`: where two lists, or two pictures, part.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::error::{CliError, print};
use super::other_format::{load_list, tell};
use super::output::{OutputFile, write};
use super::progress;
use super::run_args::RunArgs;
use classroom::page::difference;
use compare::pictures::compare_pictures;
use compare::report::{Outcome, TOLERANCE, compare};
use grading::picture::kinds::PNG;
use grading::picture::reading::read_any_picture;
use photon_list::ply;
use photon_list::reader::{self, PhotonList, STANDARD_INPUT};
use photon_list::run::RunPart;
use photon_mapping::photon_list::PhotonRecord;
use variants::reading::Reading;
use variants::run::Run;

/// The exit code when the lists or pictures differ.
const DIFFERENT: u8 = 1;

/// The options of `compare`.
#[derive(Debug, Args)]
#[command(
    after_help = "Exit codes: 0 the same: bit for bit, within the tolerance, or (without --strict) \
                  under another fair reading of the handout; 1 different; 2 could not be read.\n\
                  Pictures are the same if each channel of each pixel is, up to one step of 255, \
                  and if both have the same dots."
)]
pub struct CompareArgs {
    /// Two photon lists (PLY or CSV, with at least the columns x, y and z) or two PNG pictures,
    /// the reference first. With --seed or --photons, one list: the reference is traced
    #[arg(value_name = "FILE", required = true, num_args = 1..=2)]
    files: Vec<PathBuf>,
    /// For lists: two positions closer than this are the same, as a fraction of the scene's longest
    /// edge (0.0001 is a fifth of a millimeter in a box of two meters)
    #[arg(long, value_name = "T", default_value_t = TOLERANCE, value_parser = part)]
    tolerance: f32,
    /// For lists: the fraction of the records that may differ while the lists still count as the
    /// same (0.001 allows one in a thousand)
    #[arg(long, value_name = "PART", default_value_t = 0.0, value_parser = part)]
    allow: f32,
    /// For lists: count a list as different if it is the same only under another fair reading of
    /// the handout
    #[arg(long)]
    strict: bool,
    /// For pictures: how many pixels may have a dot in only one of the two. The framework's picture
    /// of the reference's list has up to 5
    #[arg(long, value_name = "N", default_value_t = 0)]
    dots: u64,
    /// For pictures: where to write the difference picture; if the name ends in .html, a page with
    /// the difference, a legend and both pictures
    #[arg(long, value_name = "DIFF.png|DIFF.html")]
    out: Option<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    run: RunArgs,
}

fn part(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| (0.0..=1.0).contains(number));
    number.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// Compares, and prints the report.
///
/// # Errors
/// When an input cannot be read or an output cannot be written.
pub fn run(arguments: &CompareArgs) -> Result<u8, CliError> {
    if let [reference, submission] = arguments.files.as_slice() {
        match (is_picture(reference)?, is_picture(submission)?) {
            (true, true) => return pictures(arguments, reference, submission),
            (false, false) => {}
            (is_first, _) => {
                let list = if is_first { submission } else { reference };
                return Err(CliError::Argument(format!(
                    "{}: expected a picture like the other file, or two photon lists",
                    list.display()
                )));
            }
        }
    }
    if arguments.out.is_some() {
        return Err(CliError::Argument("--out: expected two pictures to compare".to_owned()));
    }
    lists(arguments)
}

fn is_picture(path: &Path) -> Result<bool, CliError> {
    let unreadable = |error| CliError::unreadable(path, error);
    if path == Path::new(STANDARD_INPUT) {
        return Ok(false);
    }
    reader::refuse_pipe(path)?;
    let mut file = File::open(path).map_err(unreadable)?;
    // What a pipe has given once it does not give again.
    if !file.metadata().map_err(unreadable)?.is_file() {
        return Ok(false);
    }
    let mut start = [0; 8];
    match file.read_exact(&mut start) {
        Ok(()) => Ok(start == PNG),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(false),
        Err(error) => Err(unreadable(error)),
    }
}

fn lists(arguments: &CompareArgs) -> Result<u8, CliError> {
    let mut run = arguments.run.load()?;
    let mut named = None;
    let (reference, mut submission) = match arguments.files.as_slice() {
        [reference, submission] => {
            named = name_run(arguments, reference, &mut run);
            let load = |path| move || load_list(path);
            let (reference, submission) = rayon::join(load(reference), load(submission));
            let [(first, of_first), (second, of_second)] = [reference?, submission?];
            tell(&arguments.files[0], of_first);
            tell(&arguments.files[1], of_second);
            (first, second)
        }
        [submission, ..] if arguments.run.seed.is_some() || arguments.run.photons.is_some() => {
            if is_picture(submission)? {
                let submission = submission.display();
                let message = format!("{submission}: expected a photon list, found a picture");
                return Err(CliError::Argument(message));
            }
            let (list, note) = load_list(submission)?;
            tell(submission, note);
            (trace(&run, arguments.quiet), list)
        }
        files => {
            let count = files.len();
            return Err(CliError::Argument(format!(
                "expected the files REFERENCE and SUBMISSION, found {count}; to compare one list \
                 with the reference, add --seed 148 --photons N"
            )));
        }
    };
    let mut notes = Vec::new();
    let mut outside = 0;
    if let Some(part) = &named {
        if part.scene != run.part(0..0).scene {
            notes.push("the reference is the list of another scene, light or reading".to_owned());
        }
        if submission.columns.photon && part.range != (0..part.emitted) {
            let before = submission.records.len();
            submission.records.retain(|record| part.range.contains(&u64::from(record.photon)));
            outside = before - submission.records.len();
            if outside > 0 {
                let Range { start, end } = part.range;
                notes.push(format!(
                    "the reference has only the photons {start}..{end}; {outside} records of the \
                     submission lie outside and are not compared"
                ));
            }
        }
    }
    // Lists have world positions, and a scene need not be traced at its own size.
    let tolerance = arguments.tolerance * run.size();
    let waiting = progress::waiting(arguments.quiet, "comparing");
    let mut report = compare(&reference, &submission, Some(&run), tolerance, arguments.allow);
    waiting.finish_and_clear();
    if outside > 0 {
        // What was left out cannot be called the same.
        report.outcome = Outcome::Different;
        report.sha256 = None;
    }
    notes.iter().for_each(|note| report.add_note(note));
    finish(arguments, &report, &report.text(), report.outcome)
}

/// Sets what the arguments leave open to what the list `reference` says of its run, and gives that.
fn name_run(arguments: &CompareArgs, reference: &Path, run: &mut Run) -> Option<RunPart> {
    // What a pipe has given once it does not give again.
    if !reference.is_file() {
        return None;
    }
    let comments = ply::comments(reference).unwrap_or_default();
    let part = RunPart::from_comments(&comments)?;
    if arguments.run.seed.is_none() {
        run.renderer.seed = part.seed;
    }
    if arguments.run.photons.is_none() {
        run.renderer.photon_count = part.emitted;
    }
    if arguments.run.max_bounces.is_none() {
        run.renderer.max_photon_bounces = part.max_bounces;
    }
    let reading = run.reading;
    if part.scene != run.part(0..0).scene {
        run.reading = Reading::LETTER_OF_THE_HANDOUT;
        if part.scene != run.part(0..0).scene {
            run.reading = reading;
        }
    }
    Some(part)
}

fn trace(run: &Run, quiet: bool) -> PhotonList {
    let mut records: Vec<PhotonRecord> = Vec::new();
    let bar = progress::bar(quiet, "photons", run.renderer.emitted());
    let traced: Result<_, std::convert::Infallible> =
        run.trace_list(0..run.renderer.emitted(), |piece, done| {
            records.extend_from_slice(piece);
            bar.set_position(done);
            Ok(())
        });
    let Ok(_) = traced;
    bar.finish_and_clear();
    PhotonList::of(records)
}

fn pictures(arguments: &CompareArgs, reference: &Path, submission: &Path) -> Result<u8, CliError> {
    let (reference, submission) = (read_picture(reference)?, read_picture(submission)?);
    let (report, difference) = compare_pictures(&reference, &submission, arguments.dots);
    let page = arguments.out.as_ref().filter(|path| path.extension().is_some_and(|e| e == "html"));
    if let Some(path) = page {
        let page = difference::page(&reference, &submission, difference.as_ref(), &report.text());
        write(path, &page)?;
    } else if let Some((path, difference)) = arguments.out.as_ref().zip(difference) {
        let mut file = OutputFile::create(path)?;
        let mut png = io::BufWriter::new(file.file());
        let written = difference.write_to(&mut png, image::ImageFormat::Png);
        let flushed = written.map_err(io::Error::other).and_then(|()| io::Write::flush(&mut png));
        drop(png);
        flushed.map_err(|error| CliError::unwritable(path, error))?;
        file.persist()?;
    }
    finish(arguments, &report, &report.text(), report.outcome)
}

fn read_picture(path: &Path) -> Result<image::RgbImage, CliError> {
    read_any_picture(path).map_err(|reason| {
        CliError::Argument(format!("{}: expected a PNG picture: {reason}", path.display()))
    })
}

fn finish(
    arguments: &CompareArgs,
    report: &impl Serialize,
    text: &str,
    outcome: Outcome,
) -> Result<u8, CliError> {
    if arguments.json {
        let json = serde_json::to_string(report).expect("a report has only plain values");
        print(&(json + "\n"))?;
    } else {
        print(text)?;
    }
    let differs = match outcome {
        Outcome::Different => true,
        Outcome::SameUnderAnotherReading => arguments.strict,
        Outcome::Identical | Outcome::WithinTolerance => false,
    };
    Ok(if differs { DIFFERENT } else { 0 })
}
