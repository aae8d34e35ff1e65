//! The grader's judgment of lists, through the library.

use std::f64::consts::PI;
use std::sync::LazyLock;

use fast::lanes::offset::Offset;
use glam::{DVec3, Vec3, Vec3Swizzles};
use oracle::table::ExpectedTable;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::hypotheses::{
    BOUNCE_OFF_BY_ONE, Hypothesis, fair_readings, misreadings, no_offset, to_the_letter,
};
use variants::pairs::pairs;
use variants::reading::Reading;
use variants::variation::{Hemisphere, Roulette, Simulation, Storage, Variation};

use super::{EMITTED, EXPECTATIONS, name, observed, positions_of, records};
use crate::expected::{Expected, fit_size};
use crate::judge_list::{Expectations, Judgment, SIGNIFICANCE, judge};
use crate::observation::{CountsByPlace, Observation};
use crate::places::{Place, Places};
use crate::policy::Policy;
use crate::recognized::TELLING;
use crate::signature::{Signature, Signatures, classes, measure};
use crate::statistics::{corrected, normal_tail};
use crate::verdict::{Finding, Verdict, Weight};

static PLACES: LazyLock<Places> = LazyLock::new(|| EXPECTATIONS.places.clone());

fn is_incorrect(judgment: &Judgment) -> bool {
    judgment.findings.iter().any(|finding| finding.is_fault())
}

/// Whether photons are said to come straight from the light.
fn says_direct(judgment: &Judgment) -> bool {
    judgment.findings.iter().any(|finding| finding.check == "indirect only" && finding.is_fault())
}

#[test]
fn kept_signatures_are_those_of_the_tracer() {
    let kept = Signatures::of_assignment8();
    let check = |hypothesis: &Hypothesis, kept: &_, emitted| {
        let (measured, _) = measure(hypothesis, &PLACES, emitted, 1000);
        let kept: &Signature = kept;
        let counts: Vec<f64> = measured.classes.iter().map(|mean| mean * emitted as f64).collect();
        let law = Expected { slack: vec![0.0; counts.len()], ..kept.of_classes(emitted as f64) };
        let p_value = law.law(false).fit(&counts).p_value;
        assert!(p_value > 1e-6, "{}: {p_value:e}", hypothesis.title);
    };
    assert_eq!(kept.fair.len(), fair_readings().len());
    for (hypothesis, kept) in fair_readings().iter().zip(&kept.fair) {
        assert_eq!(*hypothesis, kept.hypothesis);
        check(hypothesis, &kept.signature, 400_000);
    }
    assert_eq!(kept.misreadings.len(), misreadings().len());
    for (hypothesis, kept) in misreadings().iter().zip(&kept.misreadings) {
        assert_eq!(*hypothesis, kept.hypothesis);
        check(hypothesis, &kept.signature, 40_000);
    }
}

#[test]
fn signatures_of_a_limit_are_those_of_the_tracer() {
    for max_bounces in [1, 2, 3, 7, 15] {
        let table = Signatures::of_limit(&PLACES, max_bounces);
        let ids = ["direct-stored", "mean-roulette", BOUNCE_OFF_BY_ONE, "third-hit-on"];
        let of_ids = table.misreadings.iter().filter(|known| ids.contains(&known.hypothesis.id));
        for known in of_ids.chain([&table.fair[0], &table.fair[1]]) {
            let emitted = 100_000;
            let (measured, _) = measure(&known.hypothesis, &PLACES, emitted, max_bounces);
            let counts = |means: &[f64]| -> Vec<f64> {
                means.iter().map(|mean| mean * emitted as f64).collect()
            };
            let expected = known.signature.of_classes(emitted as f64);
            let exact = Expected { slack: vec![0.0; expected.mean.len()], ..expected };
            let p_value = exact.law(false).fit(&counts(&measured.classes)).p_value;
            let title = &known.hypothesis.title;
            assert!(p_value > 1e-6, "{max_bounces}, {title}: {p_value:e}");
            for (bounce, of_bounce) in measured.by_bounce.iter().enumerate() {
                let expected = known.signature.of_bounce(bounce, emitted as f64);
                let p_value = expected.law(false).fit(&counts(of_bounce)).p_value;
                assert!(p_value > 1e-6, "{max_bounces}, {title}, {bounce}: {p_value:e}");
            }
        }
        // The spread of the total, which pairs of photons of one path widen.
        let spread = |signature: &Signature| {
            let all = signature.covariance.iter().flatten().sum::<f64>();
            (all / signature.classes.iter().sum::<f64>()).sqrt()
        };
        let (of_reference, _) = measure(&fair_readings()[0], &PLACES, 400_000, max_bounces);
        let [kept, again] = [&table.fair[0].signature, &of_reference].map(spread);
        assert!((kept / again - 1.0).abs() < 0.02, "{max_bounces}: {kept} {again}");
    }
}

#[test]
fn how_many_fit_is_told_of_fair_photons_alone() {
    let found = |variation, emitted| {
        let observation = positions_of(&records(variation, 86, EMITTED));
        let judgment = judge(&observation, emitted, true, &EXPECTATIONS);
        let mut findings = judgment.findings.into_iter();
        findings.find(|finding| finding.check == "enough photons").expect("it is checked").found
    };
    let plain = Variation::default();
    assert!(found(plain, None).contains("of about"));
    assert!(!found(plain, Some(EMITTED as f64)).contains("of about"));
    let direct = Variation { storage: Storage::All, ..plain };
    let always = Variation { roulette: Roulette::Constant(0.9), ..plain };
    for variation in [direct, always] {
        assert!(!found(variation, None).contains("of about"));
    }
}

