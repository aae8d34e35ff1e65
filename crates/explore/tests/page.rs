//! The page as a student uses it: real clicks and keys in a real browser.

mod browser;
mod support;

use std::collections::HashSet;
use std::time::Instant;

use browser::launch;
use compare::explain::{Hit, Story, explain};
use explore::Exploration;
use photon_mapping::assignment8;
use photon_mapping::rendering::sampling::CLOSE_TO_PARALLEL;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use serde_json::{Value, json};
use support::{Traced, float, handout, open_handout, write_page};

/// Each step of the photon that is open: its bounce, name, values beside the code, other values,
/// the lines lit, and the parts of lines that do not run.
const ALL_STEPS: &str = "page.steps.map((step, at) => { page.go(at); return {
    link: page.link, say: document.getElementById('say').textContent,
    values: Object.fromEntries([...document.querySelectorAll('#code .value')].map((v) => \
        [v.dataset.name, v.textContent])),
    more: Object.fromEntries([...document.querySelectorAll('#more dt')].map((t) => [t.textContent, \
        t.nextSibling.textContent])),
    lit: [...document.querySelectorAll('#code .lit code')].map((c) => c.textContent.trim()),
    skipped: [...document.querySelectorAll('#code span.skipped')].map((c) => c.textContent) }; })";

/// The pixels of all photons that the handout's camera sees.
fn dots_in_sight(traced: &Traced) -> HashSet<(i64, i64)> {
    let camera = assignment8::create_camera(640, 480);
    let in_sight = traced.records.iter().filter_map(|record| {
        let way = record.position - camera.position;
        let mut state = IntersectionState::new();
        let ray = Ray::new(camera.position, way.normalize());
        let is_hit = traced.run.scene().trace(&ray, Some(&mut state));
        if !is_hit || (state.intersection_t - way.length()).abs() > 0.01 {
            return None;
        }
        let depth = way.dot(camera.forward);
        let across = way.dot(camera.right) / (depth * camera.half_width);
        let upwards = way.dot(camera.up) / (depth * camera.half_height);
        Some((((across + 1.0) * 320.0).round() as i64, ((1.0 - upwards) * 240.0).round() as i64))
    });
    in_sight.collect()
}

#[test]
fn handouts_camera_shows_dots_where_the_picture_has_them() {
    let Some(browser) = open_handout("") else { return };
    browser.media("prefers-reduced-motion", "reduce");
    browser.run("document.getElementById('view').style.cssText = 'width: 640px; height: 480px'");
    browser.run(
        "const colors = document.getElementById('colors'); colors.value = 'red'; \
         colors.dispatchEvent(new Event('input'))",
    );
    browser.click_on("#home");
    // The path and its labels would hide dots.
    browser.run(
        "page.view.setLines('path', []); page.view.setMarks([]); \
         document.getElementById('labels').style.display = 'none'",
    );
    browser.run("window.scrollTo(0, 0)");
    browser.settle();
    let place = browser.run(
        "(() => { const r = document.getElementById('view').getBoundingClientRect(); return [r.x, \
         r.y, r.width, r.height]; })()",
    );
    let [left, top, width, height] = [0, 1, 2, 3].map(|i| float(&place[i]) as u32);
    assert_eq!((width, height), (640, 480));
    let shot = browser.screenshot();
    let picture = &handout().0.picture;
    let is_drawn = |x: i64, y: i64| {
        let inside = (0..640).contains(&x) && (0..480).contains(&y);
        inside && {
            let [r, g, b] = shot.get_pixel(left + x as u32, top + y as u32).0.map(i32::from);
            r > g + 60 && r > b + 60
        }
    };
    let near = |x: u32, y: u32, is_red: &dyn Fn(i64, i64) -> bool| {
        let around = |d: i64| (-1..=1).map(move |e| (d, e));
        (-1..=1).flat_map(around).any(|(dx, dy)| is_red(i64::from(x) + dx, i64::from(y) + dy))
    };
    let red: Vec<_> = picture
        .enumerate_pixels()
        .filter(|(_, _, p)| p.0[0] == 255)
        .map(|(x, y, _)| (x, y))
        .collect();
    let found = red.iter().filter(|(x, y)| near(*x, *y, &is_drawn)).count();
    assert!(red.len() > 10_000, "{}", red.len());
    assert!(found * 100 >= red.len() * 99, "{found} of {}", red.len());
    // And no dots but those of photons in sight. The picture misses some of these: seen at a
    // grazing angle, a dot is narrower than a pixel.
    let in_sight = dots_in_sight(&handout().0);
    let all = (0..480).flat_map(|y| (0..640).map(move |x| (x, y)));
    let drawn: Vec<_> = all.filter(|(x, y)| is_drawn(*x, *y)).collect();
    let is_in_sight = |x: i64, y: i64| in_sight.contains(&(x, y));
    let right = drawn.iter().filter(|(x, y)| near(*x as u32, *y as u32, &is_in_sight)).count();
    eprintln!(
        "{found} of {} red pixels drawn; {right} of {} drawn pixels at a photon in sight",
        red.len(),
        drawn.len()
    );
    assert!(right * 100 >= drawn.len() * 98, "{right} of {}", drawn.len());
    browser.has_been_quiet();
}

