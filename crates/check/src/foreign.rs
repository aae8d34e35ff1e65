//! Files that a compiler must not read, because a submission could then show what is in them: all
//! that was not handed in, and is no header of the system.

use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

use crate::workshop::Workshop;

/// What assembler code reads files with, or may spell the names of such directives with.
const DIRECTIVES: [&str; 5] = [".incbin", ".include", ".macro", ".irp", ".altmacro"];
/// What compilers themselves write before a text in quotes.
const TEXTS: [&str; 4] = [".string", ".ascii", ".asciz", ".file"];

/// The folders in which `compiler` looks for headers.
pub(crate) fn system_folders(compiler: &Path) -> Vec<PathBuf> {
    let output = Command::new(compiler)
        .args(["-E", "-v", "-x", "c++", "/dev/null"])
        .env("LC_ALL", "C")
        .stdin(Stdio::null())
        .output();
    let printed = output.map(|output| output.stderr).unwrap_or_default();
    let printed = String::from_utf8_lossy(&printed);
    let list = printed.split_once("search starts here:").map_or("", |(_, list)| list);
    let lines = list.lines().take_while(|line| !line.starts_with("End of search list"));
    lines
        .map(|line| line.trim().trim_end_matches(" (framework directory)"))
        .filter(|line| line.starts_with('/'))
        .map(|line| without_dots(Path::new(line)))
        .collect()
}

/// Takes the list of the headers that were read, which compilers print with `-H`, from the rest.
pub(crate) fn take_headers(printed: &mut String) -> Vec<String> {
    let mut headers = Vec::new();
    let mut rest = String::new();
    for line in printed.lines() {
        match line.split_once(' ') {
            Some((dots, path)) if !dots.is_empty() && dots.bytes().all(|byte| byte == b'.') => {
                headers.push(path.to_owned());
            }
            // Precompiled: taken, or not fit to be taken.
            Some(("!" | "x", path)) if path.ends_with(".gch") => headers.push(path.to_owned()),
            // GCC's advice about headers ends the list.
            None if line.starts_with('/') => {}
            _ if line.starts_with("Multiple include guards") => {}
            _ => rest = rest + line + "\n",
        }
    }
    *printed = rest;
    headers
}

/// The directive in `assembly` that could read a file.
pub(crate) fn file_directive(assembly: &str) -> Option<&'static str> {
    let suspects = assembly.lines().filter(|line| !is_text(line.trim()));
    suspects
        .map(str::to_ascii_lowercase)
        .find_map(|line| DIRECTIVES.into_iter().find(|directive| line.contains(directive)))
}

/// Whether `line` has one text in quotes, and nothing after it.
fn is_text(line: &str) -> bool {
    let Some((directive, text)) = line.split_once([' ', '\t']) else { return false };
    let Some(text) = text.trim().strip_prefix('"') else { return false };
    let mut is_escaped = false;
    let end = text.char_indices().find(|(_, letter)| {
        let ends = *letter == '"' && !is_escaped;
        is_escaped = *letter == '\\' && !is_escaped;
        ends
    });
    TEXTS.contains(&directive) && end.is_some_and(|(at, _)| at + 1 == text.len())
}

/// `path` without `..`, as it is written: what a folder of the system links to is trusted, too.
fn without_dots(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(plain.pop()),
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}

impl Workshop<'_> {
    /// The first of `paths`, as the compiler names them, that was not handed in and is no header of
    /// the system.
    pub(crate) fn foreign<'p>(
        &self,
        paths: impl IntoIterator<Item = &'p String>,
    ) -> Option<&'p str> {
        // Without the compiler's folders, nothing could be told apart.
        let system = &self.kit.system;
        let ours = [self.kit.path(), self.kit.folder()];
        let trusted = || system.iter().chain(&self.kit.glm).map(PathBuf::as_path).chain(ours);
        let is_foreign = |path: &&String| {
            let written = without_dots(Path::new(path));
            !system.is_empty()
                && written.is_absolute()
                // The submission's folder is in ours, and has no links.
                && !trusted().any(|folder| written.starts_with(folder))
                && !std::fs::canonicalize(&written).is_ok_and(|path| self.is_students(&path))
        };
        paths.into_iter().find(is_foreign).map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_told_from_messages() {
        let mut printed =
            ". /usr/include/a.h\n! /k/a.h.gch\n... /usr/include/a b.h\n/x/a.cpp:1:2: error: no\n\
                           Multiple include guards may be useful for:\n/usr/include/a.h\n"
                .to_owned();
        assert_eq!(
            take_headers(&mut printed),
            ["/usr/include/a.h", "/k/a.h.gch", "/usr/include/a b.h"]
        );
        assert_eq!(printed, "/x/a.cpp:1:2: error: no\n");
    }

    #[test]
    fn directives_that_read_files_are_found() {
        for line in [
            "\t.incbin \"/etc/passwd\"",
            "x: .INCBIN \"a\"",
            "nop; .include \"a\"",
            "\t.string\t\"a\"; .incbin \"b\"",
            "\t.string\t'\"; .incbin \"b\"",
            ".macro m a\n.inc\\a \"b\"\n.endm",
            "\t.section .text\n.irp a, bin\n.inc\\a \"b\"\n.endr",
        ] {
            assert!(file_directive(line).is_some(), "{line}");
        }
        for line in
            ["\t.string\t\"say \\\".incbin\\\" twice\"", "\t.file\t\"a.include.cpp\"", "nop"]
        {
            assert_eq!(file_directive(line), None, "{line}");
        }
    }

    #[test]
    fn the_compilers_folders_are_found() {
        let compiler = Path::new("g++");
        if Command::new(compiler).arg("--version").output().is_ok() {
            let folders = system_folders(compiler);
            assert!(folders.iter().any(|folder| folder.join("vector").is_file()), "{folders:?}");
        }
    }
}
