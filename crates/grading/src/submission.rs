//! One student's submission, and its grade.

use std::path::{Path, PathBuf};

use super::axes;
use super::beside::{apart, own, own_picture};
use super::exact::exact_comparison;
use super::facts::ENOUGH_PHOTONS;
use super::judge_list::{Expectations, Judgment, judge};
use super::limits::FEW_EMITTED;
use super::naming::Explanation;
use super::observation::observe;
use super::picture::judge_picture;
use super::picture::kinds::other_format;
use super::policy::Policy;
use super::recognized::{is_recognized, scored_as};
use super::text::printable;
use super::unjudged::{no_photons, not_readable, too_few, without_bounces};
pub use super::unjudged::{remark, unreadable};
use super::verdict::{Finding, Grade, Verdict, Weight};
pub use crate::limits::submission::MOST_RECORDS;
use photon_list::error::{ListError, Reason};
use photon_list::reader::{self, PhotonList};
use photon_mapping::assignment8;

/// What one student handed in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Submission {
    /// What it is called in the grade.
    pub name: String,
    /// The photon list, if there is one.
    pub list: Option<PathBuf>,
    /// The picture, if there is one.
    pub picture: Option<PathBuf>,
}

/// How submissions are graded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// How many photons were emitted, if the course says so.
    pub emitted: Option<u64>,
    /// The seed of lists that follow the reference's streams.
    pub seed: u64,
    /// What a verdict is worth.
    pub policy: Policy,
}

/// A grade, and what it was given for.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The grade.
    pub grade: Grade,
    /// The list, if it could be read, with what was concluded from it.
    pub list: Option<(PhotonList, Judgment)>,
    /// Whether a file could not be read, which may be over soon.
    pub try_again: bool,
}

impl Graded {
    fn new(grade: Grade) -> Self {
        Self { grade, list: None, try_again: false }
    }
}

/// Grades `submission`. Whatever is wrong with its files is part of the grade.
pub fn grade(submission: &Submission, settings: &Settings, expectations: &Expectations) -> Graded {
    grade_at_most(submission, settings, expectations, MOST_RECORDS)
        .expect("the limit is the largest")
}

/// As [`grade`], if the list has no more than `most` records, or even [`MOST_RECORDS`].
pub fn grade_at_most(
    submission: &Submission,
    settings: &Settings,
    expectations: &Expectations,
    most: usize,
) -> Option<Graded> {
    let Some(path) = &submission.list else {
        return Some(match &submission.picture {
            Some(picture) => grade_picture(submission, picture, settings, expectations),
            None => unreadable(submission, settings, "there is no photon list, and no picture"),
        });
    };
    let mut graded = match reader::load_at_most(path, most) {
        Err(ListError::TooLong { most, .. }) if most < MOST_RECORDS => return None,
        Ok((mut list, notes)) => {
            let is_turned = axes::turn_to_world(&mut list, &expectations.places);
            let mut graded = grade_list(submission, list, settings, expectations);
            if graded.grade.verdict == Verdict::Correct {
                graded.grade.for_course.extend(own(&graded, settings));
            }
            let turned =
                is_turned.then_some("positions in the model's axes, y up: taken as (x, -z, y)");
            let guessed = notes.guessed.as_deref().filter(|_| !is_link(path));
            graded.grade.findings.extend(guessed.into_iter().chain(turned).map(|note| {
                let expected = "columns x, y and z, in world space, with commas between them";
                let advice = "Write the position as the framework has it, under these names.";
                remark("format", expected, note, advice)
            }));
            graded.grade.findings.extend(notes.left_out.iter().map(|reason| {
                let expected = "numbers in every column that is judged";
                let advice = "Write this column as photon_dump.hpp does, or leave it out.";
                remark("columns", expected, &told(path, reason), advice)
            }));
            graded
        }
        // The name of the submission says already which file it is.
        Err(ListError::Malformed { reason, start, .. }) => {
            let reason = match other_format(&start, path) {
                Some(found) => format!("expected a photon list, found {found}"),
                None => told(path, &reason),
            };
            unreadable(submission, settings, &reason)
        }
        Err(ListError::TooLong { most, .. }) => {
            let reason = format!("expected a list of at most {most} records, found a longer one");
            unreadable(submission, settings, &reason)
        }
        Err(ListError::Unreadable { source, .. }) => not_read(submission, settings, &source),
    };
    let is_read = graded.grade.verdict != Verdict::Unreadable;
    if let Some(picture) =
        submission.picture.as_ref().filter(|_| !(is_read && is_recognizable(&graded)))
    {
        let mut of_picture = grade_picture(submission, picture, settings, expectations);
        let is_picture_read = of_picture.grade.verdict != Verdict::Unreadable;
        if !is_read || (is_picture_read && is_recognizable(&of_picture)) {
            let of_list = graded.grade.findings.remove(0);
            // Where the picture says nothing either, both reasons do.
            let (weight, decides) = match is_picture_read {
                true => (Weight::Remark, ": the picture decides"),
                false => (Weight::Grave, ""),
            };
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let found = printable(&format!("{name}: {}{decides}", of_list.found));
            let of_list = Finding { check: "photon list", weight, found, ..of_list };
            of_picture.grade.findings.push(of_list);
            of_picture.try_again &= graded.try_again;
            return Some(of_picture);
        }
    }
    if let Some(picture) = &submission.picture {
        let emitted = settings.emitted.map(|emitted| emitted as f64);
        let findings = match judge_picture(picture, emitted, expectations.pictures()) {
            Ok(judgment) => judgment.findings,
            Err(reason) => vec![not_readable(&reason)],
        };
        // The list says the same more exactly, so it alone decides.
        let remarks =
            findings.into_iter().map(|finding| Finding { weight: Weight::Remark, ..finding });
        graded.grade.findings.extend(remarks);
        if let Some((list, _)) = &graded.list {
            graded.grade.findings.extend(apart(list, picture, expectations));
        }
    }
    Some(graded)
}

