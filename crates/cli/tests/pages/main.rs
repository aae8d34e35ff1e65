//! The pages: links lead somewhere, sentences are short, commands exist, numbers agree.

mod architecture;
mod commands;
mod computed;
mod grader;
mod links;
mod markdown;
mod measured;
mod numbers;
mod release;
mod speed;
mod words;

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The text of the file `path` of the project.
pub fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The files below `folder` with one of `endings`, as paths from the root.
fn files(folder: &str, endings: &[&str], found: &mut Vec<String>) {
    let entries = fs::read_dir(root().join(folder)).expect("a folder of the project");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("can be read").file_name().into_string().expect("is text"))
        .collect();
    names.sort();
    for name in names {
        let path = if folder == "." { name.clone() } else { format!("{folder}/{name}") };
        if root().join(&path).is_dir() {
            let is_made = ["out", "report", "golden"].contains(&path.as_str());
            if !is_made && name != "target" && !name.starts_with('.') {
                files(&path, endings, found);
            }
        } else if endings.iter().any(|ending| name.ends_with(ending)) {
            found.push(path);
        }
    }
}

/// The files of the project with one of `endings`: their paths from the root and their texts.
pub fn project_files(endings: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    files(".", endings, &mut found);
    found.into_iter().map(|path| (path.clone(), read(path))).collect()
}

/// All pages: their paths from the root and their texts.
pub fn pages() -> Vec<(String, String)> {
    project_files(&[".md"])
}
