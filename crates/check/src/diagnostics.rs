//! What compilers and linkers say, and what it means for the student.

use std::fs;
use std::path::{Path, PathBuf};

use grading::text::printable;
use serde::Serialize;

use crate::error::CheckError;
use crate::headers::files_below;
use crate::sandbox::{Exit, RunOutcome};
use crate::workshop::Workshop;

/// Why a submission does not build.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct BuildError {
    /// The student's file, by the name they know.
    pub file: Option<String>,
    /// The line in it.
    pub line: Option<u32>,
    /// What the compiler says.
    pub message: String,
    /// A name that neither the framework of the assignment has nor the student's files declare.
    pub missing: Option<String>,
    /// Whether a header of the framework declares it that was changed and handed in.
    pub is_in_changed_framework: bool,
    /// Headers that are included, and were not handed in.
    pub missing_headers: Vec<String>,
}

impl BuildError {
    pub(crate) fn plain(message: String) -> Self {
        Self { message, ..Self::default() }
    }

    /// In one line.
    pub fn sentence(&self) -> String {
        let place = match (&self.file, self.line) {
            (Some(file), Some(number)) => format!("{file}:{number}: "),
            _ => String::new(),
        };
        let missing = self
            .missing
            .as_ref()
            .map(|missing| match self.is_in_changed_framework {
                true => format!("; `{missing}` is no part of the assignment's framework"),
                false => format!("; `{missing}` is declared in no file you handed in"),
            })
            .unwrap_or_default();
        let headers = match self.missing_headers.as_slice() {
            [] => String::new(),
            headers => format!("; included, but not handed in: {}", headers.join(", ")),
        };
        printable(&format!("{place}{}{missing}{headers}", self.message))
    }
}

impl Workshop<'_> {
    /// The first error among what the compiler printed, with the student's own name of the file.
    pub(crate) fn explain(
        &self,
        outcome: &RunOutcome,
        is_harness: bool,
    ) -> Result<BuildError, CheckError> {
        if outcome.ending == Exit::TimeOut {
            let seconds = self.time.as_secs();
            let message = format!("the compiler needs more than {seconds} s of processor time");
            return Ok(BuildError::plain(message));
        }
        let Some(error) = outcome.printed.lines().find_map(parse_error) else {
            return Ok(BuildError::plain(first_line(&outcome.printed, "the compiler failed")));
        };
        let missing = missing_name(&error.message);
        // What is missing may well be in a header that is.
        let missing_headers = match missing {
            Some(_) => self.missing_headers(),
            None => missing_header(&error.message).into_iter().map(str::to_owned).collect(),
        };
        let shown = self.original_name(Path::new(&error.file));
        if shown.is_none() && is_harness {
            // Only a header of the student's can be the reason, unless the kit itself is broken.
            if !self.has_own_headers() {
                let compiler = self.kit.compiler.display().to_string();
                return Err(CheckError::Kit { compiler, message: error.message });
            }
            let message = format!("the harness cannot use your headers: {}", error.message);
            return Ok(BuildError { missing, missing_headers, ..BuildError::plain(message) });
        }
        Ok(BuildError {
            file: shown.or(Some(error.file)),
            line: Some(error.line),
            message: error.message,
            is_in_changed_framework: missing
                .as_ref()
                .is_some_and(|name| self.headers().mention(name)),
            missing,
            missing_headers,
        })
    }

    /// Whether a header of the student's stands where the stand-in has its own: the harness then
    /// reads it.
    pub(crate) fn has_own_headers(&self) -> bool {
        let submission = self.path().join("submission");
        let standin = self.kit.path().join("standin");
        let files = files_below(&submission);
        let mut places = files.iter().filter_map(|file| file.strip_prefix(&submission).ok());
        places.any(|place| standin.join(place).exists())
    }

    /// The student's name of the file that the compiler knows as `path`.
    pub(crate) fn original_name(&self, path: &Path) -> Option<String> {
        let of_copy = self
            .originals
            .iter()
            .find_map(|(copies, original)| Some(original.join(path.strip_prefix(copies).ok()?)));
        let full = of_copy.or_else(|| self.is_students(path).then(|| path.to_owned()))?;
        let canonical = fs::canonicalize(&full).unwrap_or_else(|_| full.clone());
        let below_root = self.root.as_ref().and_then(|root| canonical.strip_prefix(root).ok());
        let shown = below_root.map(Path::to_owned).or_else(|| full.file_name().map(PathBuf::from));
        shown.map(|path| path.display().to_string())
    }

    pub(crate) fn is_students(&self, path: &Path) -> bool {
        path.starts_with(self.path())
            || self.root.as_ref().is_some_and(|root| path.starts_with(root))
    }
}

pub(crate) struct CompilerError {
    pub(crate) file: String,
    pub(crate) line: u32,
    pub(crate) message: String,
}

/// `file:line:column: error: message`, as g++ and clang++ write it.
pub(crate) fn parse_error(line: &str) -> Option<CompilerError> {
    let (place, message) = line.split_once(" error: ")?;
    let place = place.strip_suffix(": fatal").or(place.strip_suffix(':')).unwrap_or(place);
    let mut parts = place.rsplitn(3, ':');
    let _column = parts.next()?;
    let line = parts.next()?.parse().ok()?;
    let file = parts.next()?.to_owned();
    Some(CompilerError { file, line, message: message.trim().to_owned() })
}

