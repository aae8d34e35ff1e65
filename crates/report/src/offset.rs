//! Where a scattered ray starts: errors without an offset, with fixed offsets, and with the
//! reference's rule.

use std::fmt::Write as _;
use std::time::Instant;

use super::PageSection;
use super::csv::{Table, digits, short};
use super::hits::{look_at_paths, surface_hits};
use super::judge::{HitJudge, HitVerdict};
use super::plan::Plan;
use super::plot::{Axes, Mark, PlotLine, draw};
use super::rules::{HitRule, cases};
use super::statistics::most_per_million;
use super::transform::{Displacement, as_it_comes, as_loaded};
use super::true_paths::TruePaths;
use fast::lanes::offset::Offset;
use model::facets::facet_of_triangles;
use model::placement::Placement;
use photon_mapping::assignment8::SEED;
use variants::reading::Reading;
use variants::run::Run;

/// What happened under one rule in one place.
pub struct OffsetCase {
    rule: HitRule,
    place: Displacement,
    verdict: HitVerdict,
    /// Hits that are missing from the path, and hits that should not be on it.
    lost: u64,
    extra: u64,
    /// All photons stored, right or wrong.
    stored: u64,
    emitted: u64,
    seconds: f64,
}

impl OffsetCase {
    fn per_million(&self, count: u64) -> f64 {
        count as f64 * 1e6 / self.emitted as f64
    }

    /// Self-hits, leaks, lost and extra photons, per million emitted.
    fn wrongs(&self) -> [f64; 4] {
        let HitVerdict { self_hits, leaks, .. } = self.verdict;
        [self_hits, leaks, self.lost, self.extra].map(|count| self.per_million(count))
    }

    fn wrong(&self) -> f64 {
        self.wrongs().iter().sum()
    }
}

/// All cases, and how many photons they should have stored.
pub struct Offsets {
    cases: Vec<OffsetCase>,
    true_stored: u64,
}

