//! From the files and folders that a grader names to one submission a student.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::submission::Submission;
use super::text::printable;
use photon_list::reader::starts_like_a_list;

/// A student's folder that has more in it is none.
const MOST_ENTRIES: usize = 10_000;
const MOST_LEVELS: usize = 6;
/// Larger files are not held against each other.
const MOST_COMPARED: u64 = 1 << 28;
/// How pictures start: PNG, JPEG, GIF, BMP, TIFF, WebP, and the framework's own PPM.
const PICTURES: [&[u8]; 9] = [
    b"\x89PNG\r\n\x1a\n",
    b"\xff\xd8\xff",
    b"GIF8",
    b"BM",
    b"II*\0",
    b"MM\0*",
    b"RIFF",
    b"P6",
    b"P3",
];

/// How packed files start, and what they are.
const PACKED: [(&[u8], &str); 7] = [
    (b"\x1f\x8b", "gzip"),
    (b"PK\x03\x04", "zip"),
    (b"\xfd7zXZ\0", "xz"),
    (b"7z\xbc\xaf\x27\x1c", "7-Zip"),
    (b"Rar!", "RAR"),
    (b"BZh", "bzip2"),
    (b"\x28\xb5\x2f\xfd", "Zstandard"),
];

/// A submission, and what there is to say about its files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandedIn {
    /// The submission.
    pub submission: Submission,
    /// Why it cannot be graded at all.
    pub problem: Option<String>,
    /// What was left out.
    pub notes: Vec<String>,
    /// Which others have the same files.
    pub twins: Vec<String>,
}

/// The submissions named by `paths`, in that order: a student's folder is one, a file is one, a list and a
/// picture that differ in the extension alone are one, and a class's folder has one in each folder in it.
pub fn collect(paths: &[PathBuf]) -> Vec<HandedIn> {
    let mut all: Vec<HandedIn> = Vec::new();
    let students = |path: &PathBuf| match students(path) {
        Some(students) => students.into_iter().map(|student| (student, true)).collect(),
        None => vec![(path.clone(), false)],
    };
    let (paths, of_class): (Vec<PathBuf>, Vec<bool>) = paths.iter().flat_map(students).unzip();
    for (path, of_class) in paths.iter().zip(of_class) {
        let handed_in = if of_class && path.is_symlink() {
            // It may lead to another student's files, or anywhere.
            let problem = "it is a link, which is not followed".to_owned();
            HandedIn { problem: Some(problem), ..HandedIn::default() }
        } else if path.is_dir() {
            from_folder(path)
        } else {
            from_file(path)
        };
        all.push(HandedIn {
            submission: Submission { name: name(path), ..handed_in.submission },
            ..handed_in
        });
    }
    join_stems(&mut all, &paths);
    let mut seen: HashMap<String, usize> = HashMap::new();
    for handed_in in &mut all {
        let times = seen.entry(handed_in.submission.name.clone()).or_default();
        *times += 1;
        if *times > 1 {
            handed_in.submission.name += &format!(" ({times})");
        }
    }
    tell_twins(&mut all);
    all
}

/// What a class's students handed in, if `folder` is that of a class: it has no list or picture itself, but at least
/// two folders in it have one. What they lack, and what is a link or packed, is said in each one's grade.
fn students(folder: &Path) -> Option<Vec<PathBuf>> {
    let (mut folders, mut others) = (Vec::new(), Vec::new());
    for entry in fs::read_dir(folder).ok()? {
        let entry = entry.ok()?;
        let (path, kind) = (entry.path(), entry.file_type().ok()?);
        if entry.file_name().to_string_lossy().starts_with('.') {
            continue;
        }
        if kind.is_dir() {
            folders.push(path);
        } else if kind.is_symlink() || is_called_packed(&path) {
            others.push(path);
        } else if kind.is_file() {
            let is_list = is_called_a_list(&path) || starts_like_a_list(&path).unwrap_or_default();
            if is_list || is_picture(&path).unwrap_or_default() {
                return None;
            }
        }
    }
    let has_files = |folder: &&PathBuf| {
        let Submission { list, picture, .. } = from_folder(folder).submission;
        list.is_some() || picture.is_some()
    };
    let is_class = folders.iter().filter(has_files).take(2).count() == 2;
    folders.append(&mut others);
    folders.sort();
    is_class.then_some(folders)
}

fn is_called_a_list(path: &Path) -> bool {
    has_extension(path, &["csv", "ply"])
}

/// Spreadsheets and documents are packed too, but are not called so.
fn is_called_packed(path: &Path) -> bool {
    has_extension(path, &["zip", "gz", "tgz", "xz", "7z", "rar", "bz2", "zst", "tar"])
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    extensions.iter().any(|known| extension == *known)
}

