//! How many points are given for what was made up: prints the tables of
//! `golden/grading-made-up.md`.

#[path = "common/made_up.rs"]
mod made_up;

use grading::judge_list::Expectations;
use grading::picture::judge::judge_dots;
use grading::places::Places;
use grading::recognized::scored_as;
use grading::signature::Signatures;
use grading::submission::{Settings, Submission, grade_list};
use grading::verdict::Verdict;
use made_up::{Kind, kinds, list, patch_of_noise};
use photon_mapping::assignment8::create_scene;
use rayon::prelude::*;

/// How many points are made up.
const COUNTS: [usize; 9] = [1, 10, 60, 100, 149, 150, 500, 1000, 10_000];
const SEEDS: u64 = 6;
/// The edges of patches of noise in pictures, in pixels.
const EDGES: [usize; 3] = [20, 40, 80];

fn main() {
    let places = Places::new(&create_scene());
    let expectations = Expectations::new(places, Signatures::of_assignment8());
    println!("# Points for what was made up\n");
    println!(
        "How many of {SEEDS} submissions get a point, by the number of their photons or red \
         pixels. A list is graded without the number of photons emitted and with 10,000, a \
         picture with 1,000,000: both are told.\n"
    );
    let head: Vec<String> = COUNTS.iter().map(usize::to_string).collect();
    println!("| made up | {} |\n|---{}|", head.join(" | "), "|---".repeat(COUNTS.len()));
    for kind in kinds(&expectations) {
        row(kind.name, |count, seed| {
            let graded = [None, Some(10_000)].map(|emitted| {
                let settings = Settings { emitted, ..Settings::default() };
                let list = list(Kind::points(&kind, count, seed));
                grade_list(&Submission::default(), list, &settings, &expectations).grade.score
            });
            graded.map(|score| score > 0.0)
        });
    }
    let pictures = expectations.pictures();
    for edge in EDGES {
        row(&format!("patch of {edge} pixels"), |count, seed| {
            let red = patch_of_noise(&pictures.view, edge, count, seed);
            [None, Some(1e6)].map(|emitted| {
                let judgment = judge_dots(&red, &pictures.view, emitted, pictures);
                let scored = scored_as(judgment.verdict(), &judgment.findings);
                matches!(scored, Verdict::Correct | Verdict::Incorrect)
            })
        });
    }
}

/// Prints how many seeds `get` a point, by count: without and with the number emitted.
fn row(name: &str, get: impl Fn(usize, u64) -> [bool; 2] + Sync) {
    let of_count = |count: &usize| {
        let got: Vec<_> = (0..SEEDS).into_par_iter().map(|seed| get(*count, seed)).collect();
        let [without, with] = [0, 1].map(|at| got.iter().filter(|got| got[at]).count());
        format!("{without}, {with}")
    };
    let row: Vec<String> = COUNTS.iter().map(of_count).collect();
    println!("| {name} | {} |", row.join(" | "));
}
