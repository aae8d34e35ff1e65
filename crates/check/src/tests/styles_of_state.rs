//! Programs whose `TracePhoton` needs what `GenericPhotonMapGeneration` does before: a flag of its
//! own, or the loop around it. They are judged by what they do in a run.

use variants::section::Section;

use super::cases::{Change, FEW, Faults, program, wrong};
use super::{sections_text, statuses};

type Changes = &'static [Change<'static>];

const SCATTER: &str = "    path.push_back('D');
    TracePhoton(photonMap, &scattered, lightIntensity, path, currentIOR, remainingBounces - 1);";
const END: &str = "    if (remainingBounces < 0) {\n        return;\n    }\n";
const CALL: &str = "TracePhoton(photonMap, &photonRay, each, path, 1.f, maxPhotonBounces);";
const INCLUDE: &str = "#include <ctime>";
const STORES: &str = "path.size() > 1";

/// Styles, each with a condition to store a photon.
const STYLES: [(&str, &str, Changes); 5] = [
    (
        "a flag that is set for every photon",
        "!fromLight",
        &[
            (INCLUDE, "#include <ctime>\nstatic bool fromLight;"),
            (
                "GenerateRandomPhotonRay(photonRay);",
                "GenerateRandomPhotonRay(photonRay);\nfromLight = true;",
            ),
            ("path.push_back('D');", "fromLight = false;"),
        ],
    ),
    ("the first bounce has all bounces before it", "remainingBounces != maxPhotonBounces", &[]),
    (
        "a depth of its own",
        "depth > 0",
        &[
            (END, "for (int depth = 0; remainingBounces >= 0; --remainingBounces, ++depth) {\n"),
            (SCATTER, "*photonRay = scattered;\n    }"),
        ],
    ),
    (
        "a bounce in every call, and the loop outside",
        "path.size() > 1",
        &[
            (INCLUDE, "#include <ctime>\nstatic bool again;"),
            (
                CALL,
                "int left = maxPhotonBounces;\ndo {\nagain = false;\nTracePhoton(photonMap, \
                    &photonRay, each, path, 1.f, left--);\n} while (again);",
            ),
            (SCATTER, "*photonRay = scattered;\npath.push_back('D');\nagain = true;"),
        ],
    ),
    (
        "a pointer that is set for every photon",
        "current->size() > 1",
        &[
            (INCLUDE, "#include <ctime>\nstatic std::vector<char>* current;"),
            (
                "GenerateRandomPhotonRay(photonRay);",
                "GenerateRandomPhotonRay(photonRay);\ncurrent = &path;",
            ),
        ],
    ),
];

/// What is wrong in every style, its condition to store, and what is told.
const CASES: [(Changes, &str, Faults); 4] = [
    (&[], "stores", &[]),
    // The whole run is not the reference's, and still says what is stored.
    (
        &[("std::sqrt(u1)", "u1"), (">= pr", "< pr")],
        "stores",
        &[
            (Section::PhotonScatteringAbsorption, Some("inverted-roulette")),
            (Section::HemisphereSampling, Some("no-square-root")),
        ],
    ),
    (&[], "stores || true", &[(Section::PhotonStorage, Some("direct-stored"))]),
    (
        &[],
        "stores && remainingBounces % 2",
        &[(Section::PhotonStorage, Some("absorbed-not-stored"))],
    ),
];

#[test]
fn every_style_is_judged_by_what_it_does() {
    let mut cases = Vec::new();
    for (what, stores, changes) in STYLES {
        for (mistakes, condition, expected) in CASES {
            let condition = condition.replace("stores", stores);
            cases.push((what, condition, [changes, mistakes].concat(), expected));
        }
    }
    let changes: Vec<Vec<Change>> = cases
        .iter()
        .map(|(_, condition, changes, _)| [changes, &[(STORES, &**condition)][..]].concat())
        .collect();
    let Some(program) = program(&changes) else { return };
    for (case, (what, condition, _, expected)) in cases.iter().enumerate() {
        let report = program.report(case, FEW);
        assert_eq!(wrong(&report, expected, ""), None, "{what}: {condition}");
        let is_right = statuses(&report) == "+++++" && report.whole.is_reference();
        assert!(is_right || !expected.is_empty(), "{what}: {}", sections_text(&report));
    }
}

/// Millions of directions are counted for as long as there is time, and change no photon.
#[test]
fn an_engine_of_its_own_gives_the_same_photons_in_every_check() {
    let include = "#include \"common/Scene/Lights/Point/PointLight.h\"";
    let draw = "#include <random>\nstatic float Draw() {\n\
                static std::ranlux48 engine(148);\n\
                return std::uniform_real_distribution<float>(0.f, 1.f)(engine);\n}\n";
    let of_light = format!("{include}\n{draw}");
    let of_renderer = format!("{INCLUDE}\n{draw}");
    let changes =
        [(include, &*of_light), (INCLUDE, &of_renderer), ("(float)rand() / RAND_MAX", "Draw()")];
    let Some(program) = program(&[changes, changes]) else { return };
    // As if the second had less time.
    let lists = [(0, 2 * FEW), (1, FEW)].map(|(case, around)| program.report(case, around).list);
    assert!(lists[0].is_some() && lists[0] == lists[1]);
}
