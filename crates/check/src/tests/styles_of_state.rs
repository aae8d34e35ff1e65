//! Programs whose `TracePhoton` needs what `GenericPhotonMapGeneration` does before: a flag of its
//! own, or the loop around it. They are judged by what they do in a run.

use crate::sections::Status;
use variants::section::Section;

use super::{faults, report, sections_text};

type Changes = &'static [(&'static str, &'static str)];

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
            (SCATTER, "*photonRay = scattered;\n}"),
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

#[test]
fn right_programs_are_right_in_every_style() {
    for (what, stores, changes) in STYLES {
        let Some(report) = report(&[changes, &[(STORES, stores)]].concat()) else { return };
        let statuses: Vec<_> = report.sections.iter().map(|verdict| verdict.status).collect();
        assert_eq!(statuses, [Status::Right; 5], "{what}: {}", sections_text(&report));
        assert!(report.whole.is_reference(), "{what}");
    }
}

/// The whole run is not the reference's, and still says what is stored.
#[test]
fn mistakes_are_told_alone_in_every_style() {
    let mistakes = [("std::sqrt(u1)", "u1"), (">= pr", "< pr")];
    let expected = [
        (Section::PhotonScatteringAbsorption, Some("inverted-roulette")),
        (Section::HemisphereSampling, Some("no-square-root")),
    ];
    for (what, stores, changes) in STYLES {
        let changes = [changes, &[(STORES, stores)], &mistakes].concat();
        let Some(report) = report(&changes) else { return };
        assert_eq!(faults(&report), expected, "{what}: {}", sections_text(&report));
    }
}

#[test]
fn direct_photons_are_told_in_every_style() {
    for (what, stores, changes) in STYLES {
        let always = format!("{stores} || true");
        let Some(report) = report(&[changes, &[(STORES, &always)]].concat()) else { return };
        let expected = [(Section::PhotonStorage, Some("direct-stored"))];
        assert_eq!(faults(&report), expected, "{what}: {}", sections_text(&report));
    }
}

#[test]
fn too_few_photons_are_told_in_styles_of_state() {
    for (what, stores, changes) in [STYLES[0], STYLES[4]] {
        let fewer = format!("{stores} && remainingBounces % 2");
        let Some(report) = report(&[changes, &[(STORES, &fewer)]].concat()) else { return };
        let sections: Vec<_> = faults(&report).iter().map(|(section, _)| *section).collect();
        assert!(sections.contains(&Section::PhotonStorage), "{what}: {}", sections_text(&report));
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
    let lists = [(); 2].map(|()| report(&changes).and_then(|report| report.list));
    assert!(lists[0] == lists[1]);
}
