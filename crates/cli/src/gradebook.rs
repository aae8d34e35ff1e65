//! Grades for a gradebook: students by the names of a roster or of a course system's export, a row
//! for each, and what a regrade changed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use classroom::intake::HandedIn;
use classroom::text::last_part;
use classroom::written::GRADEBOOK;
use grading::text::verdict_in_words;
use grading::verdict::Grade;
use serde::Deserialize;

use super::error::CliError;
use super::export::{self, Student};
use super::input;

/// The options about the class.
#[derive(Debug, Args)]
pub struct GradebookArgs {
    /// A CSV file with a column for names, and one for ids or e-mail addresses if there is one:
    /// names and orders the submissions, and lists who handed in nothing
    #[arg(long, value_name = "FILE.csv")]
    roster: Option<PathBuf>,
    /// Replace names with numbers, so that you can show the grades to others
    #[arg(long, conflicts_with = "roster")]
    anonymous: bool,
    /// The grades of an earlier run with --format json: says what changed
    #[arg(long, value_name = "OLD.json")]
    before: Option<PathBuf>,
}

/// Whose submissions are graded, in the order of the submissions.
#[derive(Debug, Default)]
pub struct Roll {
    students: Vec<Option<Student>>,
    absent: Vec<Student>,
    before: BTreeMap<String, Before>,
    is_anonymous: bool,
}

/// A grade of an earlier run.
#[derive(Debug, Deserialize)]
struct Before {
    submission: String,
    score: f64,
    verdict: String,
}

/// The grades of an earlier run: of one submission or of several, or those of `check`.
#[derive(Deserialize)]
#[serde(untagged)]
enum Earlier {
    One(Before),
    Several(Vec<Before>),
    Checked(Vec<CheckedBefore>),
}

#[derive(Deserialize)]
struct CheckedBefore {
    grade: Before,
}

/// A submission: its file or folder, its name, and its student if an export or the name tells.
type Named<T> = (Option<Student>, String, T);

impl GradebookArgs {
    /// The files that are read.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.roster.iter().chain(&self.before)
    }

    /// Names and orders what was `handed_in` at `paths`.
    ///
    /// # Errors
    /// When the roster or the earlier grades cannot be read.
    pub fn class(
        &self,
        paths: &[PathBuf],
        handed_in: &mut Vec<HandedIn>,
    ) -> Result<Roll, CliError> {
        let exported = export::students(paths);
        let known = handed_in.drain(..).map(|one| {
            let name = one.submission.name.clone();
            (student_of(&exported, Path::new(&name)), name, one)
        });
        let (roll, named) = self.roll(join(known.collect()))?;
        for (name, mut one) in named {
            one.submission.name = name;
            if self.anonymous {
                one.notes.clear();
            }
            handed_in.push(one);
        }
        Ok(roll)
    }

    /// Names and orders the `folders` that were handed in, which are at `paths` or in them.
    ///
    /// # Errors
    /// When the roster or the earlier grades cannot be read.
    #[cfg(unix)]
    pub fn folders(
        &self,
        paths: &[PathBuf],
        folders: Vec<PathBuf>,
    ) -> Result<(Roll, Vec<(String, PathBuf)>), CliError> {
        let exported = export::students(paths);
        let known =
            |path: PathBuf| (student_of(&exported, &path), check::find::name_of(&path), path);
        self.roll(folders.into_iter().map(known).collect())
    }

    /// Names and orders what is `known`.
    fn roll<T>(&self, mut known: Vec<Named<T>>) -> Result<(Roll, Vec<(String, T)>), CliError> {
        let mut roll = Roll { is_anonymous: self.anonymous, ..Roll::default() };
        if let Some(path) = &self.before {
            roll.before = earlier(path)?;
        }
        if let Some(path) = &self.roster {
            let roster = export::roster(path)?;
            let place = |(student, name, _): &Named<T>| {
                roster.iter().position(|one| one.is(last_word(name), student.as_ref()))
            };
            known.sort_by_key(|one| place(one).unwrap_or(usize::MAX));
            let places: Vec<Option<usize>> = known.iter().map(place).collect();
            for ((student, _, _), place) in known.iter_mut().zip(&places) {
                *student = place.map(|place| roster[place].clone()).or(student.take());
            }
            let is_absent = |(place, _): &(usize, Student)| !places.contains(&Some(*place));
            let absent = roster.into_iter().enumerate().filter(is_absent);
            roll.absent = absent.map(|(_, student)| student).collect();
        }
        if self.anonymous {
            // By name, their numbers would tell who is who.
            known.sort_by_key(|(_, name, _)| number(name));
        }
        let mut named = Vec::new();
        for (at, (student, name, one)) in known.into_iter().enumerate() {
            let name = match &student {
                _ if self.anonymous => format!("submission {}", at + 1),
                Some(student) => student.name.clone(),
                None => name,
            };
            roll.students.push(student);
            named.push((name, one));
        }
        Ok((roll, named))
    }
}

/// Whose submission is at `path`: an export says so, or the name that it gave.
fn student_of(exported: &BTreeMap<PathBuf, Student>, path: &Path) -> Option<Student> {
    let in_name = || export::in_name(last_word(&path.to_string_lossy()));
    exported.get(path).cloned().or_else(in_name)
}

/// The name that a student or a course system gave the file or folder `name`: the end of its path,
/// without the words for a list or a picture.
fn last_word(name: &str) -> &str {
    let word = last_part(name);
    let is_kind = |kind: &str| ["csv", "ply", "png"].contains(&kind.to_lowercase().as_str());
    match word.rsplit_once('.') {
        Some((word, kind)) if is_kind(kind) => word,
        _ => word,
    }
}

