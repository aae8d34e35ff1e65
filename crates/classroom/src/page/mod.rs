//! A grade as a page that needs nothing else: no network, no script.
//!
//! Whatever comes from a submission, its name included, goes through `maud`, which escapes it.

pub mod difference;
mod faces;
mod findings;
pub mod index;
pub mod pictures;
pub mod plot;
pub mod profile;
mod rubric;

use std::path::Path;
use std::sync::{Mutex, OnceLock};

use image::RgbImage;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::text::last_part;
use super::written::GENERATOR;
use compare::numbers::thousands;
use findings::{findings, sections};
use grading::judge_list::{Expectations, Judgment};
use grading::naming::Explanation;
use grading::policy::Policy;
use grading::submission::{Graded, Submission};
use grading::text::{rounded, verdict_in_words};
use grading::verdict::{Grade, Verdict};
use photon_list::reader::PhotonList;
use photon_mapping::assignment8;
use profile::Profile;
use rubric::rubric;
use variants::variation::Variation;

const STYLE: &str = include_str!("style.css");
/// Keeps the page from loading anything, should ever something of a submission get through
/// unescaped.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";
/// A larger picture is not shown.
const MOST_BYTES: u64 = 8 << 20;
const LONGEST_EDGE: u32 = 4096;
/// With fewer photons than this, each dot is drawn larger, or nobody would see them.
const FEW_DOTS: usize = 5_000;

/// What the pages of one class have in common; each part is made when a page first needs it.
pub struct Pages<'a> {
    expectations: &'a Expectations,
    policy: &'a Policy,
    /// Whether an index leads to them.
    has_index: bool,
    plain: OnceLock<RgbImage>,
    /// For one photon emitted.
    profiles: Mutex<Vec<(Variation, Profile)>>,
}

impl<'a> Pages<'a> {
    /// No page yet. Pages lead back to the index, if there is one.
    pub fn new(expectations: &'a Expectations, policy: &'a Policy, has_index: bool) -> Self {
        let profiles = Mutex::new(Vec::new());
        Self { expectations, policy, has_index, plain: OnceLock::new(), profiles }
    }

    /// The page of `graded`, the grade of `submission`.
    pub fn page(&self, submission: &Submission, graded: &Graded) -> String {
        let grade = &graded.grade;
        let name = last_part(&grade.submission);
        let body = html! {
            @if self.has_index { p.small { a href="index.html" { "All submissions" } } }
            h1 title=(grade.submission) { (name) }
            (self.verdict(grade, graded.list.as_ref()))
            (sections(grade))
            (findings(grade, advice_on_misreading(graded)))
            (self.pictures(submission, graded))
            @if let Some((list, judgment)) = &graded.list {
                (self.faces(list, judgment))
            }
        };
        document(&format!("{name}: {}", verdict_in_words(grade.verdict)), POLICY, &body)
    }

    fn verdict(&self, grade: &Grade, list: Option<&(PhotonList, Judgment)>) -> Markup {
        let best = self.policy.best();
        let explanation = list.and_then(|(_, judgment)| judgment.explanation.as_ref());
        html! {
            p.verdict.(class_of(grade.verdict)) {
                span.word { (verdict_in_words(grade.verdict)) }
                span.score { (grade.score) " of " (best) " points" }
            }
            @if let Some(stored) = grade.stored {
                p {
                    (thousands(stored)) " photons stored, "
                    @match (grade.emitted, list) {
                        (Some(emitted), _) => { (thousands(emitted)) " emitted." }
                        (None, Some((_, judgment))) => {
                            "which fits about " (rounded(judgment.emitted)) " emitted. How many \
                             were is not known, so their shares are judged, not their number."
                        }
                        (None, None) => { "how many were emitted is not known." }
                    }
                }
            }
            // Sections that were run say more than the name of one of them.
            @if grade.wrong_sections().next().is_none() { (misreading(grade, explanation)) }
            (rubric(grade, self.policy))
        }
    }

    fn plain(&self) -> &RgbImage {
        // Not `get_or_init`: who waits within a thread of rayon may wait for himself.
        if self.plain.get().is_none() {
            let _ = self.plain.set(pictures::direct_light());
        }
        self.plain.get().expect("it has been set")
    }

