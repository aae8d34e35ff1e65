//! The build script's search through the port's source, and what it says when the port changed.

#[path = "../src/steps.rs"]
#[allow(dead_code)]
mod steps;

use std::fs;
use std::path::Path;

fn read(file: &str) -> Result<String, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    fs::read_to_string(path).map_err(|error| format!("{file}: {error}"))
}

/// The error where `from` stands as `to` in the port.
fn error(from: &str, to: &str) -> String {
    let changed = |file: &str| read(file).map(|text| text.replace(from, to));
    steps::find(changed).expect_err("the port was changed")
}

#[test]
fn the_port_has_all_steps() {
    steps::find(read).unwrap();
}

#[test]
fn a_renamed_function_is_named() {
    let message = error("fn tangent_frame(", "fn frame(");
    assert_eq!(
        message,
        "src/rendering/sampling.rs: expected a function 'tangent_frame', found none"
    );
}

#[test]
fn a_missing_step_comment_is_named() {
    let message = error("// Photon Scattering/Absorption", "// Roulette");
    assert!(message.starts_with("src/rendering/photon_mapping_renderer.rs:"), "{message}");
    assert!(
        message.ends_with(
            "expected the step comment '// Photon Scattering/Absorption' in 'trace_photon'"
        ),
        "{message}"
    );
}

#[test]
fn a_line_without_its_value_is_named() {
    let message = error("let probability_of_reflection", "let p");
    let expected = "expected a line with 'let probability_of_reflection' for the step 'roulette' \
                    of 'trace_photon'";
    assert!(message.ends_with(expected), "{message}");
}