/// The name that the compiler does not know, if that is its complaint.
pub(crate) fn missing_name(message: &str) -> Option<String> {
    let complaints = [
        "was not declared",
        "has not been declared",
        "does not name a type",
        "undeclared identifier",
        "has no member named",
        "no member named",
        "unknown type name",
        "unknown class name",
        "is not a member of",
        "expected class-name",
    ];
    if !complaints.iter().any(|complaint| message.contains(complaint)) {
        return None;
    }
    let after = match message.split_once("has no member named") {
        Some((_, after)) => after,
        None => message,
    };
    after.split('\'').nth(1).map(str::to_owned)
}

/// The header that the compiler does not find, if that is its complaint.
pub(crate) fn missing_header(message: &str) -> Option<&str> {
    match message.split_once(": No such file") {
        Some((name, _)) => Some(name.trim()),
        None => message.strip_suffix(" file not found").map(|name| name.trim_matches('\'')),
    }
}

/// The names that the linker does not find, as GNU's and Apple's write them.
pub(crate) fn undefined_names(printed: &str) -> Vec<String> {
    let name_in = |line: &str| {
        let name = match line.split_once("undefined reference to ") {
            Some((_, name)) => name,
            None => line.strip_suffix(", referenced from:")?,
        };
        Some(name.trim().trim_matches(['`', '\'', '"', '.']).to_owned())
    };
    printed.lines().filter_map(name_in).collect()
}

/// The name that the linker finds twice, as GNU's and Apple's write it.
pub(crate) fn defined_twice(printed: &str) -> Option<String> {
    let name_in = |line: &str| {
        let (_, name) = line
            .split_once("multiple definition of ")
            .or_else(|| line.split_once("duplicate symbol "))?;
        let name = name.trim_start_matches(['`', '\'', '"']);
        name.split([';', '\'', '"']).next().map(str::to_owned)
    };
    printed.lines().find_map(name_in)
}

/// The last word of a function's or class's full name: `f` of `space::f(float)`.
pub(crate) fn last_word(name: &str) -> &str {
    let name = name.split(['(', '<', '[']).next().unwrap_or(name);
    name.rsplit([':', ' ']).next().unwrap_or(name)
}

/// The paths in a list of dependencies, as compilers write it for `make`: spaces are escaped.
pub(crate) fn paths_of_list(list: &str) -> Vec<String> {
    let list = list.split_once(": ").map_or("", |(_, paths)| paths);
    let list = list.replace("\\\n", " ").replace("\\\r\n", " ").replace("\\ ", "\0");
    let plain = |word: &str| word.replace('\0', " ").replace("\\#", "#").replace("$$", "$");
    list.split_whitespace().map(plain).collect()
}

pub(crate) fn first_line(printed: &str, otherwise: &str) -> String {
    let line = printed.lines().map(str::trim).find(|line| !line.is_empty());
    line.unwrap_or(otherwise).chars().take(300).collect()
}

/// The headers in a list of dependencies that no folder has.
pub(crate) fn missing_in_list(list: &str) -> Vec<String> {
    let mut paths = paths_of_list(list);
    paths.retain(|path| !Path::new(path).is_absolute());
    paths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_both_compilers_are_read() {
        let of_gcc =
            "/tmp/a/PointLight.cpp:12:9: error: 'RandFloat01' was not declared in this scope";
        let error = parse_error(of_gcc).expect("an error");
        assert_eq!((error.file.as_str(), error.line), ("/tmp/a/PointLight.cpp", 12));
        assert_eq!(missing_name(&error.message).as_deref(), Some("RandFloat01"));
        let of_clang = "a.cpp:3:10: fatal error: 'common/utils.h' file not found";
        let error = parse_error(of_clang).expect("an error");
        assert_eq!((error.file.as_str(), error.line), ("a.cpp", 3));
        assert_eq!(missing_header(&error.message), Some("common/utils.h"));
        let fatal = "a.cpp:3:10: fatal error: common/utils.h: No such file or directory";
        let error = parse_error(fatal).expect("an error");
        assert_eq!(missing_header(&error.message), Some("common/utils.h"));
        let member = "'struct Photon' has no member named 'normal'";
        assert_eq!(missing_name(member).as_deref(), Some("normal"));
        assert!(parse_error("a.cpp:3:10: warning: an error: none").is_none());
    }

    #[test]
    fn names_that_the_linker_misses_are_read() {
        let of_gnu = "a.cpp:(.text+0x5): undefined reference to `utils::uniform(float)'";
        let of_apple = "Undefined symbols:\n  \"utils::uniform(float)\", referenced from:\n   a.o";
        for printed in [of_gnu, of_apple] {
            assert_eq!(undefined_names(printed), ["utils::uniform(float)"]);
        }
        let twice = "a.cpp:(.text+0x0): multiple definition of `f(int)'; b.o: first defined here";
        assert_eq!(defined_twice(twice).as_deref(), Some("f(int)"));
        assert_eq!(last_word("utils::uniform(float)"), "uniform");
        assert_eq!(last_word("vtable for Sampler"), "Sampler");
    }

    #[test]
    fn lists_of_dependencies_may_have_spaces() {
        let list = "a.o: /x/my\\ homework/a.cpp \\\n /x/my\\ homework/a.h utils.h\n";
        assert_eq!(paths_of_list(list), ["/x/my homework/a.cpp", "/x/my homework/a.h", "utils.h"]);
        assert_eq!(missing_in_list(list), ["utils.h"]);
    }
}
