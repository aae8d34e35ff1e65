//! Signatures, places and the laws of counts.

use glam::{DVec3, Vec3};
use oracle::table::ExpectedTable;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use variants::hypotheses::{
    BOUNCE_OFF_BY_ONE, Hypothesis, fair_readings, misreadings, to_the_letter,
};
use variants::variation::Variation;

use super::{EXPECTATIONS, observed, positions_of, records};
use crate::expected::{Expected, fit_size};
use crate::judge_list::{Judgment, SIGNIFICANCE, judge};
use crate::limits::view::SHARES;
use crate::observation::CountsByPlace;
use crate::picture::expected::turned_together;
use crate::places::Place;
use crate::signature::{Signature, Signatures, classes, measure};
use crate::statistics::{corrected, normal_tail};

#[test]
fn kept_signatures_are_those_of_the_tracer() {
    let kept = Signatures::of_assignment8();
    let check = |hypothesis: &Hypothesis, kept: &_, emitted| {
        let (measured, _) = measure(hypothesis, &EXPECTATIONS.places, emitted, 1000);
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
        let table = Signatures::of_limit(&EXPECTATIONS.places, max_bounces);
        let ids = ["direct-stored", "mean-roulette", BOUNCE_OFF_BY_ONE, "third-hit-on"];
        let of_ids = table.misreadings.iter().filter(|known| ids.contains(&known.hypothesis.id));
        for known in of_ids.chain([&table.fair[0], &table.fair[1]]) {
            let emitted = 100_000;
            let (measured, _) =
                measure(&known.hypothesis, &EXPECTATIONS.places, emitted, max_bounces);
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
        let (of_reference, _) =
            measure(&fair_readings()[0], &EXPECTATIONS.places, 400_000, max_bounces);
        let [kept, again] = [&table.fair[0].signature, &of_reference].map(spread);
        assert!((kept / again - 1.0).abs() < 0.02, "{max_bounces}: {kept} {again}");
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
        match EXPECTATIONS.places.place(record.position.as_dvec3()) {
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
        let Place::Cell { facet, cell } = EXPECTATIONS.places.place(position) else { continue };
        for off in [-7e-3, -1e-3, 1e-3, 7e-3] {
            let moved = position + off * EXPECTATIONS.places.facets[facet].normal;
            assert_eq!(
                EXPECTATIONS.places.place(moved),
                Place::Cell { facet, cell },
                "{record:?} {off}"
            );
        }
    }
}

#[test]
fn places_off_the_scene_are_told() {
    let place = |x, y, z| EXPECTATIONS.places.place(DVec3::new(x, y, z));
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
    let mut counts = CountsByPlace::new(&EXPECTATIONS.places);
    let mut rand = photon_random(1, 1);
    let floor = EXPECTATIONS.places.facets.len() - 1;
    for _ in 0..100_000 {
        let (x, y) = (2.0 * rand() - 1.0, 2.0 * rand() - 1.0);
        counts.add(EXPECTATIONS.places.place(DVec3::new(x.into(), y.into(), 0.0)));
    }
    let first = EXPECTATIONS.places.facets[floor].first_cell;
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
fn pairs_of_pixels_are_summed_by_their_shares() {
    for at in 0..2000 {
        let common = f64::from(at * at) * 1e-5;
        for bin in 0..=SHARES {
            let mut pairs = [0; SHARES + 1];
            pairs[bin] = 3;
            let share = if bin < SHARES { (bin as f64 + 0.5) / SHARES as f64 } else { 1.0 };
            let expected = 3.0 * (share * common).exp_m1();
            let sum = turned_together(&pairs, common);
            assert!((sum - expected).abs() <= 1e-13 * expected, "{common} {bin}");
        }
    }
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
    let sum: f64 = classes(&observation.counts, &EXPECTATIONS.places).iter().sum();
    assert_eq!(sum, observation.counts.on_surfaces());
    assert_eq!(sum as usize, of_reference.len());
}
