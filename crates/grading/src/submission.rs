//! One student's submission, and its grade.

use std::path::{Path, PathBuf};

use super::axes;
use super::exact::exact_comparison;
use super::facts::ENOUGH_PHOTONS;
use super::judge_list::{Expectations, Judgment, judge};
use super::limits::FEW_EMITTED;
use super::naming::Explanation;
use super::observation::observe;
use super::own;
use super::picture::dots::{FoundDots, find_dots};
use super::picture::judge_picture;
use super::picture::reading::read_picture;
use super::picture::view::{PIXELS, View};
use super::policy::Policy;
use super::recognized::RECOGNIZED;
use super::text::{printable, rounded};
use super::verdict::{Finding, Grade, Verdict, Weight};
pub use crate::limits::submission::MOST_RECORDS;
use crate::limits::submission::{FEW_STORED, FEWEST_DOTS, TOGETHER};
use photon_list::error::{ListError, Reason};
use photon_list::reader::{self, PhotonList};
use photon_mapping::assignment8;
use variants::section::Section;

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
        Err(ListError::Malformed { reason, .. }) => {
            unreadable(submission, settings, &told(path, &reason))
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
    let mut faults = graded.grade.findings.iter().filter(|finding| finding.is_fault());
    faults.all(|fault| fault.check != RECOGNIZED)
}

/// The grade of a submission of which a file could not be read because of `error`.
fn not_read(submission: &Submission, settings: &Settings, error: &std::io::Error) -> Graded {
    let reason = format!("it could not be read: {error}: try again");
    Graded { try_again: true, ..unreadable(submission, settings, &reason) }
}

/// What the course is told, if this program's own list was handed in.
fn own(graded: &Graded, settings: &Settings) -> Option<String> {
    let (list, _) = graded.list.as_ref()?;
    own::seed_of(&list.records, settings.seed).map(|seed| told_own("photons", seed))
}

/// The same for a picture.
fn own_picture(picture: &Path, settings: &Settings, expectations: &Expectations) -> Option<String> {
    let (dots, view) = dots_of(picture, expectations)?;
    own::seed_of_picture(&dots.red, view, settings.seed).map(|seed| told_own("dots", seed))
}

fn told_own(what: &str, seed: u64) -> String {
    format!(
        "the {what} are all or part of what this program produces with --seed {seed}; a correct \
         program that draws the same random numbers produces them, too"
    )
}