/// A number that depends on every letter of `name`, and on nothing else.
fn number(name: &str) -> u64 {
    let step = |sum: u64, byte: u8| (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    name.bytes().fold(0xcbf2_9ce4_8422_2325, step)
}

/// Joins a list and a picture that an export gives one student in two files.
fn join(all: Vec<Named<HandedIn>>) -> Vec<Named<HandedIn>> {
    let mut joined: Vec<Named<HandedIn>> = Vec::new();
    for (student, name, one) in all {
        let fits = |other: &&mut Named<HandedIn>| {
            let (a, b) = (&one.submission, &other.2.submission);
            student.is_some()
                && student == other.0
                && !(a.list.is_some() && b.list.is_some())
                && !(a.picture.is_some() && b.picture.is_some())
                && one.problem.is_none()
                && other.2.problem.is_none()
        };
        match joined.iter_mut().find(fits) {
            Some((_, _, other)) => {
                let submission = &mut other.submission;
                submission.list = submission.list.take().or(one.submission.list);
                submission.picture = submission.picture.take().or(one.submission.picture);
                other.notes.extend(one.notes);
            }
            None => joined.push((student, name, one)),
        }
    }
    joined
}

fn earlier(path: &Path) -> Result<BTreeMap<String, Before>, CliError> {
    let text = input::text(path)?;
    let grades = match serde_json::from_str(&text) {
        Ok(Earlier::One(grade)) => vec![grade],
        Ok(Earlier::Several(grades)) => grades,
        Ok(Earlier::Checked(checked)) => checked.into_iter().map(|one| one.grade).collect(),
        Err(_) => {
            let path = path.display();
            let message = format!("{path}: expected grades written with --format json");
            return Err(CliError::Argument(message));
        }
    };
    Ok(grades.into_iter().map(|grade| (grade.submission.clone(), grade)).collect())
}

impl Roll {
    /// Whether no name may be shown.
    pub fn is_anonymous(&self) -> bool {
        self.is_anonymous
    }

    /// Leaves out the submission `at`, which has no grade.
    #[cfg(unix)]
    pub fn leave_out(&mut self, at: usize) {
        self.students.remove(at);
    }

    /// The names of those who handed in nothing.
    pub fn absent(&self) -> Vec<&str> {
        self.absent.iter().map(|one| one.name.as_str()).collect()
    }

    /// What people read after the grades: what changed, and who handed in nothing.
    pub fn text(&self, grades: &[&Grade]) -> String {
        let mut text = String::new();
        let changed = grades.iter().filter_map(|grade| {
            let before = self.before.get(&grade.submission)?;
            let verdict = json_name(grade);
            let is_same = before.score == grade.score && before.verdict == verdict;
            (!is_same).then(|| {
                format!(
                    "{}: was {}, {} points; is {verdict}, {} points",
                    grade.submission, before.verdict, before.score, grade.score
                )
            })
        });
        let changed: Vec<String> = changed.collect();
        if !self.before.is_empty() {
            let count = changed.len();
            text += &format!("\nchanged since the earlier grades: {count}\n");
            text += &changed.iter().map(|line| format!("  {line}\n")).collect::<String>();
        }
        if !self.absent.is_empty() {
            text += &format!("\nhanded in nothing: {}\n", self.absent().join(", "));
        }
        text
    }

    /// The grades as CSV: a row for each submission, and one for each student without any. The
    /// columns `head` have the cells that `more` gives for the submission with this number.
    pub fn csv(
        &self,
        grades: &[&Grade],
        score_of_nothing: f64,
        head: &[&str],
        more: impl Fn(usize) -> Vec<String>,
    ) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let columns = [&GRADEBOOK, head].concat();
        let mut rows = vec![columns.into_iter().map(str::to_owned).collect::<Vec<_>>()];
        let nobody = Student::default();
        for (at, grade) in grades.iter().enumerate() {
            let student = self.students.get(at).and_then(Option::as_ref).unwrap_or(&nobody);
            let student = if self.is_anonymous { &nobody } else { student };
            let mut row = vec![
                last_word(&grade.submission).to_owned(),
                student.id.clone(),
                student.email.clone(),
                grade.score.to_string(),
                verdict_in_words(grade.verdict).to_owned(),
            ];
            row.extend(more(at));
            rows.push(row);
        }
        for Student { name, id, email } in &self.absent {
            let (score, verdict) = (score_of_nothing.to_string(), "nothing handed in".to_owned());
            let row = [name.clone(), id.clone(), email.clone(), score, verdict];
            rows.push([row.to_vec(), vec![String::new(); head.len()]].concat());
        }
        if !self.before.is_empty() {
            rows[0].extend(["score before", "verdict before"].map(str::to_owned));
            let names = grades.iter().map(|grade| Some(&grade.submission));
            let names = names.chain(self.absent.iter().map(|_| None));
            for (row, name) in rows[1..].iter_mut().zip(names) {
                let before = name.and_then(|name| self.before.get(name));
                row.push(before.map(|before| before.score.to_string()).unwrap_or_default());
                row.push(before.map(|before| before.verdict.clone()).unwrap_or_default());
            }
        }
        for row in rows {
            let cells = row.iter().map(|cell| without_formula(cell));
            writer.write_record(cells).expect("memory takes everything");
        }
        String::from_utf8(writer.into_inner().expect("memory takes everything"))
            .expect("it was made of text")
    }
}

fn json_name(grade: &Grade) -> String {
    let name = serde_json::to_value(grade.verdict).expect("a verdict has a name");
    name.as_str().unwrap_or_default().to_owned()
}

/// Spreadsheets run a cell that starts like a formula, and students choose the names of files.
fn without_formula(cell: &str) -> String {
    let is_formula = cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
    if is_formula && cell.parse::<f64>().is_err() { format!("'{cell}") } else { cell.to_owned() }
}