    fn pictures(&self, submission: &Submission, graded: &Graded) -> Markup {
        let emitted = match (&graded.list, graded.grade.emitted) {
            (_, Some(emitted)) => emitted,
            (Some((_, judgment)), None) => judgment.emitted as u64,
            (None, None) => assignment8::PHOTON_COUNT,
        };
        let drawn = graded.list.as_ref().map(|(list, _)| {
            pictures::with_dots(list.records.iter().map(|record| record.position).collect())
        });
        let handed_in = submission.picture.as_deref().map(png_address);
        let stored = graded.list.as_ref().map_or(usize::MAX, |(list, _)| list.records.len());
        let is_enlarged = stored < FEW_DOTS;
        let shown_large = |picture: &RgbImage| match is_enlarged {
            true => pictures::address(&pictures::enlarged(picture, self.plain())),
            false => pictures::address(picture),
        };
        let larger = if is_enlarged { ", dots enlarged" } else { "" };
        let is_worth_a_reference = drawn.is_some() || matches!(handed_in, Some(Ok(_)));
        let reference = is_worth_a_reference
            .then(|| pictures::of_the_reference(emitted, self.expectations.signatures.max_bounces));
        let shown = thousands(emitted.clamp(1, pictures::MOST_EMITTED));
        html! {
            @if is_worth_a_reference || handed_in.is_some() {
                h2 { "Pictures" }
            }
            div.pictures {
                @match &handed_in {
                    Some(Ok(address)) => { (figure(address, "The picture that was handed in")) }
                    Some(Err(reason)) => {
                        p { "The picture that was handed in is not shown: " (reason) "." }
                    }
                    None => {}
                }
                @if let Some(drawn) = &drawn {
                    (figure(&shown_large(drawn),
                            &format!("The list's photons over direct light{larger}")))
                }
                @if let Some(reference) = &reference {
                    (figure(&shown_large(reference),
                            &format!("The reference, {shown} photons emitted{larger}")))
                }
                @if let (Some(drawn), Some(reference)) = (&drawn, &reference) {
                    @let difference = pictures::difference(drawn, reference, self.plain());
                    (figure(&pictures::address(&difference),
                            "The difference beyond what is usual by chance: more dots in orange, \
                             fewer in blue"))
                }
            }
        }
    }
}

/// The picture at `address`, which a click makes as large as the window, without a script.
fn figure(address: &str, caption: &str) -> Markup {
    html! {
        figure {
            label title="Zoom" {
                input type="checkbox" aria-label=(format!("Zoom: {caption}"));
                img src=(address) alt=(caption) width="640" height="480";
            }
            figcaption { (caption) }
        }
    }
}

/// The misreading that explains `grade`, or that none does.
fn misreading(grade: &Grade, explanation: Option<&Explanation>) -> Markup {
    html! {
        @if let Some(misreading) = grade.misreading {
            div.misreading {
                p {
                    "This is what comes of the misreading " strong { (misreading) }
                    @if let Some(title) = &grade.misreading_title { ": " (title) }
                    "."
                }
                @if let Some(advice) = explanation.and_then(|e| e.hypothesis.misreading) {
                    p { em { (advice.section.title()) } ": " (advice.advice) }
                }
                p { "To see it: " code { "photon-mapping explore --misreading " (misreading) } }
                @if let Some(confidence) = grade.misreading_confidence {
                    p.small {
                        (format!("{:.1} % sure, among known misreadings.", 100.0 * confidence))
                    }
                }
            }
        } @else if grade.verdict == Verdict::Incorrect {
            p { "None of the known misreadings explains it alone." }
        }
    }
}

fn advice_on_misreading(graded: &Graded) -> Option<&'static str> {
    let explanation = graded.list.as_ref()?.1.explanation.as_ref()?;
    Some(explanation.hypothesis.misreading?.advice)
}

/// The PNG file `path` as an address, or why it is not shown.
fn png_address(path: &Path) -> Result<String, String> {
    let about = std::fs::metadata(path).map_err(|error| error.to_string())?;
    if !about.is_file() || about.len() > MOST_BYTES {
        return Err(format!("expected a file of at most {} MiB", MOST_BYTES >> 20));
    }
    let png = std::fs::read(path).map_err(|error| error.to_string())?;
    let reader =
        image::ImageReader::with_format(std::io::Cursor::new(&png), image::ImageFormat::Png);
    let (width, height) =
        reader.into_dimensions().map_err(|_| "it is no PNG picture".to_owned())?;
    if width.max(height) > LONGEST_EDGE {
        return Err(format!("expected at most {LONGEST_EDGE} pixels an edge"));
    }
    Ok(pictures::address_of_png(&png))
}

fn class_of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Correct => "correct",
        Verdict::Incorrect => "incorrect",
        Verdict::Undecided | Verdict::NoDots | Verdict::Unreadable => "nothing",
    }
}

fn document(title: &str, policy: &str, body: &Markup) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy);
                meta name="generator" content=(GENERATOR);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { main { (body) } }
        }
    }
    .into_string()
}
