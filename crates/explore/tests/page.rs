//! The page as a student uses it: real clicks and keys in a real browser.

use std::collections::HashSet;
use std::time::Instant;

use crate::browser::launch;
use crate::support::{Traced, float, handout, open_short, short, write_page};
use compare::numbers::thousands;
use explore::Exploration;
use photon_mapping::assignment8;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use serde_json::json;

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
    let Some(browser) = launch(true) else { return };
    browser.open(&handout().1, "");
    browser.run("document.getElementById('view').style.cssText = 'width: 640px; height: 480px'");
    browser.set("#colors", "red");
    browser.click_on("#home");
    // The path and its labels would hide dots.
    browser.run("document.getElementById('over').style.display = 'none'");
    browser.run("window.scrollTo(0, 0)");
    browser.settle();
    let [left, top, right, bottom] = browser.edges("#view").map(|edge| edge.round() as u32);
    assert_eq!((right - left, bottom - top), (640, 480));
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
    let Some(browser) = open_short("#photon=253&bounce=0&step=emission") else { return };
    // Close to the dot, so that no other is as near to the click.
    browser.run(
        "const stored = page.run.dotPhoton.indexOf(73); page.view.look({ \
         target: page.run.place(stored), distance: 0.3, yaw: 1.2, pitch: 0 });",
    );
    browser.settle();
    let before = Instant::now();
    browser.click_at("page.view.camera.target", 1);
    browser.wait_for("location.hash === '#photon=73&bounce=1&step=stored'");
    eprintln!("a click to its story, with the protocol: {:?}", before.elapsed());
    assert_eq!(browser.text("document.getElementById('photon').value"), "73");
    assert!(browser.text_of("#say").contains("stored"));
    browser.has_been_quiet();
}

#[test]
fn a_link_restores_its_step() {
    let Some(browser) = open_short("#photon=73&bounce=1&step=roulette") else { return };
    let title = || browser.text_of("#step-title");
    assert_eq!(title(), "Photon Scattering/Absorption");
    assert_eq!(browser.text_of("#names [aria-current]"), "Roulette");
    assert_eq!(browser.text_of("#path [aria-current]"), "1 rightWall");
    // Going on changes the address, and the address alone brings back what was there.
    browser.press("ArrowLeft");
    browser.wait_for("location.hash === '#photon=73&bounce=1&step=stored'");
    browser.run("location.hash = '#photon=73&bounce=0&step=frame'");
    browser.wait_for("document.querySelector('#names [aria-current]').textContent === 'Frame'");
    assert_eq!(title(), "Hemisphere Ray Transformation");
    // A photon that the page does not have is named, with the command that shows it.
    browser.run("location.hash = '#photon=74'");
    browser.wait_for("!document.getElementById('no-story').hidden");
    assert!(browser.text_of("#no-story").contains("explore --photon 74"));
    assert_eq!(
        browser.run("[...document.querySelectorAll('#no-story .whole')].map((n) => n.textContent)"),
        json!(["photon-mapping explore --photon 74"])
    );
    browser.run("location.hash = '#photon=99999999999'");
    browser.wait_for("document.getElementById('no-story').textContent.includes('below 20,000')");
    // Nothing but the number of a photon names one.
    for typed in ["-1", "73.5", ""] {
        browser.run("document.getElementById('no-story').textContent = ''");
        browser.set("#photon", typed);
        assert!(browser.text_of("#no-story").contains("a whole number"), "{typed}");
    }
    // So it is when the page opens on such a link, beside the story of the first photon.
    browser.open(&short().1, "#photon=74");
    let no_story = browser.text_of("#no-story");
    assert!(no_story.contains("explore --photon 74"), "{no_story}");
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=emission");
    browser.has_been_quiet();
}

#[test]
fn the_mouse_turns_zooms_and_centers() {
    let Some(browser) = open_short("#photon=73&bounce=0&step=emission") else { return };
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
    let dot = "page.run.place(0)";
    browser.run(&format!(
        "page.view.look({{ target: {dot}, distance: 0.3, yaw: 1.2, pitch: 0 }}); page.view.look({{ \
         target: page.view.camera.target.map((x) => x + 0.01) }})"
    ));
    browser.settle();
    browser.click_at(dot, 2);
    browser.wait_for(&format!(
        "Math.hypot(...page.view.camera.target.map((x, i) => x - {dot}[i])) < 1e-6"
    ));
    browser.has_been_quiet();
}

