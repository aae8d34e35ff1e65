//! The page's parts, put together under a policy that lets it load nothing.

use std::io::Cursor;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::ImageFormat;
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use super::Exploration;
use super::paths::Paths;

/// The port's source as the page shows it, found when this crate was built.
const SOURCE: &str = include_str!(concat!(env!("OUT_DIR"), "/source.json"));
const TEMPLATE: &str = include_str!("../assets/explore.html");
const STYLE: &str = include_str!("../assets/explore.css");
/// One script in strict mode, whose names do not leave it.
const SCRIPT: &str = concat!(
    "(() => {\n\"use strict\";\n",
    include_str!("../assets/data.js"),
    include_str!("../assets/view.js"),
    include_str!("../assets/shaders.js"),
    include_str!("../assets/orbit.js"),
    include_str!("../assets/diagrams.js"),
    include_str!("../assets/story.js"),
    include_str!("../assets/counts.js"),
    include_str!("../assets/box.js"),
    include_str!("../assets/panel.js"),
    include_str!("../assets/app.js"),
    "})();\n"
);

/// The page of `exploration`.
pub fn page(exploration: &Exploration) -> String {
    let paths = Paths::new(exploration);
    let (meta, data) = rayon::join(|| meta(exploration, &paths), || paths.columns.to_base64());
    let policy = format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; \
         form-action 'none'",
        hash(SCRIPT),
        hash(STYLE)
    );
    let title = match &exploration.comparison {
        Some(comparison) => format!("{} - photon mapping", comparison.name()),
        None => "Photon mapping, photon by photon".to_owned(),
    };
    let parts = [
        ("policy", policy),
        ("run", super::name_of(exploration.run)),
        ("title", escape(&title)),
        ("style", STYLE.to_owned()),
        ("meta", meta),
        ("data", data),
        ("script", SCRIPT.to_owned()),
    ];
    fill(TEMPLATE, &parts)
}

/// `template` with each `{name}` replaced; what is put in is not looked at again.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let size = template.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>();
    let mut page = String::with_capacity(size);
    let mut rest = template;
    for (name, part) in parts {
        let place = format!("{{{name}}}");
        let (before, after) =
            rest.split_once(&place).expect("the template has every part once, in order");
        page += before;
        page += part;
        rest = after;
    }
    page + rest
}

fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// What the script reads besides the columns. JSON within HTML must not hold a `<`.
fn meta(exploration: &Exploration, paths: &Paths) -> String {
    let renderer = &exploration.run.renderer;
    let (surfaces, total) = exploration.table;
    let rows: Vec<Value> = surfaces
        .iter()
        .chain([total])
        .map(|row| {
            let whole = json!({ "stored": row.stored, "expected": row.expected, "z": row.z });
            let cells = row.by_bounce.iter().take(3).chain([&row.late]).map(
                |cell| json!({ "stored": cell.stored, "expected": cell.expected, "z": cell.z }),
            );
            json!({ "name": row.name, "cells": cells.chain([whole]).collect::<Vec<_>>() })
        })
        .collect();
    let mut png = Vec::new();
    exploration
        .picture
        .write_to(&mut Cursor::new(&mut png), ImageFormat::Png)
        .expect("a picture in memory can be written");
    let meta = json!({
        "seed": renderer.seed.to_string(),
        "emitted": renderer.emitted(),
        "keptOf": exploration.records.len(),
        "maxBounces": renderer.max_photon_bounces,
        "isHandout": exploration.is_handout,
        "headings": ["bounce 1", "bounce 2", "bounce 3", "bounce 4+", "stored"],
        "rows": rows,
        "scene": paths,
        "picture": format!("data:image/png;base64,{}", STANDARD.encode(png)),
        "comparison": exploration.comparison.map(|it| it.meta(paths.surfaces.len())),
        "source": serde_json::from_str::<Value>(SOURCE).expect("the build script wrote JSON"),
        "sections": paths.columns.sections(),
    });
    meta.to_string().replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let parts = [("a", "{b}".to_owned()), ("b", "2".to_owned())];
        assert_eq!(fill("<{a}|{b}>", &parts), "<{b}|2>");
    }
}
