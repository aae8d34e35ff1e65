//! `photon-mapping merge`: the pieces that `render --range` made become one.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Deserialize;

use super::error::CliError;
use super::input;
use super::other_format::{other_format, tell};
use super::output::OutputFile;
use super::run_summary::{Summary, print_summary};
use oracle::summary::{Counts, Tally};
use oracle::table::ExpectedTable;
use photon_list::error::ListError;
use photon_list::run::RunPart;
use photon_list::writer::{Format, ListWriter};
use photon_list::{ply, reader};
use photon_mapping::photon_list::ListHash;
use variants::run::is_of_assignment8;

/// Records are handed on in pieces of this many.
const RECORDS_AT_ONCE: usize = 4096;

/// The options of `merge`.
#[derive(Debug, Args)]
pub struct MergeArgs {
    /// The pieces in any order: PLY lists, or the JSON of `--count-only --json`
    #[arg(required = true, value_name = "PIECE")]
    pieces: Vec<PathBuf>,
    /// The list to write, PLY or, when its name ends in .csv, CSV; needed for lists
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the summary as JSON; that of counts can be merged again
    #[arg(long)]
    json: bool,
}

/// What is read of the JSON of `--count-only`.
#[derive(Deserialize)]
struct CountOnly {
    run: RunPart,
    counts: Counts,
}

/// Merges, and prints the summary.
///
/// # Errors
/// When the pieces are not neighbors of one run, or cannot be read, or the list cannot be written.
pub fn run(arguments: &MergeArgs) -> Result<u8, CliError> {
    let is_list = |path: &PathBuf| match other_format(path) {
        Some(found) if !starts_with(path, b"{")? => {
            Err(malformed(path, format!("expected a PLY list of render, found {found}")))
        }
        _ => starts_with(path, b"ply"),
    };
    let lists: Vec<bool> = arguments.pieces.iter().map(is_list).collect::<Result<_, _>>()?;
    let summary = match &arguments.out {
        Some(out) if lists.iter().all(|is_list| *is_list) => merge_lists(arguments, out)?,
        None if !lists.contains(&true) => merge_counts(arguments)?,
        Some(_) => {
            let other = lists.iter().position(|is_list| !is_list).unwrap_or_default();
            return Err(no_list(&arguments.pieces[other])?);
        }
        None => {
            let message = "expected --out FILE to merge lists into, or summaries alone";
            return Err(CliError::Argument(message.to_owned()));
        }
    };
    print_summary(&summary, arguments.json)
}

/// What to do about the piece `path`, which is no PLY list where one is needed.
fn no_list(path: &Path) -> Result<CliError, CliError> {
    let advice = match starts_with(path, b"{")? {
        true => "counts are merged without --out",
        false => {
            "no other file names its run; trace it with --format ply (--out FILE.csv merges into \
             CSV)"
        }
    };
    Ok(malformed(path, format!("expected a PLY list of render: {advice}")))
}

fn starts_with(path: &Path, start: &[u8]) -> Result<bool, CliError> {
    let unreadable = |source| ListError::Unreadable { path: path.to_owned(), source };
    if path == Path::new("-") {
        let message = "-: expected the names of files; merge does not read standard input";
        return Err(CliError::Argument(message.to_owned()));
    }
    reader::refuse_pipe(path)?;
    let mut first = Vec::new();
    let file = fs::File::open(path).map_err(unreadable)?;
    file.take(start.len() as u64).read_to_end(&mut first).map_err(unreadable)?;
    Ok(first == start)
}

/// The order in which the pieces follow each other, and the part of the run that they make up.
fn join(arguments: &MergeArgs, parts: &[RunPart]) -> Result<(Vec<usize>, RunPart), CliError> {
    let mut order: Vec<usize> = (0..parts.len()).collect();
    let whole = RunPart::join(parts, &mut order).map_err(|(before, after, message)| {
        let [before, after] = [before, after].map(|piece| arguments.pieces[piece].display());
        CliError::Argument(format!("{before} and {after} {message}"))
    })?;
    Ok((order, whole))
}

