//! A grade as a page that needs nothing else: no network, no script.
//!
//! Whatever comes from a submission, its name included, goes through `maud`, which escapes it.

pub mod index;
pub mod pictures;
pub mod plot;
pub mod profile;

use std::collections::HashSet;
use std::path::Path;
use std::sync::{Mutex, OnceLock};

use image::RgbImage;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::judge_list::{Expectations, Judgement};
use super::policy::{Policy, SectionPoints, points};
use super::submission::{Graded, Submission};
use super::text::{chance, verdict_in_words};
use super::verdict::{Finding, Grade, Verdict, Weight};
use photon_list::reader::PhotonList;
use photon_mapping::assignment8;
use plot::Histogram;
use profile::{Axis, LAST_BOUNCE, Profile};
use variants::variation::{FACETS, Variation};

const STYLE: &str = include_str!("style.css");
/// Keeps the page from loading anything, should ever something of a submission get through
/// unescaped.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";
/// A larger picture is not shown.
const MOST_BYTES: u64 = 8 << 20;
const LONGEST_EDGE: u32 = 4096;
/// With how many photons the curves of a page are measured: for the handout, and for a misreading,
/// which takes longer to trace.
const PHOTONS_FOR_CURVES: u64 = 1_000_000;
const PHOTONS_FOR_MISREADINGS: u64 = 300_000;

/// What the pages of one class have in common; each part is made when a page first needs it.
pub struct Pages<'a> {
    expectations: &'a Expectations,
    policy: &'a Policy,
    plain: OnceLock<RgbImage>,
    /// For one photon emitted.
    profiles: Mutex<Vec<(Variation, Profile)>>,
}

impl<'a> Pages<'a> {
    /// No page yet.
    pub fn new(expectations: &'a Expectations, policy: &'a Policy) -> Self {
        let profiles = Mutex::new(Vec::new());
        Self { expectations, policy, plain: OnceLock::new(), profiles }
    }

    /// The page of `graded`, the grade of `submission`.
    pub fn page(&self, submission: &Submission, graded: &Graded) -> String {
        let grade = &graded.grade;
        let body = html! {
            h1 { (grade.submission) }
            (self.verdict(grade, graded.list.as_ref()))
            (findings(grade, advice_on_misreading(graded)))
            (self.pictures(submission, graded))
            @if let Some((list, judgement)) = &graded.list {
                (self.densities(grade, list, judgement))
            }
        };
        document(
            &format!("{}: {}", grade.submission, verdict_in_words(grade.verdict)),
            POLICY,
            &body,
        )
    }

