//! Compiling a submission together with the harness.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use crate::error::CheckError;
use crate::find::{LIGHT, LIGHT_FOLDER, RENDERER, RENDERER_FOLDER, Submission, beside};
use crate::kit::{Kit, write};
use crate::sandbox::{Ending, Limits, Outcome, Program, search_path};

/// The framework's standard first; the other for those whose compiler let them use more.
const STANDARDS: [&str; 2] = ["-std=gnu++11", "-std=gnu++17"];
/// So many sources besides the two are compiled at most.
const MOST_SOURCES: usize = 20;
/// The compiler's memory, in MiB.
const MEMORY: u64 = 3 << 10;

/// Why a submission does not build.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BuildError {
    /// The student's file, by the name they know.
    pub file: Option<String>,
    /// The line in it.
    pub line: Option<u32>,
    /// What the compiler says.
    pub message: String,
    /// A name that is declared in no file that was handed in.
    pub missing: Option<String>,
}

/// A submission in the folder in which it is compiled and run.
#[derive(Debug)]
pub struct Workshop<'kit> {
    kit: &'kit Kit,
    folder: tempfile::TempDir,
    /// Folders of copies, and where the originals lie.
    originals: Vec<(PathBuf, PathBuf)>,
    checkout: Option<PathBuf>,
    time: Duration,
}

