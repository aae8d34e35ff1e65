//! Assembling and linking a submission: with sources of its own besides the two, where they are
//! needed.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use crate::diagnostics::{
    BuildError, defined_twice, first_line, last_word, paths_of_list, undefined_names,
};
use crate::error::CheckError;
use crate::find::{LIGHT, RENDERER, SOURCES};
use crate::sandbox::Exit;
use crate::workshop::Workshop;

/// So many sources besides the two are compiled at most.
const MOST_SOURCES: usize = 20;

impl Workshop<'_> {
    /// The object file of `assembly`, or what is wrong with it.
    pub(crate) fn assemble(&self, assembly: &Path) -> Result<Result<PathBuf, String>, CheckError> {
        let object = assembly.with_extension("o");
        let mut command: Vec<OsString> = vec![self.kit.compiler.clone().into(), "-c".into()];
        command.extend([assembly.into(), "-o".into(), object.clone().into()]);
        let outcome = self.run(command)?;
        if outcome.ending == Exit::Code(0) {
            return Ok(Ok(object));
        }
        let errors = outcome.printed.lines().filter_map(|line| line.split_once("rror: "));
        let error = errors.map(|(_, error)| error.trim()).next().unwrap_or("unknown");
        Ok(Err(format!("its assembler code is wrong: {error}")))
    }

    /// The sources beside the student's headers in a list of dependencies.
    pub(crate) fn sources_of(&self, list: &str) -> BTreeSet<PathBuf> {
        let paths = paths_of_list(list).into_iter().map(PathBuf::from);
        let headers = paths.filter(|path| self.is_students(path));
        let sources =
            headers.flat_map(|header| SOURCES.map(|extension| header.with_extension(extension)));
        sources
            .filter(|source| {
                let name = source.file_name().unwrap_or_default();
                name != LIGHT && name != RENDERER && source.is_file()
            })
            .collect()
    }

    /// Links `objects`, with those of `others` that define what is undefined without them.
    pub(crate) fn link_with_others(
        &self,
        mut objects: Vec<PathBuf>,
        mut others: BTreeSet<PathBuf>,
    ) -> Result<Result<PathBuf, BuildError>, CheckError> {
        let mut tried = BTreeSet::new();
        // Where the two files lie in one folder, all beside them was copied twice.
        let mut contents = BTreeSet::new();
        let mut first_error = None;
        loop {
            let (error, names) = match self.link(&objects)? {
                Ok(program) => return Ok(Ok(program)),
                Err(error) => error,
            };
            let mentions = |source: &&PathBuf| {
                let text = fs::read(source).unwrap_or_default();
                let text = String::from_utf8_lossy(&text);
                names.iter().any(|name| text.contains(last_word(name)))
            };
            let untried: Vec<_> = others.difference(&tried).filter(mentions).cloned().collect();
            if untried.is_empty() || tried.len() >= MOST_SOURCES {
                return Ok(Err(first_error.unwrap_or(error)));
            }
            for source in untried {
                let content = fs::read(&source).unwrap_or_default();
                tried.insert(source.clone());
                if !contents.insert(content) {
                    continue;
                }
                match self.compile(&source, false)? {
                    Ok(object) => {
                        objects.push(object.path);
                        others.extend(object.sources);
                    }
                    Err(error) => {
                        first_error.get_or_insert(error);
                    }
                }
            }
        }
    }

    /// The program, or what is wrong with the names that are undefined.
    fn link(
        &self,
        objects: &[PathBuf],
    ) -> Result<Result<PathBuf, (BuildError, Vec<String>)>, CheckError> {
        let program = self.path().join("harness");
        let mut command: Vec<OsString> = vec![self.kit.compiler.clone().into(), "-o".into()];
        command.push(program.clone().into());
        command.extend(objects.iter().map(|object| object.clone().into()));
        let outcome = self.run(command)?;
        if outcome.ending == Exit::Code(0) {
            return Ok(Ok(program));
        }
        let names = undefined_names(&outcome.printed);
        let message = match names.first() {
            Some(name) => format!("`{name}` is defined in no file you handed in"),
            None => match defined_twice(&outcome.printed) {
                Some(name) => format!("`{name}` is defined twice"),
                None => first_line(&outcome.printed, "the linker failed"),
            },
        };
        Ok(Err((BuildError::plain(message), names)))
    }
}
