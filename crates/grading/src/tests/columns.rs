//! What intensity and direction to the light tell of photons, and what they cost.

use std::f64::consts::PI;

use photon_list::record::Columns;
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use variants::hypotheses::no_offset;
use variants::variation::{Hemisphere, Roulette, Storage, Variation};

use super::{
    EMITTED, EXPECTATIONS, is_incorrect, name, observed, positions_of, records, says_direct,
};
use crate::judge_list::judge;
use crate::observation::Observation;
use crate::recognized::TELLING;
use crate::verdict::Weight;

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
