//! Which misreadings are found, beside the best possible tests.

use glam::Vec3;
use grading::expected::Expected;
use grading::judge_list::{Expectations, RATE_OF_WAYS, rate_to_find};
use grading::signature::Signature;
use photon_mapping::photon_list::PhotonRecord;
use rayon::prelude::*;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::variation::{FACETS, Simulation};

use crate::limit::best_test;
use crate::{CONTENTS, Content, Outcome, SMALL_LIMIT, judged, outcome};

/// The numbers of photons emitted of which the power is told.
const SIZES: [u64; 4] = [10_000, 100_000, 200_000, 1_000_000];

/// Prints how many of `seeds` lists of each misreading are found, and how many are named.
pub fn detection(
    seeds: u64,
    only: &str,
    expectations: &Expectations,
    with_small_limit: &Expectations,
) {
    // As the framework's rounding has it: less where a plane lies along the axes. And as others'.
    let sides = [0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15];
    let mut hypotheses = fair_readings();
    hypotheses.extend([sides, [0.1; FACETS], [0.45; FACETS]].map(no_offset));
    hypotheses.extend(misreadings());
    let mut ids: Vec<&'static str> = hypotheses.iter().map(|hypothesis| hypothesis.id).collect();
    ids.sort_unstable();
    ids.dedup();
    ids.retain(|id| *id != "fair");
    println!("## Found and named\n");
    println!(
        "Each row has {seeds} lists, made in all ways of the misreading in turn. The three numbers \
         of a cell are: how many lists the best possible test would find / how many are called \
         incorrect / how many are named rightly. The best test knows the counts that this \
         misreading and the closest fair reading give in the cells. \"All columns\" leaves out \
         `photon`; the best test with columns is not known.\n"
    );
    println!(
        "| what was done | emitted | positions alone | and the number emitted | all columns \
         | named wrongly |"
    );
    println!("|---|---|---|---|---|---|");
    let rows = std::iter::once(&"fair").chain(&ids);
    for id in rows.filter(|id| only.is_empty() || **id == only) {
        let ways: Vec<&Hypothesis> =
            hypotheses.iter().filter(|hypothesis| hypothesis.id == *id).collect();
        let is_of_limit = *id == "bounce-off-by-one";
        let expectations = if is_of_limit { with_small_limit } else { expectations };
        let outcomes: Vec<_> = (0..seeds)
            .into_par_iter()
            .map(|seed| outcomes(ways[seed as usize % ways.len()], 9_000_000 + seed, expectations))
            .collect();
        for (size, emitted) in SIZES.into_iter().enumerate() {
            let mut wrong = Vec::new();
            let columns = CONTENTS.into_iter().enumerate().map(|(at, content)| {
                let outcomes = || outcomes.iter().map(|of_seed| of_seed[size][at]);
                let incorrect = outcomes().filter(|it| *it != Outcome::Correct).count();
                let right = outcomes().filter(|it| *it == Outcome::Named(id)).count();
                wrong.extend(outcomes().filter_map(|outcome| match outcome {
                    Outcome::Named(name) if name != *id => Some(name),
                    _ => None,
                }));
                let limit = limit(id, emitted, content, expectations)
                    .map_or("-".to_owned(), |limit| format!("{:.1}", limit * seeds as f64));
                format!("{limit} / {incorrect} / {right}")
            });
            let columns: Vec<String> = columns.collect();
            wrong.sort_unstable();
            println!("| `{id}` | {emitted} | {} | {} |", columns.join(" | "), wrong.join(", "));
        }
    }
    println!("\n`bounce-off-by-one` is judged with `--max-bounces {SMALL_LIMIT}`.\n");
}

