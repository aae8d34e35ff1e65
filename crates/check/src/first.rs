//! What a file reads first. Where that is the framework's common.h, the compiler may read it before
//! the file, precompiled: nothing stands between them that could change it.

use std::path::Path;

use crate::kit::{COMMON, NOTHING};
use crate::workshop::Workshop;

/// How many headers deep common.h is looked for.
const DEEPEST: u32 = 16;

impl Workshop<'_> {
    /// The header of ours to read before `file`: GCC takes no other one as somebody compiled it,
    /// and what was compiled elsewhere may do anything to the compiler.
    pub(crate) fn header_before(&self, file: &Path) -> &'static str {
        if self.reads_common_first(file, DEEPEST) { COMMON } else { NOTHING }
    }

    /// Whether `file` begins with common.h, or with a header that does. Headers of the system may
    /// stand before it: they neither change it nor are changed by it.
    fn reads_common_first(&self, file: &Path, deepest: u32) -> bool {
        let common = self.kit.path().join(COMMON);
        let text = std::fs::read(file).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let mut rest = &*text;
        while let Some((is_quoted, name, after)) = first_include(rest) {
            let beside = file.parent().filter(|_| is_quoted);
            let folders = [self.path().join("submission"), self.kit.path().join("standin")];
            let folders = beside.into_iter().chain(folders.iter().map(|folder| &**folder));
            let place = folders.map(|folder| folder.join(name)).find(|place| place.is_file());
            if let Some(place) = place {
                return place == common
                    || (deepest > 0 && self.reads_common_first(&place, deepest - 1));
            }
            let is_of_system = |folder: &std::path::PathBuf| folder.join(name).is_file();
            if name.contains('/') || !self.kit.system.iter().any(is_of_system) {
                return false;
            }
            rest = after;
        }
        false
    }
}

/// The header that `source` plainly includes before all else, but for comments and `#pragma once`:
/// whether its name is in double quotes, the name, and what follows.
fn first_include(source: &str) -> Option<(bool, &str, &str)> {
    let mut rest = source.trim_start();
    loop {
        let comment = match (rest.strip_prefix("//"), rest.strip_prefix("/*")) {
            (Some(rest), _) => rest.split_once('\n'),
            (_, Some(rest)) => rest.split_once("*/"),
            _ => {
                let directive = rest.strip_prefix('#')?.trim_start();
                let Some(line) = directive.strip_prefix("pragma once") else {
                    return include(directive);
                };
                line.split_once('\n').filter(|(end, _)| end.trim().is_empty())
            }
        };
        let (comment, after) = comment?;
        // A comment whose line ends so goes on.
        if comment.contains('\\') {
            return None;
        }
        rest = after.trim_start();
    }
}

fn include(directive: &str) -> Option<(bool, &str, &str)> {
    let rest = directive.strip_prefix("include")?.trim_start();
    let is_quoted = rest.starts_with('"');
    let (name, rest) = match rest.strip_prefix('"') {
        Some(rest) => rest.split_once('"')?,
        None => rest.strip_prefix('<')?.split_once('>')?,
    };
    let (end, after) = rest.split_once('\n').unwrap_or((rest, ""));
    let is_plain = !name.starts_with('/') && !name.contains("..") && !name.contains(['\\', '\n']);
    let end = end.trim();
    let ends = end.is_empty() || (end.starts_with("//") && !end.contains('\\'));
    (is_plain && ends).then_some((is_quoted, name, after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_included_plainly_and_before_all_else_is_found() {
        for (source, is_quoted) in [
            ("#include <a/b.h>\nrest", false),
            ("// one\n/* two\n */\n # include\"a/b.h\" \r\nrest", true),
            ("// one\n#pragma once\n\n#include \"a/b.h\" // two\nrest", true),
        ] {
            assert_eq!(first_include(source), Some((is_quoted, "a/b.h", "rest")), "{source}");
        }
        for other in [
            "#include \"/home/eve/evil.h\"\n",
            "#include \"../../evil.h\"\n",
            "// \\\n#include <a.h>\n#include \"/home/eve/evil.h\"\n",
            "/* \\\n*/#include <a.h>\n",
            "#define A \"/home/eve/evil.h\"\n#include A\n",
            "%:include \"/home/eve/evil.h\"\n",
            "int a;\n#include <a.h>\n",
            "#pragma once \\\n#include <a.h>\n",
            "#pragma push_macro(\"A\")\n#include <a.h>\n",
            "#include <a.h> /*\n#include <b.h> */\n",
            "#include <a.h> // \\\n#include <b.h>\n",
            "#include <a.h\n>",
            "// no end",
            "",
        ] {
            assert_eq!(first_include(other), None, "{other}");
        }
    }
}