#[test]
fn few_photons_are_tested_exactly() {
    let judged = |positions: Vec<Vec3>| {
        let records = positions.into_iter().map(|position| PhotonRecord { position, ..ABSENT });
        let observation = observed(records.collect(), Columns::default());
        judge(&observation, None, false, &EXPECTATIONS)
    };
    let facets = |judgment: &Judgment| {
        let facets = judgment.findings.iter().find(|finding| finding.check == "facets");
        facets.and_then(|facets| facets.p_value).expect("they are tested")
    };
    // All on the floor, and spread over it.
    let mut rand = photon_random(5, 5);
    let mut on_floor = |count: usize| -> Vec<Vec3> {
        (0..count).map(|_| Vec3::new(-0.8 + 0.2 * rand(), 1.8 * rand() - 0.9, 0.0)).collect()
    };
    for count in [12, 20, 60, 120] {
        assert!(facets(&judged(on_floor(count))) < SIGNIFICANCE, "{count}");
    }
    assert!(facets(&judged(on_floor(4))) > 1e-4);
    // Those of right programs follow their law.
    let smallest = (0..300).map(|seed| {
        let positions = records(Variation::default(), 20_000 + seed, 500 + 5 * seed);
        facets(&judged(positions.iter().map(|record| record.position).collect()))
    });
    let below = smallest.filter(|p_value| *p_value < 0.01).count();
    assert!(below <= 6, "{below} of 300");
}

#[test]
fn the_reference_s_signature_agrees_with_the_oracle() {
    let signature = &Signatures::of_assignment8().fair[0].signature;
    let oracle = ExpectedTable::of_assignment8();
    let total: f64 = signature.classes.iter().sum();
    // The standard deviation of the stored total is 316 per million photons and root million.
    let deviation = 0.316 / signature.emitted.sqrt();
    assert!((total - oracle.total.stored).abs() < 4.0 * deviation, "{total}");
    for (bounce, of_bounce) in signature.by_bounce.iter().enumerate() {
        let (mean, expected) = (of_bounce.iter().sum::<f64>(), oracle.total.hits[bounce + 1]);
        let deviation = (expected / signature.emitted).sqrt();
        assert!((mean - expected).abs() < 4.0 * deviation, "bounce {bounce}: {mean} {expected}");
    }
}

#[test]
fn every_photon_of_the_reference_has_its_place() {
    let records = records(Variation::default(), 3, 100_000);
    for record in &records {
        match PLACES.place(record.position.as_dvec3()) {
            // Of a simulation, the column has the facet.
            Place::Cell { facet, .. } | Place::Corner { facet } => {
                assert_eq!(facet, usize::from(record.surface), "{record:?}");
            }
            place => panic!("{place:?}: {record:?}"),
        }
    }
}

#[test]
fn a_position_off_its_surface_stays_in_its_place() {
    for record in records(Variation::default(), 4, 50_000) {
        let position = record.position.as_dvec3();
        let Place::Cell { facet, cell } = PLACES.place(position) else { continue };
        for off in [-7e-3, -1e-3, 1e-3, 7e-3] {
            let moved = position + off * PLACES.facets[facet].normal;
            assert_eq!(PLACES.place(moved), Place::Cell { facet, cell }, "{record:?} {off}");
        }
    }
}

#[test]
fn places_off_the_scene_are_told() {
    let place = |x, y, z| PLACES.place(DVec3::new(x, y, z));
    assert_eq!(place(0.0, 0.0, 0.02), Place::OffSurface);
    assert_eq!(place(f64::NAN, 0.0, 0.0), Place::NotFinite);
    assert_eq!(place(1e300, f64::INFINITY, 0.0), Place::NotFinite);
    // In the middle of each box's foot, which the floor runs under.
    assert_eq!(place(0.33, -0.37, 0.0), Place::Footprint);
    assert_eq!(place(-0.33, 0.29, 0.001), Place::Footprint);
    assert!(matches!(place(-0.8, -0.8, 0.0), Place::Cell { .. }));
    // Where the floor meets the wall.
    assert!(matches!(place(0.995, 0.0, 0.0), Place::Corner { .. }));
}

#[test]
fn cells_of_a_facet_cover_it_evenly() {
    let mut counts = CountsByPlace::new(&PLACES);
    let mut rand = photon_random(1, 1);
    let floor = PLACES.facets.len() - 1;
    for _ in 0..100_000 {
        let (x, y) = (2.0 * rand() - 1.0, 2.0 * rand() - 1.0);
        counts.add(PLACES.place(DVec3::new(x.into(), y.into(), 0.0)));
    }
    let first = PLACES.facets[floor].first_cell;
    let corner_cells = [first, first + 3, first + 12];
    for cell in corner_cells {
        // A sixteenth each, but for the margin along the wall.
        assert!((6250.0 - counts.cells[cell]).abs() < 450.0, "{cell}: {}", counts.cells[cell]);
    }
}

#[test]
fn wald_s_distance_follows_its_law() {
    // Two correlated counts: u + v and u, with u and v binomial.
    let covariance = [[0.25, 0.16], [0.16, 0.16]];
    let covariance = |a: usize, b: usize| covariance[a][b];
    let expected = Expected::of_paths(&[0.3, 0.2], covariance, 1e12, &[0.0; 2], 1000.0);
    let law = expected.law(false);
    let mut rand = photon_random(2, 2);
    let (mut below, mut far, rounds) = (0, 0, 2000);
    for _ in 0..rounds {
        let (mut u, mut v) = (0.0, 0.0);
        for _ in 0..1000 {
            u += f64::from(u8::from(rand() < 0.2));
            v += f64::from(u8::from(rand() < 0.1));
        }
        below += i32::from(law.fit(&[u + v, u]).p_value < 0.1);
        let mut towards = law.towards(&[u + v, u], [vec![400.0, 200.0]].into_iter());
        far += i32::from(towards.all(|(deviations, _)| deviations.abs() > 1.645));
    }
    // 200 are expected, with a standard deviation of 13.
    assert!((140..260).contains(&below), "{below}");
    assert!((140..260).contains(&far), "{far}");
}

