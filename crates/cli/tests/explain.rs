//! `explain` as a user runs it, and its numbers against those of the list.

use std::path::Path;

use crate::support::{fails, json, run_line, stdout};
use compare::explain::{Ending, Story, explain, first_that_stores};
use model::placement::Placement;
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::Scene;
use photon_mapping::scene::point_light::PointLight;
use variants::run::Run;

fn records_of(list: &[PhotonRecord], photon: u64) -> Vec<&PhotonRecord> {
    list.iter().filter(|record| u64::from(record.photon) == photon).collect()
}

/// Holds a story against the photon's records, by bits.
fn check(story: &Story, records: &[&PhotonRecord]) {
    let stored: Vec<_> = story.hits.iter().filter(|hit| hit.stored).collect();
    assert_eq!(stored.len(), records.len(), "photon {}", story.photon);
    let bits = |xyz: [f32; 3]| xyz.map(f32::to_bits);
    for (hit, record) in stored.iter().zip(records) {
        assert_eq!(hit.bounce, usize::from(record.bounce));
        assert_eq!(hit.surface_index, usize::from(record.surface));
        assert_eq!(bits(hit.position), bits(record.position.to_array()));
        let arrived = story.hits[hit.bounce - 1].direction.expect("the hit before scattered");
        assert_eq!(bits(arrived.map(|c| -c)), bits(record.to_light.to_array()));
    }
}

fn check_run(run: &Run, photons: std::ops::Range<u64>) {
    let list = run.trace_piece(photons.clone());
    assert!(!list.is_empty());
    for photon in photons {
        let story = explain(run, photon).expect("the photon is emitted");
        check(&story, &records_of(&list, photon));
        let (taken, rejected) = story.emission.tries.split_last().expect("a try is taken");
        let length_squared = |[x, y, z]: [f32; 3]| x * x + y * y + z * z;
        assert!(length_squared(*taken) <= 1.0);
        assert!(rejected.iter().all(|xyz| length_squared(*xyz) > 1.0));
        let scatters = story.hits.iter().filter(|hit| hit.scattered).count();
        let is_absorbed = story.ending == Ending::Absorbed;
        assert_eq!(scatters + usize::from(is_absorbed), story.hits.len());
    }
}

#[test]
fn the_story_has_the_numbers_of_the_list() {
    let run = Run::handout(148, 1_000_000);
    check_run(&run, 0..3000);
    check_run(&run, 999_000..1_000_000);
}

#[test]
fn the_story_knows_its_light() {
    let scene = assignment8::create_scene();
    let second = PointLight { position: glam::Vec3::new(-0.5, -0.5, 1.9), color: glam::Vec3::ONE };
    let lights = vec![scene.lights()[0], second];
    let scene = Scene::new(scene.mesh_objects().to_vec(), scene.triangles().to_vec(), lights);
    let run = Run::of_scene(scene, Placement::WORLD, 148, 4000);
    check_run(&run, 1500..2500);
    assert_eq!(explain(&run, 1999).expect("emitted").emission.light, 0);
    assert_eq!(explain(&run, 2000).expect("emitted").emission.light, 1);
    assert!(explain(&run, 4000).is_none());
}

#[test]
fn the_story_ends_at_the_last_bounce_allowed() {
    let mut run = Run::handout(148, 1_000_000);
    run.renderer.max_photon_bounces = 1;
    check_run(&run, 0..1000);
    let ending = |photon| explain(&run, photon).expect("emitted");
    let limited = (0..1000).map(ending).find(|story| story.ending == Ending::BounceLimit);
    assert_eq!(limited.expect("some photon would go on").hits.len(), 2);
}

#[test]
fn the_first_photon_that_stores_is_found() {
    let run = Run::handout(148, 1_000_000);
    let mut found = 0;
    for at_least in 1..=4 {
        found = first_that_stores(&run, 0, at_least).expect("there is one");
        let list = run.trace_piece(0..found + 1);
        let stored = |photon| records_of(&list, photon).len();
        assert!(stored(found) >= at_least);
        assert!((0..found).all(|photon| stored(photon) < at_least));
    }

    let story = json(run_line("explain --until-stored 4 --json", &[]).success());
    assert_eq!(story["photon"], found);
    let next = json(run_line(
        "explain {} --until-stored 4 --json",
        &[Path::new(&(found + 1).to_string())],
    ));
    assert!(next["photon"].as_u64() > Some(found));
}

#[test]
fn json_and_text_tell_the_same() {
    let run = Run::handout(148, 1_000_000);
    let photon = first_that_stores(&run, 0, 2).expect("there is one");
    let story = explain(&run, photon).expect("emitted");
    let photon = photon.to_string();
    let told = json(run_line("explain {} --json", &[Path::new(&photon)]).success());
    assert_eq!(told["seed"], 148);
    let float = |value: &serde_json::Value| value.as_f64().expect("a number") as f32;
    for (axis, component) in story.emission.direction.iter().enumerate() {
        assert_eq!(float(&told["emission"]["direction"][axis]).to_bits(), component.to_bits());
    }
    for (told, hit) in told["hits"].as_array().expect("a list").iter().zip(&story.hits) {
        for key in [
            "bounce",
            "surface",
            "facet",
            "t",
            "position",
            "normal",
            "roulette",
            "survival",
            "scattered",
            "stored",
            "why",
            "u1",
            "u2",
            "tangent",
            "bitangent",
            "direction",
        ] {
            assert!(told.get(key).is_some(), "{key}");
        }
        assert_eq!(float(&told["t"]).to_bits(), hit.t.to_bits());
        assert_eq!(told["surface"], hit.surface);
    }
    let text = stdout(run_line("explain {}", &[Path::new(&photon)]).success());
    for hit in &story.hits {
        assert!(text.contains(&format!("bounce {}: {}", hit.bounce, hit.surface)), "{text}");
        assert!(text.contains(&hit.roulette.to_string()), "{text}");
    }
}

#[test]
fn bad_arguments_are_refused() {
    fails("explain", &[], &["PHOTON"]);
    fails("explain one", &[], &["one"]);
    fails("explain -- -1", &[], &["-1"]);
    fails("explain 1000000", &[], &["1000000", "expected a number below 1000000"]);
    fails("explain 10 --photons 10", &[], &["PHOTON 10", "below 10"]);
    fails("explain --until-stored 0", &[], &["--until-stored"]);
    for line in ["explain abc", "explain -3", "explore --photon x", "explore --photon -1"] {
        fails(line, &[], &["expected a whole number from 0"]);
    }
    let line = "explain --until-stored 900 --photons 1000";
    fails(line, &[], &["--until-stored 900", "found none"]);
    fails("explain 1 --scene no.obj --light 0,0,1", &[], &["no.obj"]);
}
