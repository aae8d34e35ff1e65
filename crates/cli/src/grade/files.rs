//! The files of a class: what each is called, and what they say of the run that wrote them.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::error::CliError;
use crate::output;

/// The page with links to all others.
pub const INDEX: &str = "index.html";
/// The longest name of a file without number and extension, in bytes. Systems allow 255 in all.
const LONGEST_NAME: usize = 100;

/// The folder `out` where `count` submissions get a file each, with the `extension` of a format
/// that has such, and the names of these files. None where there is one submission and `out` is its
/// file.
///
/// # Errors
/// If `out` cannot be such a folder, has files of another run, or is handed in.
pub fn places_of_each<'a>(
    extension: Option<&str>,
    out: Option<&Path>,
    names: impl Iterator<Item = &'a str>,
    count: usize,
) -> Result<(Option<PathBuf>, Vec<String>), CliError> {
    let files = file_names(names, extension.unwrap_or_default());
    let is_folder =
        |out: &Path| out.is_dir() || out.to_string_lossy().ends_with(std::path::is_separator);
    let folder = match (extension, out) {
        (Some(_), Some(out)) if count > 1 || is_folder(out) => output::folder(out)?,
        (Some(_), None) if count > 1 => {
            return Err(CliError::Argument(format!(
                "--out: expected a folder, for each of {count} submissions has a file of its own"
            )));
        }
        (_, out) => {
            out.map_or(Ok(()), output::refuse_protected)?;
            return Ok((None, files));
        }
    };
    let index = (extension == Some("html")).then_some(INDEX);
    let written = files.iter().map(String::as_str).chain(index);
    written.map(|name| folder.join(name)).try_for_each(|path| output::refuse_protected(&path))?;
    refuse_others(folder, &files, extension.unwrap_or_default())?;
    Ok((Some(folder.to_owned()), files))
}

/// The file names for the submissions `names`: without characters that systems forbid or that lead
/// to another folder, and with `extension`.
fn file_names<'a>(names: impl Iterator<Item = &'a str>, extension: &str) -> Vec<String> {
    // Also for systems that do not tell capitals apart.
    let mut seen = HashSet::from(["index".to_owned()]);
    let mut unique = |name: &str| {
        let plain = plain(name);
        let numbered = (2..).map(|number| format!("{plain}-{number}"));
        let mut names = std::iter::once(plain.clone()).chain(numbered);
        names.find(|name| seen.insert(name.to_lowercase())).expect("there is always another number")
    };
    names.map(|name| unique(name) + "." + extension).collect()
}

/// Refuses a `folder` with other files of `extension` than `files`: pages of an earlier run would
/// look like pages of this one.
///
/// # Errors
/// When there is such a file.
fn refuse_others(folder: &Path, files: &[String], extension: &str) -> Result<(), CliError> {
    let Ok(entries) = fs::read_dir(folder) else { return Ok(()) };
    let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let is_other = |name: &String| {
        Path::new(name).extension().is_some_and(|its| its == extension)
            && !files.contains(name)
            && name != INDEX
    };
    match names.filter(is_other).min() {
        Some(name) => Err(CliError::Argument(format!(
            "--out: expected a folder without files of another run, found {}: remove them, or \
             name another folder",
            folder.join(name).display()
        ))),
        None => Ok(()),
    }
}

/// The program, the day in UTC, and the command line. With `anonymous`, no command line, because it
/// may have names.
pub fn made_by(is_anonymous: bool) -> String {
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let day = &now[.."2026-01-01".len()];
    let words: Vec<String> =
        std::env::args().skip(1).map(|word| word.replace(['\n', '\r'], " ")).collect();
    let command = match is_anonymous {
        true => String::new(),
        false => format!(": photon-mapping {}", words.join(" ")),
    };
    format!("photon-mapping {}, {day}{command}", env!("CARGO_PKG_VERSION"))
}

/// The last part of `name` as the name of a file.
fn plain(name: &str) -> String {
    let path = Path::new(name);
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let is_plain = |letter: char| letter.is_alphanumeric() || "-_.".contains(letter);
    let mut plain: String = name.chars().map(|c| if is_plain(c) { c } else { '_' }).collect();
    while plain.len() > LONGEST_NAME {
        plain.pop();
    }
    match plain.trim_start_matches('.') {
        "" => "submission".to_owned(),
        plain => plain.to_owned(),
    }
}
