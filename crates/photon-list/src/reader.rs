//! Reading lists, whoever wrote them.

use std::fs::{self, File};
use std::io::{self, BufReader, Cursor, Read};
use std::path::Path;

use glam::Vec3;
use photon_mapping::photon_list::{COLUMNS, PhotonRecord};

use super::csv::{self, TextStart};
use super::error::{ListError, Reason};
use super::naming::Naming;
use super::ply::{self, Header};
use super::record::{Columns, Rows};
use super::text::{Lines, decoded};

/// No longer list is graded: the positions of five million records have 60 MB in PLY, and time
/// grows with the bytes.
pub const MOST_BYTES: u64 = 100_000_000;
/// So much of a file is looked at to see whether it is a list.
pub const LONGEST_START: u64 = 65_536;
/// So much of it is kept, to tell which other format it has.
const KEPT: u64 = 4096;
/// Memory is taken for at least so many records at once.
const LEAST_RESERVED: usize = 1024;
/// The name of standard input.
pub const STANDARD_INPUT: &str = "-";

/// A list in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotonList {
    /// What the list has besides positions; other columns of its records are
    /// [`super::record::ABSENT`].
    pub columns: Columns,
    /// The records, in the file's order.
    pub records: Vec<PhotonRecord>,
}

impl PhotonList {
    /// The list of `records`, which tell everything.
    pub fn of(records: Vec<PhotonRecord>) -> Self {
        Self { columns: Columns::ALL, records }
    }
}

/// What is to be said about how a list is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes {
    /// What had to be guessed.
    pub guessed: Option<String>,
    /// Why a column was left out, for each that was.
    pub left_out: Vec<Reason>,
}

/// What a file looks like from its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// No list.
    Other,
    /// Three columns, but too few rows, too far away, or the corners of faces.
    Unlikely,
    /// A list of photons.
    List,
}

/// Reads the list `path` into memory; `-` is standard input.
///
/// # Errors
/// When the file cannot be read or is not a list.
pub fn load(path: &Path) -> Result<PhotonList, ListError> {
    let mut records = Vec::new();
    let (columns, _) = read(path, |record| records.push(record))?;
    Ok(PhotonList { columns, records })
}

/// Reads the list `path` into memory if it is a file of no more than `most` records, in bounded
/// time and memory whatever it holds. Columns besides the position that cannot be read are left
/// out; the notes say so.
///
/// # Errors
/// When the file cannot be read, is not a list, or is too long.
pub fn load_at_most(path: &Path, most: usize) -> Result<(PhotonList, Notes), ListError> {
    // To open a pipe would be to wait for its other end.
    let about = fs::metadata(path).map_err(|error| ListError::unreadable(path, error))?;
    if !about.is_file() {
        return Err(ListError::malformed(path, "expected a file, found a folder, pipe or device"));
    }
    if about.len() > MOST_BYTES {
        let [most, found] = [MOST_BYTES, about.len()].map(|bytes| bytes / 1_000_000);
        let message = format!("expected a list of at most {most} MB, found {found} MB");
        return Err(ListError::malformed(path, message));
    }
    let mut records: Vec<PhotonRecord> = Vec::new();
    let mut rows = Rows::new(path, false, |record| {
        if records.len() == most {
            return Err(ListError::TooLong { path: path.to_owned(), most });
        }
        if records.len() == records.capacity() {
            // Twice as much, as vectors grow, is a lot for long lists.
            records.reserve_exact(LEAST_RESERVED.max(records.len() / 4));
        }
        records.push(record);
        Ok(true)
    });
    let naming = read_file(path, MOST_BYTES, &mut rows)?;
    let mut columns = naming.columns;
    let mut left_out = Vec::new();
    for (place, error) in rows.left_out.into_iter().enumerate() {
        let Some(ListError::Malformed { reason, .. }) = error else { continue };
        let message = format!("the column '{}' is left out: {}", COLUMNS[place], reason.message);
        left_out.push(Reason { message, ..reason });
        columns.forget(place, &mut records);
    }
    Ok((PhotonList { columns, records }, Notes { guessed: naming.note, left_out }))
}

