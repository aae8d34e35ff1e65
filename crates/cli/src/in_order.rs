//! Reports of a class, printed as they come.

use std::collections::BTreeMap;

use super::error::{CliError, print_whole};

/// Prints reports as they come, each after those before it.
#[derive(Default)]
pub struct InOrder {
    next: usize,
    has_printed: bool,
    /// Those that wait for others; nothing for a submission that could not be checked.
    waiting: BTreeMap<usize, Option<String>>,
    /// Why nothing can be printed any more.
    pub problem: Option<CliError>,
}

impl InOrder {
    /// Prints `text`, the report number `at`, or keeps it until those before it have come.
    pub fn print(&mut self, at: usize, text: Option<String>) {
        self.waiting.insert(at, text);
        while let Some(text) = self.waiting.remove(&self.next) {
            self.next += 1;
            let Some(text) = text.filter(|_| self.problem.is_none()) else { continue };
            let gap = if self.has_printed { "\n" } else { "" };
            self.has_printed = true;
            self.problem = print_whole(&format!("{gap}{text}")).err();
        }
    }
}
