//! The page for everyone: by keyboard and by touch, on small and large screens, for the
//! color-blind, with less motion, and without WebGL.

use crate::browser::launch;
use crate::support::{float, open_short, short};

const PICTURE_IS_SHOWN: &str = "(() => { const picture = document.getElementById('picture'); \
                                return picture.checkVisibility() && picture.naturalWidth === 640; \
                                })()";

#[test]
fn the_keyboard_alone_is_enough() {
    let Some(browser) = open_short("#photon=73&bounce=0&step=emission") else { return };
    let link = || browser.text("page.link");
    for (key, then) in [
        ("ArrowRight", "bounce=0&step=hit"),
        ("ArrowRight", "bounce=0&step=stored"),
        ("ArrowDown", "bounce=1&step=stored"),
        ("ArrowUp", "bounce=0&step=stored"),
        ("ArrowLeft", "bounce=0&step=hit"),
    ] {
        browser.press(key);
        assert_eq!(link(), format!("#photon=73&{then}"));
    }
    browser.press("n");
    assert_ne!(link(), "#photon=73&bounce=0&step=hit");
    browser.press("p");
    assert_eq!(link(), "#photon=73&bounce=0&step=hit");
    browser.press(" ");
    browser.wait_for("document.getElementById('play').ariaPressed === 'true'");
    browser.wait_for("location.hash === '#photon=73&bounce=0&step=stored'");
    browser.press(" ");
    let distance = || float(&browser.run("page.view.camera.distance"));
    let before = distance();
    browser.press("+");
    assert!(distance() < before);
    browser.press("h");
    assert!((distance() - 4.1469).abs() < 1e-4);
    // Every control is reached by Tab, and what is reached shows it.
    let mut reached = Vec::new();
    for _ in 0..80 {
        browser.press("Tab");
        reached.push(browser.text("document.activeElement.id || document.activeElement.tagName"));
    }
    for id in [
        "view", "home", "center", "colors", "walls", "previous", "photon", "next", "play", "slider",
    ] {
        assert!(reached.iter().any(|name| name == id), "{id}: {reached:?}");
    }
    // A number is typed and Enter opens it; its arrows are the field's own.
    browser.run(
        "document.getElementById('photon').focus(); document.getElementById('photon').select()",
    );
    "253".chars().for_each(|digit| browser.press(&digit.to_string()));
    browser.press("Enter");
    assert_eq!(link(), "#photon=253&bounce=0&step=emission");
    // A cell of the table lights its photons, and Enter keeps them alone.
    browser.run("document.querySelector('#table td button').focus()");
    let states = |state: u8| {
        float(&browser.run(&format!(
            "page.looks.filter((look, i) => i % 2 === 1 && look === {state}).length"
        ))) as u64
    };
    let of_cell = short().0.table.0[0].by_bounce[0].stored;
    assert_eq!(states(2), of_cell);
    browser.press("Enter");
    assert_eq!(states(0), short().0.records.len() as u64 - of_cell);
    browser.has_been_quiet();
}

#[test]
fn it_works_on_a_phone() {
    let Some(browser) = launch(true) else { return };
    browser.size(390, 844);
    browser.open(&short().1, "#photon=73&bounce=0&step=emission");
    for scheme in ["light", "dark"] {
        browser.media("prefers-color-scheme", scheme);
        for step in ["emission", "hit", "stored", "roulette", "hemisphere", "frame", "ray"] {
            browser.run(&format!("location.hash = '#photon=73&bounce=0&step={step}'"));
            browser.settle();
            assert_eq!(browser.run("document.documentElement.scrollWidth"), 390, "{step}");
        }
    }
    // A box to tick is as large as its label.
    let smallest = "Math.min(...\
         [...document.querySelectorAll('button, input, select, summary, .chips a')]\
         .filter((n) => n.offsetParent).map((n) => n.type === 'checkbox' ? n.parentNode : n)\
         .map((n) => n.getBoundingClientRect()).map((r) => Math.min(r.width, r.height)))";
    assert!(float(&browser.run(smallest)) >= 40.0, "{}", browser.run(smallest));
    let place = browser.run(
        "(() => { const b = [...document.querySelectorAll('#names a')].find((b) => \
         b.textContent === 'Roulette'); b.scrollIntoView({ block: 'center' }); const r = \
         b.getBoundingClientRect(); return [r.x + 9, r.y + 9]; })()",
    );
    browser.tap(float(&place[0]), float(&place[1]));
    browser.wait_for("location.hash.endsWith('step=roulette')");
    browser.has_been_quiet();
}

