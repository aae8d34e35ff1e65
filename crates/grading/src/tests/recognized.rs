//! What was made up gets no points, and whatever comes of tracing keeps those it has.

#[path = "../../examples/common/made_up.rs"]
mod made_up;

use made_up::{kinds, list, patch_of_noise};
use photon_list::reader::PhotonList;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::hypotheses::misreadings;
use variants::variation::{Simulation, Variation};

use super::{EXPECTATIONS, positions_of, records};
use crate::list::OfList;
use crate::picture::judge::judge_dots;
use crate::picture::view::PIXELS;
use crate::recognized::{RECOGNIZABLE, RECOGNIZED, TELLING, scored_as, to_nearest};
use crate::submission::{Settings, Submission, grade_list};
use crate::verdict::{Finding, Grade, Verdict};

fn grade(list: PhotonList, emitted: Option<u64>) -> Grade {
    let settings = Settings { emitted, ..Settings::default() };
    grade_list(&Submission::default(), list, &settings, &EXPECTATIONS).grade
}

fn is_told(findings: &[Finding]) -> bool {
    findings
        .iter()
        .any(|it| it.is_fault() && [RECOGNIZED, RECOGNIZABLE, TELLING].contains(&it.check))
}

#[test]
fn what_was_made_up_gets_no_points() {
    let kinds = kinds(&EXPECTATIONS);
    for kind in &kinds {
        for count in [1, 10, 100, 149, 150, 300, 800, 1000, 20_000] {
            for emitted in [None, Some(10_000)] {
                let Grade { verdict, score, findings, .. } =
                    grade(list(kind.points(count, 5)), emitted);
                let what = format!("{count} {} {emitted:?}: {verdict:?}", kind.name);
                let is_told = is_told(&findings) || verdict == Verdict::Undecided;
                assert!(is_told && score == 0.0, "{what}");
            }
        }
    }
}

#[test]
fn copies_of_a_point_get_no_points() {
    let point = kinds(&EXPECTATIONS)[0].points(1, 7);
    for count in [1, 100, 20_000] {
        for emitted in [None, Some(1), Some(200_000)] {
            let grade = grade(list(point.repeat(count)), emitted);
            // One alone may be the whole of a short run.
            let is_short_run = count == 1 && emitted == Some(1);
            assert!(is_short_run || grade.score == 0.0, "{count} {emitted:?}");
        }
    }
}

#[test]
fn few_incorrect_photons_get_the_points_of_an_undecided_submission() {
    let floor = &kinds(&EXPECTATIONS)[0];
    let mut settings = Settings { emitted: Some(1_000_000), ..Settings::default() };
    settings.policy.undecided = 1.5;
    let few = list(floor.points(50, 8));
    let grade = grade_list(&Submission::default(), few, &settings, &EXPECTATIONS).grade;
    assert_eq!((grade.verdict, grade.score), (Verdict::Incorrect, 1.5));
    let told = grade.findings.iter().find(|it| it.check == RECOGNIZABLE).unwrap();
    assert!(told.advice.contains("a person must look"));
}

/// The positions that `variation` stores of `emitted` photons.
fn positions(variation: Variation, emitted: u64) -> PhotonList {
    let records = Simulation::new(variation, 8, emitted, 1000).trace(0..emitted);
    list(records.iter().map(|record| record.position).collect())
}

#[test]
fn every_misreading_keeps_its_points() {
    let lost: Vec<_> = misreadings()
        .into_par_iter()
        .filter_map(|it| {
            let list = positions(it.variation, 100_000);
            let stored = list.records.len();
            let grade = grade(list, None);
            let is_kept = stored > 0 && (stored >= 1000 || grade.misreading.is_some());
            (is_kept && grade.score < 2.0).then_some((it.title, grade.score))
        })
        .collect();
    assert!(lost.is_empty(), "{lost:?}");
}

#[test]
fn of_all_hypotheses_the_nearest_counts() {
    for id in ["not-transformed", "inverted-roulette"] {
        let hypothesis =
            misreadings().into_iter().find(|it| it.id == id).expect("it is in the table");
        let observation = positions_of(&records(hypothesis.variation, 8, 200_000));
        let expectations = &*EXPECTATIONS;
        let evidence = OfList { observation: &observation, emitted: None, expectations };
        let (nearest, enough) = (to_nearest(&evidence, 0.0), to_nearest(&evidence, 0.9));
        assert!(4.0 * nearest < enough, "{id}: {nearest} {enough}");
    }
}

#[test]
fn of_few_incorrect_photons_those_with_a_name_keep_their_points() {
    let [mut named, mut without_name] = [0; 2];
    for it in misreadings().into_iter().step_by(5) {
        let list = positions(it.variation, 10_000);
        let stored = list.records.len();
        let grade = grade(list, Some(10_000));
        if grade.verdict != Verdict::Incorrect || !(150..1000).contains(&stored) {
            continue;
        }
        let is_telling = !grade.findings.iter().any(|it| it.is_fault() && it.check == TELLING);
        assert_eq!((grade.score > 0.0, is_telling), [grade.misreading.is_some(); 2].into());
        let counted = if is_telling { &mut named } else { &mut without_name };
        *counted += 1;
    }
    assert!(named > 2 && without_name > 2, "{named} {without_name}");
}

#[test]
fn noise_in_a_picture_gets_no_points_and_dots_do() {
    let expectations = EXPECTATIONS.pictures();
    let view = &expectations.view;
    let gets_points = |red: &[bool], emitted| {
        let judgment = judge_dots(red, view, emitted, expectations);
        let scored = scored_as(judgment.verdict(), &judgment.findings);
        matches!(scored, Verdict::Correct | Verdict::Incorrect)
    };
    let mut rand = photon_random(7, 7);
    for part in [0.01, 0.5] {
        let noise: Vec<bool> = (0..PIXELS).map(|_| rand() < part).collect();
        assert!(!gets_points(&noise, None), "{part}");
    }
    let dots = |points: Vec<glam::Vec3>| {
        let mut red = vec![false; PIXELS];
        points.iter().for_each(|point| view.for_each_pixel_of(*point, |pixel| red[pixel] = true));
        red
    };
    for kind in kinds(&EXPECTATIONS) {
        let red = dots(kind.points(20_000, 5));
        if red.iter().filter(|is_red| **is_red).count() >= 1000 {
            let gets_none = !gets_points(&red, None) && !gets_points(&red, Some(2e5));
            assert!(gets_none, "{}", kind.name);
        }
    }
    let patches = [(20, 10, 6), (20, 40, 2), (20, 59, 2), (20, 400, 2)];
    let large = [(80, 500, 2), (80, 1000, 2), (80, 10_000, 2)];
    for (edge, count, seeds) in patches.into_iter().chain(large) {
        for seed in 0..seeds {
            let red = patch_of_noise(view, edge, count, seed);
            let gets_none = !gets_points(&red, None) && !gets_points(&red, Some(2e5));
            assert!(gets_none, "{edge} {count} {seed}");
        }
    }
    for it in misreadings().into_iter().step_by(16) {
        let records = Simulation::new(it.variation, 9, 200_000, 1000).trace(0..200_000);
        let red = dots(records.iter().map(|record| record.position).collect());
        let judgment = judge_dots(&red, view, None, expectations);
        assert!(!is_told(&judgment.findings), "{}", it.title);
    }
}
