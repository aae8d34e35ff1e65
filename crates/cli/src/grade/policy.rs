//! A course's own scores.

use std::path::Path;

use crate::error::CliError;
use crate::input;
use grading::policy::Policy;
use variants::misreadings::names;
use variants::section::Section;

/// The policy in the file `path`, or the handout's.
///
/// # Errors
/// When the file cannot be read, or is no policy.
pub fn read(path: Option<&Path>) -> Result<Policy, CliError> {
    let Some(path) = path else {
        return Ok(Policy::default());
    };
    let wrong = |message: String| {
        CliError::Argument(format!("{}: expected a policy: {message}", path.display()))
    };
    let text = input::text(path)?;
    // Without this, an array would be taken for the scores in their order.
    let object: serde_json::Map<String, serde_json::Value> =
        serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let policy: Policy =
        serde_json::from_value(object.into()).map_err(|error| wrong(error.to_string()))?;
    if let Some((name, score)) = policy.odd_score() {
        let best = policy.correct;
        return Err(wrong(format!(
            "'{name}' is {score}, which is not from 0 to 'correct', {best}"
        )));
    }
    let titles = Section::ALL.map(Section::title);
    if let Some(title) = policy.sections.keys().find(|title| !titles.contains(&title.as_str())) {
        let known = titles.join(", ");
        return Err(wrong(format!("no section is called '{title}'; there are {known}")));
    }
    if let Some(sum) = policy.of_all_sections().filter(|sum| *sum != policy.correct) {
        let best = policy.correct;
        return Err(wrong(format!("the points of the sections add up to {sum}, not to {best}")));
    }
    let known = names();
    match policy.misreadings.keys().find(|id| !known.contains(&id.as_str())) {
        Some(id) => {
            let known = known.join(", ");
            Err(wrong(format!("no misreading is called '{id}'; there are {known}")))
        }
        None => Ok(policy),
    }
}
