//! Numbers of pages that follow from the scene, from the expected values, or from a run.

use std::convert::Infallible;

use fast::trace::trace_list;
use oracle::table::ExpectedTable;
use photon_mapping::assignment8;
use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use photon_mapping::scene::triangle::Triangle;
use serde_json::Value;

use super::markdown::code_blocks;
use super::numbers::is_rounded;
use super::read;
use crate::support::{folder, json, run_line, stdout};

/// The numbers at the `#`s of `words`, if `text` starts with these.
fn numbers_at<'a>(text: &'a str, words: &str) -> Option<Vec<&'a str>> {
    let mut parts = words.split('#');
    let mut rest = text.strip_prefix(parts.next()?)?;
    let mut numbers = Vec::new();
    for part in parts {
        let end = rest.find(|c: char| !c.is_ascii_digit() && !".,e-".contains(c));
        let number = rest[..end.unwrap_or(rest.len())].trim_end_matches(['.', ',', '-', 'e']);
        if number.is_empty() {
            return None;
        }
        numbers.push(number);
        rest = rest[number.len()..].strip_prefix(part)?;
    }
    Some(numbers)
}

/// Asserts that the page `path` has `words`, with `values` at the `#`s, rounded to the digits
/// shown.
pub fn assert_says(path: &str, words: &str, values: &[f64]) {
    let text = read(path).split_whitespace().collect::<Vec<_>>().join(" ");
    let places = text.char_indices().map(|(place, _)| &text[place..]);
    let found = places.filter_map(|text| numbers_at(text, words)).next();
    let found = found.unwrap_or_else(|| panic!("{path} does not say '{words}'"));
    let agree = found.iter().zip(values).all(|(number, value)| is_rounded(number, *value));
    assert!(agree && found.len() == values.len(), "{path}: {words}: {found:?} are not {values:?}");
}

#[test]
fn numbers_are_found_and_held_to_their_digits() {
    assert_eq!(numbers_at("at 1e-5, 0.30.", "at #, #."), Some(vec!["1e-5", "0.30"]));
    assert_eq!(numbers_at("10,026 become 9,066", "# become #"), Some(vec!["10,026", "9,066"]));
    assert_eq!(numbers_at("at last", "at #"), None);
    assert!(is_rounded("2.4e-4", 2.441e-4) && !is_rounded("2.4e-4", 2.46e-4));
    assert!(is_rounded("950", 947.0) && !is_rounded("948", 947.0));
}

#[test]
fn numbers_of_the_expected_values() {
    let expected = ExpectedTable::of_assignment8();
    assert_says(
        "ASSIGNMENT.md",
        "On average, # photons are stored per emitted photon",
        &[expected.total.stored],
    );
    let deviation = (1e6 * expected.covariance.iter().flatten().sum::<f64>()).sqrt();
    assert_says(
        "README.md",
        "For the total of this run, whose paths store several photons each, these are # and #.",
        &[deviation, 3.0 * deviation],
    );
    let words = "the standard deviation of the stored total is about #.";
    assert_says("docs/accuracy.md", words, &[deviation]);
    // "About twice that of independent photons", of which each is stored at most once.
    let of_independent = expected.total.stored * (1.0 - expected.total.stored) * 1e6;
    assert!((1.9..2.3).contains(&(deviation * deviation / of_independent)));
    let [_, second, third, ref later @ ..] = expected.total.error[..] else {
        unreachable!("there are later hits")
    };
    let later = later.iter().copied().fold(0.0, f64::max);
    for (words, bound) in [
        ("|second|adaptive cubature of form factors|#|", second),
        ("|third|adaptive cubature over the lit pieces|#|", third),
        ("|later, and covariance|collocation on two meshes|#|", later),
    ] {
        assert_says("docs/accuracy.md", words, &[bound]);
    }
    let of_cell = 10_000_f64.sqrt();
    let words = "with # expected is usually within # of it (the square root), and nearly always \
                 within #.";
    assert_says("README.md", words, &[10_000.0, of_cell, 3.0 * of_cell]);
}

#[test]
fn numbers_of_the_scene_and_of_rounding() {
    let scene = assignment8::create_scene();
    // Of the box sides that face x, but not the wall, which does exactly.
    let lengths = scene.triangles().iter().map(|triangle| {
        let x = triangle.normal.x;
        1.0 - x * x
    });
    let lengths: Vec<f32> = lengths.filter(|length| (0.01..0.2).contains(length)).collect();
    assert_eq!(lengths.len(), 2 * 4);
    let [least, most] = [f32::min, f32::max]
        .map(|choose| f64::from(lengths.iter().copied().reduce(choose).expect("some").sqrt()));
    assert_says("ASSIGNMENT.md", "|b| = sqrt(1 - n_x^2): # to # on four box", &[least, most]);
    let tries = 6.0 / std::f64::consts::PI;
    assert_says("ASSIGNMENT.md", "It takes 6 / pi = # tries", &[tries]);
    // The largest number drawn is one step of 2^-24 below 1.
    let lowest = f64::exp2(-24.0).sqrt();
    assert_says("ASSIGNMENT.md", "so z is at least # and", &[lowest]);
    assert_says("docs/numerics.md", "rises above its surface by at least #,", &[lowest]);
    let angle = |triangle: &Triangle| {
        let [a, b, c] = triangle.vertices.map(|corner| corner.as_dvec3());
        let exact = (b - a).cross(c - a).normalize();
        exact.cross(triangle.normal.as_dvec3()).length()
    };
    let angle = scene.triangles().iter().map(angle).fold(0.0, f64::max);
    assert_says("docs/numerics.md", "normals of the model file are off by # at most", &[angle]);
    let step = f64::from(1e5_f32.next_up() - 1e5);
    assert_says("docs/numerics.md", "at 1e5, f32 steps are #;", &[step]);
    let rounding = f64::from(f32::EPSILON);
    assert_says("docs/numerics.md", "has coordinates good to # D", &[rounding]);
}