#[test]
fn box_story_and_code_are_seen_at_once_on_a_phone() {
    let Some(browser) = launch(true) else { return };
    for (width, height) in [(390, 844), (844, 390)] {
        browser.size(width, height);
        browser.load(&short().1, "");
        for step in ["hit", "stored", "roulette", "hemisphere", "frame", "ray"] {
            browser.run("window.scrollTo(0, 0)");
            browser.run(&format!("page.open(73, 0, '{step}')"));
            let is_in_sight = |selector: &str| {
                let [_, top, _, bottom] = browser.edges(selector);
                let place = format!("{selector}, {step} at {width} x {height}: {top} to {bottom}");
                assert!(top >= 0.0 && bottom <= f64::from(height), "{place}");
            };
            // At once, with a line of code that runs.
            ["#over", "#say", "#forward", "#code .lit"].into_iter().for_each(is_in_sight);
            // Further down, the box and the buttons that step stay.
            browser.run(
                "document.querySelector('#code figure:last-of-type')\
                 .scrollIntoView({ block: 'end' })",
            );
            assert!(float(&browser.run("window.scrollY")) > 0.0);
            is_in_sight("#forward");
            assert_eq!(browser.edges("#stage")[1], 0.0, "{step} at {width} x {height}");
        }
    }
    let before = browser.text("page.link");
    let [left, top, ..] = browser.edges("#back");
    browser.tap(left + 9.0, top + 9.0);
    browser.wait_for(&format!("page.link !== '{before}'"));
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=frame");
    browser.has_been_quiet();
}

#[test]
fn without_webgl_the_rest_works() {
    let Some(browser) = launch(false) else { return };
    browser.open(&short().1, "#photon=73&bounce=0&step=roulette");
    assert!(browser.text_of("#trouble").contains("WebGL"));
    browser.wait_for(PICTURE_IS_SHOWN);
    let is_seen = "document.getElementById('view').checkVisibility({ visibilityProperty: true })";
    assert_eq!(browser.run(is_seen), false);
    browser.press("ArrowRight");
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=hemisphere");
    browser.click_on("#table td button");
    browser.wait_for("document.getElementById('shown').textContent.includes('shortBox, bounce 1')");
    browser.has_been_quiet();
}

#[test]
fn two_fingers_zoom_and_one_turns() {
    let Some(browser) = launch(true) else { return };
    browser.size(390, 844);
    browser.open(&short().1, "#photon=73&bounce=0&step=emission");
    let of_camera = |what: &str| float(&browser.run(&format!("page.view.camera.{what}")));
    let (distance, yaw) = (of_camera("distance"), of_camera("yaw"));
    let [left, top, right, bottom] = browser.edges("#view");
    browser.pinch((left + right) / 2.0, (top + bottom) / 2.0, 80.0, 160.0);
    let halved = of_camera("distance") / distance;
    assert!((halved - 0.5).abs() < 0.05, "{halved}");
    assert_eq!(of_camera("yaw"), yaw);
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=emission");
    browser.has_been_quiet();
}