#[test]
fn of_an_unknown_size_the_shape_alone_counts() {
    let mean = [0.01, 0.02, 0.03];
    let covariance = |a: usize, b: usize| if a == b { mean[a] } else { 0.0 };
    let of = |emitted| Expected::of_paths(&mean, covariance, 1e12, &[0.0; 3], emitted);
    let size_of = |counts: &[f64]| fit_size(counts, |emitted| of(emitted).mean, of);
    let fit = |counts: &[f64]| of(size_of(counts)).law(true).fit(counts).p_value;
    let twice = [2000.0, 4000.0, 6000.0];
    assert!(fit(&twice) > 0.99 && (size_of(&twice) - 200_000.0).abs() < 100.0);
    assert!(of(100_000.0).law(false).fit(&twice).p_value < 1e-100);
    assert!(fit(&[2300.0, 4000.0, 5700.0]) < 1e-6);
    // Nothing is left of a way that leads to more of the same.
    let law = of(200_000.0).law(true);
    let mut more = law.towards(&[2000.0, 4100.0, 5900.0], [of(400_000.0).mean].into_iter());
    assert!(more.all(|(deviations, _)| deviations.abs() < 1e-6));
}

#[test]
fn corrections_and_tails_are_the_textbooks() {
    assert!((normal_tail(1.959_964) - 0.025).abs() < 1e-6);
    assert!((corrected(0.05, 2) - 0.0975).abs() < 1e-12);
    assert!((corrected(1e-20, 10) / 1e-19 - 1.0).abs() < 1e-9);
    assert!((corrected(1.0, 3) - 1.0).abs() < 1e-12);
}

#[test]
fn fair_readings_are_correct_at_any_size() {
    for (index, hypothesis) in fair_readings().iter().enumerate() {
        for emitted in [10_000, 200_000, 1_000_000] {
            let of_reading = records(hypothesis.variation, 50 + index as u64, emitted);
            let observation = positions_of(&of_reading);
            for known in [None, Some(emitted as f64)] {
                let judgment = judge(&observation, known, known.is_some(), &EXPECTATIONS);
                assert!(
                    !is_incorrect(&judgment),
                    "{}, {emitted}: {:#?}",
                    hypothesis.title,
                    judgment.findings
                );
            }
        }
    }
}

#[test]
fn misreadings_are_named_from_positions_alone() {
    let sides = [0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15];
    let mut all = misreadings();
    // With a limit of its own, below.
    all.retain(|hypothesis| hypothesis.id != "bounce-off-by-one");
    all.push(no_offset(sides));
    // Of ways to the letter of the handout, every third.
    let is_literal = |way: &Hypothesis| way.title.ends_with("t and b as written");
    let (literal, mut all): (Vec<_>, Vec<_>) = all.into_iter().partition(is_literal);
    all.extend(literal.into_iter().step_by(3));
    let count = all.len();
    let named = all.into_par_iter().filter(|hypothesis| {
        let observation = positions_of(&records(hypothesis.variation, 60, EMITTED));
        let judgment = judge(&observation, Some(EMITTED as f64), true, &EXPECTATIONS);
        assert!(is_incorrect(&judgment), "{}", hypothesis.title);
        // The name says it all.
        assert!(!says_direct(&judgment), "{}", hypothesis.title);
        let name = name(&judgment);
        assert!(name.is_none_or(|name| name == hypothesis.id), "{}: {name:?}", hypothesis.title);
        name.is_some()
    });
    let named = named.count();
    // A roulette that begins late and none at all are too alike; and of so many, a few look like
    // something else.
    assert!(named as f64 >= 0.85 * count as f64, "{named} of {count}");
}

#[test]
fn a_missing_last_bounce_is_seen_where_the_limit_is_small() {
    let signatures = Signatures::of_limit(&PLACES, 3);
    let expectations = Expectations::new(PLACES.clone(), signatures);
    let columns = Columns { bounce: true, ..Columns::default() };
    let judged = |fewer_bounces| {
        let variation = Variation { fewer_bounces, ..Variation::default() };
        let records = Simulation::new(variation, 61, EMITTED, 3).trace(0..EMITTED);
        judge(&observed(records, columns), Some(EMITTED as f64), true, &expectations)
    };
    assert!(!is_incorrect(&judged(0)));
    let short = judged(1);
    assert!(is_incorrect(&short));
    assert_eq!(name(&short), Some("bounce-off-by-one"));
    let last = short.findings.iter().find(|it| it.check == "last bounce").expect("it is tested");
    assert!(last.is_fault() && last.advice.contains("--max-bounces"), "{last:?}");
}

#[test]
fn what_no_misreading_explains_gets_no_name() {
    let combination = Variation {
        hemisphere: Hemisphere::Uniform,
        roulette: Roulette::Mean,
        ..Variation::default()
    };
    let half: Vec<PhotonRecord> = records(Variation::default(), 62, EMITTED)
        .into_iter()
        .filter(|record| record.position.x > 0.0)
        .collect();
    for records in [records(combination, 63, EMITTED), half] {
        let judgment = judge(&positions_of(&records), Some(EMITTED as f64), true, &EXPECTATIONS);
        assert!(is_incorrect(&judgment));
        assert_eq!(name(&judgment), None);
        assert!(!says_direct(&judgment));
    }
}

#[test]
fn two_misreadings_at_once_are_told_and_not_named() {
    let pairs = pairs();
    for pair in pairs.iter().step_by(9) {
        let judgment = judge(
            &positions_of(&records(pair.variation, 83, EMITTED)),
            Some(EMITTED as f64),
            true,
            &EXPECTATIONS,
        );
        assert!(is_incorrect(&judgment), "{}", pair.title);
        assert_eq!(name(&judgment), None, "{}", pair.title);
        let told = judgment.pair.as_ref().expect(&pair.title);
        assert_eq!(told.hypothesis.title, pair.title);
        let is_told =
            |finding: &Finding| finding.is_fault() && finding.advice.contains(&pair.title);
        assert!(judgment.findings.iter().any(is_told), "{:#?}", judgment.findings);
    }
}