/// Notes submissions whose files are the same, byte by byte.
fn tell_twins(all: &mut [HandedIn]) {
    for is_list in [true, false] {
        let file = |handed_in: &HandedIn| {
            let Submission { list, picture, .. } = &handed_in.submission;
            if is_list { list.clone() } else { picture.clone() }
        };
        let files: Vec<Option<PathBuf>> = all.iter().map(file).collect();
        let paths: Vec<Option<PathBuf>> =
            files.iter().map(|file| fs::canonicalize(file.as_ref()?).ok()).collect();
        let mut of_contents: HashMap<Contents, Vec<usize>> = HashMap::new();
        for (at, contents) in contents(&files).into_iter().enumerate() {
            if let Some(contents) = contents {
                of_contents.entry(contents).or_default().push(at);
            }
        }
        for twins in of_contents.values().filter(|twins| twins.len() > 1) {
            for at in twins {
                // A file that is named twice is no twin of itself.
                let is_other = |other: &&usize| paths[**other] != paths[*at];
                let names = twins.iter().filter(is_other).take(5);
                let names: Vec<_> =
                    names.map(|other| all[*other].submission.name.clone()).collect();
                if !names.is_empty() {
                    let what = if is_list { "photon list" } else { "picture" };
                    all[*at].twins.push(format!(
                        "the {what} is the same, byte by byte, as that of {}; two right programs with \
                         the same random numbers may write the same",
                        names.join(", ")
                    ));
                }
            }
        }
    }
}

/// How many bytes a file has, and their SHA-256.
type Contents = (u64, [u8; 32]);

/// The contents of those `files` that are as long as another one: no others can be the same.
fn contents(files: &[Option<PathBuf>]) -> Vec<Option<Contents>> {
    let length = |file: &Option<PathBuf>| Some(fs::metadata(file.as_ref()?).ok()?.len());
    let lengths: Vec<Option<u64>> = files.iter().map(length).collect();
    let contents = |at: usize| {
        let length = lengths[at].filter(|length| *length <= MOST_COMPARED)?;
        let is_alone = lengths.iter().filter(|other| **other == Some(length)).count() == 1;
        if is_alone {
            return None;
        }
        let mut hash = Sha256::new();
        let file = File::open(files[at].as_ref()?).ok()?;
        let mut input = io::BufReader::with_capacity(1 << 16, file.take(MOST_COMPARED));
        loop {
            let bytes = io::BufRead::fill_buf(&mut input).ok()?;
            if bytes.is_empty() {
                break;
            }
            hash.update(bytes);
            let read = bytes.len();
            io::BufRead::consume(&mut input, read);
        }
        Some((length, hash.finalize().into()))
    };
    (0..files.len()).map(contents).collect()
}

fn name(path: &Path) -> String {
    let name = path.display().to_string();
    let trimmed = name.trim_end_matches('/');
    printable(if trimmed.is_empty() { &name } else { trimmed })
}

fn from_file(path: &Path) -> HandedIn {
    let mut handed_in = HandedIn::default();
    let about = match fs::metadata(path) {
        Ok(about) => about,
        Err(error) => {
            handed_in.problem = Some(format!("it cannot be read: {error}"));
            return handed_in;
        }
    };
    if !about.is_file() {
        handed_in.problem = Some("it is neither a file nor a folder".to_owned());
        return handed_in;
    }
    if let Ok(Some(kind)) = packed(path) {
        handed_in.problem = Some(format!("it is packed ({kind}): unpack it first"));
        return handed_in;
    }
    match is_picture(path) {
        Ok(true) => handed_in.submission.picture = Some(path.to_owned()),
        Ok(false) => handed_in.submission.list = Some(path.to_owned()),
        Err(error) => handed_in.problem = Some(format!("it cannot be read: {error}")),
    }
    handed_in
}

fn start(path: &Path) -> io::Result<Vec<u8>> {
    let mut start = Vec::new();
    File::open(path)?.take(16).read_to_end(&mut start)?;
    Ok(start)
}

/// What a file is packed with, if it is.
fn packed(path: &Path) -> io::Result<Option<&'static str>> {
    let start = start(path)?;
    Ok(PACKED.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, kind)| *kind))
}

fn is_picture(path: &Path) -> io::Result<bool> {
    let start = start(path)?;
    Ok(PICTURES.iter().any(|magic| start.starts_with(magic)))
}

/// Joins `alice.csv` and `alice.png`, where there is just one list and one picture of the stem.
fn join_stems(all: &mut Vec<HandedIn>, paths: &[PathBuf]) {
    let mut of_stem: HashMap<PathBuf, (Vec<usize>, Vec<usize>)> = HashMap::new();
    for (at, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_dir()) {
        let (lists, pictures) = of_stem.entry(path.with_extension("")).or_default();
        match &all[at].submission {
            Submission { list: Some(_), .. } => lists.push(at),
            Submission { picture: Some(_), .. } => pictures.push(at),
            _ => {}
        }
    }
    let mut joined = Vec::new();
    for (stem, places) in of_stem {
        if let ([list], [picture]) = (places.0.as_slice(), places.1.as_slice()) {
            let (first, second) = (*list.min(picture), *list.max(picture));
            let later = all[second].submission.clone();
            let submission = &mut all[first].submission;
            submission.list = submission.list.take().or(later.list);
            submission.picture = submission.picture.take().or(later.picture);
            submission.name = name(&stem);
            joined.push(second);
        }
    }
    let mut at = 0;
    all.retain(|_| {
        at += 1;
        !joined.contains(&(at - 1))
    });
}

