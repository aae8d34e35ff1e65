//! What the tests of real C++ have in common.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use check::kit::Kit;

/// The kit, with its harness compiled once for all tests of a file; nothing, with a message, where
/// there is no compiler or no glm. In CI there must be both.
pub fn kit() -> Option<&'static Kit> {
    static KIT: OnceLock<Option<Kit>> = OnceLock::new();
    let made = KIT.get_or_init(|| match Kit::new(None) {
        Ok(kit) => Some(kit),
        Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    });
    made.as_ref()
}

/// `program` under another name, by which it chooses what it does.
#[allow(dead_code, reason = "some tests have no choice")]
pub fn named(program: &Path, name: &str) -> PathBuf {
    let named = program.with_file_name(name);
    std::fs::copy(program, &named).expect("can be copied");
    named
}
