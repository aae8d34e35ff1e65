//! Faults that look like something else: what is said of them, and what is not.

use glam::Vec3;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use variants::hypotheses::{misreadings, no_offset};
use variants::reading::Reading;
use variants::variation::{Storage, Transformation, Variation};

use super::{EMITTED, EXPECTATIONS, name, observed, positions_of, records};
use crate::crowding::crowding;
use crate::judge_list::{Judgment, judge};
use crate::verdict::Weight;

fn faults(judgment: &Judgment) -> Vec<&'static str> {
    let faults = judgment.findings.iter().filter(|finding| finding.is_fault());
    faults.map(|fault| fault.check).collect()
}

#[test]
fn hits_that_come_back_from_farther_than_rounding_are_not_called_no_offset() {
    let sides = [0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15];
    let self_hits = records(no_offset(sides).variation, 60, EMITTED);
    // As from 1e-5 above the surface, in a direction below it.
    let mut below = self_hits.clone();
    for at in 1..below.len() {
        if self_hits[at].position == self_hits[at - 1].position {
            let facet = &EXPECTATIONS.places.facets[usize::from(self_hits[at].surface)];
            let along = (facet.corners[1] - facet.corners[0]).normalize();
            below[at].position = below[at - 1].position + 1.2e-5 * along.as_vec3();
        }
    }
    for emitted in [None, Some(EMITTED as f64)] {
        let judged = |list| judge(&positions_of(list), emitted, emitted.is_some(), &EXPECTATIONS);
        assert_eq!(name(&judged(&self_hits)), Some("no-offset"));
        let judgment = judged(&below);
        assert_eq!(name(&judgment), None);
        assert!(faults(&judgment).contains(&"same place"));
        let mut same_place = judgment.findings.iter().filter(|it| it.check == "same place");
        assert!(same_place.all(|it| it.advice.contains("hemisphere over the normal")));
    }
}

/// What is said of `positions` alone.
fn faults_at(positions: impl Iterator<Item = Vec3>) -> Vec<&'static str> {
    let records: Vec<_> = positions.map(|position| PhotonRecord { position, ..ABSENT }).collect();
    faults(&judge(&observed(records, Columns::default()), None, false, &EXPECTATIONS))
}

#[test]
fn copies_spots_and_lines_are_never_correct() {
    let copies = |count| (0..count).map(|_| Vec3::new(0.1, 0.2, 0.0));
    assert!(!faults_at(copies(10)).is_empty());
    assert!(faults_at(copies(100)).contains(&"spread"));
    let along = |count: u16, step: f32| {
        (0..count).map(move |at| Vec3::new(0.100_123_4 + step * f32::from(at), -0.8, 0.0))
    };
    assert!(faults_at(along(75, 1e-4)).contains(&"spread"));
    assert!(faults_at(along(400, 1e-3)).contains(&"spread"));
    let mut rand = photon_random(3, 3);
    let spot = (0..300).map(|_| Vec3::new(0.02 * rand() - 0.8, 0.02 * rand() - 0.8, 0.0));
    assert!(faults_at(spot).contains(&"spread"));
}

#[test]
fn photons_of_the_reference_do_not_crowd() {
    for (seed, emitted) in [(1, 1000), (2, 20_000), (3, EMITTED), (4, 2_000_000)] {
        let records = records(Variation::default(), seed, emitted);
        for unit in [0.0, 0.01, 0.1] {
            let rounded = |record: &PhotonRecord| match record.position.as_dvec3() {
                exact if unit == 0.0 => exact,
                exact => (exact / unit).round() * unit,
            };
            let positions: Vec<_> = records.iter().map(rounded).collect();
            let chance = crowding(positions.iter().copied(), unit);
            assert!(chance > 0.9, "{emitted} {unit}: {chance:e}");
        }
    }
}

const PATHS: Columns =
    Columns { intensity: false, to_light: false, photon: true, bounce: true, surface: false };

fn faults_of_paths(records: Vec<PhotonRecord>, columns: Columns) -> Vec<&'static str> {
    let judgment = judge(&observed(records, columns), Some(EMITTED as f64), true, &EXPECTATIONS);
    assert_eq!(name(&judgment), None);
    faults(&judgment)
}

#[test]
fn bounces_that_contradict_the_scene_are_a_fault() {
    let of_reference = records(Variation::default(), 70, EMITTED);
    assert!(faults_of_paths(of_reference.clone(), PATHS).is_empty());
    // Photons after one bounce and after two, some of them the other way round.
    let columns = Columns { photon: false, ..PATHS };
    let with = |change: &dyn Fn(usize, &mut PhotonRecord)| {
        let mut records = of_reference.clone();
        records.iter_mut().enumerate().for_each(|(at, record)| change(at, record));
        faults_of_paths(records, columns)
    };
    let swapped = with(&|at, record| {
        if at % 2 == 0 && record.bounce <= 2 {
            record.bounce = 3 - record.bounce;
        }
    });
    assert_eq!(swapped, ["bounces"]);
    // A column that counts bounces backwards is no count of hits.
    assert!(with(&|_, record| record.bounce = 1000 - record.bounce).is_empty());
    assert!(with(&|_, record| record.bounce -= 1).is_empty());
    assert!(with(&|_, record| record.bounce += 1).is_empty());
}

