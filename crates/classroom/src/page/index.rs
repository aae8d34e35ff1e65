//! The list of a class's pages.

use std::collections::BTreeMap;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use super::{STYLE, class_of, document};
use crate::text::last_part;
use grading::text::verdict_in_words;
use grading::verdict::Grade;

/// Sorts the table by the column whose head is clicked, and hides rows that a filter leaves out.
const SCRIPT: &str = include_str!("index.js");
const COLUMNS: [&str; 6] =
    ["Submission", "Score", "Verdict", "Wrong sections", "Misreading", "Remarks"];
/// How wide the longest bar of a chart is, in percent.
const LONGEST_BAR: usize = 100;

/// The page that leads to all others.
pub struct Index<'a> {
    /// The grades, with the names of their files.
    pub pages: Vec<(&'a Grade, String)>,
    /// Who handed in nothing.
    pub absent: Vec<&'a str>,
    /// The highest score.
    pub best: f64,
    /// The program with its version, when it ran, and its command line.
    pub made_by: String,
}

impl<'a> Index<'a> {
    /// The page.
    pub fn page(&self) -> String {
        let Self { pages, absent, best, made_by } = self;
        let folders = || pages.iter().map(|(grade, _)| Path::new(&grade.submission).parent());
        // One folder of all says nothing.
        let has_one_folder = folders().all(|folder| folder == folders().next().flatten());
        let name = |full: &'a str| if has_one_folder { last_part(full) } else { full };
        let body = html! {
            h1 { (pages.len()) " submissions" }
            (self.summary())
            p { label { "Filter " input type="search" placeholder="name, section, misreading ..."; }
                " " output {} }
            table.index {
                thead { tr {
                    @for name in COLUMNS { th { button type="button" { (name) } } }
                } }
                tbody {
                    @for (grade, file) in pages {
                        tr {
                            td { a href=(file) { (name(&grade.submission)) } }
                            td data-value=(grade.score) { (grade.score) " of " (best) }
                            td.(class_of(grade.verdict)) { (verdict_in_words(grade.verdict)) }
                            td { (grade.sections().join(", ")) }
                            td { (grade.misreading.unwrap_or_default()) }
                            td { (grade.remarks().join(", ")) }
                        }
                    }
                }
            }
            @if !absent.is_empty() { p { "Handed in nothing: " (absent.join(", ")) "." } }
            p.small { (made_by) }
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

    /// The mean score, and how many submissions there are of each score, section and misreading.
    fn summary(&self) -> Markup {
        let grades = || self.pages.iter().map(|(grade, _)| *grade);
        let mean = grades().map(|grade| grade.score).sum::<f64>() / self.pages.len().max(1) as f64;
        let mut scores: Vec<f64> = grades().map(|grade| grade.score).collect();
        scores.sort_by(|a, b| b.total_cmp(a));
        let scores = scores.chunk_by(|a, b| a == b);
        let scores = scores.map(|equal| (equal[0].to_string(), equal.len())).collect();
        let verdicts = most_first(grades().map(|grade| verdict_in_words(grade.verdict)));
        let sections = most_first(grades().flat_map(Grade::sections));
        let misreadings = most_first(grades().filter_map(|grade| grade.misreading));
        html! {
            p { "Mean score: " (format!("{mean:.2}")) " of " (self.best) " points." }
            div.charts {
                (chart("Scores", &scores))
                (chart("Verdicts", &verdicts))
                (chart("Wrong sections", &sections))
                (chart("Misreadings", &misreadings))
            }
        }
    }
}

/// How often each of `words` comes, the most frequent first.
fn most_first<'a>(words: impl Iterator<Item = &'a str>) -> Vec<(String, usize)> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    words.for_each(|word| *counts.entry(word).or_default() += 1);
    let mut counts: Vec<_> = counts.into_iter().map(|(word, n)| (word.to_owned(), n)).collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    counts
}

/// A bar for each of `counts`.
fn chart(title: &str, counts: &Vec<(String, usize)>) -> Markup {
    let most = counts.iter().map(|(_, count)| *count).max().unwrap_or(1);
    html! {
        @if !counts.is_empty() {
            table.chart {
                caption { (title) }
                @for (word, count) in counts {
                    tr {
                        th scope="row" { (word) }
                        td { svg width="100%" height="12" aria-hidden="true" {
                            rect width=(format!("{}%", count * LONGEST_BAR / most)) height="12" {}
                        } }
                        td { (count) }
                    }
                }
            }
        }
    }
}

/// The hash by which a policy names `source`.
fn hash(source: &str) -> String {
    STANDARD.encode(Sha256::digest(source))
}
