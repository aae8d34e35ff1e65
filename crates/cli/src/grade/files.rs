//! What the file of each submission is called.

use std::collections::HashSet;
use std::path::Path;

/// The longest name of a file without number and extension, in bytes, of which systems take 255.
const LONGEST_NAME: usize = 100;

/// For each submission of `names` the name of its file: its own, without what systems do not take
/// or what leads elsewhere, and with `extension`.
pub fn file_names<'a>(names: impl Iterator<Item = &'a str>, extension: &str) -> Vec<String> {
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