fn merge_lists(arguments: &MergeArgs, out: &Path) -> Result<Summary, CliError> {
    let headers: Vec<Vec<String>> =
        arguments.pieces.iter().map(|path| ply::comments(path)).collect::<Result<_, _>>()?;
    let run_of = |(path, comments): (&PathBuf, &Vec<String>)| {
        RunPart::from_comments(comments)
            .ok_or_else(|| malformed(path, "expected a header that names the run"))
    };
    let parts: Vec<RunPart> =
        arguments.pieces.iter().zip(&headers).map(run_of).collect::<Result<_, _>>()?;
    let (order, whole) = join(arguments, &parts)?;
    let surfaces: Vec<String> =
        headers[order[0]].iter().filter(|line| line.starts_with("surface ")).cloned().collect();
    let names =
        surfaces.iter().map(|line| line.splitn(3, ' ').nth(2).unwrap_or_default().to_owned());
    let mut tally = Tally::new(names);
    let mut hash = ListHash::default();
    let mut file = OutputFile::create(out)?;
    let is_csv = out.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    let format = if is_csv { Format::Csv } else { Format::Ply };
    let mut comments = whole.comments();
    comments.extend(surfaces.iter().cloned());
    let unwritable = |error| CliError::unwritable(out, error);
    let mut writer = ListWriter::new(file.file(), format, comments).map_err(unwritable)?;
    for piece in order {
        let path = &arguments.pieces[piece];
        let range = &parts[piece].range;
        let mut records = Vec::new();
        let mut last = None;
        let mut result = Ok(());
        let (_, note) = reader::read(path, |record| {
            let place = (record.photon, record.bounce);
            let fits = range.contains(&u64::from(record.photon))
                && last.is_none_or(|last| last < place)
                && record.bounce > 0
                && usize::from(record.surface) < surfaces.len();
            if result.is_err() {
                return;
            }
            if !fits {
                let photon = record.photon;
                result = Err(malformed(path, format!("photon {photon} is out of place")));
                return;
            }
            last = Some(place);
            tally.add(&record);
            records.push(record);
            if records.len() == RECORDS_AT_ONCE {
                hash.update(&records);
                result = writer.write(&records).map_err(unwritable);
                records.clear();
            }
        })?;
        result?;
        tell(path, note);
        hash.update(&records);
        writer.write(&records).map_err(unwritable)?;
    }
    writer.finish().map_err(unwritable)?;
    let files = vec![file.path().to_owned()];
    file.persist()?;
    Ok(Summary { sha256: Some(hash.hex()), files, ..summary(&whole, &tally) })
}

fn merge_counts(arguments: &MergeArgs) -> Result<Summary, CliError> {
    let read = |path: &PathBuf| -> Result<CountOnly, CliError> {
        let text = input::text(path)?;
        let expected = "expected a PLY list or the JSON of --count-only --json; a list in CSV does \
                        not name its run: trace it with --format ply";
        serde_json::from_str(&text).map_err(|_| malformed(path, expected))
    };
    let pieces: Vec<CountOnly> = arguments.pieces.iter().map(read).collect::<Result<_, _>>()?;
    let parts: Vec<RunPart> = pieces.iter().map(|piece| piece.run.clone()).collect();
    let (order, whole) = join(arguments, &parts)?;
    let mut tally = Tally::new(pieces[order[0]].counts.names.iter().cloned());
    for piece in order {
        if !tally.add_counts(&pieces[piece].counts) {
            return Err(malformed(&arguments.pieces[piece], "has other surfaces"));
        }
    }
    let counts = Some(tally.counts());
    Ok(Summary { counts, run: Some(whole.clone()), ..summary(&whole, &tally) })
}

fn summary(whole: &RunPart, tally: &Tally) -> Summary {
    let emitted = whole.range.end - whole.range.start;
    let expected = is_of_assignment8(whole).then(ExpectedTable::of_assignment8);
    let max_bounces = whole.max_bounces.max(0) as usize;
    let (surfaces, total) = tally.surfaces(emitted, max_bounces, expected.as_ref());
    Summary {
        seed: Some(whole.seed),
        emitted: Some(emitted),
        stored: tally.stored(),
        surfaces,
        total: Some(total),
        ..Summary::default()
    }
}

fn malformed(path: &Path, message: impl Into<String>) -> CliError {
    ListError::malformed(path, message.into()).into()
}