#[test]
fn clicking_a_dot_opens_its_photon() {
    let Some(browser) = open_handout("#photon=253&bounce=0&step=emission") else { return };
    browser.media("prefers-reduced-motion", "reduce");
    // Close to the dot, so that no other is as near to the click.
    browser.run(
        "const stored = page.run.firstStored[page.run.pathOfPhoton(73)]; page.view.look({ target: \
         [...page.positions.subarray(3 * stored, 3 * stored + 3)], distance: 0.3, yaw: 1.2, pitch: \
         0 });",
    );
    browser.settle();
    let place = browser.run(
        "(() => { const [x, y] = page.view.project(page.view.camera.target); const r = \
         page.view.canvas.getBoundingClientRect(); return [r.x + x, r.y + y]; })()",
    );
    let before = Instant::now();
    browser.click(float(&place[0]), float(&place[1]));
    browser.wait_for("location.hash === '#photon=73&bounce=1&step=stored'");
    eprintln!("a click to its story, with the protocol: {:?}", before.elapsed());
    assert_eq!(browser.text("document.getElementById('photon').value"), "73");
    assert!(browser.text("document.getElementById('say').textContent").contains("stored"));
    browser.has_been_quiet();
}

/// Whether `step` lights the line `code`.
fn is_lit(step: &Value, code: &str) -> bool {
    step["lit"].as_array().expect("a list").iter().any(|line| line == code)
}

