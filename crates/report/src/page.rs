//! The page that the sections make.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, html::push_html};

use super::PageSection;
use super::plan::Plan;

const HEAD: &str = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
    <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; \
    style-src 'unsafe-inline'\">\n\
    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
    <title>Speed and accuracy</title>\n<style>\n\
    body { max-width: 900px; margin: 0 auto; padding: 16px; }\n\
    body { font: 16px/1.5 system-ui, sans-serif; }\n\
    img { max-width: 100%; height: auto; }\n\
    table { display: block; overflow-x: auto; border-collapse: collapse; }\n\
    td, th { border: 1px solid #ccc; padding: 3px 9px; text-align: right; }\n\
    </style></head><body>\n";

/// The page.
pub fn assemble(plan: &Plan, sections: &[PageSection]) -> String {
    let mut page = format!(
        "# Speed and accuracy\n\n\
         This page measures what the number of photons, precision, offset and sampler do to the \
         error of the stored photons. It comes from `photon-mapping report{}` in the handout's \
         scene. Errors are differences from the expected values that `photon-mapping expect` \
         computes without tracing. Every number follows from the CSV files beside this page.\n",
        plan.options
    );
    for section in sections {
        page += "\n";
        page += &section.markdown;
    }
    page
}

/// The page `markdown` as one self-contained file, with the plots among `files` embedded.
pub fn html(markdown: &str, files: &[(&'static str, String)]) -> String {
    let address = |name: &str| {
        let (_, plot) = files.iter().find(|(file, _)| *file == name)?;
        Some(format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(plot)))
    };
    let with_plots = |event| match event {
        Event::Start(Tag::Image { link_type, dest_url, title, id }) => {
            let dest_url = address(&dest_url).map_or(dest_url, CowStr::from);
            Event::Start(Tag::Image { link_type, dest_url, title, id })
        }
        event => event,
    };
    let mut page = HEAD.to_owned();
    push_html(&mut page, Parser::new_ext(markdown, Options::ENABLE_TABLES).map(with_plots));
    page + "</body></html>\n"
}
