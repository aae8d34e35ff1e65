//! Compiling a submission together with the harness.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

pub use crate::diagnostics::BuildError;
use crate::diagnostics::{missing_header, missing_in_list, parse_error, paths_of_list};
use crate::error::CheckError;
use crate::find::{
    CppSubmission, LIGHT, LIGHT_FOLDER, RENDERER, RENDERER_FOLDER, beside, read_source,
};
use crate::foreign::{file_directive, take_headers};
use crate::headers::Headers;
use crate::kit::{Kit, write};
use crate::sandbox::{Exit, Limits, Program, RunOutcome, on_clock, search_path};

/// The framework's standard first; the other for those whose compiler let them use more. This
/// name of C++20 is the one that older compilers know, too.
const STANDARDS: [&str; 2] = ["-std=gnu++11", "-std=gnu++2a"];
/// The signal for processor time that is used up.
const SIGXCPU: i32 = 24;
/// The compiler's memory, in MiB.
const MEMORY: u64 = 3 << 10;

/// A submission in the folder in which it is compiled and run.
#[derive(Debug)]
pub struct Workshop<'kit> {
    pub(crate) kit: &'kit Kit,
    folder: tempfile::TempDir,
    /// Folders of copies, and where the originals lie.
    pub(crate) originals: Vec<(PathBuf, PathBuf)>,
    /// The folder of all that was handed in.
    pub(crate) root: Option<PathBuf>,
    headers: Mutex<Headers>,
    pub(crate) time: Duration,
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
        submission: &CppSubmission,
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
                    if let Ok(content) = read_source(&other) {
                        write(&place.join(other_name), &content)?;
                    }
                }
            }
            write(&place.join(name), &read_source(file).map_err(unreadable)?)?;
            let original = file.parent().unwrap_or(Path::new("")).to_owned();
            originals.push((place, original));
        }
        let headers = Mutex::new(Headers::new(kit, folder.path(), &submission.headers));
        let root = submission.root.as_ref().and_then(|root| fs::canonicalize(root).ok());
        Ok(Self { kit, folder, originals, root, headers, time })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The headers that are included, were not handed in, and are no part of the stand-in.
    pub fn missing_headers(&self) -> Vec<String> {
        self.headers().missing()
    }

    pub(crate) fn headers(&self) -> MutexGuard<'_, Headers> {
        self.headers.lock().unwrap_or_else(PoisonError::into_inner)
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
        // The student's own files speak first: the harness fails where their headers do.
        let mut results = results.into_iter();
        let of_harness = results.next().expect("the harness is first");
        let mut objects = Vec::new();
        let mut others = BTreeSet::new();
        for result in results.chain([of_harness]) {
            match result? {
                Ok(object) => {
                    others.extend(object.sources);
                    objects.push(object.path);
                }
                Err(error) => return Ok(Err(error)),
            }
        }
        self.link_with_others(objects, others)
    }

    fn compile_one(
        &self,
        source: &Path,
        harness: &Path,
    ) -> Result<Result<Object, BuildError>, CheckError> {
        let is_harness = source == harness;
        if !is_harness || self.has_own_headers() {
            return self.compile(source, is_harness);
        }
        let compile = || Ok(self.compile(source, true)?.map(|object| object.path));
        let kept = self.kit.harness(compile)?;
        Ok(kept.map(|path| Object { path, sources: BTreeSet::new() }))
    }

    pub(crate) fn compile(
        &self,
        source: &Path,
        is_harness: bool,
    ) -> Result<Result<Object, BuildError>, CheckError> {
        let mut error = BuildError::plain(String::new());
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
        let mut command: Vec<OsString> = vec![self.kit.compiler.clone().into()];
        // -O1 takes the least time to compile and run together.
        for option in [attempt.standard, "-O1", "-w", "-fdiagnostics-color=never"] {
            command.push(option.into());
        }
        for define in ["-DGLM_FORCE_CTOR_INIT", "-DGLM_ENABLE_EXPERIMENTAL"] {
            command.push(define.into());
        }
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
        command
    }

    /// Writes the headers that `attempt` lacks; whether there is any new one.
    fn supply_headers(&self, attempt: &Invocation<'_>) -> Result<bool, CheckError> {
        let mut command = self.command(attempt);
        command.extend(["-M", "-MG"].map(OsString::from));
        command.push(attempt.source.into());
        let list = self.run_for_output(command)?;
        self.headers().supply(missing_in_list(&list))
    }

    pub(crate) fn run(&self, command: Vec<OsString>) -> Result<RunOutcome, CheckError> {
        let (processor, time) = (self.time, on_clock(self.time));
        let limits = Limits { time, processor, memory: MEMORY, file_blocks: 1 << 19 };
        let mut outcome = self.program(command).run(limits, |_| Some(time))?;
        // GCC says so of the process that it started; clang crashes.
        let is_signal = outcome.ending == Exit::Signal(SIGXCPU);
        if is_signal || outcome.printed.to_lowercase().contains("time limit exceeded") {
            outcome.ending = Exit::TimeOut;
        }
        Ok(outcome)
    }

    /// What `command` writes to its standard output.
    fn run_for_output(&self, mut command: Vec<OsString>) -> Result<String, CheckError> {
        let list = self.path().join("missing.d");
        command.extend(["-MF".into(), list.clone().into()]);
        self.run(command)?;
        Ok(fs::read_to_string(&list).unwrap_or_default())
    }

    fn program(&self, command: Vec<OsString>) -> Program {
        let path = search_path(&self.kit.compiler);
        let temporary: OsString = self.path().into();
        Program {
            command,
            folder: self.path().to_owned(),
            environment: vec![
                ("PATH".to_owned(), path),
                ("LC_ALL".to_owned(), "C".into()),
                ("TMPDIR".to_owned(), temporary),
            ],
            writes: true,
        }
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
