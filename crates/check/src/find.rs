//! The two files of a submission, wherever they lie in what was handed in.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use encoding_rs::{Encoding, UTF_8};

use crate::error::CheckError;

/// The file with `GenerateRandomPhotonRay`.
pub(crate) const LIGHT: &str = "PointLight.cpp";
/// The file with `TracePhoton`.
pub(crate) const RENDERER: &str = "PhotonMappingRenderer.cpp";
/// Where the framework keeps the light's files.
pub(crate) const LIGHT_FOLDER: &str = "common/Scene/Lights/Point";
/// Where the framework keeps the renderer's files.
pub(crate) const RENDERER_FOLDER: &str = "common/Rendering/Renderer/Photon";
/// What the light's file defines.
const EMISSION: &str = "PointLight::GenerateRandomPhotonRay";
/// What the renderer's file defines.
const TRACING: &str = "PhotonMappingRenderer::GenericPhotonMapGeneration";

/// Folders deeper than this are not searched.
const DEEPEST: usize = 12;
/// After so many files, the search ends.
const MOST_FILES: usize = 20_000;
/// A larger file is not taken for source code.
const LARGEST: u64 = 1 << 20;
/// The extensions of headers.
const HEADERS: [&str; 6] = ["h", "hpp", "hh", "hxx", "inl", "ipp"];
/// The extensions of sources.
pub(crate) const SOURCES: [&str; 3] = ["cpp", "cc", "cxx"];
/// So many headers and sources beside the two files are taken along.
const MOST_BESIDE: usize = 200;

/// What was handed in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CppSubmission {
    /// What it is called in the report.
    pub name: String,
    /// The file with the emission, if there is one.
    pub light: Option<PathBuf>,
    /// The file with `TracePhoton`, if there is one.
    pub renderer: Option<PathBuf>,
    /// The folder in which all of it lies.
    pub root: Option<PathBuf>,
    /// The headers in that folder, in the order in which they were found.
    pub headers: Vec<PathBuf>,
    /// What is worth saying about the search.
    pub notes: Vec<String>,
}

impl CppSubmission {
    /// Finds the two files in `path`: a folder anywhere above them, or one of them, with the other
    /// beside it.
    ///
    /// # Errors
    /// When `path` cannot be read.
    pub fn find(path: &Path) -> Result<Self, CheckError> {
        let about = fs::metadata(path)
            .map_err(|source| CheckError::Unreadable { path: path.to_owned(), source })?;
        let folder = if about.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let mut submission = Self { name: name_of(path), ..Self::default() };
        let mut search = FileSearch::default();
        search.look_into(folder, 0);
        submission.light = search.choose([LIGHT, LIGHT_FOLDER, EMISSION], &mut submission.notes);
        submission.renderer =
            search.choose([RENDERER, RENDERER_FOLDER, TRACING], &mut submission.notes);
        submission.root = Some(folder.to_owned());
        submission.headers = search.headers;
        if search.files >= MOST_FILES {
            submission.notes.push(format!("only the first {MOST_FILES} files were searched"));
        }
        Ok(submission)
    }

    /// The folders in the class `path`, each of which is a submission.
    ///
    /// # Errors
    /// When `path` cannot be read.
    pub fn of_class(path: &Path) -> Result<Vec<PathBuf>, CheckError> {
        let entries = fs::read_dir(path)
            .map_err(|source| CheckError::Unreadable { path: path.to_owned(), source })?;
        let mut folders: Vec<_> = entries
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.is_dir() && !is_hidden(path))
            .collect();
        folders.sort();
        Ok(folders)
    }
}

/// Refuses the folder `path` if it is not one submission: two folders in it have both files each.
///
/// # Errors
/// When it is a class.
pub fn refuse_class(path: &Path) -> Result<(), CheckError> {
    let is_whole = |folder: &PathBuf| {
        let found = CppSubmission::find(folder);
        found.is_ok_and(|found| found.light.is_some() && found.renderer.is_some())
    };
    let folders = CppSubmission::of_class(path).unwrap_or_default();
    let whole: Vec<String> =
        folders.iter().filter(|folder| is_whole(folder)).map(|folder| name_of(folder)).collect();
    match whole.len() {
        0 | 1 => Ok(()),
        _ => Err(CheckError::Ambiguous { path: path.to_owned(), folders: whole.join(", ") }),
    }
}

