//! Code that misbehaves: one clear line under the section in which it happened, and the rest is
//! judged.

use std::path::Path;
use std::time::{Duration, Instant};

use super::{handed_in, kit, named};
use crate::find::CppSubmission;
use crate::run::run;
use crate::sections::{Status, judge};
use crate::workshop::Workshop;

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
    let Some(kit) = kit() else { return };
    let light = handed_in().join("hostile/PointLight.cpp");
    let renderer = handed_in().join("submissions/one_function/PhotonMappingRenderer.cpp");
    let submission = CppSubmission::default();
    let workshop = Workshop::new(kit, &light, &renderer, &submission, Duration::from_secs(60));
    let workshop = workshop.expect("a workshop");
    let program = workshop.build(1).expect("a compiler").expect("it compiles");
    let observed = |deed: &str| {
        let program = named(&program, deed);
        run(&program, workshop.path(), 100, TIME).expect("it runs")
    };
    for (deed, words) in DEEDS {
        let start = Instant::now();
        let observed = observed(deed);
        let verdicts = judge(&observed);
        let prints = ["output", "print"].contains(&deed);
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
    }
    assert_eq!(left_behind(workshop.path()), Vec::<String>::new());
    for (deed, words) in [("static-exit", "exit code 0"), ("static-loop", "does not end")] {
        let death = observed(deed).before_any.expect("it never begins");
        assert!(death.sentence().contains(words), "{deed}: {death:?}");
    }
}

/// The command lines of the processes that name something in `folder`.
fn left_behind(folder: &Path) -> Vec<String> {
    let folder = folder.to_str().expect("a path of letters");
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let lines = processes.filter_map(|process| {
        let line = std::fs::read(process.path().join("cmdline")).ok()?;
        let line = String::from_utf8_lossy(&line).replace('\0', " ");
        line.contains(folder).then_some(line)
    });
    lines.collect()
}
