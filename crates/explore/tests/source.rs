//! The build script's search through the port's source, and what it says when the port changed.

#[path = "../src/port/mod.rs"]
mod port;

use std::fs;
use std::path::Path;

const STEPS: &str = include_str!("../assets/steps.html");

fn read(file: &str) -> Result<String, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    fs::read_to_string(path).map_err(|error| format!("{file}: {error}"))
}

/// The error where `from` stands as `to` in the port.
fn error(from: &str, to: &str) -> String {
    let changed = |file: &str| read(file).map(|text| text.replace(from, to));
    port::find(changed).expect_err("the port was changed")
}

#[test]
fn the_port_has_all_steps() {
    let html = port::html::templates(&port::find(read).unwrap(), STEPS).unwrap();
    for step in ["emission", "hit", "stored", "roulette", "hemisphere", "frame", "ray"] {
        assert!(html.contains(&format!("<template id=\"step-{step}\"")), "{step}");
    }
}

#[test]
fn a_step_without_its_block_is_named() {
    let source = port::find(read).unwrap();
    for (from, to, found) in [
        ("<template id=\"step-frame\" ", "<template ", "</template>"),
        (" title=\"{title}\"", "", "{title}"),
    ] {
        let error = port::html::templates(&source, &STEPS.replace(from, to)).unwrap_err();
        let step = if to.is_empty() { "emission" } else { "frame" };
        let expected = format!("expected '{found}' in '<template id=\"step-{step}\" '");
        assert_eq!(error, format!("assets/steps.html: {expected}"));
    }
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
    let expected = "expected a line with 'let probability_of_reflection = ' for the step \
                    'roulette' of 'trace_photon'";
    assert!(message.ends_with(expected), "{message}");
}

#[test]
fn a_branch_that_no_story_tells_is_named() {
    let loops = "let axis = if is_parallel { Vec3::Y } else { Vec3::X };";
    for (from, to, found) in [
        ("if path.len() > 1 {", "if path.len() > 2 {", "if path.len() > 2 {"),
        (loops, "let axis = match is_parallel {", "let axis = match is_parallel {"),
        ("path.push(", "for _ in 0..2 { } path.push(", "for _ in 0..2 { } path.push("),
    ] {
        let message = error(from, to);
        let expected = format!("expected an 'if' whose condition a story tells, found '{found}");
        assert!(message.contains(&expected), "{message}");
        assert!(message.starts_with("src/rendering/"), "{message}");
    }
}

#[test]
fn each_branch_has_the_lines_that_it_decides() {
    let source = port::find(read).unwrap();
    let mut told = Vec::new();
    for function in &source.functions {
        for arm in &function.branches {
            let [first, last] = arm.lines.map(|at| function.lines[at].trim());
            let code = arm.code.clone().unwrap_or_else(|| format!("{first} .. {last}"));
            told.push(format!("{} {}: {code}", arm.condition, arm.holds));
        }
    }
    let expected = [
        "in_sphere true: break Vec3::new(x, y, z); .. }",
        "bounce_limit true: return; .. }",
        "bounce_limit false: if !self.stored_scene.trace(photon_ray, Some(&mut state)) { .. }",
        "no_hit true: return; .. }",
        "no_hit false: let intersection_point = \
         state.intersection_ray.ray_position(state.intersection_t); .. }",
        "has_bounced true: photon_map.push(Photon { .. }",
        "absorbed true: return; .. }",
        "absorbed false: let (u1, u2) = (rand(), rand()); .. }",
        "is_parallel true: { Vec3::Y }",
        "is_parallel false: { Vec3::X }",
    ];
    assert_eq!(told, expected);
}