impl<'kit> Workshop<'kit> {
    /// Copies the two files, and the headers and sources beside them, to where the framework has
    /// them.
    ///
    /// # Errors
    /// When a file cannot be copied.
    pub fn new(
        kit: &'kit Kit,
        light: &Path,
        renderer: &Path,
        submission: &Submission,
        time: Duration,
    ) -> Result<Self, CheckError> {
        let folder = kit.work_folder()?;
        let mut originals = Vec::new();
        for (file, name, home) in
            [(light, LIGHT, LIGHT_FOLDER), (renderer, RENDERER, RENDERER_FOLDER)]
        {
            let place = folder.path().join("submission").join(home);
            let unreadable = |source| CheckError::Unreadable { path: file.to_owned(), source };
            for other in beside(file) {
                let other_name = other.file_name().unwrap_or_default();
                // Neither of the two may stand where the other belongs.
                if other_name != LIGHT && other_name != RENDERER {
                    // What cannot be read is missed by the compiler, if it is needed.
                    if let Ok(content) = fs::read(&other) {
                        write(&place.join(other_name), &content)?;
                    }
                }
            }
            write(&place.join(name), &fs::read(file).map_err(unreadable)?)?;
            let original = file.parent().unwrap_or(Path::new("")).to_owned();
            originals.push((place, original));
        }
        Ok(Self { kit, folder, originals, checkout: submission.checkout.clone(), time })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Compiles the harness and the submission; the path of the program.
    ///
    /// # Errors
    /// When the compiler or the kit is at fault; what is wrong with the submission is the inner
    /// error.
    pub fn build(&self, jobs: usize) -> Result<Result<PathBuf, BuildError>, CheckError> {
        let submission = self.path().join("submission");
        let harness = self.kit.path().join("harness/all.cpp");
        let sources = [
            harness.clone(),
            submission.join(RENDERER_FOLDER).join(RENDERER),
            submission.join(LIGHT_FOLDER).join(LIGHT),
        ];
        let results: Vec<_> = if jobs > 1 {
            std::thread::scope(|scope| {
                let harness = &harness;
                let running: Vec<_> = sources
                    .iter()
                    .map(|source| scope.spawn(move || self.compile_one(source, harness)))
                    .collect();
                running.into_iter().map(|one| one.join().expect("no compilation panics")).collect()
            })
        } else {
            sources.iter().map(|source| self.compile_one(source, &harness)).collect()
        };
        let mut objects = Vec::new();
        // The student's own files speak first: the harness fails where their headers do.
        let mut results = results.into_iter();
        let of_harness = results.next().expect("the harness is first");
        let mut needed = BTreeSet::new();
        for result in results {
            match result? {
                Ok(object) => {
                    needed.extend(object.sources);
                    objects.push(object.path);
                }
                Err(error) => return Ok(Err(error)),
            }
        }
        match of_harness? {
            Ok(object) => objects.insert(0, object.path),
            Err(error) => return Ok(Err(error)),
        }
        if let Err(error) = self.compile_others(needed, &mut objects)? {
            return Ok(Err(error));
        }
        self.link(&objects)
    }

    fn compile_one(
        &self,
        source: &Path,
        harness: &Path,
    ) -> Result<Result<Object, BuildError>, CheckError> {
        let is_harness = source == harness;
        if !is_harness || self.has_own_headers() || self.checkout.is_some() {
            return self.compile(source, is_harness);
        }
        let compile = || Ok(self.compile(source, true)?.map(|object| object.path));
        let kept = self.kit.harness(compile)?;
        Ok(kept.map(|path| Object { path, sources: BTreeSet::new() }))
    }

    /// Compiles the sources beside the headers that were used, as far as they are not compiled yet.
    fn compile_others(
        &self,
        mut needed: BTreeSet<PathBuf>,
        objects: &mut Vec<PathBuf>,
    ) -> Result<Result<(), BuildError>, CheckError> {
        let mut done = BTreeSet::new();
        while let Some(source) = needed.pop_first() {
            if done.len() >= MOST_SOURCES || !done.insert(source.clone()) {
                continue;
            }
            match self.compile(&source, false)? {
                Ok(object) => {
                    objects.push(object.path);
                    needed.extend(object.sources);
                }
                Err(error) => return Ok(Err(error)),
            }
        }
        Ok(Ok(()))
    }

    fn compile(
        &self,
        source: &Path,
        is_harness: bool,
    ) -> Result<Result<Object, BuildError>, CheckError> {
        let mut first_error = None;
        for standard in STANDARDS {
            let number = source
                .display()
                .to_string()
                .bytes()
                .fold(7_u64, |hash, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte)));
            let object = self.path().join(format!("{number:x}.o"));
            let list = object.with_extension("d");
            let mut command: Vec<OsString> = vec![self.kit.compiler.clone().into()];
            // -O1 takes the least time to compile and run together.
            for option in [standard, "-O1", "-w", "-fdiagnostics-color=never"] {
                command.push(option.into());
            }
            for define in ["-DGLM_FORCE_CTOR_INIT", "-DGLM_ENABLE_EXPERIMENTAL"] {
                command.push(define.into());
            }
            if is_harness {
                command.push("-fno-access-control".into());
            }
            let mut folder = |option: &str, path: &Path| {
                command.push(option.into());
                command.push(path.into());
            };
            folder("-I", &self.path().join("submission"));
            folder("-I", &self.kit.path().join("standin"));
            if let Some(glm) = &self.kit.glm {
                folder("-I", glm);
            }
            if let Some(checkout) = &self.checkout {
                folder("-idirafter", checkout);
            }
            folder("-MD", Path::new("-MF"));
            command.push(list.clone().into());
            command.push("-o".into());
            command.push(object.clone().into());
            command.push("-c".into());
            command.push(source.into());
            let outcome = self.run(command)?;
            if outcome.ending == Ending::Code(0) {
                let sources = self.sources_of(&fs::read_to_string(&list).unwrap_or_default());
                return Ok(Ok(Object { path: object, sources }));
            }
            if outcome.printed.contains("glm/glm.hpp") && is_missing_header(&outcome.printed) {
                return Err(CheckError::NoGlm);
            }
            let is_final = matches!(outcome.ending, Ending::TimeOut | Ending::Signal(_));
            let error = self.explain(&outcome, is_harness)?;
            let error = first_error.get_or_insert(error);
            if is_final {
                return Ok(Err(error.clone()));
            }
        }
        Ok(Err(first_error.expect("every standard was tried")))
    }

    fn link(&self, objects: &[PathBuf]) -> Result<Result<PathBuf, BuildError>, CheckError> {
        let program = self.path().join("harness");
        let mut command: Vec<OsString> = vec![self.kit.compiler.clone().into(), "-o".into()];
        command.push(program.clone().into());
        command.extend(objects.iter().map(|object| object.clone().into()));
        let outcome = self.run(command)?;
        if outcome.ending == Ending::Code(0) {
            return Ok(Ok(program));
        }
        let missing = outcome.printed.lines().find_map(|line| {
            let after = line.split_once("undefined reference to ")?.1;
            Some(after.trim().trim_matches(['`', '\'', '"', '.']).to_owned())
        });
        let message = match &missing {
            Some(name) => format!("{name} is defined in no file"),
            None => first_line(&outcome.printed, "the linker failed"),
        };
        Ok(Err(BuildError { file: None, line: None, message, missing }))
    }

    fn run(&self, command: Vec<OsString>) -> Result<Outcome, CheckError> {
        let path = search_path(&self.kit.compiler);
        let temporary: OsString = self.path().into();
        let program = Program {
            command,
            folder: self.path().to_owned(),
            environment: vec![
                ("PATH".to_owned(), path),
                ("LC_ALL".to_owned(), "C".into()),
                ("TMPDIR".to_owned(), temporary),
            ],
            writes: true,
        };
        let limits = Limits { time: self.time, memory: MEMORY, file_blocks: 1 << 19 };
        program.run(limits, |_| Some(self.time))
    }

    /// The first error among what the compiler printed, with the student's own name of the file.
    fn explain(&self, outcome: &Outcome, is_harness: bool) -> Result<BuildError, CheckError> {
        let plain = |message: String| BuildError { file: None, line: None, message, missing: None };
        if outcome.ending == Ending::TimeOut {
            let seconds = self.time.as_secs();
            return Ok(plain(format!("the compiler did not end within {seconds} s")));
        }
        let Some(error) = outcome.printed.lines().find_map(parse_error) else {
            return Ok(plain(first_line(&outcome.printed, "the compiler failed")));
        };
        let shown = self.original_name(Path::new(&error.file));
        if shown.is_none() && is_harness {
            // Only a header of the student's can be the reason, unless the kit itself is broken.
            let has_headers = self.has_own_headers();
            if !has_headers {
                let compiler = self.kit.compiler.display().to_string();
                return Err(CheckError::Kit { compiler, message: error.message });
            }
            let message = format!("the harness cannot use your headers: {}", error.message);
            return Ok(BuildError { missing: missing_name(&error.message), ..plain(message) });
        }
        Ok(BuildError {
            file: shown.or(Some(error.file)),
            line: Some(error.line),
            missing: missing_name(&error.message),
            message: error.message,
        })
    }

    fn has_own_headers(&self) -> bool {
        self.originals.iter().any(|(copies, _)| {
            fs::read_dir(copies).is_ok_and(|mut entries| {
                entries.any(|entry| {
                    entry.is_ok_and(|entry| entry.path().extension().is_some_and(|e| e != "cpp"))
                })
            })
        })
    }

    /// The student's name of the file that the compiler knows as `path`.
    fn original_name(&self, path: &Path) -> Option<String> {
        let of_copy = self.originals.iter().find_map(|(copies, original)| {
            let rest = path.strip_prefix(copies).ok()?;
            Some((original.clone(), rest.to_owned()))
        });
        let full = match of_copy {
            Some((original, rest)) => original.join(rest),
            None => path.to_owned(),
        };
        let is_students = path.starts_with(self.path())
            || self.checkout.as_ref().is_some_and(|checkout| path.starts_with(checkout));
        if !is_students {
            return None;
        }
        let root = self.checkout.as_deref();
        let canonical = fs::canonicalize(&full).unwrap_or_else(|_| full.clone());
        let shown = root
            .and_then(|root| canonical.strip_prefix(root).ok())
            .map(Path::to_owned)
            .or_else(|| full.file_name().map(PathBuf::from));
        shown.map(|path| path.display().to_string())
    }

    /// The sources beside the student's headers in a list of dependencies, as compilers write it
    /// for `make`.
    fn sources_of(&self, list: &str) -> BTreeSet<PathBuf> {
        let words = list.split_whitespace().filter(|word| *word != "\\");
        let headers = words.map(Path::new).filter(|path| {
            path.starts_with(self.path())
                || self.checkout.as_ref().is_some_and(|checkout| path.starts_with(checkout))
        });
        let sources = headers.flat_map(|header| {
            ["cpp", "cc", "cxx"].map(|extension| header.with_extension(extension))
        });
        sources
            .filter(|source| {
                let name = source.file_name().unwrap_or_default();
                name != LIGHT && name != RENDERER && source.is_file()
            })
            .collect()
    }
}

