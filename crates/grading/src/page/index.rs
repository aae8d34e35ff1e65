//! The list of a class's pages.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{PreEscaped, html};
use sha2::{Digest, Sha256};

use super::{STYLE, class_of, document};
use crate::text::verdict_in_words;
use crate::verdict::Grade;

/// Sorts the table by the column whose head is touched; again, the other way.
const SCRIPT: &str = include_str!("index.js");

/// The page that leads to `pages`: grades of at most `best` points, with the names of their files.
pub fn index(pages: &[(&Grade, String)], best: f64) -> String {
    let count = pages.len();
    let body = html! {
        h1 { (count) " submissions" }
        table.index {
            thead { tr {
                @for name in ["Submission", "Score", "Verdict", "Misreading"] {
                    th { button type="button" { (name) } }
                }
            } }
            tbody {
                @for (grade, file) in pages {
                    tr {
                        td { a href=(file) { (grade.submission) } }
                        td data-value=(grade.score) { (grade.score) " of " (best) }
                        td.(class_of(grade.verdict)) { (verdict_in_words(grade.verdict)) }
                        td { (grade.misreading.unwrap_or_default()) }
                    }
                }
            }
        }
        script { (PreEscaped(SCRIPT)) }
    };
    // As for pages, but for the one script, and nothing that is written into an element.
    let policy = format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'",
        hash(STYLE),
        hash(SCRIPT)
    );
    document("Grades", &policy, &body)
}

/// The hash by which a policy names `source`.
fn hash(source: &str) -> String {
    STANDARD.encode(Sha256::digest(source))
}
