//! Where a scattered ray starts: what goes wrong with no offset, fixed ones, and the reference's rule.

use std::fmt::Write as _;
use std::time::Instant;

use super::Section;
use super::csv::{Table, digits, short};
use super::hits::look_at_paths;
use super::judge::{Judge, Verdict};
use super::plan::Plan;
use super::plot::{Axes, Line, Mark, draw};
use super::rules::{Rule, cases};
use super::transform::{Place, as_it_comes, as_loaded};
use crate::accuracy::table::ExpectedTable;
use crate::assignment8;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use crate::rendering::reading::{Offset, Reading};

/// What happened under one rule in one place.
pub struct Case {
    rule: Rule,
    place: Place,
    verdict: Verdict,
    emitted: u64,
    seconds: f64,
}

impl Case {
    fn per_million(&self, count: u64) -> f64 {
        count as f64 * 1e6 / self.emitted as f64
    }

    /// Stored photons that are missing, per million emitted; nothing where chance may explain it.
    fn lost(&self, expected: &ExpectedTable) -> f64 {
        let emitted = self.emitted as f64;
        let variance: f64 = expected.covariance.iter().flatten().sum();
        let missing = expected.total.stored * emitted - self.verdict.sound as f64;
        if missing > 3.0 * (variance * emitted).sqrt() { missing * 1e6 / emitted } else { 0.0 }
    }

    fn wrong(&self, expected: &ExpectedTable) -> f64 {
        self.per_million(self.verdict.self_hits + self.verdict.leaks) + self.lost(expected)
    }
}

/// Traces every case.
pub fn measure(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Vec<Case> {
    cases()
        .into_iter()
        .map(|(rule, place)| {
            let case = trace(rule, place, plan.offset_photons);
            progress(plan.offset_photons);
            case
        })
        .collect()
}

fn trace(rule: Rule, place: Place, photons: u64) -> Case {
    let (scene, offset) = match rule {
        Rule::None => (as_it_comes(place), Offset::None),
        Rule::Fixed(length) => (as_it_comes(place), Offset::AlongNormal(length)),
        Rule::Reference => (as_loaded(place), Reading::REFERENCE.offset),
    };
    let judge = Judge::new(&scene);
    let renderer = PhotonMappingRenderer {
        photon_count: photons,
        reading: Reading { offset, ..Reading::REFERENCE },
        // With walls that are hit again and again, a path would not end for long.
        max_photon_bounces: 50,
        ..assignment8::create_renderer(scene)
    };
    let start = Instant::now();
    let pieces = look_at_paths(&renderer, 0..photons, |verdict: &mut Verdict, _, path| {
        judge.look(&renderer.stored_scene, path, verdict);
    });
    let seconds = start.elapsed().as_secs_f64();
    let mut verdict = Verdict::default();
    for piece in pieces {
        verdict.self_hits += piece.self_hits;
        verdict.leaks += piece.leaks;
        verdict.sound += piece.sound;
    }
    Case { rule, place, verdict, emitted: photons, seconds }
}

/// The section of the page.
pub fn section(plan: &Plan, cases: &[Case]) -> Section {
    let expected = ExpectedTable::of_assignment8();
    let mut csv = Table::new(
        "rule place amount emitted self_hits leaks sound expected lost_per_million \
         wrong_per_million nanoseconds_per_photon",
    );
    for case in cases {
        let (place, amount) = match case.place {
            Place::Scaled(factor) => ("scaled", factor),
            Place::Moved(distance) => ("moved", distance),
        };
        let Verdict { self_hits, leaks, sound } = case.verdict;
        let counts = [case.emitted, self_hits, leaks, sound].map(|count| count.to_string());
        let emitted = case.emitted as f64;
        let numbers = [
            expected.total.stored * emitted,
            case.lost(&expected),
            case.wrong(&expected),
            case.seconds * 1e9 / emitted,
        ];
        let names = [case.rule.name(), place.to_owned(), format!("{amount:e}")];
        csv.push(names.into_iter().chain(counts).chain(numbers.map(digits)));
    }
    let files = vec![("offset.csv", csv.csv()), ("offset.svg", plot(cases, &expected))];
    Section { markdown: markdown(plan, cases, &expected), files }
}

fn markdown(plan: &Plan, cases: &[Case], expected: &ExpectedTable) -> String {
    let mut text = String::from(
        "## 3. Offset\n\n![Wrong photons over scale and displacement](offset.svg)\n\n",
    );
    let _ = writeln!(
        text,
        "Per million emitted photons: **self-hits / leaks / lost**. A self-hit is a second hit in a row on one \
         plane. A leak is a hit from behind, or on the floor inside a box's footprint. Lost are photons missing from \
         what is expected, counted before anything else went wrong on their path, where that is more than three standard \
         deviations ({} here). {} photons a case; fixed offsets are in units of the scene as it comes, the last rule \
         is what the program does with a model that it loads. Wrong, in the plot, is the sum of the three.\n",
        short(deviation(expected, plan.offset_photons), 2),
        plan.offset_photons
    );
    let places = [
        Place::Scaled(1e-4),
        Place::Scaled(1e-2),
        Place::Scaled(1.0),
        Place::Scaled(1e2),
        Place::Scaled(1e4),
        Place::Moved(1e2),
        Place::Moved(1e4),
        Place::Moved(1e5),
    ];
    let heads = places.map(|place| match place {
        Place::Scaled(factor) => format!("x {factor:.0e}"),
        Place::Moved(distance) => format!("+ {distance:.0e}"),
    });
    let mut table = Table::with_heads(
        ["offset"].into_iter().chain(heads.iter().map(String::as_str)).chain(["ns/photon at x 1"]),
    );
    let find = |rule, place| {
        let mut all = cases.iter();
        all.find(|case| case.rule == rule && case.place == place).expect("all cases are traced")
    };
    for rule in Rule::all() {
        let cells = places.map(|place| {
            let case = find(rule, place);
            let Verdict { self_hits, leaks, .. } = case.verdict;
            let numbers =
                [case.per_million(self_hits), case.per_million(leaks), case.lost(expected)];
            numbers.map(|number| format!("{number:.0}")).join(" / ")
        });
        let at_home = find(rule, Place::Scaled(1.0));
        let time = short(at_home.seconds * 1e9 / at_home.emitted as f64, 3);
        table.push([rule.name()].into_iter().chain(cells).chain([time]));
    }
    text += &table.markdown();
    let worst = cases
        .iter()
        .filter(|case| case.rule == Rule::Reference)
        .map(|case| case.wrong(expected))
        .fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "\n- The reference's rule, in its worst place: **{} wrong per million**.",
        short(worst, 3)
    );
    text += "- A moved scene that is traced as it comes also has its corners rounded to f32, up to 4e-3 at 1e5: part \
             of what is lost there is lost to that.\n- Times include the judging.\n\nData: [all cases](offset.csv).\n";
    text
}

