//! Which lines of a function run only where a condition holds, or only where it does not.

use super::indent;
use super::steps::CONDITIONS;

/// Code that runs only if a condition is `holds`.
#[derive(Debug)]
pub struct Arm {
    /// The name under which a story tells whether the condition holds.
    pub condition: &'static str,
    pub holds: bool,
    /// The first and the last line, counted from the function's first line.
    pub lines: [usize; 2],
    /// The part of the line, where it is not all of it.
    pub code: Option<String>,
}

/// All branches of the function `lines`: the block of each `if`, what follows a block that returns,
/// and both sides of an `if` on one line.
///
/// # Errors
/// A line, and what was expected there.
pub fn find(lines: &[String]) -> Result<Vec<Arm>, (usize, String)> {
    let mut branches = Vec::new();
    let is_code = |line: &&String| !line.trim_start().starts_with("//");
    for (at, line) in lines.iter().enumerate().filter(|(_, line)| is_code(line)) {
        let unknown = || {
            let found = line.trim();
            (at, format!("expected an 'if' whose condition a story tells, found '{found}'"))
        };
        let has =
            |word: &str| line.trim_start().starts_with(word) || line.contains(&format!(" {word}"));
        if ["match ", "for ", "while ", "else if "].into_iter().any(has) || line.contains("?;") {
            return Err(unknown());
        }
        if !has("if ") {
            continue;
        }
        let known = CONDITIONS.iter().find(|(start, _)| has(start));
        let condition = known.ok_or_else(unknown)?.1;
        if let Some((yes, no)) = line.split_once("} else {") {
            let yes = yes.rsplit_once('{').ok_or_else(unknown)?.1;
            let no = no.split_once('}').ok_or_else(unknown)?.0;
            for (code, holds) in [(yes, true), (no, false)] {
                let code = Some(format!("{{{code}}}"));
                branches.push(Arm { condition, holds, lines: [at, at], code });
            }
            continue;
        }
        let is_end =
            |end: &String| indent(end) == indent(line) && end.trim_start().starts_with('}');
        let length = lines[at..].iter().position(is_end).ok_or_else(unknown)?;
        let end = at + length;
        if lines[end].trim() != "}" || !line.ends_with('{') {
            return Err(unknown());
        }
        branches.push(Arm { condition, holds: true, lines: [at + 1, end], code: None });
        if lines[end - 1].trim().starts_with("return") {
            let rest = [end + 1, lines.len() - 1];
            branches.push(Arm { condition, holds: false, lines: rest, code: None });
        }
    }
    Ok(branches)
}