#[test]
fn nearly_all_pairs_are_told_by_their_cells() {
    // By facets alone, nine of them are not.
    let mut others = Vec::new();
    for pair in pairs() {
        let observation = positions_of(&records(pair.variation, 95, EMITTED));
        let judgment = judge(&observation, None, false, &EXPECTATIONS);
        assert_eq!(name(&judgment), None, "{}", pair.title);
        let told = judgment.pair.map(|told| told.hypothesis.title).unwrap_or_default();
        // With t and b as they are written or not: one title is longer.
        if told.is_empty() || !(told.starts_with(&pair.title) || pair.title.starts_with(&told)) {
            others.push(pair.title);
        }
    }
    assert!(others.len() <= 4, "{others:#?}");
}

#[test]
fn other_faults_speak_for_no_misreading() {
    for seed in 900..910 {
        let mut some_twice = records(Variation::default(), seed, EMITTED);
        some_twice.extend_from_within(..60);
        let mut some_astray = records(Variation::default(), seed, EMITTED);
        some_astray.iter_mut().step_by(50).for_each(|record| record.position.y += 0.03);
        for (records, check) in [(some_twice, "same place"), (some_astray, "on surfaces")] {
            for emitted in [None, Some(EMITTED as f64)] {
                let judgment = judge(&positions_of(&records), emitted, true, &EXPECTATIONS);
                let is_seen = |finding: &Finding| finding.is_fault() && finding.check == check;
                assert!(judgment.findings.iter().any(is_seen), "{seed} {check}");
                assert_eq!(name(&judgment), None, "{seed} {check}");
                assert!(judgment.pair.is_none(), "{seed} {check}");
            }
        }
    }
}

#[test]
fn photons_lost_all_over_the_scene_are_no_misreading() {
    // As many fewer as with the luminance, which shows little else.
    let mut incorrect = 0;
    for seed in 880..890 {
        let mut few = records(Variation::default(), seed, EMITTED);
        let mut at = 0;
        few.retain(|_| {
            at += 1;
            at % 9 != 0
        });
        let judgment = judge(&positions_of(&few), Some(EMITTED as f64), true, &EXPECTATIONS);
        incorrect += usize::from(is_incorrect(&judgment));
        assert_eq!(name(&judgment), None, "{seed}");
        assert!(judgment.pair.is_none(), "{seed}");
    }
    assert!(incorrect >= 5, "{incorrect}");
}

#[test]
fn a_frame_left_at_zero_sends_photons_along_the_normal() {
    let variation = |zero_frame| {
        let reading = Reading { fallback_threshold: 2.0, ..Reading::REFERENCE };
        Variation { reading, zero_frame, ..Variation::default() }
    };
    let is_wall = |record: &PhotonRecord| {
        let facet = PLACES.facets.get(usize::from(record.surface));
        facet.is_some_and(|facet| facet.normal.x < -0.999)
    };
    let of_zero = records(variation(true), 84, EMITTED);
    assert!(of_zero.iter().all(|record| record.position.is_finite()));
    let pairs = of_zero.windows(2).filter(|pair| {
        pair[0].photon == pair[1].photon
            && pair[1].bounce == pair[0].bounce + 1
            && is_wall(&pair[0])
    });
    let mut count = 0;
    for pair in pairs {
        let [from, to] = [pair[0].position, pair[1].position];
        assert!((from - to).yz().abs().max_element() < 1e-5, "{from} {to}");
        assert!(from.x > to.x && pair[1].to_light.x > 0.999);
        count += 1;
    }
    assert!(count > 100, "{count}");
    // Else they are lost, in directions that are not numbers.
    let of_nan = records(variation(false), 84, EMITTED);
    assert!(of_nan.iter().any(|record| record.position.is_nan()));
}

#[test]
fn a_bounce_too_few_is_seen_in_the_number_of_photons() {
    let signatures = Signatures::of_limit(&PLACES, 2);
    let expectations = Expectations::new(PLACES.clone(), signatures);
    let judged = |fewer_bounces, emitted| {
        let variation = Variation { fewer_bounces, ..Variation::default() };
        let records = Simulation::new(variation, 85, EMITTED, 2).trace(0..EMITTED);
        judge(&positions_of(&records), emitted, true, &expectations)
    };
    let emitted = Some(EMITTED as f64);
    let short = judged(1, emitted);
    assert_eq!(name(&short), Some("bounce-off-by-one"));
    let of_bounces = |judgment: &Judgment| {
        let mut tests = judgment.findings.iter();
        tests.find(|test| test.check == "known misreadings").expect("it is tested").passed
    };
    assert!(!of_bounces(&short));
    let right = judged(0, emitted);
    assert!(!is_incorrect(&right) && of_bounces(&right));
}

#[test]
fn positions_hardly_show_whether_three_bounces_or_two_were_allowed() {
    let plain = fair_readings().swap_remove(0);
    let short = Hypothesis {
        variation: Variation { fewer_bounces: 1, ..plain.variation },
        ..plain.clone()
    };
    let (of_three, covariance) = measure(&plain, &PLACES, 16_000_000, 3);
    let (of_two, _) = measure(&short, &PLACES, 16_000_000, 3);
    // To a test that knows both laws, and nothing else that a fair reading may do.
    let emitted = EMITTED as f64;
    let mean = &of_three.cells;
    let none = vec![0.0; mean.len()];
    let law =
        |emitted| Expected::of_paths(mean, |a, b| covariance[a][b], f64::INFINITY, &none, emitted);
    let counts: Vec<f64> = of_two.cells.iter().map(|mean| emitted * mean).collect();
    let fitted = fit_size(&counts, |emitted| law(emitted).mean, law);
    let [known, unknown] = [(emitted, false), (fitted, true)].map(|(emitted, is_free)| {
        let law = law(emitted).law(is_free);
        law.towards(&counts, [counts.clone()].into_iter()).map(|(deviations, _)| deviations).sum()
    });
    let [known, unknown]: [f64; 2] = [known, unknown];
    println!("{known:.2} standard deviations apart, {unknown:.2} where the number is not known");
    assert!((5.0..6.0).contains(&known), "{known}");
    assert!((2.0..3.2).contains(&unknown), "{unknown}");
}