#[test]
fn a_limit_of_the_program_s_own_is_a_fault() {
    let most_bounces = Variation { most_bounces: Some(5), ..Variation::default() };
    let short = records(most_bounces, 71, EMITTED);
    assert_eq!(faults_of_paths(short, PATHS), ["longest path"]);
}

#[test]
fn paths_with_gaps_are_a_fault() {
    let mut lossy = records(Variation::default(), 72, EMITTED);
    let mut rand = photon_random(72, 72);
    lossy.retain(|_| rand() > 0.03);
    assert_eq!(faults_of_paths(lossy.clone(), PATHS), ["whole paths"]);
    // A number for every record numbers no paths.
    (0..).zip(&mut lossy).for_each(|(at, record)| record.photon = at);
    assert!(!faults_of_paths(lossy, PATHS).contains(&"whole paths"));
}

/// The best of nine numbers fits another misreading, which the places alone speak against.
#[test]
fn a_name_holds_without_the_number_too() {
    let emitted = 532_983;
    let first_three_scatter = misreadings().into_iter().find(|it| it.variation.sure_hits == 3);
    let late = first_three_scatter.expect("is in the table");
    let mut records = records(late.variation, 3, emitted);
    // Ten times as many are 1.13 times as many as there were.
    records.iter_mut().for_each(|record| record.intensity = Vec3::splat(1.0 / 60_066.0));
    let observation = observed(records, Columns { intensity: true, ..Columns::default() });
    let judged = |emitted| judge(&observation, emitted, false, &EXPECTATIONS);
    assert_eq!(name(&judged(Some(600_660.0))), Some("no-roulette"));
    assert_eq!(name(&judged(None)), Some(late.id));
    assert_eq!(name(&judged(observation.emitted_by_intensity)), None);
}

#[test]
fn an_intensity_divided_twice_costs_nothing() {
    for emitted in [20_000, 50_000, EMITTED, 600_000, 1_000_000] {
        let mut twice = records(Variation::default(), 73, emitted);
        twice.iter_mut().for_each(|record| record.intensity /= emitted as f32);
        let columns = Columns { intensity: true, bounce: true, ..Columns::default() };
        let observation = observed(twice, columns);
        let by_intensity = observation.emitted_by_intensity;
        let judgment = judge(&observation, by_intensity, false, &EXPECTATIONS);
        assert!(faults(&judgment).is_empty(), "{emitted}: {:#?}", judgment.findings);
        assert!(judgment.findings.iter().any(|finding| !finding.passed));
    }
}

#[test]
fn photons_that_go_up_are_not_called_direct() {
    // As from a light that shines upward: what is stored by way of the ceiling and the walls.
    let columns = Columns { to_light: true, ..Columns::default() };
    let all = records(Variation { storage: Storage::All, ..Variation::default() }, 74, EMITTED);
    let light = create_scene().lights()[0].position;
    let goes_up = |path: &[PhotonRecord]| path[0].position.z > light.z;
    let paths = all.chunk_by(|a, b| a.photon == b.photon).filter(|path| goes_up(path));
    let stored: Vec<_> = paths.flat_map(|path| path[1..].to_vec()).collect();
    assert!(stored.len() > 200);
    for list in [positions_of(&stored), observed(stored.clone(), columns)] {
        let judgment = judge(&list, None, false, &EXPECTATIONS);
        assert!(!faults(&judgment).is_empty());
        assert!(!faults(&judgment).contains(&"indirect only"), "{:#?}", judgment.findings);
    }
}

/// Every path of `records` once more after each other, as from `threads` generators that are seeded
/// alike.
fn by_threads(records: &[PhotonRecord], threads: usize) -> Vec<PhotonRecord> {
    (0..threads).flat_map(|_| records.iter().copied()).collect()
}

#[test]
fn copies_are_named_by_how_they_come() {
    let all = records(Variation::default(), 90, EMITTED / 4);
    let twice = all.iter().flat_map(|record| [*record; 2]).collect();
    for (list, named, words) in [
        (by_threads(&all, 2), "repeated-paths", "Seed the generator once"),
        (by_threads(&all, 8), "repeated-paths", "Seed the generator once"),
        (twice, "stored-twice", "once for every hit"),
    ] {
        for emitted in [None, Some(EMITTED as f64)] {
            let judgment = judge(&positions_of(&list), emitted, true, &EXPECTATIONS);
            assert_eq!(name(&judgment), Some(named));
            let mut of_faults = judgment.findings.iter().filter(|finding| finding.is_fault());
            assert!(of_faults.all(|fault| fault.advice.contains(words)), "{named}");
        }
    }
    // A few places again and again: every photon draws the same numbers, or somebody wants points.
    let three = all[..3].iter().copied().cycle().take(3000).collect();
    for list in [vec![all[0]; 100], vec![all[0]; 5000], three] {
        let judgment = judge(&positions_of(&list), None, false, &EXPECTATIONS);
        assert_ne!(name(&judgment), Some("stored-twice"));
        let mut of_faults = judgment.findings.iter().filter(|finding| finding.is_fault());
        let same_place = of_faults.find(|fault| fault.check == "same place").expect("it is told");
        assert!(same_place.weight == Weight::Grave && same_place.advice.contains("eed"));
    }
    // Of self-hits, many are copies, and not all.
    let self_hits = records(no_offset([0.5; 12]).variation, 91, EMITTED);
    assert_eq!(
        name(&judge(&positions_of(&self_hits), None, false, &EXPECTATIONS)),
        Some("no-offset")
    );
}

