//! A course's own scores.

use std::path::Path;

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
    let object: Map<String, Value> = serde_json::from_str(text).map_err(|error| {
        let message = match error.classify() {
            Category::Eof => "expected '}', found the end of the file",
            Category::Data => "expected a JSON object of scores, found something else",
            _ => "expected JSON: look for a missing comma, quote or bracket",
        };
        (error.line(), message.to_owned())
    })?;
    let at = |key: &str, message: String| (line_of(text, key), message);
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

/// Which line of `text` has `key`.
fn line_of(text: &str, key: &str) -> usize {
    let quoted = Value::from(key).to_string();
    text.lines().position(|line| line.contains(&quoted)).map_or(1, |line| line + 1)
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
