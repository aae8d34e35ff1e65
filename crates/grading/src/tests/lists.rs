//! Lists with other faults, short ones, and the rubric.

use glam::Vec3;
use photon_list::record::Columns;
use photon_mapping::photon_list::PhotonRecord;
use variants::variation::{Roulette, Storage, Variation};

use super::{EMITTED, EXPECTATIONS, is_incorrect, observed, positions_of, records};
use crate::judge_list::{SIGNIFICANCE, judge};
use crate::observation::{CountsByPlace, Observation};
use crate::policy::Policy;
use crate::signature::Signatures;
use crate::verdict::{Finding, Verdict, Weight};

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
    let floor = EXPECTATIONS.places.facets.len() - 1;
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
fn what_is_told_beside_a_p_value_has_its_leeway() {
    // A part in a hundred more on one facet: far beyond chance at ten million photons, but little
    // beyond the leeway.
    let signature = &Signatures::of_assignment8().fair[0].signature;
    let emitted = 1e7;
    let mut counts = CountsByPlace::new(&EXPECTATIONS.places);
    counts.cells = signature.cells.iter().map(|mean| emitted * mean).collect();
    let corner = EXPECTATIONS.places.facets.len();
    counts.corner = emitted * signature.classes[corner];
    let wall = &EXPECTATIONS.places.facets[5];
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