/// Three standard deviations of the stored total, per million emitted.
fn deviation(expected: &ExpectedTable, photons: u64) -> f64 {
    let variance: f64 = expected.covariance.iter().flatten().sum();
    3.0 * (variance / photons as f64).sqrt() * 1e6
}

/// Wrong photons over scale, and over displacement. Zeros are drawn at half a photon.
fn plot(cases: &[Case], expected: &ExpectedTable) -> String {
    let shown = [
        (Rule::None, Mark::Circles),
        (Rule::Fixed(1e-7), Mark::Circles),
        (Rule::Fixed(1e-5), Mark::Circles),
        (Rule::Fixed(1e-3), Mark::Circles),
        (Rule::Reference, Mark::Hollow),
    ];
    let lines = |amount: fn(Place) -> Option<f64>| -> Vec<Line> {
        let line = |(colour, (rule, mark)): (usize, &(Rule, Mark))| {
            let of_rule = cases.iter().filter(|case| case.rule == *rule);
            let point = |case: &Case| {
                let least = 0.5e6 / case.emitted as f64;
                Some((amount(case.place)?, case.wrong(expected).max(least)))
            };
            Line {
                name: format!("offset: {}", rule.name()),
                colour,
                mark: *mark,
                points: of_rule.filter_map(point).collect(),
            }
        };
        shown.iter().enumerate().map(line).collect()
    };
    let axes = |title: &str, x: &str| Axes {
        title: title.to_owned(),
        x: x.to_owned(),
        y: "wrong per million emitted (0: at the foot)".to_owned(),
    };
    let scaled = lines(|place| match place {
        Place::Scaled(factor) => Some(factor),
        Place::Moved(_) => None,
    });
    let moved = lines(|place| match place {
        Place::Scaled(_) => None,
        Place::Moved(distance) => Some(distance),
    });
    draw(&[
        (axes("Self-hits, leaks and lost photons, scene scaled", "scale of the scene"), scaled),
        (axes("The same, scene moved", "moved along each axis (scene units)"), moved),
    ])
}
