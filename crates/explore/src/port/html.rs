//! The code of each step as HTML that the page copies: lines that run at the step are lit, values
//! have a place, and lines that depend on a condition name it as their class.

use super::branches::Arm;
use super::steps::PortStep;
use super::{FoundFunction, FoundPart, PortSource};

/// The blocks of `words`, one for each step of `source`: with the step's title, with places for the
/// values named in braces, and then with its code.
///
/// # Errors
/// The step that has no block, or whose block lacks its title.
pub fn templates(source: &PortSource, words: &str) -> Result<String, String> {
    let template = |(step, parts): &(&PortStep, Vec<FoundPart>)| {
        let start = format!("<template id=\"step-{}\" ", step.name);
        let missing = |what: &str| format!("assets/steps.html: expected '{what}' in '{start}'");
        let block = words.split_once(&start).and_then(|(_, rest)| rest.split_once("</template>"));
        let (block, _) = block.ok_or_else(|| missing("</template>"))?;
        let (head, words) = block.split_once("{title}").ok_or_else(|| missing("{title}"))?;
        let figures = parts.iter().map(|part| figure(&source.functions[part.function], part));
        let mut html = format!("{start}{head}{}", step.section);
        for (at, text) in words.split(['{', '}']).enumerate() {
            if at % 2 == 0 {
                html += text;
                continue;
            }
            let is_drawn = html.rfind("<svg") > html.rfind("</svg");
            let tag = if is_drawn { "tspan" } else { "b" };
            html += &format!("<{tag} data-name=\"{text}\"></{tag}>");
        }
        Ok(html + &figures.collect::<String>() + "</template>\n")
    };
    source.steps.iter().map(template).collect()
}

fn figure(function: &FoundFunction, part: &FoundPart) -> String {
    let FoundFunction { name, file, first, .. } = function;
    let lines = (0..function.lines.len()).map(|at| line(function, part, at));
    let lines: String = lines.collect();
    format!(
        "<figure><figcaption><b>{name}</b> in {file}</figcaption><ol start=\"{first}\">{lines}</ol>\
         </figure>"
    )
}

fn line(function: &FoundFunction, part: &FoundPart, at: usize) -> String {
    let text = &function.lines[at];
    let is_in = |[first, last]: [usize; 2]| (first..=last).contains(&at);
    let mut code = if text.is_empty() { " ".to_owned() } else { escape(text) };
    let mut classes = if is_in(part.lit) { "lit".to_owned() } else { String::new() };
    for arm in function.branches.iter().filter(|arm| is_in(arm.lines)) {
        let Arm { condition, holds, code: within, .. } = arm;
        let class = format!("{condition}-{holds}");
        match within {
            Some(words) => {
                let words = escape(words);
                code = code.replace(&words, &format!("<span class=\"{class}\">{words}</span>"));
            }
            None => classes = classes + " " + &class,
        }
    }
    let comment = if text.trim().starts_with("//") { " class=\"comment\"" } else { "" };
    let values = part.values.iter().filter(|(line, _)| *line == at);
    let values: String = values
        .map(|(_, key)| format!("<span class=\"value\" data-name=\"{key}\"></span>"))
        .collect();
    format!("<li class=\"{classes}\"><code{comment}>{code}</code>{values}</li>")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
