//! Tells the build scripts of the toolkit where this package's files are. The toolkit shows the port's
//! source, and makes the edition for students from it.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let root = std::env::var("CARGO_MANIFEST_DIR").expect("set by cargo");
    println!("cargo::metadata=root={root}");
}
