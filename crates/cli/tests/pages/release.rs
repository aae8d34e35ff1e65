//! The release workflow, and what `cargo binstall` is told of its archives.

use super::read;

/// The values of the lines `key: value` of `text`, without quotes.
fn values<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
    let lines = text.lines().map(|line| line.trim().trim_start_matches("- "));
    let values = lines.filter_map(|line| line.strip_prefix(key)?.strip_prefix(": "));
    values.map(|value| value.trim_matches('"')).collect()
}

#[test]
fn binstall_finds_the_archives_of_the_workflow() {
    let workflow = read(".github/workflows/release.yml");
    let manifest = read("crates/cli/Cargo.toml");
    let (_, binstall) = manifest.split_once("\n[package.metadata.binstall]\n").expect("metadata");
    let [name] = values(&workflow, "NAME")[..] else { panic!("one name of archives") };
    let name = name.replace("${{ matrix.target }}", "{ target }");
    let address = format!("{{ repo }}/releases/download/v{{ version }}/{name}{{ archive-suffix }}");
    for line in [
        format!("pkg-url = \"{address}\"\n"),
        format!("bin-dir = \"{name}/{{ bin }}{{ binary-ext }}\"\n"),
    ] {
        assert!(binstall.contains(&line), "no {line}in\n{binstall}");
    }
    let (targets, archives) = (values(&workflow, "target"), values(&workflow, "archive"));
    assert_eq!((targets.len(), archives.len()), (3, 3));
    for (target, archive) in targets.iter().zip(archives) {
        let own =
            binstall.split_once(&format!("\n[package.metadata.binstall.overrides.{target}]\n"));
        let (_, lines) = own.unwrap_or(("", binstall));
        let format = lines.lines().find_map(|line| line.strip_prefix("pkg-fmt = "));
        let expected = if archive == "tar.gz" { "\"tgz\"" } else { "\"zip\"" };
        assert_eq!(format, Some(expected), "{target}");
    }
}
