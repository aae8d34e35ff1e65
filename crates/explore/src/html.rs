//! HTML in which text stays text.

/// `text` for a place between tags or in an attribute.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// `text` as HTML in which no option and no command breaks at its hyphens.
pub fn prose(text: &str) -> String {
    let words = text.split_inclusive(char::is_whitespace).map(|word| {
        let (word, space) = word.split_at(word.trim_end().len());
        let is_whole = ["--", "photon-mapping"].iter().any(|part| word.contains(part));
        let [before, after] =
            if is_whole { ["<span class=\"whole\">", "</span>"] } else { [""; 2] };
        format!("{before}{}{after}{space}", escape(word))
    });
    words.collect()
}

/// `template` with each `{name}` replaced; what is put in is not looked at again.
pub fn fill(template: &str, parts: &[(&str, String)]) -> String {
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
