//! The grades of a class, and the files with them.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;
use rayon::prelude::*;
use serde::Serialize;

use super::GradeFormat;
use super::files::{INDEX, made_by};
use crate::error::{CliError, print_whole};
use crate::gradebook;
use crate::output::write;
use classroom::class::grade_one;
use classroom::gradescope;
use classroom::intake::HandedIn;
use classroom::intake::contents::{contents, is_named_twice};
use classroom::page::{Pages, index::Index};
use classroom::text;
use classroom::twins::{Fingerprint, twins};
use grading::judge_list::Expectations;
use grading::submission::{MOST_RECORDS, Settings, grade_at_most, remark};
use grading::verdict::{Grade, SAME_FILES};
use photon_list::reader::MOST_BYTES;

/// Longer lists are judged one at a time, so that memory holds only one of them.
const MANY_RECORDS: usize = 300_000;

/// All that is graded in one run.
pub struct Class<'a> {
    pub format: GradeFormat,
    pub settings: &'a Settings,
    pub expectations: &'a Expectations,
    pub pages: Pages<'a>,
    /// Whose submissions they are.
    pub students: gradebook::Roll,
    /// Where each submission has a file of its own.
    pub folder: Option<PathBuf>,
    /// The names of these files.
    pub files: Vec<String>,
    pub bar: ProgressBar,
}

/// What remains of a grade after its file is written.
pub struct Kept {
    grade: Grade,
    /// The file's contents, if there is only one and it goes elsewhere.
    output: String,
    fingerprint: Option<Fingerprint>,
    /// What went wrong that is not the student's fault.
    pub problem: Option<String>,
}

