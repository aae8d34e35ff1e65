//! The list of a class's pages.

use maud::{PreEscaped, html};

use super::{class_of, document};
use crate::text::verdict_in_words;
use crate::verdict::Grade;

/// As for pages, but for the one script.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
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
    document("Grades", POLICY, &body)
}
