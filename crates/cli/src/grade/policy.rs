//! A course's own scores.

use std::fmt;
use std::marker::PhantomData;
use std::path::Path;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::error::Category;
use serde_json::{Map, Value};

use crate::error::CliError;
use crate::input;
use grading::policy::Policy;
use variants::misreadings::names;
use variants::section::Section;

/// The keys of a policy: those with a score, and those with a table of scores.
const SCORES: [&str; 6] =
    ["correct", "undecided", "plausible", "incorrect", "no-dots", "unreadable"];
const TABLES: [&str; 2] = ["misreadings", "sections"];
/// Words whose similarity (at most 1) exceeds this may be typos of each other.
const ALIKE: f64 = 0.8;
/// From this many names on, a message does not list them.
const MANY: usize = 10;

/// The policy in the file `path`, or the handout's.
///
/// # Errors
/// When the file cannot be read, or is no policy.
pub fn read(path: Option<&Path>) -> Result<Policy, CliError> {
    let Some(path) = path else {
        return Ok(Policy::default());
    };
    let text = input::text(path)?;
    parse(&text).map_err(|(line, message)| {
        CliError::Argument(format!("{}:{line}: {message}", path.display()))
    })
}

/// The policy in `text`, or the line where it is none and why.
fn parse(text: &str) -> Result<Policy, (usize, String)> {
    // Without this, an array would be taken for the scores in their order.
    let pairs: Entries<Given> = serde_json::from_str(text).map_err(|error| {
        let message = match error.classify() {
            Category::Eof => "expected '}', found the end of the file",
            Category::Data => "expected a JSON object of scores, found something else",
            _ => "expected JSON: look for a missing comma, quote or bracket",
        };
        (error.line(), message.to_owned())
    })?;
    let at = |key: &str, message: String| (line_of(text, key), message);
    let object = pairs.each_once().map_err(|key| at(&key, format!("'{key}' comes twice")))?;
    for (key, value) in &object {
        match value {
            Value::Number(_) if SCORES.contains(&key.as_str()) => {}
            Value::Object(scores) if TABLES.contains(&key.as_str()) => {
                if let Some((name, value)) = scores.iter().find(|(_, value)| !value.is_number()) {
                    return Err(at(name, format!("'{name}': expected a number, found {value}")));
                }
            }
            _ if SCORES.contains(&key.as_str()) => {
                return Err(at(key, format!("'{key}': expected a number, found {value}")));
            }
            _ if TABLES.contains(&key.as_str()) => {
                let message = format!("'{key}': expected an object of scores, found {value}");
                return Err(at(key, message));
            }
            _ => return Err(at(key, unknown("score", key, &[&SCORES[..], &TABLES].concat()))),
        }
    }
    let policy: Policy = serde_json::from_value(object.into()).map_err(|e| (1, e.to_string()))?;
    let best = policy.correct;
    if let Some((name, score)) = policy.odd_score() {
        let message = format!("'{name}' is {score}, which is not from 0 to 'correct', {best}");
        return Err(at(name, message));
    }
    let titles = Section::ALL.map(Section::title);
    if let Some(title) = policy.sections.keys().find(|title| !titles.contains(&title.as_str())) {
        return Err(at(title, unknown("section", title, &titles)));
    }
    if let Some(sum) = policy.of_all_sections().filter(|sum| *sum != best) {
        let message = format!("the points of the sections add up to {sum}, not to {best}");
        return Err(at("sections", message));
    }
    let known = names();
    match policy.misreadings.keys().find(|id| !known.contains(&id.as_str())) {
        Some(id) => Err(at(id, unknown("misreading", id, &known))),
        None => Ok(policy),
    }
}

/// The keys and values of a JSON object. Others keep the last value of a key that comes twice.
struct Entries<V>(Vec<(String, V)>);

/// A value of a policy.
#[derive(serde::Deserialize)]
#[serde(untagged)]
enum Given {
    Table(Entries<Value>),
    Other(Value),
}

impl<'de, V: Deserialize<'de>> Deserialize<'de> for Entries<V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Object<V>(PhantomData<V>);
        impl<'de, V: Deserialize<'de>> Visitor<'de> for Object<V> {
            type Value = Entries<V>;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries<V>, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Entries(pairs))
            }
        }
        deserializer.deserialize_map(Object(PhantomData))
    }
}

impl Entries<Given> {
    /// The object, if no key in it or in a table comes twice. `Err` is that key.
    fn each_once(self) -> Result<Map<String, Value>, String> {
        let value = |(key, score)| match score {
            Given::Table(Entries(scores)) => Ok((key, unique(scores)?.into())),
            Given::Other(value) => Ok((key, value)),
        };
        unique(self.0.into_iter().map(value).collect::<Result<_, String>>()?)
    }
}

fn unique(pairs: Vec<(String, Value)>) -> Result<Map<String, Value>, String> {
    let mut object = Map::new();
    for (key, value) in pairs {
        if object.insert(key.clone(), value).is_some() {
            return Err(key);
        }
    }
    Ok(object)
}

/// The last line of `text` that has `key`.
fn line_of(text: &str, key: &str) -> usize {
    let quoted = Value::from(key).to_string();
    let lines: Vec<&str> = text.lines().collect();
    lines.iter().rposition(|line| line.contains(&quoted)).map_or(1, |line| line + 1)
}

/// The message that no `kind` is called `name`, with the closest of the `known` names.
fn unknown(kind: &str, name: &str, known: &[&str]) -> String {
    let alike = |known: &&&str| match known.to_lowercase().contains(&name.to_lowercase()) {
        true => 1.0,
        false => strsim::jaro_winkler(name, known),
    };
    let meant = known.iter().max_by(|a, b| alike(a).total_cmp(&alike(b)));
    let help = match meant.filter(|meant| alike(meant) > ALIKE) {
        Some(meant) => format!("did you mean '{meant}'?"),
        None if known.len() < MANY => format!("there are {}", known.join(", ")),
        None => format!("docs/{kind}s.md lists them"),
    };
    format!("no {kind} is called '{name}': {help}")
}