#[test]
fn a_wrong_intensity_costs_nothing() {
    let columns = Columns { intensity: true, ..Columns::default() };
    let with_factor = |factor: f32| {
        let mut of_reference = records(Variation::default(), 64, EMITTED);
        of_reference.iter_mut().for_each(|record| record.intensity *= factor);
        observed(of_reference, columns)
    };
    let remarks_on = |observation: &Observation, by_course: Option<f64>| {
        let emitted = by_course.or(observation.emitted_by_intensity);
        let judgment = judge(observation, emitted, by_course.is_some(), &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{:#?}", judgment.findings);
        let remarks = judgment.findings.into_iter().filter(|finding| !finding.passed);
        remarks.map(|remark| remark.check).collect::<Vec<_>>()
    };
    // Divided by the solid angle, not divided at all, and of half as many photons.
    let by_solid_angle = with_factor(0.25 / std::f32::consts::PI);
    assert_eq!(remarks_on(&by_solid_angle, None), ["number by intensity"]);
    assert_eq!(remarks_on(&with_factor(EMITTED as f32), None), ["intensity"]);
    let halved = with_factor(0.5);
    assert_eq!(halved.emitted_by_intensity, Some(400_000.0));
    assert_eq!(remarks_on(&halved, Some(EMITTED as f64)), ["intensity"]);
    assert!(remarks_on(&with_factor(1.0), Some(EMITTED as f64)).is_empty());
    // By the word of the course, it would be too few.
    assert!(is_incorrect(&judge(&halved, Some(400_000.0), true, &EXPECTATIONS)));
    // No factor of an intensity excuses the number that the course gives.
    let right = with_factor(1.0);
    assert!(is_incorrect(&judge(&right, Some(0.1 * EMITTED as f64), true, &EXPECTATIONS)));
}

#[test]
fn an_intensity_alone_wrong_costs_nothing() {
    let columns = Columns { intensity: true, ..Columns::default() };
    let of_reference = records(Variation::default(), 78, EMITTED);
    let stored = of_reference.len() as f64 / EMITTED as f64;
    let slips = [
        (4.0 * PI, "4 pi"),
        (2.0 * PI, "2 pi"),
        (10.0, "10"),
        (100.0, "100"),
        (1000.0, "1000"),
        (PI, "pi"),
        (1.0 / PI, "1/pi"),
        (0.25 / PI, "1/(4 pi)"),
    ];
    let slips = slips.map(|(factor, name)| (factor, format!("without a factor of {name} it")));
    let by_stored = (1.0 / stored, "which cannot be".to_owned());
    for (factor, words) in slips.into_iter().chain([by_stored]) {
        let mut wrong = of_reference.clone();
        wrong.iter_mut().for_each(|record| record.intensity *= factor as f32);
        let observation = observed(wrong, columns);
        let by_intensity = observation.emitted_by_intensity;
        let judgment = judge(&observation, by_intensity, false, &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{factor}: {:#?}", judgment.findings);
        let remarks: Vec<_> = judgment.findings.iter().filter(|it| !it.passed).collect();
        let checks: Vec<_> = remarks.iter().map(|it| it.check).collect();
        assert_eq!(checks, ["number by intensity"], "{factor}");
        assert!(remarks[0].found.contains(&words), "{factor}: {}", remarks[0].found);
    }
}

#[test]
fn a_misreading_is_named_where_the_intensity_is_off_by_a_known_factor() {
    let uniform = Variation { hemisphere: Hemisphere::Uniform, ..Variation::default() };
    let mut of_uniform = records(uniform, 82, EMITTED);
    of_uniform.iter_mut().for_each(|record| record.intensity *= std::f32::consts::TAU);
    let observation = observed(of_uniform, Columns { intensity: true, ..Columns::default() });
    let judgment = judge(&observation, observation.emitted_by_intensity, false, &EXPECTATIONS);
    assert!(is_incorrect(&judgment));
    assert_eq!(name(&judgment), Some("uniform-hemisphere"));
    let by_intensity = judgment.findings.iter().find(|it| it.check == "number by intensity");
    assert!(by_intensity.is_some_and(|it| !it.is_fault()), "{by_intensity:?}");
    assert_eq!(judgment.emitted, EMITTED as f64);
}

#[test]
fn photons_that_the_intensity_contradicts_are_not_correct() {
    let columns = Columns { intensity: true, ..Columns::default() };
    for (emitted, part) in [(EMITTED, 2), (EMITTED, 10), (1_000_000, 2)] {
        let of_reference = records(Variation::default(), 71, emitted);
        let mut rand = photon_random(71, 71);
        let kept = of_reference.into_iter().filter(|_| rand() * (part as f32) < 1.0).collect();
        let observation = observed(kept, columns);
        let by_intensity = observation.emitted_by_intensity;
        let judgment = judge(&observation, by_intensity, false, &EXPECTATIONS);
        let faults = judgment.findings.iter().filter(|it| it.is_fault());
        // The fewest of them are too few to get points without a look.
        let faults: Vec<_> = faults.filter(|it| it.check != TELLING).collect();
        assert_eq!(faults.iter().map(|it| it.check).collect::<Vec<_>>(), ["number by intensity"]);
        assert_eq!((name(&judgment), faults[0].weight), (None, Weight::Fault));
        assert!(faults[0].advice.contains("--emitted"));
    }
}

#[test]
fn no_name_is_given_that_the_number_contradicts() {
    let columns = Columns { intensity: true, ..Columns::default() };
    let no_offset = no_offset([0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15]);
    let without_root = Variation { hemisphere: Hemisphere::NoSquareRoot, ..Variation::default() };
    let both = [
        Variation { roulette: Roulette::Mean, ..no_offset.variation },
        Variation { roulette: Roulette::Red, ..no_offset.variation },
        Variation { storage: Storage::All, ..no_offset.variation },
        Variation { roulette: Roulette::Mean, ..without_root },
        Variation { roulette: Roulette::Red, ..without_root },
    ];
    for (of_both, by_course) in both.iter().flat_map(|it| [(it, true), (it, false)]) {
        let observation = observed(records(*of_both, 72, EMITTED), columns);
        let judgment = judge(&observation, Some(EMITTED as f64), by_course, &EXPECTATIONS);
        assert!(is_incorrect(&judgment), "{of_both:?}");
        assert_eq!(name(&judgment), None, "{of_both:?}");
        // Self-hits, of which the tops of the boxes have many, are not direct.
        assert!(!says_direct(&judgment) || of_both.stores_direct(), "{of_both:?}");
    }
    // As rounding has it.
    let reading = Reading { offset: Offset::AlongNormal(0.0), ..Reading::REFERENCE };
    let by_rounding = Variation { reading, ..Variation::default() };
    let observation = positions_of(&records(by_rounding, 73, EMITTED));
    let judgment = judge(&observation, Some(EMITTED as f64), true, &EXPECTATIONS);
    assert_eq!(name(&judgment), Some("no-offset"));
}

#[test]
fn a_short_list_is_correct_and_remarked_on() {
    let columns = Columns { intensity: true, ..Columns::default() };
    for seed in 0..200 {
        let of_reference = records(Variation::default(), 400 + seed, 1000);
        let observation = observed(of_reference.clone(), columns);
        assert_eq!(observation.emitted_by_intensity, Some(1000.0));
        let judgment = judge(&observation, Some(1000.0), false, &EXPECTATIONS);
        assert!(judgment.findings.iter().all(|it| it.passed), "{:#?}", judgment.findings);
        let judgment = judge(&positions_of(&of_reference), None, false, &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{:#?}", judgment.findings);
        let remarks: Vec<_> = judgment.findings.iter().filter(|it| !it.passed).collect();
        assert_eq!(remarks.iter().map(|it| it.check).collect::<Vec<_>>(), ["enough photons"]);
    }
}

#[test]
fn positions_with_few_decimals_are_correct_and_remarked_on() {
    for (decimals, remark) in
        [(2, Some("same place")), (3, Some("same place")), (4, None), (6, None)]
    {
        let mut of_reference = records(Variation::default(), 74, 1_000_000);
        let unit = 10_f64.powi(decimals);
        for record in &mut of_reference {
            record.position = ((record.position.as_dvec3() * unit).round() / unit).as_vec3();
        }
        let judgment = judge(&positions_of(&of_reference), Some(1_000_000.0), true, &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{decimals}: {:#?}", judgment.findings);
        let remarks: Vec<_> = judgment.findings.iter().filter(|it| !it.passed).collect();
        let checks: Vec<_> = remarks.iter().map(|it| it.check).collect();
        assert_eq!(checks, remark.into_iter().collect::<Vec<_>>(), "{decimals}");
    }
}

#[test]
fn photons_that_cannot_be_where_they_are_are_told_first() {
    let cases = [
        ("finite", Weight::Grave, Vec3::NAN),
        ("on surfaces", Weight::Grave, Vec3::new(0.0, 0.0, 0.02)),
        ("footprints", Weight::Fault, Vec3::new(0.33, -0.37, 0.0)),
    ];
    for (check, weight, position) in cases {
        let faults_of = |every: usize| {
            let mut moved = records(Variation::default(), 83, EMITTED);
            moved.iter_mut().step_by(every).for_each(|record| record.position = position);
            let judgment = judge(&positions_of(&moved), Some(EMITTED as f64), true, &EXPECTATIONS);
            let faults = judgment.findings.into_iter().filter(Finding::is_fault);
            faults.collect::<Vec<_>>()
        };
        let faults = faults_of(500);
        assert_eq!((faults[0].check, faults[0].weight), (check, weight));
        // Where they are missed, it is for no other reason.
        let faults = faults_of(3);
        assert_eq!(faults[0].check, check);
        assert!(faults.len() > 1 && faults[1..].iter().all(|it| it.advice.contains("echo")));
    }
}

#[test]
fn photons_side_by_side_are_seen() {
    let mut of_reference = records(Variation::default(), 84, EMITTED);
    let beside = |record: &PhotonRecord| {
        let position = record.position + Vec3::splat(5e-6);
        PhotonRecord { position, ..*record }
    };
    let others: Vec<PhotonRecord> = of_reference.iter().step_by(50).map(beside).collect();
    of_reference.extend(others);
    let judgment = judge(&positions_of(&of_reference), None, false, &EXPECTATIONS);
    let faults: Vec<_> = judgment.findings.iter().filter(|it| it.is_fault()).collect();
    assert_eq!(faults.iter().map(|it| it.check).collect::<Vec<_>>(), ["same place"]);
    assert!(!faults[0].found.contains("exactly"), "{}", faults[0].found);
}

#[test]
fn a_hundredth_of_the_photons_stored_twice_is_seen() {
    let mut of_reference = records(Variation::default(), 75, EMITTED);
    let twice: Vec<PhotonRecord> = of_reference.iter().step_by(110).copied().collect();
    of_reference.extend(twice);
    let judgment = judge(&positions_of(&of_reference), None, false, &EXPECTATIONS);
    let faults: Vec<_> = judgment.findings.iter().filter(|it| it.is_fault()).collect();
    assert_eq!(faults.iter().map(|it| it.check).collect::<Vec<_>>(), ["same place"]);
    assert!(faults[0].found.contains("exactly"), "{}", faults[0].found);
}

#[test]
fn a_tenth_of_one_facet_missing_is_seen() {
    let mut of_reference = records(Variation::default(), 76, 1_000_000);
    let floor = PLACES.facets.len() - 1;
    let mut on_floor = 0;
    of_reference.retain(|record| {
        on_floor += u32::from(usize::from(record.surface) == floor);
        usize::from(record.surface) != floor || on_floor % 10 != 0
    });
    let judgment = judge(&positions_of(&of_reference), Some(1e6), true, &EXPECTATIONS);
    let fault = judgment.findings.iter().find(|finding| finding.is_fault()).expect("a fault");
    assert_eq!(fault.check, "facets");
    assert!(fault.found.contains("floor"), "{}", fault.found);
}

#[test]
fn faults_of_to_light_cost_nothing() {
    let columns = Columns { to_light: true, ..Columns::default() };
    let faults = [("to_light set", 0.0), ("to_light length", 2.0), ("to_light direction", -1.0)];
    for (check, factor) in faults {
        let mut of_reference = records(Variation::default(), 65, EMITTED);
        of_reference.iter_mut().for_each(|record| record.to_light *= factor);
        let judgment = judge(&observed(of_reference, columns), None, false, &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{check}: {:#?}", judgment.findings);
        let remarks: Vec<_> = judgment.findings.iter().filter(|finding| !finding.passed).collect();
        assert_eq!(remarks.iter().map(|remark| remark.check).collect::<Vec<_>>(), [check]);
    }
}

#[test]
fn only_a_direction_that_is_reversed_throughout_is_called_so() {
    // Self-hits come from behind, and half of a list may be self-hits.
    let columns = Columns { to_light: true, ..Columns::default() };
    let advice_of = |every: usize| {
        let mut of_reference = records(Variation::default(), 70, EMITTED);
        of_reference.iter_mut().step_by(every).for_each(|record| record.to_light *= -1.0);
        let judgment = judge(&observed(of_reference, columns), None, false, &EXPECTATIONS);
        let findings = judgment.findings.into_iter();
        findings.filter(|it| it.check == "to_light direction").map(|it| it.advice).next()
    };
    assert!(advice_of(1).expect("a remark").contains("reversed"));
    assert!(!advice_of(2).expect("a remark").contains("reversed"));
}

#[test]
fn what_is_told_beside_a_p_value_has_its_leeway() {
    // A part in a hundred more on one facet: far beyond chance at ten million photons, but little
    // beyond the leeway.
    let signature = &Signatures::of_assignment8().fair[0].signature;
    let emitted = 1e7;
    let mut counts = CountsByPlace::new(&PLACES);
    counts.cells = signature.cells.iter().map(|mean| emitted * mean).collect();
    let corner = PLACES.facets.len();
    counts.corner = emitted * signature.classes[corner];
    let wall = &PLACES.facets[5];
    let cells = wall.first_cell..wall.first_cell + wall.divisions * wall.divisions;
    counts.cells[cells].iter_mut().for_each(|count| *count *= 1.012);
    let observation =
        Observation { counts, ..positions_of(&records(Variation::default(), 1, 9999)) };
    let judgment = judge(&observation, Some(emitted), true, &EXPECTATIONS);
    let facets = judgment.findings.iter().find(|it| it.check == "facets").expect("it is tested");
    assert!(facets.passed, "{facets:?}");
    let (_, told) = facets.found.split_once('(').expect("deviations are told");
    let told = told.split(' ').next().and_then(|word| word.parse::<f64>().ok());
    assert!(told.expect("a number") < 3.0, "{facets:?}");
}

#[test]
fn photons_straight_from_the_light_are_seen_by_their_direction() {
    // So few that densities hardly change.
    let mut of_reference = records(Variation::default(), 66, EMITTED);
    let light = create_scene().lights()[0].position.as_dvec3().as_vec3();
    for record in of_reference.iter_mut().step_by(500) {
        record.to_light = (light - record.position).normalize();
    }
    let columns = Columns { to_light: true, ..Columns::default() };
    let judgment = judge(&observed(of_reference, columns), None, false, &EXPECTATIONS);
    let fault = judgment.findings.iter().find(|finding| finding.is_fault()).expect("a fault");
    assert_eq!((fault.check, fault.weight), ("indirect only", Weight::Grave));
    // Where all are stored, that is the name, alone or with another one.
    let direct = Variation { storage: Storage::All, ..Variation::default() };
    let judged = |variation| {
        let all = observed(records(variation, 87, EMITTED), columns);
        judge(&all, None, false, &EXPECTATIONS)
    };
    assert_eq!(name(&judged(direct)), Some("direct-stored"));
    let pair = judged(Variation { roulette: Roulette::Mean, ..direct }).pair.expect("two at once");
    assert!(pair.hypothesis.variation.stores_direct(), "{}", pair.hypothesis.title);
}

#[test]
fn directions_that_the_photons_contradict_cost_nothing() {
    // As where photons that have bounced once are given the direction of the light.
    let mut of_reference = records(Variation::default(), 79, EMITTED);
    let light = create_scene().lights()[0].position.as_dvec3().as_vec3();
    for record in of_reference.iter_mut().filter(|record| record.bounce == 1) {
        record.to_light = (light - record.position).normalize();
    }
    let columns = Columns { to_light: true, ..Columns::default() };
    for emitted in [None, Some(EMITTED as f64)] {
        let observation = observed(of_reference.clone(), columns);
        let judgment = judge(&observation, emitted, emitted.is_some(), &EXPECTATIONS);
        assert!(!is_incorrect(&judgment), "{:#?}", judgment.findings);
        assert!(judgment.findings.iter().any(|it| it.check == "to_light source" && !it.passed));
    }
}

#[test]
fn a_few_photons_straight_from_the_light_are_found() {
    let with_direct = Variation { storage: Storage::All, ..Variation::default() };
    let mut rand = photon_random(80, 80);
    let light = create_scene().lights()[0].position.as_dvec3().as_vec3();
    let is_straight = |record: &PhotonRecord| {
        (light - record.position).normalize().dot(record.to_light) > 1.0 - 1e-7
    };
    // A hundredth of the list, and a twentieth.
    for part in [0.002, 0.01] {
        let mut records = records(with_direct, 80, EMITTED);
        records.retain(|record| !is_straight(record) || rand() < part);
        let columns = Columns { to_light: true, ..Columns::default() };
        let observation = observed(records, columns);
        for emitted in [None, Some(EMITTED as f64)] {
            let judgment = judge(&observation, emitted, emitted.is_some(), &EXPECTATIONS);
            let mut faults = judgment.findings.iter().filter(|it| it.is_fault());
            assert!(faults.any(|it| it.check == "indirect only"), "{part}");
        }
    }
}

#[test]
fn photons_straight_from_the_light_alone_are_seen_by_their_places() {
    let with_direct = Variation { storage: Storage::All, ..Variation::default() };
    let mut records = records(with_direct, 81, EMITTED);
    let light = create_scene().lights()[0].position.as_dvec3().as_vec3();
    records
        .retain(|record| (light - record.position).normalize().dot(record.to_light) > 1.0 - 1e-7);
    let judgment = judge(&positions_of(&records), Some(EMITTED as f64), true, &EXPECTATIONS);
    // A part of them is lost, so that it is not the whole of a misreading.
    let fault = judgment.findings.iter().find(|it| it.is_fault()).expect("a fault");
    assert_eq!((fault.check, fault.weight), ("indirect only", Weight::Grave));
    // Where directions tell it as well, it is told once.
    let columns = Columns { to_light: true, ..Columns::default() };
    let judgment = judge(&observed(records, columns), Some(EMITTED as f64), true, &EXPECTATIONS);
    let told = judgment.findings.iter().filter(|it| it.check == "indirect only" && it.is_fault());
    assert_eq!(told.count(), 1);
}

#[test]
fn self_hits_among_positions_with_few_decimals_are_not_said_to_be_direct() {
    let self_hits = no_offset([0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15]);
    let mut of_self_hits = records(self_hits.variation, 85, EMITTED);
    for record in &mut of_self_hits {
        record.position = ((record.position.as_dvec3() * 100.0).round() / 100.0).as_vec3();
    }
    let judgment = judge(&positions_of(&of_self_hits), None, false, &EXPECTATIONS);
    assert!(is_incorrect(&judgment) && name(&judgment).is_none());
    assert!(!says_direct(&judgment), "{:#?}", judgment.findings);
}

#[test]
fn directions_to_the_light_through_surfaces_say_nothing_of_photons() {
    let mut of_reference = records(Variation::default(), 77, EMITTED);
    let light = create_scene().lights()[0].position.as_dvec3().as_vec3();
    for record in &mut of_reference {
        record.to_light = (light - record.position).normalize();
    }
    let columns = Columns { to_light: true, ..Columns::default() };
    let judgment = judge(&observed(of_reference, columns), None, false, &EXPECTATIONS);
    assert!(!is_incorrect(&judgment), "{:#?}", judgment.findings);
    let remarks: Vec<_> = judgment.findings.iter().filter(|it| !it.passed).collect();
    assert_eq!(remarks.iter().map(|it| it.check).collect::<Vec<_>>(), ["to_light direction"]);
}

#[test]
fn a_list_stored_twice_is_incorrect() {
    let mut twice = records(Variation::default(), 67, EMITTED);
    twice.extend(twice.clone());
    let judgment = judge(&positions_of(&twice), None, false, &EXPECTATIONS);
    let faults: Vec<_> = judgment.findings.iter().filter(|finding| finding.is_fault()).collect();
    assert!(faults.iter().any(|fault| fault.check == "same place"), "{faults:#?}");
}

#[test]
fn too_few_photons_are_not_correct() {
    let observation = positions_of(&records(Variation::default(), 68, 60));
    assert!(observation.records > 0);
    let judgment = judge(&observation, None, false, &EXPECTATIONS);
    let fault = judgment.findings.iter().find(|finding| finding.is_fault()).expect("a fault");
    assert_eq!(fault.check, "enough photons");
    // Of 60 emitted, they are as many as they should be.
    assert!(!is_incorrect(&judge(&observation, Some(60.0), true, &EXPECTATIONS)));
}

#[test]
fn the_letter_of_the_handout_is_part_of_the_misreadings() {
    let mean = misreadings().into_iter().find(|it| it.id == "mean-roulette").expect("is known");
    let literal = to_the_letter(&mean);
    assert!(misreadings().contains(&literal));
}

#[test]
fn the_same_class_counts_make_the_same_classes() {
    let of_reference = records(Variation::default(), 69, 50_000);
    let observation = positions_of(&of_reference);
    let sum: f64 = classes(&observation.counts, &PLACES).iter().sum();
    assert_eq!(sum, observation.counts.on_surfaces());
    assert_eq!(sum as usize, of_reference.len());
}

#[test]
fn scores_follow_the_rubric_and_a_course_s_policy() {
    let rubric = Policy::default();
    assert_eq!(rubric.score(Verdict::Correct, None, true), 4.0);
    assert_eq!(rubric.score(Verdict::Incorrect, None, true), 3.0);
    assert_eq!(rubric.score(Verdict::Incorrect, None, false), 2.0);
    assert_eq!(rubric.score(Verdict::NoDots, None, false), 1.0);
    assert_eq!(rubric.score(Verdict::Unreadable, None, false), 0.0);
    let own: Policy = serde_json::from_str(
        r#"{"correct": 10, "no-dots": 2, "misreadings": {"mean-roulette": 8.5}}"#,
    )
    .expect("a policy");
    assert_eq!(own.score(Verdict::Correct, None, true), 10.0);
    assert_eq!(own.score(Verdict::Incorrect, Some("mean-roulette"), true), 8.5);
    assert_eq!(own.score(Verdict::Incorrect, Some("red-roulette"), true), 3.0);
    assert!(serde_json::from_str::<Policy>(r#"{"corect": 10}"#).is_err());
    const { assert!(SIGNIFICANCE < 1e-4) };
}