/// The dots of `picture`, and the view in which they are.
fn dots_of<'a>(picture: &Path, expectations: &'a Expectations) -> Option<(FoundDots, &'a View)> {
    let expectations = expectations.pictures();
    let picture = read_picture(picture).ok()?;
    let dots = find_dots(&picture, &expectations.view, || expectations.shifted()).ok()?;
    let view = if dots.is_shifted { expectations.shifted() } else { &expectations.view };
    Some((dots, view))
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
    let mut faults = judgment.findings.iter().filter(|finding| finding.is_fault()).peekable();
    let verdict = match (faults.peek().is_some(), judgment.has_dots) {
        (false, _) => Verdict::Correct,
        (true, false) => Verdict::NoDots,
        (true, true) if faults.all(|fault| fault.check == ENOUGH_PHOTONS) => Verdict::Undecided,
        (true, true) => Verdict::Incorrect,
    };
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

/// A remark, if the dots of `picture` are not the photons of `list`.
fn apart(list: &PhotonList, picture: &Path, expectations: &Expectations) -> Option<Finding> {
    let (dots, view) = dots_of(picture, expectations)?;
    let mut of_list = vec![false; PIXELS];
    for record in &list.records {
        view.for_each_pixel_of(record.position, |pixel| of_list[pixel] = true);
    }
    let inside = |pixel: &usize| view.patch(*pixel).is_some();
    let count = |is_counted: &dyn Fn(usize) -> bool| {
        (0..PIXELS).filter(inside).filter(|pixel| is_counted(*pixel)).count() as f64
    };
    let both = count(&|pixel| dots.red[pixel] && of_list[pixel]);
    let [of_picture, of_list] = [count(&|pixel| dots.red[pixel]), count(&|pixel| of_list[pixel])];
    let least = of_picture.min(of_list);
    let fewer = (of_picture / of_list).min(of_list / of_picture);
    if least < FEWEST_DOTS || (both > TOGETHER * least && fewer > TOGETHER) {
        return None;
    }
    let found = format!(
        "of {} red pixels of the picture and {} of the list's photons, {} are the same",
        rounded(of_picture),
        rounded(of_list),
        rounded(both)
    );
    let advice = "Hand in the list and the picture of one run: the list is what is graded.";
    Some(remark("list and picture", "dots where the list's photons are", &found, advice))
}

/// The remark that `records` photons are too few to tell a fair reading from a misreading.
fn too_few(records: u64) -> Finding {
    remark(
        "enough to tell",
        &format!("the photons of at least {FEW_EMITTED} emitted: about {FEW_STORED}"),
        &format!("{records} photons, too few to tell a correct program from others"),
        "Hand in the list of a run of 1,000,000 photons. If you meant to emit so few, grade with \
         --emitted.",
    )
}

/// A finding that costs nothing.
pub fn remark(check: &'static str, expected: &str, found: &str, advice: &'static str) -> Finding {
    Finding::new(check, expected, printable(found), advice)
}

/// The grade of a submission that is none, for `reason`.
pub fn unreadable(submission: &Submission, settings: &Settings, reason: &str) -> Graded {
    let because = Because { findings: vec![not_readable(reason)], ..Because::default() };
    because.graded(submission, settings, Verdict::Unreadable, None)
}

fn not_readable(reason: &str) -> Finding {
    let expected = "a photon list (CSV or PLY, with the columns x, y and z), or a picture";
    let advice = "Hand in the list that photon_dump.hpp writes, or the PNG picture as the program \
                  wrote it.";
    remark("readable", expected, reason, advice).weighing(Weight::Grave)
}

/// What a verdict is given for.
#[derive(Default)]
struct Because<'a> {
    findings: Vec<Finding>,
    explanation: Option<&'a Explanation>,
    pair: Option<&'a Explanation>,
    emitted: Option<u64>,
}

impl Because<'_> {
    fn graded(
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
        let is_recognized = faults.clone().all(|finding| finding.check != RECOGNIZED);
        let is_plausible = faults.all(|finding| finding.weight != Weight::Grave) && !stores_direct;
        Graded::new(Grade {
            submission: submission.name.clone(),
            emitted: emitted.or(settings.emitted),
            stored,
            score: match is_recognized {
                true => settings.policy.score(verdict, misreading, is_plausible),
                false => settings.policy.unreadable,
            },
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

/// The grade of a submission with what is `found`, where none may bounce and so none may be stored.
fn without_bounces(
    submission: &Submission,
    settings: &Settings,
    stored: Option<u64>,
    found: &str,
    is_right: bool,
) -> Graded {
    let finding = Finding::new(
        "photons",
        "no photon: one is stored only after it has bounced",
        format!("{found}, where no photon may bounce"),
        "Insert a photon only where the size of 'path' is larger than 1, and trace no further than \
         the bounces that are left.",
    );
    let finding = finding.weighing(Weight::Grave).passed_if(is_right).of(Section::PhotonStorage);
    let verdict = if is_right { Verdict::Correct } else { Verdict::Incorrect };
    let because = Because { findings: vec![finding], ..Because::default() };
    because.graded(submission, settings, verdict, stored)
}

fn no_photons(submission: &Submission, settings: &Settings) -> Graded {
    let finding = Finding::new(
        "photons",
        "photons that have bounced",
        "the list is empty",
        "Insert a photon where the size of 'path' is larger than 1; check that 'path' grows and \
         that TracePhoton calls itself.",
    );
    let finding = finding.weighing(Weight::Fault).of(Section::PhotonStorage);
    let because = Because { findings: vec![finding], ..Because::default() };
    because.graded(submission, settings, Verdict::NoDots, Some(0))
}