#[test]
fn numbers_that_are_none_are_not_said_to_come_of_the_frame() {
    // As from the root of a negative number: a photon is nowhere after it was scattered, mostly.
    let mut lost = records(Variation::default(), 92, EMITTED);
    let mut rand = photon_random(92, 92);
    lost.iter_mut().filter(|_| rand() < 0.75).for_each(|record| record.position = Vec3::NAN);
    let judgment = judge(&positions_of(&lost), Some(EMITTED as f64), true, &EXPECTATIONS);
    assert_eq!(name(&judgment), None);
    let advice = judgment.findings.iter().filter(|it| it.is_fault()).map(|it| &it.advice);
    let advice: Vec<_> = advice.collect();
    assert!(!advice.is_empty() && advice.iter().all(|it| !it.contains("(-1, 0, 0)")), "{advice:?}");
    // Where the wall makes them, it is.
    let nan = misreadings().into_iter().find(|it| it.id == "nan-frame").expect("it is known");
    let judgment =
        judge(&positions_of(&records(nan.variation, 93, EMITTED)), None, false, &EXPECTATIONS);
    assert_eq!(name(&judgment), Some("nan-frame"));
    let finite = judgment.findings.iter().find(|it| it.check == "finite").expect("it is checked");
    assert!(finite.advice.contains("(-1, 0, 0)"));
}

#[test]
fn photons_of_another_origin_or_way_are_not_called_direct() {
    for id in ["half-directions", "start-not-moved", "polar-directions", "octant-directions"] {
        for way in misreadings().into_iter().filter(|it| it.id == id) {
            let list = records(way.variation, 94, EMITTED);
            for emitted in [None, Some(EMITTED as f64)] {
                let judgment = judge(&positions_of(&list), emitted, true, &EXPECTATIONS);
                assert!(!faults(&judgment).contains(&"indirect only"), "{}", way.title);
            }
        }
    }
}

#[test]
fn half_a_letter_of_the_handout_is_a_mistake_with_a_name() {
    let half =
        misreadings().into_iter().find(|it| it.id == "half-normalised").expect("it is known");
    let mut named = 0;
    for seed in 95..100 {
        let list = positions_of(&records(half.variation, seed, 500_000));
        let judgment = judge(&list, Some(500_000.0), true, &EXPECTATIONS);
        assert!(!faults(&judgment).is_empty(), "{seed}");
        named += usize::from(name(&judgment) == Some("half-normalised"));
    }
    assert!(named >= 4, "{named}");
}

#[test]
fn rows_of_what_is_written_are_the_transposed_frame() {
    let variation = Variation {
        reading: Reading::LETTER_OF_THE_HANDOUT,
        frame: Transformation::Rows,
        ..Variation::default()
    };
    let of_rows = positions_of(&records(variation, 1127, EMITTED));
    for emitted in [None, Some(EMITTED as f64)] {
        let judgment = judge(&of_rows, emitted, emitted.is_some(), &EXPECTATIONS);
        assert_eq!(name(&judgment), Some("transposed-frame"));
    }
}

#[test]
fn the_angle_that_is_even_is_caught_and_named() {
    let even = misreadings().into_iter().find(|it| it.id == "linear-angle").expect("it is known");
    let mut named = 0;
    for seed in 101..107 {
        let list = positions_of(&records(even.variation, seed, EMITTED));
        let judgment = judge(&list, Some(EMITTED as f64), true, &EXPECTATIONS);
        assert!(!faults(&judgment).is_empty(), "{seed}");
        named += usize::from(name(&judgment) == Some("linear-angle"));
    }
    assert!(named >= 5, "{named}");
}

#[test]
fn a_roulette_that_starts_late_is_not_called_none_at_all() {
    for sure_hits in [2, 4] {
        let variation = Variation { sure_hits, ..Variation::default() };
        let list = positions_of(&records(variation, 95, 1_000_000));
        for emitted in [None, Some(1e6)] {
            let judgment = judge(&list, emitted, false, &EXPECTATIONS);
            assert!(!faults(&judgment).is_empty());
            assert_ne!(name(&judgment), Some("no-roulette"), "{sure_hits} hits");
            assert!(sure_hits > 2 || name(&judgment) == Some("late-roulette"));
        }
    }
}