#[test]
fn table_and_filters_show_what_they_say() {
    let Some(browser) = open_short("") else { return };
    let (surfaces, total) = &short().0.table;
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
    let shown = || browser.text_of("#shown");
    browser.click_on("#table tbody tr:nth-child(2) td:nth-child(3) button");
    let stored = surfaces[1].by_bounce[1].stored;
    assert_eq!(shown(), format!("{stored} photons shown: rightWall, bounce 2."));
    browser.click_on("#table tbody tr:nth-child(2) td:nth-child(3) button");
    browser.click_on("#table thead input");
    let others = total.stored - total.by_bounce[0].stored;
    assert_eq!(shown(), format!("{} photons shown.", thousands(others)));
    browser.click_on("#table thead input");
    browser.set("#from", "73");
    browser.set("#to", "73");
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
    assert_eq!(browser.text_of("#shown"), format!("{} photons shown.", thousands(stored as u64)));
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
fn of_too_many_photons_whole_paths_are_shown_evenly() {
    let Some(browser) = launch(true) else { return };
    let mut traced = Traced::new(2000);
    let records = traced.records.clone();
    let paths: Vec<_> = records.chunk_by(|a, b| a.photon == b.photon).collect();
    // Each path so often that there are twice as many photons as a page shows.
    let times = 2_000_000 / records.len();
    traced.records = paths.iter().flat_map(|path| path.repeat(times)).collect();
    browser.open(&write_page("thinned", &traced.exploration(None).page()), "");
    let shown = browser.run("page.run.paths.map(({ photon }) => photon)");
    let every_second = paths.iter().skip(1).step_by(2);
    let photons: Vec<_> = every_second.clone().map(|path| path[0].photon).collect();
    assert_eq!(shown, json!(photons));
    let kept: usize = every_second.map(|path| times * path.len()).sum();
    let told = format!("Of these the page has {}, evenly thinned.", thousands(kept as u64));
    assert!(browser.text_of("header p").contains(&told), "{told}");
    // A photon that was left out may have stored some.
    browser.run(&format!("page.open({}, 0, 'emission')", paths[0][0].photon));
    assert!(browser.text_of("#no-story").contains("or the page leaves it out"));
    browser.has_been_quiet();
}

#[test]
fn page_of_the_default_run_is_small_and_quick() {
    let (run, path) = handout();
    let page = std::fs::read_to_string(path).expect("written");
    let size = page.len();
    assert!(size <= 2_500_000, "{size}");
    // A million stored photons have 40 MB. They pack a little better than these.
    let data = page.split_once("id=\"data\">").expect("the block").1;
    let data = data.split_once("</script>").expect("its end").0.len();
    let stored = run.records.len();
    assert!(data <= 41 * stored, "{data} bytes for {stored} stored photons");
    let Some(browser) = launch(true) else { return };
    browser.open(path, "#photon=73&bounce=0&step=emission");
    let first = float(&browser.run("page.firstFrame"));
    // Generous beside the targets of 1500 ms, 20 frames/s and 50 ms: other tests run at once. For
    // the same reason the quickest of five tries counts, or of more on a machine so busy that none
    // of them keeps within the limit, in milliseconds.
    const MOST_TO_FIRST: f64 = 6000.0;
    const MOST_FOR_FRAME: f64 = 200.0;
    const MOST_FOR_CLICK: f64 = 250.0;
    let quickest = |action: &str, limit: f64| {
        float(&browser.run(&format!(
            "(() => {{ const v = page.view, times = [], start = performance.now(); while \
             (times.length < 5 || (Math.min(...times) >= {limit} && performance.now() < start + \
             30000)) {{ const before = performance.now(); {action}; v.drawNow(); v.finish(); \
             times.push(performance.now() - before); }} return Math.min(...times); }})()"
        )))
    };
    // A frame of all dots while the camera turns, waited for.
    let frame = quickest("v.camera.yaw += 0.02; v.moved = -Infinity", MOST_FOR_FRAME);
    let click = quickest("page.open([253, 73][times.length % 2], 0, 'hit')", MOST_FOR_CLICK);
    let measured = format!(
        "page {size} bytes, first frame {first:.0} ms, {:.0} frames/s, a click to its path and \
         story {click:.1} ms",
        1000.0 / frame
    );
    eprintln!("{measured}");
    assert!(
        first < MOST_TO_FIRST && frame < MOST_FOR_FRAME && click < MOST_FOR_CLICK,
        "{measured}"
    );
    browser.has_been_quiet();
}