/// The farthest that a point hit lies from its triangle's plane.
#[test]
fn points_are_rounded_as_far_as_the_pages_say() {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let mut farthest = 0_f64;
    let photons = 0..renderer.photon_count;
    renderer.generic_photon_map_generation(&mut Vec::new(), photons, |_, path, _| {
        for vertex in path {
            let PathVertex::Surface(state) = vertex else { continue };
            let triangle = &renderer.stored_scene.triangles()[state.intersected_primitive];
            let [a, b, c] = triangle.vertices.map(|corner| corner.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            let height = (state.intersection_point().as_dvec3() - a).dot(normal).abs();
            farthest = farthest.max(height);
        }
    });
    assert_says("docs/numerics.md", "A rounded point lies up to # off its plane", &[farthest]);
    assert_says("ASSIGNMENT.md", "Rounding moves a hit point by up to #,", &[farthest]);
}

#[test]
fn variance_of_many_runs_is_that_of_theory() {
    let (runs, photons) = (1_200, 20_000);
    let expected = ExpectedTable::of_assignment8();
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.photon_count = photons;
    let mut squares = 0.0;
    for seed in 1..=runs {
        renderer.seed = seed;
        let mut stored = 0;
        let ended = trace_list(&renderer, 0..photons, |records, _| {
            stored += records.len();
            Ok::<(), Infallible>(())
        });
        assert!(ended.is_ok());
        squares += (stored as f64 - photons as f64 * expected.total.stored).powi(2);
    }
    let theory = photons as f64 * expected.covariance.iter().flatten().sum::<f64>();
    let ratio = squares / runs as f64 / theory;
    // Sums over many photons are normal: the variance of a square is 2.
    let error = (2.0 / runs as f64).sqrt();
    assert!((ratio - 1.0).abs() < 3.0 * error, "{ratio} +- {error}");
    let words = "In # other runs of # photons, the variance is # of theory, with a standard error \
                 of #.";
    assert_says("docs/accuracy.md", words, &[runs as f64, photons as f64, ratio, error]);
}

#[test]
fn photons_on_the_floor_of_both_frames() {
    let floor = |line: &str| {
        let summary = json(run_line(line, &[]).success());
        let surfaces = summary["surfaces"].as_array().expect("a table").clone();
        let floor = surfaces.iter().find(|row| row["name"] == "floor").cloned();
        floor
            .as_ref()
            .and_then(|row| row["stored"].as_f64())
            .unwrap_or_else(|| panic!("no floor in {}", Value::from(surfaces)))
    };
    let counts = ["", " --letter-of-the-handout"]
        .map(|option| floor(&format!("render --count-only --json --quiet{option}")));
    assert_says("ASSIGNMENT.md", "does not: # photons on the floor become #.", &counts);
}

/// What `merge` prints of the pieces that the page's script for Slurm traces.
#[test]
fn merge_prints_what_the_page_on_large_runs_shows() {
    let folder = folder();
    let pieces = ["0..500000", "500000..1000000"].map(|range| {
        let out = folder.path().join(range);
        run_line(&format!("render --range {range} --size 1x1 --quiet --out {{}}"), &[&out])
            .success();
        out.join("photons.ply")
    });
    let whole = folder.path().join("photons.ply");
    let printed = run_line("merge {} {} --out {}", &[&pieces[0], &pieces[1], &whole]).success();
    let printed = stdout(printed);
    let blocks = code_blocks(&read("docs/large-runs.md"));
    let (_, block) = blocks.iter().find(|(language, _)| language == "text").expect("a block");
    let shown = block.lines().filter(|line| !line.starts_with('$') && *line != "...");
    let shown: Vec<_> = shown.collect();
    assert_eq!(shown.len(), 2, "{shown:?}");
    for line in shown {
        assert!(printed.lines().any(|printed| printed == line), "no '{line}' in\n{printed}");
    }
}

/// The hash of the run that the page traces in pieces.
#[test]
fn large_run_has_the_hash_of_the_page() {
    let page = read("docs/large-runs.md");
    let folder = folder();
    let line = "render --photons 40000000 --size 1x1 --quiet --out {}";
    let printed = stdout(run_line(line, &[folder.path()]).success());
    let hash = printed.split("SHA-256 ").nth(1).and_then(|rest| rest.split_whitespace().next());
    let hash = hash.expect("the name of the list");
    assert!(page.contains("--photons 40000000 --range"), "the page has another run");
    assert!(page.contains(&format!("`{hash}`")), "docs/large-runs.md lacks {hash}");
}
