//! A `Cargo.lock` for one package of a larger one, so that a kit builds with the same versions,
//! offline.

use std::collections::{BTreeMap, BTreeSet};

/// The packages of a lock file.
pub struct Lock<'a> {
    head: &'a str,
    packages: BTreeMap<&'a str, Vec<Package<'a>>>,
}

struct Package<'a> {
    text: &'a str,
    version: &'a str,
    /// `name`, or `name version` where there are several.
    dependencies: Vec<&'a str>,
}

impl<'a> Lock<'a> {
    /// Reads what Cargo has written.
    pub fn parse(text: &'a str) -> Self {
        let mut parts = text.split("[[package]]\n");
        let head = parts.next().unwrap_or_default();
        let mut packages: BTreeMap<&str, Vec<Package>> = BTreeMap::new();
        for text in parts.map(str::trim_end) {
            let value = |key: &str| {
                let mut lines = text.lines();
                let value = lines.find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
                value.unwrap_or_default().trim_matches('"')
            };
            let entries = text.split_once("dependencies = [\n").unwrap_or_default().1.lines();
            let entries = entries.take_while(|line| *line != "]");
            let dependencies = entries.map(|line| line.trim_matches([' ', ',', '"'])).collect();
            let package = Package { text, version: value("version"), dependencies };
            packages.entry(value("name")).or_default().push(package);
        }
        Self { head, packages }
    }

    /// The version of the package `name`.
    ///
    /// # Panics
    /// When there is none, or several.
    pub fn version(&self, name: &str) -> &'a str {
        match self.packages.get(name).map(Vec::as_slice) {
            Some([package]) => package.version,
            _ => panic!("Cargo.lock: expected one package '{name}'"),
        }
    }

    /// The lock file of `root` and what it depends on.
    pub fn of(&self, root: &'a str) -> String {
        let mut reached = BTreeSet::new();
        let mut left = vec![root];
        while let Some(entry) = left.pop() {
            let mut words = entry.split(' ');
            let (name, version) = (words.next().unwrap_or_default(), words.next());
            let is_meant = |package: &&Package| version.is_none_or(|is| is == package.version);
            for package in self.packages.get(name).into_iter().flatten().filter(is_meant) {
                if reached.insert((name, package.version)) {
                    left.extend(&package.dependencies);
                }
            }
        }
        let mut text = self.head.to_owned();
        for (name, packages) in &self.packages {
            for package in packages {
                if reached.contains(&(*name, package.version)) {
                    text += &format!("[[package]]\n{}\n\n", package.text);
                }
            }
        }
        text.truncate(text.trim_end().len());
        text + "\n"
    }
}
