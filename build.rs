//! Tells build scripts of packages that use this one where its source is, for those that show it.

fn main() {
    let root = std::env::var("CARGO_MANIFEST_DIR").expect("set by cargo");
    // A whole path, so that a folder that was moved with its `target` is noticed.
    println!("cargo::rerun-if-changed={root}/build.rs");
    println!("cargo::metadata=root={root}");
}
