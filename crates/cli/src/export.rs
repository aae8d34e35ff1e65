//! Students' names, from rosters and from what Canvas, Gradescope and Moodle export.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::error::CliError;
use super::input;
use classroom::intake::class::student_in;

/// What a roster or an export tells of a student.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Student {
    /// The name.
    pub name: String,
    /// The id, if it is known.
    pub id: String,
    /// The e-mail address, if it is known.
    pub email: String,
}

/// What the columns of a roster may be called, in small letters.
const NAMES: [&str; 5] = ["name", "student", "student name", "full name", "display name"];
const FIRST_NAMES: [&str; 3] = ["first name", "firstname", "given name"];
const LAST_NAMES: [&str; 4] = ["last name", "lastname", "surname", "family name"];
const IDS: [&str; 8] =
    ["id", "sid", "student id", "id number", "user id", "sis user id", "sis id", "identifier"];
const EMAILS: [&str; 5] = ["email", "e-mail", "email address", "mail", "sis login id"];

impl Student {
    /// Whether the submission called `name`, or what an export says about it, is this student's.
    pub fn is(&self, name: &str, exported: Option<&Student>) -> bool {
        let name = exported.map_or(name, |exported| &exported.name);
        let id = exported.map(|exported| exported.id.as_str()).filter(|id| !id.is_empty());
        let email =
            exported.map(|exported| exported.email.as_str()).filter(|mail| !mail.is_empty());
        let account = self.email.split('@').next().unwrap_or_default();
        let own = [&self.id, &self.email, account].map(plain);
        let is_own = |word: &str| own.iter().any(|own| !own.is_empty() && *own == plain(word));
        if id.is_some_and(is_own) || email.is_some_and(is_own) || is_own(name) {
            return true;
        }
        // "Doe, Jane", "jane_doe" and "doejane" are Jane Doe.
        let words: Vec<String> = self.name.split_whitespace().map(plain).collect();
        let turned = |first: usize| [&words[first..], &words[..first]].concat().concat();
        let name = plain(name);
        !name.is_empty() && (0..words.len()).any(|first| turned(first) == name)
    }
}

/// The letters and digits of `text`, small.
fn plain(text: &str) -> String {
    text.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Reads a roster: CSV with a header that names its columns.
///
/// # Errors
/// When it cannot be read, or has no column for names.
pub fn roster(path: &Path) -> Result<Vec<Student>, CliError> {
    let text = input::bytes(path)?;
    let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&text);
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text);
    let wrong = |line: u64, message: &str| {
        CliError::Argument(format!("{}:{line}: expected {message}", path.display()))
    };
    let head = reader.headers().map_err(|_| wrong(1, "a roster in CSV and UTF-8"))?.clone();
    let column = |known: &[&str]| {
        let is_known = |title: &str| known.contains(&title.trim().to_lowercase().as_str());
        known.iter().find_map(|_| head.iter().position(is_known))
    };
    let (name, first, last) = (column(&NAMES), column(&FIRST_NAMES), column(&LAST_NAMES));
    if name.is_none() && (first.is_none() || last.is_none()) {
        let found = head.iter().collect::<Vec<_>>().join(", ");
        let message = "a column 'name', or 'first name' and 'last name'";
        return Err(wrong(1, &format!("{message}; found {found}")));
    }
    let (id, email) = (column(&IDS), column(&EMAILS));
    let mut students = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            wrong(line, "a row in CSV and UTF-8")
        })?;
        let cell = |at: Option<usize>| at.and_then(|at| row.get(at)).unwrap_or_default().trim();
        let name = match name {
            Some(_) => cell(name).to_owned(),
            None => format!("{} {}", cell(first), cell(last)).trim().to_owned(),
        };
        if !name.is_empty() {
            let (id, email) = (cell(id).to_owned(), cell(email).to_owned());
            students.push(Student { name, id, email });
        }
    }
    Ok(students)
}

/// The student whose name a course system put into the `name` of a file or folder.
pub fn in_name(name: &str) -> Option<Student> {
    let (name, id) = student_in(name)?;
    Some(Student { name: name.to_owned(), id: id.to_owned(), email: String::new() })
}

/// The students of Gradescope's exports among `paths`, by their folders: what a student hands in
/// may have such a file, too, which then names nobody else.
pub fn students(paths: &[PathBuf]) -> BTreeMap<PathBuf, Student> {
    let mut students = BTreeMap::new();
    for path in paths {
        if let Ok(text) = input::text(&path.join("submission_metadata.yml")) {
            let of_folder = |(name, student)| (path.join(name), student);
            students.extend(gradescope(&text).into_iter().map(of_folder));
        }
    }
    students
}

/// Reads what Gradescope writes beside the folders of an export; not YAML in general.
fn gradescope(text: &str) -> BTreeMap<String, Student> {
    let mut students: BTreeMap<String, Student> = BTreeMap::new();
    let mut folder = None;
    for line in text.lines() {
        if let Some(name) = line.strip_suffix(':').filter(|line| line.starts_with("submission_")) {
            folder = Some(name.to_owned());
            continue;
        }
        let Some(folder) = &folder else { continue };
        let entry = line.trim_start().trim_start_matches("- ");
        let value = |key: &str| {
            let value = entry.strip_prefix(key)?.trim();
            Some(value.trim_matches(['\'', '"']).to_owned())
        };
        let student = students.entry(folder.clone()).or_default();
        // A group has several submitters: all their names, and the first one's id.
        if let Some(name) = value(":name:") {
            student.name = match student.name.as_str() {
                "" => name,
                others => format!("{others} & {name}"),
            };
        } else if let (Some(id), "") = (value(":sid:"), student.id.as_str()) {
            student.id = id;
        } else if let (Some(email), "") = (value(":email:"), student.email.as_str()) {
            student.email = email;
        }
    }
    students.retain(|_, student| !student.name.is_empty());
    students
}
