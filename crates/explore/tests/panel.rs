//! The panel's numbers, and the lines it lights, held to the story that `explain` tells.

use crate::browser::{Browser, launch};
use crate::support::{Traced, handout, write_page};
use compare::explain::{Ending, Hit, Story, explain, vector};
use photon_mapping::assignment8;
use photon_mapping::rendering::sampling::CLOSE_TO_PARALLEL;
use serde_json::{Value, json};
use variants::run::Run;

/// Each step of the photon that is open: its bounce, name, values beside the code and in the words,
/// the tries, the lines lit, and the parts of lines that do not run.
const ALL_STEPS: &str = "page.steps.map((step, at) => { page.go(at); return {
    link: page.link, say: document.getElementById('say').textContent,
    values: Object.fromEntries([...document.querySelectorAll('#code .value')].map((v) => \
        [v.dataset.name, v.textContent])),
    said: Object.fromEntries([...document.querySelectorAll('#say [data-name]')].map((v) => \
        [v.dataset.name, v.textContent])),
    tries: [...document.querySelectorAll('#code small')].map((t) => t.textContent),
    lit: [...document.querySelectorAll('#code .lit code')].map((c) => c.textContent.trim()),
    skipped: [...document.querySelectorAll('#code span.skipped')].map((c) => c.textContent) }; })";

/// Whether `step` lights the line `code`.
fn is_lit(step: &Value, code: &str) -> bool {
    step["lit"].as_array().expect("a list").iter().any(|line| line == code)
}

/// Checks all that the panel shows at the hit `hit`, whose steps are `steps`.
fn check_hit(hit: &Hit, steps: &[&Value]) {
    let step = |name: &str| -> Value {
        let found = steps.iter().find(|step| {
            step["link"].as_str().is_some_and(|link| link.ends_with(&format!("step={name}")))
        });
        (*found.unwrap_or_else(|| panic!("no step {name} at bounce {}", hit.bounce))).clone()
    };
    let show = |names: &[&str]| names.iter().map(|name| step(name)).collect::<Vec<_>>();
    let [at_hit, stored, roulette] =
        show(&["hit", "stored", "roulette"]).try_into().expect("three");
    assert_eq!(at_hit["said"]["t"], hit.t.to_string());
    assert_eq!(at_hit["values"]["intersection_point"], vector(&hit.position));
    assert_eq!(at_hit["said"]["normal"], vector(&hit.normal));
    let says =
        |step: &Value, words: &str| step["say"].as_str().is_some_and(|say| say.contains(words));
    assert!(says(&at_hit, &format!("The ray meets {}, face {},", hit.surface, hit.facet)));
    let [told, other] = ["It is stored,", "It is not stored."];
    let [told, other] = if hit.stored { [told, other] } else { [other, told] };
    assert!(says(&stored, told) && !says(&stored, other));
    let pushed = if hit.stored { "runs" } else { "skipped" };
    assert_eq!(stored["values"]["photon_map.push()"], pushed);
    assert_eq!(stored["values"]["path.len()"], (hit.bounce + 1).to_string());
    assert_eq!(roulette["values"]["u"], hit.roulette.to_string());
    assert_eq!(roulette["values"]["probability_of_reflection"], hit.survival.to_string());
    assert!(is_lit(&at_hit, "if remaining_bounces < 0 {"));
    assert!(is_lit(&stored, "if path.len() > 1 {"));
    assert_eq!(is_lit(&stored, "photon_map.push(Photon {"), hit.stored);
    assert!(is_lit(&stored, "path.push(PathVertex::Surface(state));"));
    assert_eq!(is_lit(&roulette, "return;"), !hit.scattered);
    assert!(says(&roulette, if hit.scattered { "the photon scatters" } else { "is absorbed" }));
    let scattering = (hit.u1, hit.u2, hit.tangent, hit.bitangent, hit.direction);
    let (Some(u1), Some(u2), Some(tangent), Some(bitangent), Some(direction)) = scattering else {
        assert!(steps.len() == 3 || hit.bounce == 0 && steps.len() == 4);
        return;
    };
    let [hemisphere, frame, ray] = show(&["hemisphere", "frame", "ray"]).try_into().expect("three");
    assert_eq!(hemisphere["values"]["u1"], u1.to_string());
    assert_eq!(hemisphere["values"]["u2"], u2.to_string());
    assert_eq!(hemisphere["values"]["ray_direction()"], vector(&direction));
    assert_eq!(frame["values"]["tangent"], vector(&tangent));
    assert_eq!(frame["values"]["bitangent"], vector(&bitangent));
    assert_eq!(frame["values"]["normal"], vector(&hit.normal));
    let is_parallel = hit.normal[0].abs() > CLOSE_TO_PARALLEL;
    let not_taken = if is_parallel { "{ Vec3::X }" } else { "{ Vec3::Y }" };
    assert_eq!(frame["skipped"], json!([not_taken]));
    assert_eq!(ray["values"]["world_space_direction"], vector(&direction));
}