/// What the file `path` looks like from its start.
///
/// # Errors
/// When the file cannot be read.
pub fn look(path: &Path) -> io::Result<Look> {
    /// A list beside a picture has more rows than what people note in a few lines.
    const FEWEST: usize = 20;
    /// The handout's scene is within 2 of the origin.
    const FARTHEST: Vec3 = Vec3::splat(10.0);
    let input = match open(path, LONGEST_START) {
        Ok(input) => input,
        Err(ListError::Unreadable { source, .. }) => return Err(source),
        Err(_) => return Ok(Look::Other),
    };
    let is_mesh = matches!(&input, Input::Ply(_, header) if header.is_mesh());
    let (mut seen, mut is_near) = (0, false);
    let mut rows = Rows::new(path, false, |record: PhotonRecord| {
        seen += 1;
        is_near |= !record.position.abs().cmpgt(FARTHEST).any();
        Ok(seen < FEWEST)
    });
    // Where the start ends within a row, that is wrong.
    let has_columns = read_rows(input, &mut rows).is_ok();
    Ok(match seen >= FEWEST && is_near && !is_mesh {
        true => Look::List,
        false if seen > 0 || has_columns => Look::Unlikely,
        false => Look::Other,
    })
}

/// Reads the list `path`, PLY or text as its first bytes tell, and hands over record after record;
/// `-` is standard input. It may have any of the columns of [`COLUMNS`], in any order, if x, y and
/// z are among them. Gives the columns, and remarks on what was guessed or passed over.
///
/// # Errors
/// When the file cannot be read or is not a list.
pub fn read(
    path: &Path,
    mut on_record: impl FnMut(PhotonRecord),
) -> Result<(Columns, Option<String>), ListError> {
    let mut rows = Rows::new(path, true, |record| {
        on_record(record);
        Ok(true)
    });
    let naming = read_file(path, u64::MAX, &mut rows)?;
    Ok((naming.columns, naming.note))
}

/// Reads the rows in at most `most` bytes of the file `path`.
fn read_file(
    path: &Path,
    most: u64,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<Naming, ListError> {
    let mut start = Vec::new();
    let input = open_and_keep(path, most, &mut start);
    let naming = input.and_then(|input| read_rows(input, rows));
    naming.map_err(|error| error.starting_with(start))
}

fn read_rows(
    input: Input<'_>,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<Naming, ListError> {
    match input {
        Input::Ply(mut lines, header) => ply::read(&mut lines, &header, rows),
        Input::Text(mut lines, start) => csv::read(&mut lines, start, rows),
    }
}

type InputLines<'path> = Lines<'path, BufReader<Box<dyn Read>>>;

/// A list up to its first row.
pub(super) enum Input<'path> {
    Ply(InputLines<'path>, Header),
    Text(InputLines<'path>, TextStart),
}

/// Opens the list `path`, of which at most `most` bytes are read.
pub(super) fn open(path: &Path, most: u64) -> Result<Input<'_>, ListError> {
    open_and_keep(path, most, &mut Vec::new())
}

/// The same; the first bytes go to `start`: what a pipe has given once it does not give again.
fn open_and_keep<'path>(
    path: &'path Path,
    most: u64,
    start: &mut Vec<u8>,
) -> Result<Input<'path>, ListError> {
    let unreadable = |error| ListError::unreadable(path, error);
    let file: Box<dyn Read> = if path == Path::new(STANDARD_INPUT) {
        Box::new(io::stdin())
    } else {
        refuse_pipe(path)?;
        Box::new(File::open(path).map_err(unreadable)?)
    };
    let mut file = file.take(most);
    file.by_ref().take(KEPT).read_to_end(start).map_err(unreadable)?;
    let input = decoded(Cursor::new(start.clone()).chain(file)).map_err(unreadable)?;
    let mut lines = Lines::new(input, path);
    let mut first = None;
    // Editors and consoles put empty lines before a list.
    while let Some((number, line)) = lines.next()? {
        if !line.trim().is_empty() {
            first = Some((number, line.into_owned()));
            break;
        }
    }
    if first.as_ref().is_some_and(|(_, line)| ply::is_magic(line)) {
        let header = Header::read(&mut lines)?;
        return Ok(Input::Ply(lines, header));
    }
    let start = csv::start(&mut lines, first)?;
    Ok(Input::Text(lines, start))
}

/// Refuses a pipe with a name, whose other end may never come; a shell's own are in `/dev` or
/// `/proc`.
///
/// # Errors
/// When `path` is such a pipe.
#[cfg_attr(not(unix), expect(unused_variables, reason = "pipes with a name are a thing of Unix"))]
pub fn refuse_pipe(path: &Path) -> Result<(), ListError> {
    #[cfg(unix)]
    if let Ok(about) = fs::metadata(path)
        && std::os::unix::fs::FileTypeExt::is_fifo(&about.file_type())
        && !path.starts_with("/dev")
        && !path.starts_with("/proc")
    {
        return Err(ListError::malformed(
            path,
            "expected a file, found a pipe: use standard input",
        ));
    }
    Ok(())
}