fn vector(xyz: &[f32; 3]) -> String {
    compare::explain::vector(xyz)
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
    assert_eq!(at_hit["more"]["t"], hit.t.to_string());
    assert_eq!(at_hit["values"]["intersection_point"], vector(&hit.position));
    assert_eq!(at_hit["more"]["normal"], vector(&hit.normal));
    let says =
        |step: &Value, words: &str| step["say"].as_str().is_some_and(|say| say.contains(words));
    assert!(says(&at_hit, &format!("The ray meets {}, face {},", hit.surface, hit.facet)));
    assert!(says(&stored, if hit.stored { "It is stored," } else { "It is not stored." }));
    let pushed = if hit.stored { "runs" } else { "skipped" };
    assert_eq!(stored["values"]["photon_map.push()"], pushed);
    assert_eq!(stored["values"]["path.len()"], (hit.bounce + 1).to_string());
    assert_eq!(roulette["values"]["rand()"], hit.roulette.to_string());
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
        let told = emission["more"][format!("try {}", i + 1)].as_str().expect("a try");
        let [x, y, z] = *xyz;
        assert!(
            told.starts_with(&format!(
                "{}, x² + y² + z² = {}: ",
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

#[test]
fn the_panel_has_the_numbers_of_explain() {
    let Some(browser) = open_handout("#photon=73") else { return };
    let run = &handout().0;
    // Nothing needs to be laid out to be read.
    browser.run("document.querySelector('main').style.display = 'none'");
    let mut photons: Vec<u64> = run.records.iter().map(|record| u64::from(record.photon)).collect();
    photons.dedup();
    // Photon 73, and 1,000 spread over the run.
    let mut some = vec![73];
    some.extend(photons.iter().step_by(photons.len() / 1000));
    for some in some.chunks(50) {
        let list = json!(some);
        let steps = browser.run(&format!(
            "{list}.map((photon) => {{ page.open(photon, 0, 'emission'); return {ALL_STEPS}; }})"
        ));
        for (photon, steps) in some.iter().zip(steps.as_array().expect("a list")) {
            check_story(&explain(&run.run, *photon).expect("emitted"), steps);
        }
    }
    browser.has_been_quiet();
}

#[test]
fn a_link_restores_its_step() {
    let Some(browser) = open_handout("#photon=73&bounce=1&step=roulette") else { return };
    let title = || browser.text("document.getElementById('step-title').textContent");
    assert_eq!(title(), "Photon Scattering/Absorption");
    assert_eq!(
        browser.text("document.querySelector('#names [aria-current]').textContent"),
        "Roulette"
    );
    assert_eq!(
        browser.text("document.querySelector('#path [aria-current]').textContent"),
        "1 rightWall"
    );
    // Going on changes the address, and the address alone brings back what was there.
    browser.press("ArrowLeft");
    browser.wait_for("location.hash === '#photon=73&bounce=1&step=stored'");
    browser.run("location.hash = '#photon=73&bounce=0&step=frame'");
    browser.wait_for("document.querySelector('#names [aria-current]').textContent === 'Frame'");
    assert_eq!(title(), "Hemisphere Ray Transformation");
    // A photon that the page does not have is named, with the command that shows it.
    browser.run("location.hash = '#photon=74'");
    browser.wait_for("!document.getElementById('no-story').hidden");
    assert!(
        browser
            .text("document.getElementById('no-story').textContent")
            .contains("explore --photon 74")
    );
    browser.run("location.hash = '#photon=99999999999'");
    browser.wait_for("document.getElementById('no-story').textContent.includes('below 1,000,000')");
    // So it is when the page opens on such a link, beside the story of the first photon.
    browser.open(&handout().1, "#photon=74");
    let no_story = browser.text("document.getElementById('no-story').textContent");
    assert!(no_story.contains("explore --photon 74"), "{no_story}");
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=emission");
    browser.has_been_quiet();
}

#[test]
fn the_mouse_turns_zooms_and_centers() {
    let Some(browser) = open_handout("#photon=73&bounce=0&step=emission") else { return };
    browser.media("prefers-reduced-motion", "reduce");
    let of_camera = |what: &str| float(&browser.run(&format!("page.view.camera.{what}")));
    let (yaw, distance) = (of_camera("yaw"), of_camera("distance"));
    browser.drag([200.0, 300.0], [300.0, 300.0]);
    assert!((of_camera("yaw") - yaw - 0.6).abs() < 0.02, "{}", of_camera("yaw"));
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=emission");
    browser.wheel(200.0, 300.0, -240.0);
    browser.wait_for(&format!("page.view.camera.distance < {}", 0.8 * distance));
    browser.click_on("#home");
    browser.settle();
    // A double-click on a dot turns the box around it from then on.
    let dot = "[...page.positions.subarray(0, 3)]";
    browser.run(&format!(
        "page.view.look({{ target: {dot}, distance: 0.3, yaw: 1.2, pitch: 0 }}); page.view.look({{ \
         target: page.view.camera.target.map((x) => x + 0.01) }})"
    ));
    browser.settle();
    let place = browser.run(&format!(
        "(() => {{ const [x, y] = page.view.project({dot}); const r = \
         page.view.canvas.getBoundingClientRect(); return [r.x + x, r.y + y]; }})()"
    ));
    let (x, y) = (float(&place[0]), float(&place[1]));
    browser.double_click(x, y);
    browser.wait_for(&format!(
        "Math.hypot(...page.view.camera.target.map((x, i) => x - {dot}[i])) < 1e-6"
    ));
    browser.has_been_quiet();
}

#[test]
fn table_and_filters_show_what_they_say() {
    let Some(browser) = open_handout("") else { return };
    let (surfaces, total) = &handout().0.table;
    let cells = browser.run(
        "[...document.querySelectorAll('#table tbody tr')].map((row) => \
         [...row.querySelectorAll('b')].map((b) => Number(b.textContent.replaceAll(',', ''))))",
    );
    for (row, surface) in surfaces.iter().chain([total]).enumerate() {
        let counts = surface.by_bounce.iter().take(3).map(|cell| cell.stored);
        for (column, stored) in counts.chain([surface.late.stored, surface.stored]).enumerate() {
            assert_eq!(cells[row][column], stored);
        }
    }
    let shown = || browser.text("document.getElementById('shown').textContent");
    browser.click_on("#table tbody tr:nth-child(2) td:nth-child(3) button");
    let stored = surfaces[1].by_bounce[1].stored;
    let number =
        format!("{},{:03} photons shown: rightWall, bounce 2.", stored / 1000, stored % 1000);
    assert_eq!(shown(), number);
    browser.click_on("#table tbody tr:nth-child(2) td:nth-child(3) button");
    browser.run("document.querySelector('.filters').open = true");
    browser.click_on("#by-bounce input");
    let others = total.stored - total.by_bounce[0].stored;
    assert_eq!(shown(), format!("{},{:03} photons shown.", others / 1000, others % 1000));
    browser.click_on("#by-bounce input");
    browser.run(
        "for (const [id, value] of [['from', 73], ['to', 73]]) { const field = \
         document.getElementById(id); field.value = value; field.dispatchEvent(new \
         Event('input')); }",
    );
    assert_eq!(shown(), "1 photon shown.");
    browser.has_been_quiet();
}

#[test]
fn a_scene_of_ones_own_is_explored() {
    let Some(browser) = launch(true) else { return };
    let traced = Traced::of(fixtures::closed_cube(0.5, 7, 2000), None);
    let (surfaces, total) = &traced.table;
    let exploration =
        Exploration { is_handout: false, table: (surfaces, total), ..traced.exploration(None) };
    browser.open(&write_page("cube", &exploration.page()), "");
    let stored = traced.records.len();
    assert_eq!(
        browser.text("document.getElementById('shown').textContent"),
        format!("{},{:03} photons shown.", stored / 1000, stored % 1000)
    );
    let photon = traced.records[0].photon;
    assert_eq!(browser.text("document.getElementById('photon').value"), photon.to_string());
    // From the box's outside its walls are turned away, so the dots within are in sight.
    browser.settle();
    let drawn = "(() => { const v = page.view, gl = v.gl; v.drawNow(); const all = new \
         Uint8Array(4 * v.canvas.width * v.canvas.height); gl.readPixels(0, 0, v.canvas.width, \
         v.canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, all); let dots = 0; for (let i = 0; i < \
         all.length; i += 4) dots += all[i + 2] > all[i] + 60; return dots; })()";
    let drawn = float(&browser.run(drawn));
    assert!(drawn > 100.0, "{drawn}");
    browser.has_been_quiet();
}

#[test]
fn page_of_the_default_run_is_small_and_quick() {
    let (_, path) = handout();
    let size = std::fs::metadata(path).expect("written").len();
    assert!(size <= 2_500_000, "{size}");
    let Some(browser) = open_handout("#photon=73&bounce=0&step=emission") else { return };
    let first = float(&browser.run("page.firstFrame"));
    // Frames of all dots while the camera turns, each waited for. Other tests run at once, so the
    // quickest counts.
    let frames = float(&browser.run(
        "(() => { const v = page.view, times = []; const start = performance.now(); while \
         (performance.now() - start < 2000 || times.length < 5) { const before = \
         performance.now(); v.camera.yaw += 0.02; v.moved = -Infinity; v.drawNow(); v.finish(); \
         times.push(performance.now() - before); } return 1000 / Math.min(...times); })()",
    ));
    let click = float(&browser.run(
        "Math.min(...[253, 73, 253, 73, 253].map((photon) => { const start = performance.now(); \
         page.open(photon, 0, 'hit'); page.view.drawNow(); page.view.finish(); return \
         performance.now() - start; }))",
    ));
    eprintln!(
        "page {size} bytes, first frame {first:.0} ms, {frames:.0} frames/s, a click to its path \
         and story {click:.1} ms"
    );
    // Generous beside the targets of 1500 ms, 20 frames/s and 50 ms: other tests run at once.
    assert!(
        first < 6000.0 && frames > 5.0 && click < 250.0,
        "{first} ms, {frames} frames/s, {click} ms"
    );
    browser.has_been_quiet();
}