    fn verdict(&self, grade: &Grade, list: Option<&(PhotonList, Judgement)>) -> Markup {
        let best = self.policy.best();
        let explanation = list.and_then(|(_, judgement)| judgement.explanation.as_ref());
        html! {
            p.verdict.(class_of(grade.verdict)) {
                span.word { (verdict_in_words(grade.verdict)) }
                span.score { (grade.score) " of " (best) " points" }
            }
            @if let Some(stored) = grade.stored {
                p {
                    (stored) " photons stored, "
                    @match (grade.emitted, list) {
                        (Some(emitted), _) => { (emitted) " emitted." }
                        (None, Some((_, judgement))) => {
                            "which fits about " (format!("{:.0}", judgement.emitted)) " emitted. \
                             How many "
                            "were is not known, so their shares are judged, not their number."
                        }
                        (None, None) => { "how many were emitted is not known." }
                    }
                }
            }
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
                    @if let Some(confidence) = grade.misreading_confidence {
                        p.small {
                            (format!("{:.1} % sure, among known misreadings.", 100.0 * confidence))
                        }
                    }
                }
            } @else if grade.verdict == Verdict::Incorrect {
                p { "None of the known misreadings explains it alone." }
            }
            (self.rubric(grade))
        }
    }

    fn rubric(&self, grade: &Grade) -> Markup {
        let findings = 0..grade.findings.len();
        let sections: Vec<_> = findings.filter_map(|at| points(grade, at, self.policy)).collect();
        if !sections.is_empty() && sections.iter().any(|section| section.score < section.most) {
            return rubric_of_sections(&sections);
        }
        let Policy { correct, undecided, plausible, incorrect, no_dots, unreadable, .. } =
            self.policy;
        let misreadings = &self.policy.misreadings;
        let own = grade.misreading.and_then(|id| Some((id, *misreadings.get(id)?)));
        let mut rows = vec![
            (*correct, "dots as the handout's photons leave them".to_owned(), Verdict::Correct),
            (
                *plausible,
                "dots that look incorrect, but finite, on surfaces, and indirect only".to_owned(),
                Verdict::Incorrect,
            ),
            (*incorrect, "dots that look incorrect otherwise".to_owned(), Verdict::Incorrect),
        ];
        rows.extend(
            own.map(|(id, score)| (score, format!("with the misreading {id}"), Verdict::Incorrect)),
        );
        rows.push((*no_dots, "no dots".to_owned(), Verdict::NoDots));
        rows.push((*unreadable, "nothing that can be read".to_owned(), Verdict::Unreadable));
        let few = "too few photons to tell: needs a look".to_owned();
        rows.push((*undecided, few, Verdict::Undecided));
        let is_row = |row: &(f64, String, Verdict)| row.2 == grade.verdict && row.0 == grade.score;
        // The last of those that fit: a score of a misreading's own stands after the others.
        let chosen = rows.iter().rposition(is_row);
        html! {
            table.rubric {
                caption { "Rubric" }
                @for (at, (score, words, _)) in rows.iter().enumerate() {
                    tr.chosen[chosen == Some(at)] { td { (score) } td { (words) } }
                }
            }
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
            (Some((_, judgement)), None) => judgement.emitted as u64,
            (None, None) => assignment8::PHOTON_COUNT,
        };
        let drawn = graded.list.as_ref().map(|(list, _)| {
            pictures::with_dots(list.records.iter().map(|record| record.position).collect())
        });
        let handed_in = submission.picture.as_deref().map(png_address);
        let is_worth_a_reference = drawn.is_some() || matches!(handed_in, Some(Ok(_)));
        let reference = is_worth_a_reference
            .then(|| pictures::of_the_reference(emitted, self.expectations.signatures.max_bounces));
        let shown = emitted.clamp(1, pictures::MOST_EMITTED);
        let figure = |address: &str, caption: &str| {
            html! {
                figure {
                    img src=(address) alt=(caption) width="640" height="480";
                    figcaption { (caption) }
                }
            }
        };
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
                    (figure(&pictures::address(drawn), "The list's photons over direct light"))
                }
                @if let Some(reference) = &reference {
                    (figure(&pictures::address(reference),
                            &format!("The reference, {shown} photons emitted")))
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

    /// What is expected of one photon under `variation`, measured with `photons`.
    fn profile(&self, variation: Variation, photons: u64) -> Profile {
        let kept = || self.profiles.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let known = kept().iter().find(|(other, _)| *other == variation).map(|(_, p)| p.clone());
        // Measured without the lock: a thread that waits for others' pieces may take up another
        // page.
        known.unwrap_or_else(|| {
            let max_bounces = self.expectations.signatures.max_bounces;
            let places = &self.expectations.places;
            let profile = Profile::expected(variation, max_bounces, places, photons, 1.0);
            // Self-hits differ from student to student.
            if variation.self_hits == [0.0; FACETS] {
                kept().push((variation, profile.clone()));
            }
            profile
        })
    }

    fn densities(&self, grade: &Grade, list: &PhotonList, judgement: &Judgement) -> Markup {
        let places = &self.expectations.places;
        // The reading that fits a wrong list best says nothing: that is held against the reference.
        let signatures = &self.expectations.signatures;
        let (reading, signature) = match grade.verdict {
            Verdict::Correct => (judgement.reading.variation, &judgement.signature),
            _ => (Variation::default(), &signatures.fair[0].signature),
        };
        let emitted = judgement.emitted;
        let first = list.records.iter().map(|record| record.bounce).min().unwrap_or_default();
        let found = Profile::of(&list.records, places, first);
        let expected = self.profile(reading, PHOTONS_FOR_CURVES).scaled(emitted);
        let misread = judgement.explanation.as_ref();
        let misread = misread.map(|explanation| {
            self.profile(explanation.hypothesis.variation, PHOTONS_FOR_MISREADINGS)
                .scaled(explanation.emitted)
        });
        let scaled = |numbers: &[f64]| numbers.iter().map(|n| n * emitted).collect::<Vec<f64>>();
        let (cells, variance) = (scaled(&signature.cells), scaled(&signature.variance));
        html! {
            h2 { "Photons on every face" }
            p.small {
                "Maps: photons found in each cell divided by those expected; in orange where there \
                 are more and in "
                "blue where there are fewer by over two standard deviations. Plots: bars are \
                 found, the black "
                "line is expected, with a grey band of two standard deviations"
                @if misread.is_some() { "; the orange line is what the misreading leads to" }
                ". x, y and z are the world's, z up."
            }
            div.facets {
                @for (at, facet) in places.facets.iter().enumerate() {
                    @let axes = Axis::of(facet);
                    section.facet {
                        h3 { (places.name(at)) }
                        p {
                            (format!(
                                "{:.0} found, {:.0} expected",
                                found.facets[at], expected.facets[at]
                            ))
                        }
                        (plot::map(facet, &axes, &found.counts.cells, &cells, &variance))
                        @for number in Axis::order(&axes) {
                            (PreEscaped(Histogram {
                                what: format!("photons along {}", axes[number].name),
                                ends: axes[number].ends,
                                found: &found.along[at][number],
                                expected: &expected.along[at][number],
                                misread: misread
                                    .as_ref()
                                    .map(|misread| &misread.along[at][number][..]),
                            }.svg()))
                        }
                    }
                }
                @if has_directions(list) {
                    section.facet {
                        h3 { "Incoming directions" }
                        p { "The cosine between the direction to the light and the normal, on all \
                             faces; what comes from behind has 0." }
                        (PreEscaped(Histogram {
                            what: "photons by cosine".to_owned(),
                            ends: [0.0, 1.0],
                            found: &found.cosines,
                            expected: &expected.cosines,
                            misread: misread.as_ref().map(|misread| &misread.cosines[..]),
                        }.svg()))
                    }
                }
                @if list.columns.bounce {
                    section.facet {
                        h3 { "Bounces" }
                        p { "1 is the first bounce after which photons are stored; the last bar \
                             has all later ones." }
                        (PreEscaped(Histogram {
                            what: "photons by bounce".to_owned(),
                            ends: [0.5, LAST_BOUNCE as f64 + 0.5],
                            found: &found.bounces,
                            expected: &expected.bounces,
                            misread: misread.as_ref().map(|misread| &misread.bounces[..]),
                        }.svg()))
                    }
                }
            }
        }
    }
}

