//! The port's functions as the page shows them: the lines of each step, and which lines a story
//! skips.
//!
//! The build script looks all of them up in the port's source. It fails, and says what it expected,
//! when a function was renamed, a step comment is missing, a line is no longer there, or a story
//! does not tell whether a branch is taken.

mod branches;
pub mod html;
mod steps;

use branches::Arm;
use steps::{FUNCTIONS, LitLines, PortPart, PortStep, SECTIONS, STEPS};

/// A function of the port as it stands in its file.
#[derive(Debug)]
pub struct FoundFunction {
    name: &'static str,
    file: &'static str,
    /// The number of its first line in the file, from 1.
    first: usize,
    /// Its lines, without the indentation that all have.
    pub lines: Vec<String>,
    pub branches: Vec<Arm>,
}

/// What a step lights of one function.
#[derive(Debug)]
struct FoundPart {
    function: usize,
    /// The first and the last line lit, counted from the function's first line.
    lit: [usize; 2],
    values: Vec<(usize, &'static str)>,
}

/// The port's functions, and where each step is in them.
#[derive(Debug)]
pub struct PortSource {
    pub functions: Vec<FoundFunction>,
    steps: Vec<(&'static PortStep, Vec<FoundPart>)>,
}

/// Finds everything in the files that `read` gives by their paths within the repository.
///
/// # Errors
/// A sentence that says what was expected and where.
pub fn find(read: impl Fn(&str) -> Result<String, String>) -> Result<PortSource, String> {
    let functions: Vec<_> = FUNCTIONS
        .iter()
        .map(|(name, file)| find_function(name, file, &read(file)?))
        .collect::<Result<_, _>>()?;
    let find_step = |step: &'static PortStep| {
        let parts = step.parts.iter().map(|part| find_part(step, part, &functions));
        Ok((step, parts.collect::<Result<_, String>>()?))
    };
    let steps = STEPS.iter().map(find_step).collect::<Result<_, String>>()?;
    Ok(PortSource { functions, steps })
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

fn find_function(
    name: &'static str,
    file: &'static str,
    text: &str,
) -> Result<FoundFunction, String> {
    let lines: Vec<_> = text.lines().collect();
    let opening = [format!("fn {name}("), format!("fn {name}<")];
    let is_opening = |line: &&str| opening.iter().any(|opening| line.contains(opening));
    let first = lines
        .iter()
        .position(is_opening)
        .ok_or_else(|| format!("{file}: expected a function '{name}', found none"))?;
    let indent = indent(lines[first]);
    let closing = format!("{}}}", " ".repeat(indent));
    let length = lines[first..]
        .iter()
        .position(|line| *line == closing)
        .ok_or_else(|| format!("{file}:{}: expected the end of '{name}'", first + 1))?;
    let body = lines[first..=first + length].iter();
    let lines: Vec<_> =
        body.map(|line| line.get(indent..).unwrap_or_default().to_owned()).collect();
    let branches = branches::find(&lines)
        .map_err(|(line, message)| format!("{file}:{}: {message}", first + 1 + line))?;
    Ok(FoundFunction { name, file, first: first + 1, lines, branches })
}

fn find_part(
    step: &PortStep,
    part: &PortPart,
    functions: &[FoundFunction],
) -> Result<FoundPart, String> {
    let index = functions
        .iter()
        .position(|function| function.name == part.function)
        .expect("a step names one of the functions shown");
    let FoundFunction { name, file, first, lines, .. } = &functions[index];
    let is_comment = |line: &String, section: &str| line.trim() == format!("// {section}");
    let last = lines.len() - 1;
    let (start, end) = match part.lines {
        LitLines::Body => (0, last),
        LitLines::Section(section) | LitLines::Within(section, ..) => {
            let start =
                lines.iter().position(|line| is_comment(line, section)).ok_or_else(|| {
                    format!("{file}:{first}: expected the step comment '// {section}' in '{name}'")
                })?;
            let is_next = |line: &String| SECTIONS.iter().any(|section| is_comment(line, section));
            let next = lines[start + 1..].iter().position(is_next);
            (start, next.map_or(last - 1, |next| start + next))
        }
    };
    let line_with = |from: usize, needle: &str| {
        let found = lines[from..=end].iter().position(|line| line.contains(needle));
        found.map(|found| from + found).ok_or_else(|| {
            format!(
                "{file}:{}: expected a line with '{needle}' for the step '{}' of '{name}'",
                first + from,
                step.name
            )
        })
    };
    let lit = match part.lines {
        LitLines::Section(_) | LitLines::Body => [start, end],
        LitLines::Within(_, from, to) => {
            let from = line_with(start, from)?;
            [from, line_with(from, to)?]
        }
    };
    // A blank line that ends a section is none of its lines.
    let blank = lines[..=lit[1]].iter().rev().take_while(|line| line.trim().is_empty()).count();
    let values = part.values.iter().map(|value| {
        let variable = format!("let {value} = ");
        let (key, needle) = value.split_once(": ").unwrap_or((value, &variable));
        Ok((line_with(start, needle)?, key))
    });
    Ok(FoundPart {
        function: index,
        lit: [lit[0], lit[1] - blank],
        values: values.collect::<Result<_, String>>()?,
    })
}
