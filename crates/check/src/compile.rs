//! Compiling a submission together with the harness.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::diagnostics::{BuildError, missing_header, missing_in_list, parse_error, paths_of_list};
use crate::error::CheckError;
use crate::find::{LIGHT, LIGHT_FOLDER, RENDERER, RENDERER_FOLDER};
use crate::foreign::{file_directive, take_headers};
use crate::kit::{HARNESS, STANDARD};
use crate::sandbox::Exit;
use crate::workshop::Workshop;

/// The framework's standard first; the other for those whose compiler let them use more. This
/// name of C++20 is the one that older compilers know, too.
const STANDARDS: [&str; 2] = [STANDARD, "-std=gnu++2a"];

impl Workshop<'_> {
    /// Compiles the harness and the submission; the path of the program.
    ///
    /// # Errors
    /// When the compiler or the kit is at fault; what is wrong with the submission is the inner
    /// error.
    pub fn build(&self, jobs: usize) -> Result<Result<PathBuf, BuildError>, CheckError> {
        let submission = self.path().join("submission");
        let [first, rest] = HARNESS.map(|source| self.kit.path().join(source));
        // The student's own files speak first: the harness fails where their headers do.
        let sources = [
            submission.join(RENDERER_FOLDER).join(RENDERER),
            submission.join(LIGHT_FOLDER).join(LIGHT),
            first,
            rest,
        ];
        let compile = |source: &PathBuf| self.compile_one(source);
        let mut early = Vec::new();
        if jobs > 1 {
            std::thread::scope(|scope| {
                let running = sources.each_ref().map(|source| scope.spawn(|| compile(source)));
                early.extend(running.map(|one| one.join().expect("no compilation panics")));
            });
        }
        let mut early = early.into_iter();
        let mut objects = Vec::new();
        let mut others = BTreeSet::new();
        for source in &sources {
            match early.next().unwrap_or_else(|| compile(source))? {
                Ok(object) => {
                    others.extend(object.sources);
                    objects.push(object.path);
                }
                Err(error) => return Ok(Err(error)),
            }
        }
        self.link_with_others(objects, others)
    }

    fn compile_one(&self, source: &Path) -> Result<Result<Object, BuildError>, CheckError> {
        let of_harness = HARNESS.iter().position(|name| source.ends_with(name));
        match of_harness.filter(|at| *at > 0 || !self.has_own_headers()) {
            None => self.compile(source, of_harness.is_some()),
            Some(at) => {
                let compile = || Ok(self.compile(source, true)?.map(|object| object.path));
                let kept = self.kit.harness(at, compile)?;
                Ok(kept.map(|path| Object { path, sources: BTreeSet::new() }))
            }
        }
    }

    pub(crate) fn compile(
        &self,
        source: &Path,
        is_harness: bool,
    ) -> Result<Result<Object, BuildError>, CheckError> {
        let mut error = BuildError::default();
        for standard in STANDARDS {
            match self.try_once(&Invocation { source, is_harness, standard })? {
                Ok(object) => return Ok(Ok(object)),
                Err(CompileFailure { error, is_final: true }) => return Ok(Err(error)),
                // The later standard knows more names, so its complaint is the true one.
                Err(failure) => error = failure.error,
            }
        }
        Ok(Err(error))
    }

    fn try_once(
        &self,
        attempt: &Invocation<'_>,
    ) -> Result<Result<Object, CompileFailure>, CheckError> {
        let source = attempt.source.display().to_string();
        let number = source
            .bytes()
            .fold(7_u64, |hash, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte)));
        let assembly = self.path().join(format!("{number:x}.s"));
        let list = assembly.with_extension("d");
        let mut unfit = None;
        let refused = |message| {
            let file = self.original_name(attempt.source);
            let error = BuildError { file, ..BuildError::plain(message) };
            Ok(Err(CompileFailure { error, is_final: true }))
        };
        loop {
            let mut command = self.command(attempt);
            for argument in ["-MD".as_ref(), "-MF".as_ref(), list.as_os_str(), "-o".as_ref()] {
                command.push(argument.to_owned());
            }
            let source = attempt.source.into();
            command.extend([assembly.as_os_str().to_owned(), "-S".into(), "-H".into(), source]);
            let mut outcome = self.run(command)?;
            let mut read = take_headers(&mut outcome.printed);
            let dependencies = fs::read_to_string(&list).unwrap_or_default();
            read.extend(paths_of_list(&dependencies));
            if let Some(path) = self.foreign(&read) {
                return refused(format!("includes {path}, which was not handed in"));
            }
            if outcome.ending == Exit::Code(0) {
                let text = fs::read(&assembly).unwrap_or_default();
                if let Some(directive) = file_directive(&String::from_utf8_lossy(&text)) {
                    return refused(format!("its assembler code may read files: {directive}"));
                }
                let sources = self.sources_of(&dependencies);
                return Ok(match self.assemble(&assembly)? {
                    Ok(path) => Ok(Object { path, sources }),
                    Err(message) => return refused(message),
                });
            }
            let error = self.explain(&outcome, attempt.is_harness)?;
            let is_final = matches!(outcome.ending, Exit::TimeOut | Exit::Signal(_));
            if is_final || !self.change_headers(attempt, &outcome.printed)? {
                // Without the headers that were given up, other errors only follow.
                let error = unfit.unwrap_or(error);
                return Ok(Err(CompileFailure { error, is_final }));
            }
            if missing_header(&error.message).is_none() {
                unfit.get_or_insert(error);
            }
        }
    }

    /// Writes the headers that `attempt` lacks, or empties one that does not fit; whether there is
    /// any.
    fn change_headers(&self, attempt: &Invocation<'_>, printed: &str) -> Result<bool, CheckError> {
        let lines = || printed.lines().map(|line| (line, parse_error(line)));
        let lacks =
            lines().find_map(|(_, error)| Some(missing_header(&error?.message)?.to_owned()));
        match lacks {
            Some(name) if name == "glm/glm.hpp" => Err(CheckError::NoGlm),
            Some(_) => self.supply_headers(attempt),
            None => {
                let Some((line, Some(error))) = lines().find(|(_, error)| error.is_some()) else {
                    return Ok(false);
                };
                let before = printed.find(line).unwrap_or_default();
                self.headers().give_up(&printed[..before], &error.file)
            }
        }
    }

    /// The compiler with all options but those for its output.
    fn command(&self, attempt: &Invocation<'_>) -> Vec<OsString> {
        let mut command = self.kit.command(attempt.standard);
        if attempt.is_harness {
            command.push("-fno-access-control".into());
        }
        if self.kit.is_clang {
            // Assembler code is to be looked at as it was written.
            command.push("-fno-integrated-as".into());
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
        folder("-idirafter", &self.headers().folder());
        folder("-include", &self.kit.path().join(self.header_before(attempt.source)));
        command
    }

    /// Writes the headers that `attempt` lacks; whether there is any new one.
    fn supply_headers(&self, attempt: &Invocation<'_>) -> Result<bool, CheckError> {
        let mut command = self.command(attempt);
        command.extend(["-M", "-MG"].map(OsString::from));
        command.push(attempt.source.into());
        let list = self.path().join("missing.d");
        command.extend(["-MF".into(), list.clone().into()]);
        self.run(command)?;
        let list = fs::read_to_string(&list).unwrap_or_default();
        self.headers().supply(missing_in_list(&list))
    }
}

/// One way to compile a file.
struct Invocation<'a> {
    source: &'a Path,
    is_harness: bool,
    standard: &'static str,
}

pub(crate) struct Object {
    pub(crate) path: PathBuf,
    /// The sources beside the headers that were read.
    pub(crate) sources: BTreeSet<PathBuf>,
}

struct CompileFailure {
    error: BuildError,
    /// Whether no other attempt can be any better.
    is_final: bool,
}