struct Object {
    path: PathBuf,
    sources: BTreeSet<PathBuf>,
}

struct CompilerError {
    file: String,
    line: u32,
    message: String,
}

/// `file:line:column: error: message`, as g++ and clang++ write it.
fn parse_error(line: &str) -> Option<CompilerError> {
    let (place, message) = line.split_once(" error: ")?;
    let place = place.strip_suffix(": fatal").or(place.strip_suffix(':')).unwrap_or(place);
    let mut parts = place.rsplitn(3, ':');
    let _column = parts.next()?;
    let line = parts.next()?.parse().ok()?;
    let file = parts.next()?.to_owned();
    Some(CompilerError { file, line, message: message.trim().to_owned() })
}

/// The name that the compiler does not know, if that is its complaint.
fn missing_name(message: &str) -> Option<String> {
    let complaints = [
        "was not declared",
        "has not been declared",
        "does not name a type",
        "undeclared identifier",
        "has no member named",
        "no member named",
        "No such file",
        "file not found",
        "unknown type name",
        "is not a member of",
    ];
    if !complaints.iter().any(|complaint| message.contains(complaint)) {
        return None;
    }
    if let Some((name, _)) = message.split_once(": No such file") {
        return Some(name.trim().to_owned());
    }
    let after = match message.split_once("has no member named") {
        Some((_, after)) => after,
        None => message,
    };
    after.split('\'').nth(1).map(str::to_owned)
}

fn is_missing_header(printed: &str) -> bool {
    printed.contains("No such file") || printed.contains("file not found")
}

fn first_line(printed: &str, otherwise: &str) -> String {
    let line = printed.lines().map(str::trim).find(|line| !line.is_empty());
    line.unwrap_or(otherwise).chars().take(300).collect()
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
        assert_eq!(missing_name(&error.message).as_deref(), Some("common/utils.h"));
        let fatal = "a.cpp:3:10: fatal error: common/utils.h: No such file or directory";
        let error = parse_error(fatal).expect("an error");
        assert_eq!(missing_name(&error.message).as_deref(), Some("common/utils.h"));
        let member = "'struct Photon' has no member named 'normal'";
        assert_eq!(missing_name(member).as_deref(), Some("normal"));
        assert!(parse_error("a.cpp:3:10: warning: an error: none").is_none());
    }
}