/// What the submission at `path` is called.
pub fn name_of(path: &Path) -> String {
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    name.chars().map(|letter| if letter.is_control() { '\u{fffd}' } else { letter }).collect()
}

fn is_hidden(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('.') || name == "__MACOSX" || name == "CMakeFiles"
}

/// Source code in UTF-8, which is what all compilers read.
pub(crate) fn read_source(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = fs::read(path)?;
    Ok(match Encoding::for_bom(&bytes) {
        Some((encoding, _)) if encoding != UTF_8 => {
            encoding.decode(&bytes).0.into_owned().into_bytes()
        }
        _ => bytes,
    })
}

fn defines(source: &Path, function: &str) -> bool {
    read_source(source).is_ok_and(|text| String::from_utf8_lossy(&text).contains(function))
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    extensions.contains(&&*extension)
}

#[derive(Default)]
struct FileSearch {
    found: BTreeMap<String, Vec<PathBuf>>,
    headers: Vec<PathBuf>,
    sources: Vec<PathBuf>,
    files: usize,
}

impl FileSearch {
    fn look_into(&mut self, folder: &Path, depth: usize) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut entries: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        entries.sort();
        for path in entries {
            if self.files >= MOST_FILES || is_hidden(&path) {
                continue;
            }
            // Symlinks are not followed: they may lead out of the submission.
            let Ok(about) = fs::symlink_metadata(&path) else { continue };
            if about.is_dir() {
                if depth < DEEPEST {
                    self.look_into(&path, depth + 1);
                }
                continue;
            }
            self.files += 1;
            if !about.is_file() || about.len() > LARGEST {
                continue;
            }
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name == LIGHT || name == RENDERER {
                self.found.entry(name.into_owned()).or_default().push(path);
            } else if has_extension(&path, &HEADERS) {
                self.headers.push(path);
            } else if has_extension(&path, &SOURCES) {
                self.sources.push(path);
            }
        }
    }

    /// Of several files with one name, or with one function, the one where the framework has it,
    /// else the one nearest to the top.
    fn choose(
        &self,
        [name, home, function]: [&str; 3],
        notes: &mut Vec<String>,
    ) -> Option<PathBuf> {
        let by_content = || {
            let sources = self.sources.iter();
            sources.filter(|source| defines(source, function)).cloned().collect::<Vec<_>>()
        };
        // Systems for handing in rename files.
        let all = self.found.get(name).cloned().unwrap_or_else(by_content);
        let at_home = |path: &&PathBuf| path.parent().is_some_and(|parent| parent.ends_with(home));
        let depth = |path: &&PathBuf| path.components().count();
        let chosen = all.iter().min_by_key(|path| (!at_home(path), depth(path)))?;
        if chosen.file_name().is_some_and(|other| other != name) {
            notes.push(format!("{} was taken for {name}", chosen.display()));
        }
        let content = fs::read(chosen).ok();
        if all.iter().any(|other| fs::read(other).ok() != content) {
            notes.push(format!(
                "there are {} different files {name}; {} was taken",
                all.len(),
                chosen.display()
            ));
        }
        Some(chosen.clone())
    }
}

/// The headers and sources in the folder of `file`, with `file` itself: their paths.
pub(crate) fn beside(file: &Path) -> Vec<PathBuf> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let Ok(entries) = fs::read_dir(folder.unwrap_or(Path::new("."))) else { return Vec::new() };
    let mut files: Vec<_> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| {
            let is_source = has_extension(path, &HEADERS) || has_extension(path, &SOURCES);
            let is_small = fs::symlink_metadata(path)
                .is_ok_and(|about| about.is_file() && about.len() <= LARGEST);
            is_source && is_small && !is_hidden(path)
        })
        .collect();
    files.sort();
    files.truncate(MOST_BESIDE);
    files
}
