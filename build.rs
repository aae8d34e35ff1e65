//! Tells build scripts of packages that use this one where its source is, for those that show it.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = std::env::var("CARGO_MANIFEST_DIR").expect("set by cargo");
    println!("cargo::metadata=root={root}");
}
