//! The port's source as the page shows it, found when this crate was built.

use std::collections::BTreeMap;

use serde::Serialize;

/// The functions and steps of the port.
#[derive(Debug, Serialize)]
pub struct Source {
    functions: &'static [Function],
    #[serde(serialize_with = "by_name")]
    steps: &'static [Step],
}

#[derive(Debug, Serialize)]
struct Function {
    name: &'static str,
    file: &'static str,
    first: usize,
    lines: &'static [&'static str],
}

#[derive(Debug, Serialize)]
struct Step {
    #[serde(skip)]
    name: &'static str,
    short: &'static str,
    title: &'static str,
    parts: &'static [Part],
}

#[derive(Debug, Serialize)]
struct Part {
    function: usize,
    lit: [usize; 2],
    values: &'static [(usize, &'static str)],
}

/// What the build script found.
pub const SOURCE: Source = include!(concat!(env!("OUT_DIR"), "/source.rs"));

fn by_name<S: serde::Serializer>(steps: &&'static [Step], to: S) -> Result<S::Ok, S::Error> {
    steps.iter().map(|step| (step.name, step)).collect::<BTreeMap<_, _>>().serialize(to)
}