/// What becomes of lists of each size with each content, all of one run.
fn outcomes(way: &Hypothesis, seed: u64, expectations: &Expectations) -> Vec<Vec<Outcome>> {
    let max_bounces = expectations.signatures.max_bounces;
    let most = SIZES[SIZES.len() - 1];
    let all = Simulation::new(way.variation, seed, most, max_bounces).trace(0..most);
    let of_size = |emitted: u64| {
        let first = all.iter().filter(|record| u64::from(record.photon) < emitted);
        let intensity = Vec3::splat(1.0 / emitted as f32);
        let records: Vec<_> = first.map(|record| PhotonRecord { intensity, ..*record }).collect();
        let of_content =
            |content| outcome(&judged(records.clone(), emitted, content, expectations));
        CONTENTS.into_iter().map(of_content).collect()
    };
    SIZES.into_iter().map(of_size).collect()
}

/// How often, over the ways to `id`, the best test would find it that knows two laws: this one, and
/// that of the closest fair reading.
fn limit(id: &str, size: u64, content: Content, expectations: &Expectations) -> Option<f64> {
    let emitted = match content {
        Content::PositionsAlone => None,
        Content::PositionsAndNumber => Some(size as f64),
        Content::Everything => return None,
    };
    let signatures = &expectations.signatures;
    let of_id: Vec<_> =
        signatures.misreadings.iter().filter(|known| known.hypothesis.id == id).collect();
    let none = vec![0.0; expectations.places.cells];
    let powers: Vec<f64> = of_id
        .iter()
        .map(|known| {
            let counts: Vec<f64> =
                known.signature.cells.iter().map(|mean| mean * size as f64).collect();
            best_test(&counts, emitted, signatures.fair.iter(), |fair, size| {
                fair.signature.of_cells(&signatures.correlation, &none, size)
            })
        })
        .collect();
    (!powers.is_empty()).then(|| powers.iter().sum::<f64>() / powers.len() as f64)
}

/// Prints what it would cost to find nearly as many lists as the best tests, each of which looks
/// for one misreading.
pub fn cost_of_power(expectations: &Expectations) {
    let signatures = &expectations.signatures;
    let shows = |id: &str| id != "bounce-off-by-one";
    let known: Vec<_> =
        signatures.misreadings.iter().filter(|known| shows(known.hypothesis.id)).collect();
    println!("## What more would cost\n");
    println!(
        "The best test looks for one misreading. The judge looks for {} ways to make one. To find \
         nearly as many as the best tests, it would call so many of 100,000 correct lists \
         incorrect. Allowed are {:.0}.\n",
        known.len(),
        RATE_OF_WAYS * 1e5
    );
    println!("| emitted | positions alone | and the number emitted |");
    println!("|---|---|---|");
    let none = vec![0.0; expectations.places.cells];
    for size in SIZES.map(|size| size as f64) {
        let fair = signatures.fair[0].signature.of_cells(&signatures.correlation, &none, size);
        let rates = [true, false].map(|is_free| {
            let means = |it: &Signature| it.cells.iter().map(|mean| mean * size).collect();
            let means = known.iter().map(|known| means(&known.signature)).collect();
            1e5 * rate_to_find_all(&fair, means, is_free)
        });
        println!("| {size} | {:.1} | {:.1} |", rates[0], rates[1]);
    }
    println!();
}

/// How often correct submissions would be called incorrect if the test of each misreading, of which
/// `means` has the counts, found nearly as many as the best one. They are held against `fair`,
/// what a fair reading leaves.
fn rate_to_find_all(fair: &Expected, means: Vec<Vec<f64>>, is_free: bool) -> f64 {
    let law = fair.law(is_free);
    let all = |counts: &[f64]| counts.iter().sum::<f64>();
    let scaled = means.into_iter().map(|mut means| {
        let factor = if is_free { all(&fair.mean) / all(&means).max(1.0) } else { 1.0 };
        means.iter_mut().for_each(|mean| *mean *= factor);
        means
    });
    law.towards(&fair.mean, scaled).map(|(_, length)| rate_to_find(length)).sum()
}