/// Traces every case.
pub fn measure(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Offsets {
    let truth = TruePaths::trace(plan.offset_photons);
    let trace = |(rule, place)| {
        let case = trace(rule, place, plan.offset_photons, &truth);
        progress(plan.offset_photons);
        case
    };
    let cases = cases().into_iter().map(trace).collect();
    Offsets { cases, true_stored: truth.stored() }
}

/// The counts of one piece of the work.
#[derive(Default)]
struct OffsetCounts {
    verdict: HitVerdict,
    lost: u64,
    extra: u64,
    stored: u64,
}

fn trace(rule: HitRule, place: Displacement, photons: u64, truth: &TruePaths) -> OffsetCase {
    let (scene, offset) = match rule {
        HitRule::None => (as_it_comes(place), Offset::None),
        HitRule::Fixed(length) => (as_it_comes(place), Offset::AlongNormal(length)),
        HitRule::Reference => (as_loaded(place), Reading::REFERENCE.offset),
    };
    let judge = HitJudge::new(&scene);
    let mut run = Run::of_scene(scene, Placement::WORLD, SEED, photons);
    run.reading = Reading { offset, ..Reading::REFERENCE };
    // With walls that are hit again and again, a path would not end for long.
    run.renderer.max_photon_bounces = 50;
    let facets = facet_of_triangles(run.scene());
    let start = Instant::now();
    let pieces = look_at_paths(&run, 0..photons, |found: &mut OffsetCounts, photon, path| {
        let mut verdict = HitVerdict::default();
        judge.look(run.scene(), path, &mut verdict);
        let hits = surface_hits(path).map(|hit| facets[hit.intersected_primitive]);
        if let Some(parting) = truth.part(photon, hits) {
            // Where the judge has seen an impossible hit, what parts there is counted as that.
            let is_possible = verdict.self_hits + verdict.leaks == 0;
            if is_possible || parting.hit as u64 <= verdict.sound {
                found.lost += u64::from(parting.lost);
                found.extra += u64::from(parting.extra);
            }
        }
        found.verdict.self_hits += verdict.self_hits;
        found.verdict.leaks += verdict.leaks;
        found.verdict.sound += verdict.sound;
        found.stored += (path.len() as u64).saturating_sub(2);
    });
    let seconds = start.elapsed().as_secs_f64();
    let (mut verdict, mut lost, mut extra, mut stored) = (HitVerdict::default(), 0, 0, 0);
    for piece in pieces {
        verdict.self_hits += piece.verdict.self_hits;
        verdict.leaks += piece.verdict.leaks;
        verdict.sound += piece.verdict.sound;
        lost += piece.lost;
        extra += piece.extra;
        stored += piece.stored;
    }
    OffsetCase { rule, place, verdict, lost, extra, stored, emitted: photons, seconds }
}

/// The section of the page.
pub fn section(plan: &Plan, offsets: &Offsets) -> PageSection {
    let mut csv = Table::new(
        "rule place amount emitted self_hits leaks lost extra wrong_per_million stored true_stored \
         nanoseconds_per_photon",
    );
    for case in &offsets.cases {
        let (place, amount) = match case.place {
            Displacement::Scaled(factor) => ("scaled", factor),
            Displacement::Moved(distance) => ("moved", distance),
        };
        let HitVerdict { self_hits, leaks, .. } = case.verdict;
        let names = [case.rule.name(), place.to_owned(), format!("{amount:e}")];
        let counts = [case.emitted, self_hits, leaks, case.lost, case.extra];
        let wrong = digits(case.wrong());
        let stored = [case.stored, offsets.true_stored];
        let time = digits(case.seconds * 1e9 / case.emitted as f64);
        let cells = names.into_iter().chain(counts.map(|count| count.to_string())).chain([wrong]);
        csv.push(cells.chain(stored.map(|count| count.to_string())).chain([time]));
    }
    let files = vec![("offset.csv", csv.csv()), ("offset.svg", plot(&offsets.cases))];
    PageSection { markdown: markdown(plan, offsets), files }
}

fn markdown(plan: &Plan, offsets: &Offsets) -> String {
    let cases = &offsets.cases;
    let mut text = String::from(
        "## 3. Offset\n\n![Wrong photons over scale and displacement](offset.svg)\n\n",
    );
    let _ = writeln!(
        text,
        "Per million emitted photons: **self-hits / leaks / lost / extra**. A self-hit is a second \
         hit in a row on one plane. A leak is a hit from behind, or on the floor inside a box's \
         footprint. Lost and extra compare each photon with the same random numbers in f64, whose \
         rays start 1e-9 off the unscaled facet. Lost is the first hit that a path should have \
         made and did not. Extra is one that it should not have made. A hit on another facet is \
         both. {} photons a case, so a 0 stands for fewer than {} of a million (95 %, by the rule \
         of three). Fixed offsets are in units of the scene as it comes. The last rule is what the \
         program does with a model that it loads. In the plot, wrong is the sum of the four.\n",
        plan.offset_photons,
        short(most_per_million(plan.offset_photons), 2)
    );
    let places = [
        Displacement::Scaled(1e-4),
        Displacement::Scaled(1e-2),
        Displacement::Scaled(1.0),
        Displacement::Scaled(1e2),
        Displacement::Scaled(1e4),
        Displacement::Moved(1e2),
        Displacement::Moved(1e4),
        Displacement::Moved(1e5),
    ];
    let heads = places.map(|place| match place {
        Displacement::Scaled(factor) => format!("x {factor:.0e}"),
        Displacement::Moved(distance) => format!("+ {distance:.0e}"),
    });
    let mut table = Table::with_heads(
        ["offset"]
            .into_iter()
            .chain(heads.iter().map(String::as_str))
            .chain(["stored at x 1, against f64", "ns/photon at x 1"]),
    );
    let find = |rule, place| {
        let mut all = cases.iter();
        all.find(|case| case.rule == rule && case.place == place).expect("all cases are traced")
    };
    for rule in HitRule::all() {
        let cells = places.map(|place| {
            find(rule, place).wrongs().map(|number| format!("{number:.0}")).join(" / ")
        });
        let at_home = find(rule, Displacement::Scaled(1.0));
        let change = at_home.stored as f64 / offsets.true_stored as f64 - 1.0;
        let time = short(at_home.seconds * 1e9 / at_home.emitted as f64, 3);
        let last = [signed_percent(change), time];
        table.push([rule.name()].into_iter().chain(cells).chain(last));
    }
    text += &table.markdown();
    let of_reference = cases.iter().filter(|case| case.rule == HitRule::Reference);
    let worst = of_reference.map(OffsetCase::wrong).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "\n- The reference's rule, in its worst place: **{} wrong per million**{}.",
        short(worst, 3),
        if worst == 0.0 { ", none seen in any" } else { "" }
    );
    text += "- A moved scene that is traced as it comes also has its corners rounded to f32, up to \
             4e-3 at 1e5. That explains a part of its lost photons.\n- Times include the \
             judging.\n\nData: [all cases](offset.csv).\n";
    text
}