impl Class<'_> {
    /// The grades of `handed_in`, whose files are written as soon as each is graded. Nothing that
    /// happens to one submission costs another its grade.
    pub fn grade(&self, handed_in: &[HandedIn]) -> Vec<Kept> {
        let all = 0..handed_in.len();
        let one = |at: usize, most: usize| self.grade_one(at, &handed_in[at], most);
        let small: Vec<Option<Kept>> =
            all.into_par_iter().map(|at| one(at, MANY_RECORDS)).collect();
        let large = |(at, kept): (usize, Option<Kept>)| {
            kept.unwrap_or_else(|| one(at, MOST_RECORDS).expect("the limit is the largest"))
        };
        let mut graded: Vec<Kept> = small.into_iter().enumerate().map(large).collect();
        if self.students.is_anonymous() {
            return graded;
        }
        let list = |at: usize| handed_in[at].submission.list.clone();
        let prints: Vec<_> = graded.iter().map(|one| one.fingerprint.as_ref()).collect();
        let twins = twins(&prints);
        let with_twins =
            twins.iter().enumerate().map(|(at, others)| list(at).filter(|_| !others.is_empty()));
        let contents = contents(&with_twins.collect::<Vec<_>>(), MOST_BYTES);
        for (at, mut others) in twins.into_iter().enumerate() {
            others.retain(|other| match (list(at), list(*other)) {
                (Some(one), Some(other)) => !is_named_twice(&one, &other),
                _ => true,
            });
            let is_copy =
                |other: &usize| contents[at].is_some() && contents[at] == contents[*other];
            let (copies, others): (Vec<usize>, Vec<usize>) = others.into_iter().partition(is_copy);
            let notes: Vec<String> = [
                twin_note("the photon list is the same, byte by byte, as that", &copies, &graded),
                twin_note("the photons are the same as those", &others, &graded),
            ]
            .into_iter()
            .flatten()
            .collect();
            if !notes.is_empty() {
                let kept = &mut graded[at];
                let note =
                    |note: &String| remark(SAME_FILES, "photons of the student's own", note, "");
                kept.grade.findings.extend(notes.iter().map(note));
                self.write_results(at, kept);
            }
        }
        graded
    }

    /// The grade of submission `at`; none if its list has more than `most` records.
    fn grade_one(&self, at: usize, handed_in: &HandedIn, most: usize) -> Option<Kept> {
        let graded = grade_one(handed_in, self.settings, |submission| {
            grade_at_most(submission, self.settings, self.expectations, most)
        })?;
        let name = &graded.grade.submission;
        let problem = graded.try_again.then(|| format!("{name}: could not be read: try again"));
        let fingerprint = graded.list.as_ref().and_then(|(list, _)| Fingerprint::of(&list.records));
        let output = match self.format {
            GradeFormat::Html => self.pages.page(&handed_in.submission, &graded),
            _ => String::new(),
        };
        let mut kept = Kept { grade: graded.grade, output, fingerprint, problem };
        if self.format == GradeFormat::Html
            && let Some(folder) = &self.folder
        {
            let written = write(&folder.join(&self.files[at]), std::mem::take(&mut kept.output));
            kept.failed(written);
        }
        self.write_results(at, &mut kept);
        self.bar.inc(1);
        Some(kept)
    }

    /// Writes Gradescope's file if the format asks for it.
    fn write_results(&self, at: usize, kept: &mut Kept) {
        if self.format != GradeFormat::Gradescope {
            return;
        }
        let results = json(&gradescope::results(&kept.grade, &self.settings.policy));
        match &self.folder {
            Some(folder) => kept.failed(write(&folder.join(&self.files[at]), &results)),
            None => kept.output = results,
        }
    }

    /// Writes the one output for all `graded`.
    pub fn write(
        &self,
        graded: &[Kept],
        is_alone: bool,
        out: Option<&Path>,
    ) -> Result<(), CliError> {
        let best = self.settings.policy.best();
        let grades: Vec<&Grade> = graded.iter().map(|one| &one.grade).collect();
        let output = match (self.format, grades.as_slice()) {
            (GradeFormat::Text, grades) => {
                let texts: Vec<_> = grades.iter().map(|grade| text::text(grade, best)).collect();
                texts.join("\n") + &self.students.text(grades)
            }
            (GradeFormat::Csv, grades) => {
                let head = ["sections", "misreading", "remarks"];
                let more = |at: usize| {
                    let grade = grades[at];
                    let misreading = grade.misreading.unwrap_or_default().to_owned();
                    vec![grade.sections().join("; "), misreading, grade.remarks().join("; ")]
                };
                self.students.csv(grades, self.settings.policy.unreadable, &head, more)
            }
            (GradeFormat::Json, [grade]) if is_alone => json(grade),
            (GradeFormat::Json, grades) => json(&grades),
            (GradeFormat::Gradescope | GradeFormat::Html, _) => {
                graded.first().map(|one| one.output.clone()).unwrap_or_default()
            }
        };
        match (&self.folder, out) {
            (Some(folder), _) if self.format == GradeFormat::Html => {
                let pages = grades.into_iter().zip(self.files.iter().cloned()).collect();
                let absent = self.students.absent();
                let made_by = made_by(self.students.is_anonymous());
                let index = Index { pages, absent, best, made_by };
                write(&folder.join(INDEX), index.page())
            }
            (Some(_), _) => Ok(()),
            (None, Some(path)) => write(path, &output),
            (None, None) => print_whole(&output),
        }
    }
}

impl Kept {
    fn failed(&mut self, written: Result<(), CliError>) {
        if let Err(error) = written {
            self.problem = Some(error.to_string());
        }
    }
}

fn twin_note(what: &str, others: &[usize], graded: &[Kept]) -> Option<String> {
    const MOST_NAMED: usize = 5;
    let names = others.iter().take(MOST_NAMED).map(|at| graded[*at].grade.submission.clone());
    let names = names.collect::<Vec<_>>().join(", ");
    (!others.is_empty()).then(|| {
        format!(
            "{what} of {names}; two correct programs with the same random numbers may produce the \
             same"
        )
    })
}

/// `value` as JSON.
pub fn json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).expect("a grade has only plain values") + "\n"
}
