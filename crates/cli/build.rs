//! Gathers the files of the root package from which `kit student` makes its project.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Files and folders of the root package. The other files in `golden/` are not the assignment's.
const PARTS: [&str; 12] = [
    "src",
    "tests",
    "golden/assignment8.png",
    "golden/closed-cube.snap",
    "golden/expected.csv",
    "golden/handout-1000000-sha256.snap",
    "golden/handout-seed-0.snap",
    "golden/handout-seed-148.snap",
    "golden/handout-seed-largest.snap",
    "Cargo.lock",
    "LICENSE-APACHE",
    "LICENSE-MIT",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = PathBuf::from(env::var_os("DEP_PHOTON_MAPPING_ROOT").expect("set by the port"));
    let mut files = Vec::new();
    for part in PARTS {
        println!("cargo::rerun-if-changed={}", root.join(part).display());
        gather(&root.join(part), &mut files);
    }
    files.sort();
    let mut table = String::from("&[\n");
    for file in &files {
        let name = file.strip_prefix(&root).expect("it is in the root's folder");
        let name = name.to_str().expect("the port's files have plain names").replace('\\', "/");
        table += &format!("    ({name:?}, include_bytes!({file:?})),\n");
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by cargo"));
    fs::write(out.join("port.rs"), table + "]\n").expect("OUT_DIR can be written");
}

fn gather(path: &Path, files: &mut Vec<PathBuf>) {
    if path.is_dir() {
        let entries = fs::read_dir(path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        for entry in entries {
            gather(&entry.expect("a folder can be listed").path(), files);
        }
    } else {
        files.push(path.to_owned());
    }
}
