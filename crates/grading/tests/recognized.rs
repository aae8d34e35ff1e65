//! What was made up gets no points, and whatever comes of tracing keeps those it has.

use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use grading::judge_list::Expectations;
use grading::picture::expectations::PictureExpectations;
use grading::picture::judge::judge_dots;
use grading::places::Places;
use grading::recognized::RECOGNIZED;
use grading::signature::Signatures;
use grading::submission::{Settings, Submission, grade_list};
use grading::verdict::{Finding, Grade, Verdict};
use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::hypotheses::misreadings;
use variants::variation::Simulation;

static EXPECTATIONS: LazyLock<Expectations> =
    LazyLock::new(|| Expectations::new(Places::new(&create_scene()), Signatures::of_assignment8()));

fn grade(positions: impl Iterator<Item = Vec3>, emitted: Option<u64>) -> Grade {
    let records = positions.map(|position| PhotonRecord { position, ..ABSENT }).collect();
    let list = PhotonList { columns: Columns::default(), records };
    let settings = Settings { emitted, ..Settings::default() };
    grade_list(&Submission::default(), list, &settings, &EXPECTATIONS).grade
}

fn is_unrecognized(finding: &Finding) -> bool {
    finding.check == RECOGNIZED && finding.is_fault()
}

/// A point of facet `facet`, at the part `u` and `v` of its sides.
fn on_facet(facet: usize, [u, v]: [f32; 2]) -> Vec3 {
    let [a, b, c, d]: [DVec3; 4] = EXPECTATIONS.places.facets[facet].corners;
    let (u, v) = (f64::from(u), f64::from(v));
    a.lerp(b, u).lerp(d.lerp(c, u), v).as_vec3()
}

/// Points that somebody made up, by what was done.
fn made_up() -> Vec<(&'static str, Vec<Vec3>)> {
    let facets = &EXPECTATIONS.places.facets;
    let largest = |axis: DVec3| {
        let looks_there = |at: &usize| facets[*at].normal.dot(axis).abs() > 0.9;
        let size = |at: &usize| facets[*at].corners[0].distance(facets[*at].corners[2]);
        let there = (0..facets.len()).filter(looks_there);
        there.max_by(|a, b| size(a).total_cmp(&size(b))).expect("there is one")
    };
    let (floor, wall) = (largest(DVec3::Z), largest(DVec3::X));
    let mut rand = photon_random(5, 5);
    let mut strewn = |count: usize, facet: &dyn Fn(usize) -> usize| -> Vec<Vec3> {
        (0..count).map(|at| on_facet(facet(at), [rand(), rand()])).collect()
    };
    let any = |at: usize| at % facets.len();
    let one = on_facet(floor, [0.3, 0.2]);
    let mut all = vec![
        ("one photon", vec![one]),
        ("100 copies", vec![one; 100]),
        ("20,000 copies", vec![one; 20_000]),
        ("100 on all facets", strewn(100, &any)),
        ("20,000 on all facets", strewn(20_000, &any)),
        ("1,000 on the floor", strewn(1000, &|_| floor)),
        ("20,000 on the floor", strewn(20_000, &|_| floor)),
        ("20,000 on the wall", strewn(20_000, &|_| wall)),
    ];
    // As many on every facet as there should be.
    let of_facets = &EXPECTATIONS.signatures.fair[0].signature.classes;
    let right = |(facet, share): (usize, &f64)| vec![facet; (2e5 * share) as usize];
    let right: Vec<usize> = of_facets[..facets.len()].iter().enumerate().flat_map(right).collect();
    all.push(("as many on each facet", strewn(right.len(), &|at| right[at])));
    let grid = |at: usize| [(at % 50) as f32 / 50.0 + 0.01, (at / 50 % 50) as f32 / 50.0 + 0.01];
    all.push(("a grid", (0..30_000).map(|at| on_facet(at / 2500, grid(at))).collect()));
    let mut rand = photon_random(6, 6);
    let mut cube = || Vec3::new(2.0 * rand() - 1.0, 2.0 * rand() - 1.0, 2.0 * rand());
    all.push(("all over the room", (0..5000).map(|_| cube()).collect()));
    let cloud = |at: Vec3| on_facet(floor, [0.3 + 0.05 * at.x * at.y, 0.2 + 0.05 * at.y]);
    all.push(("a cloud", (0..5000).map(|_| cloud(cube())).collect()));
    all
}

#[test]
fn what_was_made_up_gets_the_fewest_points() {
    for (what, points) in made_up() {
        for emitted in [None, Some(200_000)] {
            let Grade { verdict, score, findings, .. } = grade(points.iter().copied(), emitted);
            assert_eq!(score, 0.0, "{what} {emitted:?}");
            // One alone may be the whole of a short run.
            let is_told = findings.iter().any(is_unrecognized);
            assert!(is_told || verdict == Verdict::Undecided, "{what} {emitted:?}");
        }
    }
}

#[test]
fn every_misreading_keeps_its_points() {
    let lost: Vec<_> = misreadings()
        .into_par_iter()
        .filter_map(|it| {
            let records = Simulation::new(it.variation, 8, 100_000, 1000).trace(0..100_000);
            let positions = records.iter().map(|record| record.position);
            let grade = grade(positions, None);
            (!records.is_empty() && grade.score < 2.0).then_some((it.title, grade.score))
        })
        .collect();
    assert!(lost.is_empty(), "{lost:?}");
}

#[test]
fn noise_in_a_picture_gets_the_fewest_points_and_dots_do_not() {
    let expectations = PictureExpectations::new(&EXPECTATIONS.places, 1000);
    let view = &expectations.view;
    let is_unrecognized = |red: &[bool]| {
        let judgment = judge_dots(red, view, None, &expectations);
        assert!(judgment.is_incorrect());
        judgment.findings.iter().any(is_unrecognized)
    };
    let mut rand = photon_random(7, 7);
    for part in [0.01, 0.5] {
        let noise: Vec<bool> = (0..grading::picture::view::PIXELS).map(|_| rand() < part).collect();
        assert!(is_unrecognized(&noise), "{part}");
    }
    for (what, points) in made_up().into_iter().filter(|(_, points)| points.len() >= 20_000) {
        let mut red = vec![false; grading::picture::view::PIXELS];
        points.iter().for_each(|point| view.for_each_pixel_of(*point, |pixel| red[pixel] = true));
        let judgment = judge_dots(&red, view, None, &expectations);
        let has_few = red.iter().filter(|is_red| **is_red).count() < 100;
        assert!(has_few || judgment.findings.iter().any(self::is_unrecognized), "{what}");
    }
    for it in misreadings().into_iter().step_by(16) {
        let mut red = vec![false; grading::picture::view::PIXELS];
        for record in Simulation::new(it.variation, 9, 200_000, 1000).trace(0..200_000) {
            view.for_each_pixel_of(record.position, |pixel| red[pixel] = true);
        }
        let judgment = judge_dots(&red, view, None, &expectations);
        assert!(!judgment.findings.iter().any(self::is_unrecognized), "{}", it.title);
    }
}
