//! Fair readings and misreadings, from positions alone.

use fast::lanes::offset::Offset;
use glam::Vec3Swizzles;
use photon_list::record::Columns;
use photon_mapping::photon_list::PhotonRecord;
use rayon::prelude::*;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::pairs::pairs;
use variants::reading::Reading;
use variants::variation::{Hemisphere, Roulette, Simulation, Storage, Variation};

use super::{
    EMITTED, EXPECTATIONS, is_incorrect, name, observed, positions_of, records, says_direct,
};
use crate::expected::{Expected, fit_size};
use crate::judge_list::{Expectations, Judgment, judge};
use crate::signature::{Signatures, measure};
use crate::verdict::Finding;

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
    let signatures = Signatures::of_limit(&EXPECTATIONS.places, 3);
    let expectations = Expectations::new(EXPECTATIONS.places.clone(), signatures);
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
        let facet = EXPECTATIONS.places.facets.get(usize::from(record.surface));
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
    let signatures = Signatures::of_limit(&EXPECTATIONS.places, 2);
    let expectations = Expectations::new(EXPECTATIONS.places.clone(), signatures);
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
    let (of_three, covariance) = measure(&plain, &EXPECTATIONS.places, 16_000_000, 3);
    let (of_two, _) = measure(&short, &EXPECTATIONS.places, 16_000_000, 3);
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