/// Whether something of a photon map is recognizable in what was `graded`.
fn is_recognizable(graded: &Graded) -> bool {
    is_recognized(&graded.grade.findings)
}

/// The grade of a submission of which a file could not be read because of `error`.
fn not_read(submission: &Submission, settings: &Settings, error: &std::io::Error) -> Graded {
    let reason = format!("it could not be read: {error}: try again");
    Graded { try_again: true, ..unreadable(submission, settings, &reason) }
}

/// `reason` without the contents of the file `path`, if a link may lead to somebody else's.
fn told(path: &Path, reason: &Reason) -> String {
    if is_link(path) { reason.message.clone() } else { reason.to_string() }
}

fn is_link(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|about| about.is_symlink())
}

fn grade_picture(
    submission: &Submission,
    picture: &Path,
    settings: &Settings,
    expectations: &Expectations,
) -> Graded {
    if let Err(error) = std::fs::File::open(picture) {
        return not_read(submission, settings, &error);
    }
    let emitted = settings.emitted.map(|emitted| emitted as f64);
    let judgment = match judge_picture(picture, emitted, expectations.pictures()) {
        Ok(judgment) => judgment,
        Err(reason) => return unreadable(submission, settings, &reason),
    };
    if expectations.signatures.max_bounces == 0 {
        let found = if judgment.has_dots { "dots" } else { "no dot" };
        return without_bounces(submission, settings, None, found, !judgment.has_dots);
    }
    let verdict = judgment.verdict();
    let because = Because {
        explanation: judgment.explanation.as_ref(),
        pair: judgment.pair.as_ref(),
        findings: judgment.findings,
        emitted: None,
    };
    let mut graded = because.graded(submission, settings, verdict, None);
    if verdict == Verdict::Correct {
        graded.grade.for_course.extend(own_picture(picture, settings, expectations));
    }
    graded
}

/// What a verdict is given for.
#[derive(Default)]
pub(super) struct Because<'a> {
    pub(super) findings: Vec<Finding>,
    pub(super) explanation: Option<&'a Explanation>,
    pub(super) pair: Option<&'a Explanation>,
    pub(super) emitted: Option<u64>,
}

impl Because<'_> {
    pub(super) fn graded(
        self,
        submission: &Submission,
        settings: &Settings,
        verdict: Verdict,
        stored: Option<u64>,
    ) -> Graded {
        let Self { findings, explanation, pair, emitted } = self;
        let misreading = explanation.map(|explanation| explanation.hypothesis.id);
        let mut explained = explanation.iter().chain(&pair);
        let stores_direct = explained.any(|it| it.hypothesis.variation.stores_direct());
        let mut faults = findings.iter().filter(|finding| finding.is_fault());
        let is_plausible = faults.all(|finding| finding.weight != Weight::Grave) && !stores_direct;
        Graded::new(Grade {
            submission: submission.name.clone(),
            emitted: emitted.or(settings.emitted),
            stored,
            score: settings.policy.score(scored_as(verdict, &findings), misreading, is_plausible),
            verdict,
            misreading,
            misreading_confidence: explanation.map(|explanation| explanation.confidence),
            misreading_title: explanation.map(|explanation| explanation.hypothesis.title.clone()),
            findings,
            for_course: Vec::new(),
        })
    }
}

/// Grades a submission that has only a list.
pub fn grade_list(
    submission: &Submission,
    list: PhotonList,
    settings: &Settings,
    expectations: &Expectations,
) -> Graded {
    let light = assignment8::create_scene().lights()[0].position.as_dvec3();
    let observation = observe(&list, &expectations.places, light);
    let finite = observation.records as f64 - observation.counts.not_finite;
    if observation.records > 0 && finite == 0.0 {
        return unreadable(submission, settings, "no position in the list is a finite number");
    }
    if expectations.signatures.max_bounces == 0 {
        let stored = observation.records;
        let found = format!("{stored} photons");
        return without_bounces(submission, settings, Some(stored), &found, stored == 0);
    }
    if observation.records == 0 {
        return no_photons(submission, settings);
    }
    let by_user = settings.emitted.map(|emitted| emitted as f64);
    let emitted = by_user.or(observation.emitted_by_intensity);
    let mut judgment = judge(&observation, emitted, by_user.is_some(), expectations);
    let exact = exact_comparison(
        &list,
        settings,
        expectations.signatures.max_bounces,
        emitted.map(|emitted| emitted as u64),
    );
    judgment.findings.extend(exact);
    // What the course says of the number is what it wants to know of so few.
    let is_too_few = by_user.is_none() && judgment.emitted < FEW_EMITTED;
    if is_too_few {
        judgment.findings.push(too_few(observation.records));
    }
    let mut faults = judgment.findings.iter().filter(|finding| finding.is_fault());
    let verdict = match faults.all(|fault| fault.check == ENOUGH_PHOTONS) {
        false => Verdict::Incorrect,
        true if is_too_few => Verdict::Undecided,
        true => Verdict::Correct,
    };
    let because = Because {
        explanation: judgment.explanation.as_ref(),
        pair: judgment.pair.as_ref(),
        findings: judgment.findings.clone(),
        emitted: emitted.map(|emitted| emitted as u64),
    };
    let graded = because.graded(submission, settings, verdict, Some(observation.records));
    Graded { list: Some((list, judgment)), ..graded }
}