#[test]
fn it_fills_a_projector() {
    let Some(browser) = launch(true) else { return };
    browser.size(1920, 1080);
    browser.open(&short().1, "#photon=73&bounce=0&step=roulette");
    let is_too_wide = "document.documentElement.scrollWidth > document.documentElement.clientWidth";
    assert_eq!(browser.run(is_too_wide), false);
    let [left, _, right, _] = browser.edges("#view");
    assert!(right - left > 900.0, "{}", right - left);
    let [.., bottom] = browser.edges("#code .lit");
    assert!(bottom < 1080.0, "{bottom}");
    browser.has_been_quiet();
}

#[test]
fn a_lost_graphics_context_leaves_picture_table_and_story() {
    let Some(browser) = open_short("#photon=73&bounce=0&step=roulette") else { return };
    browser.run("page.view.gl.getExtension('WEBGL_lose_context').loseContext()");
    browser.wait_for(PICTURE_IS_SHOWN);
    browser.press("ArrowRight");
    assert_eq!(browser.text("page.link"), "#photon=73&bounce=0&step=hemisphere");
    browser.click_on("#table td button");
    browser.wait_for("document.getElementById('shown').textContent.includes('shortBox, bounce 1')");
    browser.has_been_quiet();
}

#[test]
fn shapes_tell_what_colors_tell() {
    let Some(browser) = open_short("#photon=73") else { return };
    // The pixels that a large dot of each shape colors.
    let pixels = "(() => { const v = page.view, gl = v.gl, drawn = {}; \
         v.layers.walls.count = 0; for (let shape = 0; shape < 6; shape++) { \
         v.setLayer('dots', 'POINTS', new Float32Array(v.camera.target), \
         Uint8Array.of(255, 0, 0, 255), new Int8Array(3), Uint8Array.of(shape, 3)); v.drawNow(); \
         const all = new Uint8Array(4 * v.canvas.width * v.canvas.height); \
         gl.readPixels(0, 0, v.canvas.width, v.canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, all); \
         drawn[shape] = []; for (let i = 0; i < all.length; i += 4) \
         if (all[i] > all[i + 1] + 60 && all[i] > all[i + 2] + 60) drawn[shape].push(i); } \
         return drawn; })()";
    let pixels = browser.run(pixels);
    let of_shapes: Vec<_> = pixels.as_object().expect("pixels for each shape").values().collect();
    assert!(of_shapes.iter().all(|pixels| pixels.as_array().is_some_and(|all| all.len() > 20)));
    for (i, pixels) in of_shapes.iter().enumerate() {
        assert!(!of_shapes[..i].contains(pixels), "{pixels}");
    }
    // No two entries of a legend have one shape.
    for mode in ["bounce", "surface"] {
        browser.set("#colors", mode);
        let shapes = "new Set([...document.querySelectorAll('#legend .swatch')].map((dot) => \
                      dot.textContent)).size";
        assert_eq!(browser.run(shapes), 4, "{mode}");
        let drawn = "new Set(page.looks.filter((look, i) => i % 2 === 0)).size";
        assert_eq!(browser.run(drawn), 4, "{mode}");
    }
    browser.has_been_quiet();
}

#[test]
fn no_label_covers_another() {
    let Some(browser) = open_short("") else { return };
    let overlaps = "(() => { const spans = [...document.querySelectorAll('#over .label')]; const \
         boxes = spans.filter((span) => span.style.display !== 'none')\
         .map((span) => span.getBoundingClientRect()); \
         return boxes.some((a, i) => boxes.some((b, j) => i < j && a.left < b.right && b.left < \
         a.right && a.top < b.bottom && b.top < a.bottom)); })()";
    let mut steps = 0;
    for photon in [73, 85, 3101] {
        let of_photon = browser.run(&format!(
            "page.open({photon}, 0, 'emission'); page.steps.map((step, at) => {{ page.go(at); \
             page.view.drawNow(); return {overlaps}; }})"
        ));
        let of_photon = of_photon.as_array().expect("a list");
        assert!(of_photon.iter().all(|overlaps| overlaps == false), "{photon}: {of_photon:?}");
        steps += of_photon.len();
    }
    assert!(steps > 30, "{steps}");
}