fn check_story(story: &Story, steps: &Value) {
    let steps = steps.as_array().expect("a list");
    let (taken, tries) = (story.emission.tries.last().expect("one"), &story.emission.tries);
    let emission = &steps[0];
    for (name, component) in ["x", "y", "z"].into_iter().zip(taken) {
        assert_eq!(emission["values"][name], component.to_string());
    }
    assert_eq!(emission["values"]["direction"], vector(&story.emission.direction));
    for (i, xyz) in tries.iter().enumerate() {
        let told = emission["tries"][i].as_str().expect("a try");
        let [x, y, z] = *xyz;
        assert!(
            told.starts_with(&format!(
                "Try {}: {}, x² + y² + z² = {}:",
                i + 1,
                vector(xyz),
                x * x + y * y + z * z
            )),
            "{told}"
        );
    }
    let times = if tries.len() == 1 { "once".into() } else { format!("{} times", tries.len()) };
    assert_eq!(emission["values"]["loop"], format!("runs {times}"));
    // Every path ends by one `return`, at its last step.
    let returns = steps.iter().map(|step| is_lit(step, "return;"));
    let at: Vec<_> = returns.enumerate().filter(|(_, is_lit)| *is_lit).map(|(at, _)| at).collect();
    assert_eq!(at, [steps.len() - 1], "photon {}", story.photon);
    for hit in &story.hits {
        let of_bounce = |step: &&Value| {
            step["link"]
                .as_str()
                .is_some_and(|link| link.contains(&format!("&bounce={}&", hit.bounce)))
        };
        check_hit(hit, &steps.iter().filter(of_bounce).collect::<Vec<_>>());
    }
}

/// Checks the stories of `photons` on the page of `run`.
fn check_stories(browser: &Browser, run: &Run, photons: &[u32]) {
    // Nothing needs to be laid out to be read.
    browser.run("document.body.style.display = 'none'");
    for some in photons.chunks(50) {
        let list = json!(some);
        let steps = browser.run(&format!(
            "{list}.map((photon) => {{ page.open(photon, 0, 'emission'); return {ALL_STEPS}; }})"
        ));
        for (photon, steps) in some.iter().zip(steps.as_array().expect("a list")) {
            check_story(&explain(run, u64::from(*photon)).expect("emitted"), steps);
        }
    }
    browser.has_been_quiet();
}

/// The photons that `run` stores, each once.
fn photons(run: &Traced) -> Vec<u32> {
    let mut photons: Vec<_> = run.records.iter().map(|record| record.photon).collect();
    photons.dedup();
    photons
}

#[test]
fn the_panel_has_the_numbers_of_explain() {
    let Some(browser) = launch(true) else { return };
    let (run, page) = handout();
    browser.open(page, "#photon=73");
    // Photon 73, and 1,000 spread over the run.
    let all = photons(run);
    let some: Vec<_> = all.iter().step_by(all.len() / 1000).copied().chain([73]).collect();
    check_stories(&browser, &run.run, &some);
}

#[test]
fn a_path_that_ends_at_the_bounce_limit_lights_its_return() {
    let Some(browser) = launch(true) else { return };
    let mut run = Run::handout(assignment8::SEED, 2000);
    run.renderer.max_photon_bounces = 1;
    let run = Traced::of(run, None);
    browser.open(&write_page("limit", &run.exploration(None).page()), "");
    let photons = photons(&run);
    check_stories(&browser, &run.run, &photons);
    let ending = |photon: &&u32| explain(&run.run, u64::from(**photon)).expect("emitted").ending;
    let limits = photons.iter().filter(|photon| ending(photon) == Ending::BounceLimit).count();
    assert!(limits > 10, "{limits}");
}
