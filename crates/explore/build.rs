//! Finds the port's functions and the lines of each step in them, by the port's own step comments.

#[path = "src/port/mod.rs"]
mod port;

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/port");
    println!("cargo::rerun-if-changed=assets/steps.html");
    let root = PathBuf::from(env::var_os("DEP_PHOTON_MAPPING_ROOT").expect("set by the port"));
    let read = |file: &str| {
        let path = root.join(file);
        println!("cargo::rerun-if-changed={}", path.display());
        fs::read_to_string(&path).map_err(|error| format!("{file}: {error}"))
    };
    let words = include_str!("assets/steps.html");
    match port::find(read).and_then(|source| port::html::templates(&source, words)) {
        Ok(html) => {
            let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by cargo"));
            fs::write(out.join("steps.html"), html).expect("OUT_DIR can be written");
        }
        Err(error) => {
            println!("cargo::error=explore shows the port's source, but {error}");
            std::process::exit(1);
        }
    }
}
