//! Prints the table of misreadings: `docs/misreadings.md`.
//!
//! `cargo run -p photon-mapping-variants --example misreadings > docs/misreadings.md`

fn main() {
    print!("{}", variants::misreadings::table());
}