/// Whether directions to the light are given, and not one for all, as those of a ray that is never
/// set.
fn has_directions(list: &PhotonList) -> bool {
    let directions = || list.records.iter().map(|record| record.to_light);
    list.columns.to_light && directions().any(|direction| Some(direction) != directions().next())
}

fn advice_on_misreading(graded: &Graded) -> Option<&'static str> {
    let explanation = graded.list.as_ref()?.1.explanation.as_ref()?;
    Some(explanation.hypothesis.misreading?.advice)
}

/// The findings of `grade`, of which `said` has been said already.
fn findings(grade: &Grade, said: Option<&str>) -> Markup {
    // What several findings advise is said once.
    let mut said: HashSet<&str> = said.into_iter().collect();
    let mut card = |finding| card(finding, &mut said);
    let (faults, others): (Vec<_>, Vec<_>) =
        grade.findings.iter().filter(|f| !f.is_of_others()).partition(|f| f.is_fault());
    let (passed, remarks): (Vec<_>, Vec<_>) = others.into_iter().partition(|f| f.passed);
    html! {
        @if !faults.is_empty() { h2 { "What is wrong" } }
        @for finding in faults { (card(finding)) }
        @if !remarks.is_empty() { h2 { "Remarks, which cost nothing" } }
        @for finding in remarks { (card(finding)) }
        @if !passed.is_empty() {
            details {
                summary { "What is as it should be (" (passed.len()) ")" }
                @for finding in passed { (card(finding)) }
            }
        }
    }
}

fn card<'a>(finding: &'a Finding, said: &mut HashSet<&'a str>) -> Markup {
    let is_new = !finding.advice.is_empty() && said.insert(&finding.advice);
    let kind = match (finding.passed, finding.weight) {
        (true, _) => "passed",
        (false, Weight::Remark) => "remark",
        (false, _) => "fault",
    };
    html! {
        div.card.(kind) {
            h3 {
                (finding.check)
                @if let Some(section) = finding.section { span.section { (section) } }
            }
            dl {
                dt { "expected" } dd { (finding.expected) }
                dt { "found" } dd { (finding.found) }
                @if let Some(p_value) = finding.p_value {
                    dt { "by chance" } dd { (chance(p_value)) }
                }
            }
            @if is_new { p { (finding.advice) } }
        }
    }
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
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { main { (body) } }
        }
    }
    .into_string()
}

fn rubric_of_sections(sections: &[SectionPoints]) -> Markup {
    html! {
        table.rubric {
            caption { "Points by section" }
            @for section in sections {
                tr { td { (section.score) " of " (section.most) } td { (section.title) } }
            }
        }
    }
}
