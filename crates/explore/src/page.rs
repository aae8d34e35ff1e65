//! The page's parts, put together under a policy that lets it load nothing.

use std::io::Cursor;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use compare::numbers::thousands;
use image::ImageFormat;
use serde_json::json;
use sha2::{Digest as _, Sha256};

use super::Exploration;
use super::comparison::ListComparison;
use super::html::{escape, fill};
use super::paths::Paths;
use super::table::table;

/// The steps with the port's source, found when this crate was built.
const STEPS: &str = include_str!(concat!(env!("OUT_DIR"), "/steps.html"));
const TEMPLATE: &str = include_str!("../assets/explore.html");
const STYLE: &str = include_str!("../assets/explore.css");
/// One script in strict mode, whose names do not leave it.
const SCRIPT: &str = concat!(
    "(() => {\n\"use strict\";\n",
    include_str!("../assets/data.js"),
    include_str!("../assets/view.js"),
    include_str!("../assets/shaders.js"),
    include_str!("../assets/story.js"),
    include_str!("../assets/box.js"),
    include_str!("../assets/panel.js"),
    include_str!("../assets/page.js"),
    "})();\n"
);

/// The page of `exploration`.
pub fn page(exploration: &Exploration) -> String {
    let Exploration { run, is_handout, comparison, .. } = *exploration;
    let paths = Paths::new(exploration);
    let (meta, data) = rayon::join(|| meta(exploration, &paths), || paths.columns.to_base64());
    let policy = format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; \
         form-action 'none'",
        hash(SCRIPT),
        hash(STYLE)
    );
    let title = match comparison {
        Some(comparison) => format!("{} - photon mapping", comparison.name()),
        None => "Photon mapping, photon by photon".to_owned(),
    };
    let cells = match comparison {
        Some(comparison) => format!(
            "Stored by the reference, in orange by the {}, then expected, then the reference's \
             difference in standard deviations.",
            comparison.kind()
        ),
        None => "Stored, then expected, then the difference in standard deviations.".to_owned(),
    };
    let whose = if comparison.is_some() { "the reference's" } else { "the" };
    let difference = match comparison {
        Some(_) => "<option value=\"kind\" selected>by difference</option>",
        None => "",
    };
    let home = if is_handout { "Handout's camera" } else { "Whole scene" };
    let parts = [
        ("policy", policy),
        ("run", super::name_of(run)),
        ("title", escape(&title)),
        ("style", STYLE.to_owned()),
        ("counts", counts(exploration, &paths)),
        ("whose", whose.to_owned()),
        ("comparison", comparison.map(ListComparison::head).unwrap_or_default()),
        ("picture", picture(exploration)),
        ("home", home.to_owned()),
        ("difference", difference.to_owned()),
        ("cells", cells),
        ("table", table(exploration.table, comparison)),
        ("sides", comparison.map(ListComparison::sides).unwrap_or_default()),
        ("steps", STEPS.to_owned()),
        ("meta", meta),
        ("data", data),
        ("script", SCRIPT.to_owned()),
    ];
    fill(TEMPLATE, &parts)
}

fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())))
}

fn counts(exploration: &Exploration, paths: &Paths) -> String {
    let renderer = &exploration.run.renderer;
    let [emitted, stored] = [renderer.emitted(), exploration.records.len() as u64].map(thousands);
    let all = format!("{emitted} emitted, {stored} stored, seed {}.", renderer.seed);
    match paths.thinned {
        Some(kept) => format!("{all} Of these the page has {}, evenly thinned.", thousands(kept)),
        None => all,
    }
}

fn picture(exploration: &Exploration) -> String {
    let mut png = Vec::new();
    let written = exploration.picture.write_to(&mut Cursor::new(&mut png), ImageFormat::Png);
    written.expect("a picture in memory can be written");
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// What the script reads besides the columns. JSON within HTML must not hold a `<`.
fn meta(exploration: &Exploration, paths: &Paths) -> String {
    let renderer = &exploration.run.renderer;
    let meta = json!({
        "seed": renderer.seed.to_string(),
        "emitted": renderer.emitted(),
        "maxBounces": renderer.max_photon_bounces,
        "scene": paths,
        "comparison": exploration.comparison.map(ListComparison::meta),
        "orLeftOut": if paths.thinned.is_some() { ", or the page leaves it out" } else { "" },
        "sections": paths.columns.sections(),
    });
    meta.to_string().replace('<', "\\u003c")
}
