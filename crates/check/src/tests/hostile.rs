//! Code that misbehaves: one clear line under the section in which it happened, and the rest is
//! judged.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use super::cases::{FEW, Program};
use super::{handed_in, two_at_a_time};
use crate::sections::{Status, judge};

const RENDERER: &str = "submissions/one_function/PhotonMappingRenderer.cpp";

/// The processor time of a probe and of the whole run.
const TIME: Duration = Duration::from_secs(1);
/// How long all of it may take, also on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// What the light does, and what is said of it under Photon Emission; nothing where it comes to
/// nothing. Sleeping for 2 s takes none of the processor's time.
const DEEDS: [(&str, &str); 20] = [
    ("sleep", ""),
    ("loop", "does not end within 1 s"),
    ("crash", "segmentation fault"),
    ("abort", "aborts"),
    ("exit", "ends the whole program with exit code 0"),
    ("kill", "aborts"),
    ("output", "prints more than"),
    ("memory", "of memory"),
    ("malloc", "uses more than 1024 MB of memory"),
    ("daemon", ""),
    ("fill", ""),
    ("recursion", "overflows the stack"),
    ("throw", "throws an exception: on purpose\u{fffd}bob"),
    ("forks", ""),
    ("socket", ""),
    ("file", ""),
    ("read", ""),
    ("print", ""),
    ("forge", ""),
    ("forge-all", "writes to the pipe"),
];

#[test]
fn what_misbehaves_is_told_in_a_line_and_stops_nothing_else() {
    let tests = handed_in();
    let folder = tempfile::tempdir().expect("a folder");
    for file in ["hostile/name.h", "hostile/PointLight.cpp", RENDERER] {
        let name = Path::new(file).file_name().expect("a name");
        fs::copy(tests.join(file), folder.path().join(name)).expect("can be copied");
    }
    let Some(program) = Program::new(folder.path()) else { return };
    let observed = |deed: &str, time: Duration| program.run(deed, FEW, time);
    two_at_a_time(&DEEDS, |(deed, words)| {
        let start = Instant::now();
        // To fill the memory takes long on a busy machine.
        let time = if words.contains("memory") { 3 * TIME } else { TIME };
        let observed = observed(deed, time);
        let verdicts = judge(&observed);
        let prints = ["output", "print"].contains(deed);
        assert!(prints || observed.printed.is_empty(), "{deed}: {}", observed.printed);
        let emission = &verdicts[0];
        if words.is_empty() {
            assert_eq!(emission.status, Status::Right, "{deed}: {emission:#?}");
        } else {
            let told = emission.faults.iter().any(|fault| fault.found.contains(words));
            assert!(told, "{deed}: {emission:#?}");
        }
        for verdict in &verdicts[1..] {
            assert_eq!(verdict.status, Status::Right, "{deed}: {verdict:#?}");
        }
        assert!(start.elapsed() < PATIENCE, "{deed} takes {:?}", start.elapsed());
    });
    assert_eq!(left_behind(program.workshop.path()), Vec::<String>::new());
    for (deed, words) in [("static-exit", "exit code 0"), ("static-loop", "does not end")] {
        let death = observed(deed, TIME).before_any.expect("it never begins");
        assert!(death.sentence().contains(words), "{deed}: {death:?}");
    }
}

/// The command lines of the processes that name something in `folder`.
fn left_behind(folder: &Path) -> Vec<String> {
    let folder = folder.to_str().expect("a path of letters");
    let processes = fs::read_dir("/proc").into_iter().flatten().flatten();
    let lines = processes.filter_map(|process| {
        let line = fs::read(process.path().join("cmdline")).ok()?;
        let line = String::from_utf8_lossy(&line).replace('\0', " ");
        line.contains(folder).then_some(line)
    });
    lines.collect()
}
