//! What the names of files and folders tell.

use std::path::Path;

/// What students call the folders in their own.
const PARTS: [&str; 34] = [
    "assets",
    "assignment8",
    "bin",
    "build",
    "cmake",
    "code",
    "data",
    "debug",
    "doc",
    "docs",
    "external",
    "figures",
    "framework",
    "images",
    "include",
    "lib",
    "media",
    "models",
    "out",
    "output",
    "outputs",
    "photons",
    "pictures",
    "release",
    "render",
    "renders",
    "report",
    "result",
    "results",
    "scenes",
    "screenshots",
    "source",
    "src",
    "textures",
];
/// What they call several files of their own, besides.
const FILES: [&str; 36] = [
    "backup",
    "box",
    "camera",
    "cloud",
    "copy",
    "cube",
    "dump",
    "earlier",
    "final",
    "first",
    "image",
    "img",
    "kdtree",
    "last",
    "light",
    "list",
    "mesh",
    "new",
    "old",
    "older",
    "photonmap",
    "picture",
    "points",
    "run",
    "scene",
    "screen",
    "screenshot",
    "second",
    "shot",
    "test",
    "tests",
    "times",
    "timings",
    "try",
    "version",
    "vertices",
];
/// What systems leave in folders and archives.
const LITTER: [&str; 4] = [".ds_store", "__macosx", "desktop.ini", "thumbs.db"];

fn last(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().to_lowercase()
}

fn is_of_course(name: &str) -> bool {
    ["assignment", "cs148", "photon"].iter().any(|word| name.contains(word))
}

/// Whether the folder `path` is called like a part of a submission, and not like a student.
pub fn is_part(path: &Path) -> bool {
    let name = last(path);
    PARTS.contains(&name.as_str()) || is_of_course(&name)
}

/// Whether a file with this `stem` is called like one of several that a student has.
pub fn is_own_file(stem: &str) -> bool {
    let name = stem.to_lowercase();
    let mut words = name.split(|letter: char| !letter.is_alphabetic());
    let is_known = |word: &str| PARTS.contains(&word) || FILES.contains(&word);
    is_of_course(&name) || words.any(is_known) || !name.contains(char::is_alphabetic)
}

/// Whether `path` is what systems leave beside the files of their users.
pub fn is_litter(path: &Path) -> bool {
    LITTER.contains(&last(path).as_str())
}

/// The student's name and id that Canvas or Moodle put into the `name` of a file or folder.
pub fn student_in(name: &str) -> Option<(&str, &str)> {
    let parts: Vec<&str> = name.split('_').collect();
    let is_number = |part: &&str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    match parts.as_slice() {
        // Moodle: Jane Doe_1234_assignsubmission_file
        [name, id, "assignsubmission", ..] if is_number(id) => Some((name, id)),
        // Canvas: doejane_LATE_1234_5678_photons
        [name, "LATE", id, number, _, ..] if is_number(id) && is_number(number) => Some((name, id)),
        [name, id, number, _, ..] if is_number(id) && is_number(number) => Some((name, id)),
        _ => None,
    }
}