/// What a folder holds.
#[derive(Default)]
struct Found {
    lists: Vec<PathBuf>,
    pictures: Vec<PathBuf>,
    /// Called like a list, without being one.
    would_be_lists: Vec<PathBuf>,
    notes: Vec<String>,
    entries: usize,
}

fn from_folder(folder: &Path) -> HandedIn {
    let mut found = Found::default();
    let looked = fs::canonicalize(folder).and_then(|root| look_into(folder, &root, 0, &mut found));
    let mut handed_in = HandedIn { notes: found.notes, ..HandedIn::default() };
    if let Err(error) = looked {
        handed_in.problem = Some(format!("it cannot be read: {error}"));
        return handed_in;
    }
    if found.lists.is_empty() && found.would_be_lists.len() == 1 {
        // Its reader says what is wrong with it.
        found.lists = found.would_be_lists;
    }
    let notes = &mut handed_in.notes;
    let list = choice("photon lists", found.lists, folder, notes);
    let picture = choice("pictures", found.pictures, folder, notes);
    match (list, picture) {
        (Ok(None), Ok(None)) => {
            let mut problem = "it has neither a photon list nor a picture in it".to_owned();
            handed_in.notes.iter().for_each(|note| problem += &format!("; {note}"));
            handed_in.problem = Some(problem);
        }
        (Ok(list), Ok(picture)) => {
            handed_in.submission = Submission { list, picture, ..Submission::default() };
        }
        (Ok(Some(list)), Err(problem)) => {
            handed_in.submission.list = Some(list);
            handed_in.notes.push(problem);
        }
        (Err(problem), _) | (_, Err(problem)) => handed_in.problem = Some(problem),
    }
    handed_in
}

/// The one of several `files` that is meant: any, if they are all the same, else the one called as this
/// program and the handout call it. What is left out is noted.
fn choice(
    what: &str,
    mut files: Vec<PathBuf>,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<Option<PathBuf>, String> {
    if files.len() < 2 {
        return Ok(files.pop());
    }
    let names = |files: &[PathBuf]| -> String {
        let names: Vec<String> = files.iter().take(5).map(|path| within(path, folder)).collect();
        names.join(", ")
    };
    let all: Vec<Option<PathBuf>> = files.iter().cloned().map(Some).collect();
    let contents = contents(&all);
    let is_usual = |path: &PathBuf| {
        let stem = path.file_stem().unwrap_or_default().to_ascii_lowercase();
        ["photons", "assignment8"].iter().any(|usual| stem == *usual)
    };
    let is_same = contents[0].is_some() && contents.iter().all(|other| *other == contents[0]);
    let chosen = match files.iter().filter(|path| is_usual(path)).count() {
        1 => files.iter().position(is_usual),
        _ => is_same.then_some(0),
    };
    let Some(chosen) = chosen else {
        let (names, all) = (names(&files), files.len());
        return Err(format!(
            "there are {all} {what} in it ({names}), of which one is expected, or one of them called \
             photons or assignment8"
        ));
    };
    let chosen = files.remove(chosen);
    let same = if is_same { ", which is the same" } else { "" };
    notes.push(format!(
        "of several {what}, {} is judged, and left out: {}{same}",
        within(&chosen, folder),
        names(&files)
    ));
    Ok(Some(chosen))
}

fn within(path: &Path, folder: &Path) -> String {
    printable(&path.strip_prefix(folder).unwrap_or(path).display().to_string())
}

fn look_into(folder: &Path, root: &Path, level: usize, found: &mut Found) -> io::Result<()> {
    let mut entries = Vec::new();
    for entry in fs::read_dir(folder)? {
        entries.push(entry?);
        found.entries += 1;
        if found.entries > MOST_ENTRIES || level > MOST_LEVELS {
            return Err(io::Error::other(format!(
                "expected a student's folder, found more than {MOST_ENTRIES} files or \
                 {MOST_LEVELS} levels"
            )));
        }
    }
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        let name = printable(&entry.file_name().to_string_lossy());
        // What systems leave: .DS_Store, ._photons.csv, .git.
        if name.starts_with('.') {
            continue;
        }
        let kind = entry.file_type()?;
        if kind.is_symlink() {
            // What a link within the folder leads to is found without it.
            if !fs::canonicalize(&path).is_ok_and(|target| target.starts_with(root)) {
                found.notes.push(format!("the link {name} leads out of the folder"));
            }
        } else if kind.is_dir() {
            look_into(&path, root, level + 1, found)?;
        } else if !kind.is_file() {
            found.notes.push(format!("{name} is neither a file nor a folder"));
        } else if let Some(kind) = packed(&path)? {
            found.notes.push(format!("{name} is packed ({kind}): unpack it first"));
        } else if is_picture(&path)? {
            found.pictures.push(path);
        } else if starts_like_a_list(&path)? {
            found.lists.push(path);
        } else if is_called_a_list(&path) {
            found.would_be_lists.push(path);
        }
    }
    Ok(())
}
