//! What a page of Markdown has in it.

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

fn events(page: &str) -> impl Iterator<Item = Event<'_>> {
    Parser::new_ext(page, Options::ENABLE_TABLES)
}

/// The texts of headings, paragraphs, list items and table cells; a code span is one word.
pub fn texts(page: &str) -> Vec<String> {
    let mut texts = vec![String::new()];
    let mut is_code = false;
    for event in events(page) {
        let text = texts.last_mut().expect("one at least");
        match event {
            Event::Start(Tag::CodeBlock(_)) => is_code = true,
            Event::End(TagEnd::CodeBlock) => is_code = false,
            Event::Text(words) if !is_code => text.push_str(&words),
            Event::Code(code) => text.push_str(&code.replace([' ', '.'], "_")),
            Event::SoftBreak | Event::HardBreak => text.push(' '),
            Event::Start(Tag::Paragraph | Tag::Item | Tag::TableCell | Tag::Heading { .. })
            | Event::End(TagEnd::Paragraph | TagEnd::Item | TagEnd::Heading(_)) => {
                texts.push(String::new());
            }
            _ => {}
        }
    }
    texts
}

/// The code within the text of a page.
pub fn code_spans(page: &str) -> Vec<String> {
    let code = |event| if let Event::Code(code) = event { Some(code.to_string()) } else { None };
    events(page).filter_map(code).collect()
}

/// The blocks of code of a page with their languages.
pub fn code_blocks(page: &str) -> Vec<(String, String)> {
    let mut blocks = Vec::new();
    let mut is_code = false;
    for event in events(page) {
        match event {
            Event::Start(Tag::CodeBlock(kind)) => {
                let CodeBlockKind::Fenced(language) = kind else { continue };
                blocks.push((language.to_string(), String::new()));
                is_code = true;
            }
            Event::End(TagEnd::CodeBlock) => is_code = false,
            Event::Text(text) if is_code => blocks.last_mut().expect("begun").1.push_str(&text),
            _ => {}
        }
    }
    blocks
}

/// The anchors that GitHub gives the headings of `page`.
pub fn anchors(page: &str) -> Vec<String> {
    let mut anchors = Vec::new();
    let mut is_heading = false;
    for event in events(page) {
        match event {
            Event::Start(Tag::Heading { .. }) => {
                is_heading = true;
                anchors.push(String::new());
            }
            Event::End(TagEnd::Heading(_)) => is_heading = false,
            Event::Text(text) | Event::Code(text) if is_heading => {
                let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
                let slug = text.to_lowercase().chars().filter(kept).collect::<String>();
                anchors.last_mut().expect("begun").push_str(&slug.replace(' ', "-"));
            }
            _ => {}
        }
    }
    anchors
}

/// Where the links and pictures of a page lead.
pub fn links(page: &str) -> Vec<String> {
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => Some(dest_url),
        _ => None,
    };
    events(page).filter_map(target).map(|url| url.to_string()).collect()
}