/// `change` as people write it: with a sign, to a hundredth of a percent.
fn signed_percent(change: f64) -> String {
    if change == 0.0 { "0 %".to_owned() } else { format!("{:+.2} %", 100.0 * change) }
}

/// Wrong photons over scale, and over displacement. Zeros are drawn as half a photon.
fn plot(cases: &[OffsetCase]) -> String {
    let shown = [
        (HitRule::None, Mark::Circles),
        (HitRule::Fixed(1e-7), Mark::Circles),
        (HitRule::Fixed(1e-5), Mark::Circles),
        (HitRule::Fixed(1e-3), Mark::Circles),
        (HitRule::Reference, Mark::Hollow),
    ];
    let lines = |amount: fn(Displacement) -> Option<f64>| -> Vec<PlotLine> {
        let line = |(color, (rule, mark)): (usize, &(HitRule, Mark))| {
            let of_rule = cases.iter().filter(|case| case.rule == *rule);
            let point = |case: &OffsetCase| {
                let half_a_photon = 0.5e6 / case.emitted as f64;
                let wrong = if case.wrong() == 0.0 { half_a_photon } else { case.wrong() };
                Some((amount(case.place)?, wrong))
            };
            PlotLine {
                name: format!("offset: {}", rule.name()),
                color,
                mark: *mark,
                points: of_rule.filter_map(point).collect(),
                bars: Vec::new(),
            }
        };
        shown.iter().enumerate().map(line).collect()
    };
    let axes = |title: &str, x: &str| Axes {
        title: title.to_owned(),
        x: x.to_owned(),
        y: "wrong per million emitted (0: as half a photon)".to_owned(),
    };
    let scaled = lines(|place| match place {
        Displacement::Scaled(factor) => Some(factor),
        Displacement::Moved(_) => None,
    });
    let moved = lines(|place| match place {
        Displacement::Scaled(_) => None,
        Displacement::Moved(distance) => Some(distance),
    });
    draw(&[
        (axes("Self-hits, leaks and lost photons, scene scaled", "scale of the scene"), scaled),
        (axes("The same, scene moved", "moved along each axis (scene units)"), moved),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the framework's figures say: nothing at 1e-5, half a percent of the stored photons at
    /// 1e-2.
    #[test]
    fn losses_are_counted_photon_by_photon() {
        let photons = 1_000_000;
        let truth = TruePaths::trace(photons);
        let of_rule = |rule| trace(rule, Displacement::Scaled(1.0), photons, &truth);
        let change = |case: &OffsetCase| case.stored as f64 / truth.stored() as f64 - 1.0;
        let reference = of_rule(HitRule::Fixed(1e-5));
        assert!(reference.wrong() < 10.0, "{}", reference.wrong());
        assert!(change(&reference).abs() < 5e-4);
        let known = of_rule(HitRule::Fixed(1e-2));
        assert!((change(&known) + 0.005).abs() < 0.0025, "{}", change(&known));
        let far = of_rule(HitRule::Fixed(1e-1));
        assert!(change(&far) < -0.03, "{}", change(&far));
        assert!(far.lost > 5 * known.lost && known.lost > 50 * reference.lost.max(1));
        for case in [reference, known, far] {
            assert_eq!((case.verdict.self_hits, case.verdict.leaks), (0, 0));
        }
    }
}
