//! What is found, compiled and linked of what is handed in, and what is not.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use variants::section::Section;

use super::{faults, handed_in, kit, read, report, report_on, sections_text, target};
use crate::checking::{CheckSettings, check};
use crate::find::{CppSubmission, LIGHT, LIGHT_FOLDER, RENDERER, RENDERER_FOLDER};
use crate::kit::{COMMON, HARNESS, Kit, STANDARD};
use crate::report::Builds;
use crate::sections::Status;
use crate::workshop::Workshop;

const TIME: Duration = Duration::from_secs(60);

#[test]
fn a_missing_name_is_told_with_file_and_line() {
    let Some(report) = report(&[("sum = x * x", "sum = RandFloat01() + x * x")]) else { return };
    let Builds::No(error) = &report.builds else { panic!("it builds: {report:?}") };
    assert_eq!(error.file.as_deref(), Some("PointLight.cpp"));
    assert_eq!(error.missing.as_deref(), Some("RandFloat01"));
    assert!(error.line.is_some());
}

/// A whole checkout of the framework, with a helper of the student's own in another folder, in a
/// folder with a space in its name. Headers are included that nobody needs, or in other letters.
#[test]
fn a_checkout_brings_its_own_helpers() {
    let light = read("PointLight.cpp").replace("((float)rand() / RAND_MAX)", "RandFloat01()");
    let light = format!(
        "#include \"utility\\Utils.h\"\n#include <SDL2/SDL.h>\n\
         #include \"../Area/AreaLight.h\"\n{light}"
    );
    let area_light = "#pragma once\n#include \"common/Scene/Lights/Light.h\"\n\
                      class AreaLight : public Light { int Area() const override; };\n";
    let utils = "#include \"common/Utility/utils.h\"\n#include <cstdlib>\n\
                 float RandFloat01() { return rand() / (float)RAND_MAX; }\n";
    let of = |text: &str| text.as_bytes().to_vec();
    let report = report_on(&[
        ("my homework/common/Scene/Lights/Point/PointLight.cpp", of(&light)),
        (
            "my homework/common/Rendering/Renderer/Photon/PhotonMappingRenderer.cpp",
            of(&read("PhotonMappingRenderer.cpp")),
        ),
        ("my homework/common/Utility/utils.h", of("#pragma once\nfloat RandFloat01();\n")),
        ("my homework/common/Utility/utils.cpp", of(utils)),
        // What the framework has and the stand-in does not need is of no interest.
        ("my homework/common/Scene/Lights/Area/AreaLight.h", of(area_light)),
        ("my homework/common/Scene/Lights/Area/AreaLight.cpp", of("#error nor is this compiled\n")),
        ("my homework/main.cpp", of("#error this is not compiled\n")),
        ("my homework/common/common.h", of("#error nor is this read\n")),
    ]);
    let Some(report) = report else { return };
    assert_eq!(report.builds, Builds::Yes);
    let statuses: Vec<_> = report.sections.iter().map(|verdict| verdict.status).collect();
    assert_eq!(statuses, [Status::Right; 5], "{}", sections_text(&report));
    assert!(report.whole.is_reference(), "{:?}", report.whole.sentence(&report.sections));
    let remark = report.remarks.iter().find(|remark| remark.contains("SDL2/SDL.h"));
    assert!(remark.is_some_and(|remark| !remark.contains("Utils.h")), "{:?}", report.remarks);
}

/// Systems for handing in rename files, and some editors write UTF-16.
#[test]
fn renamed_files_in_utf_16_are_found() {
    let number = "(float)rand() / RAND_MAX >= pr";
    let renderer = read("PhotonMappingRenderer.cpp").replace(number, "rand() / RAND_MAX >= pr");
    let utf_16 = std::iter::once(0xfeff).chain(renderer.encode_utf16());
    let report = report_on(&[
        ("doe_PointLight-1.cpp", read("PointLight.cpp").into_bytes()),
        ("doe_Renderer.cpp", utf_16.flat_map(u16::to_le_bytes).collect()),
    ]);
    let Some(report) = report else { return };
    // Dividing two integers makes the roulette's number 0.
    let expected = [(Section::PhotonScatteringAbsorption, Some("no-roulette"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// What lies outside of the submission is shown to nobody, whatever reads it.
#[test]
fn files_that_were_not_handed_in_are_not_read() {
    let outside = tempfile::tempdir().expect("a folder");
    let secret = outside.path().join("secret.h");
    fs::write(&secret, "hunter2 = no_type;\n").expect("can be written");
    let secret = secret.display();
    let lines = [
        format!("#include \"{secret}\"\n"),
        format!("#include \"/usr/include/../..{secret}\"\n"),
        format!("#define TEXT \"{secret}\"\n#include TEXT\n"),
        format!("#line 1 \"{secret}\"\nnonsense value;\n"),
        format!("#define TEXT(x) #x\nconst char* text = TEXT(\n#include \"{secret}\"\n);\n"),
        format!("#ifdef NO\n#endif\n#include \"{secret}\"\n#error stop\n"),
        format!("__asm__(\".incbin \\\"{secret}\\\"\");\n"),
        format!("__asm__(\".include \\\"{secret}\\\"\");\n"),
        format!("__asm__(\".macro m a\\n.inc\\\\a \\\"{secret}\\\"\\n.endm\\nm bin\");\n"),
        format!(
            "__attribute__((section(\".text\\n.incbin \\\"{secret}\\\"\\n.section a\")))\
                 void put() {{}}\n"
        ),
        "__asm__(\"no_such_instruction\");\n".to_owned(),
    ];
    let Some(kit) = kit() else { return };
    let renderer = handed_in().join("submissions/one_function").join(RENDERER);
    for line in lines {
        let folder = tempfile::tempdir().expect("a folder");
        let light = folder.path().join(LIGHT);
        fs::write(&light, read(LIGHT) + &line).expect("can be written");
        let submission = CppSubmission::default();
        let workshop = Workshop::new(kit, &light, &renderer, &submission, TIME).expect("it is new");
        let copy = workshop.path().join("submission").join(LIGHT_FOLDER).join(LIGHT);
        let compiled = workshop.compile(&copy, false).expect("there is a compiler");
        let Err(error) = compiled else { panic!("{line} builds") };
        assert!(!format!("{error:?}").contains("hunter2"), "{line}: {error:?}");
        let is_told = ["not handed in", "assembler code", "nonsense", "not supported"];
        assert!(is_told.iter().any(|words| error.message.contains(words)), "{line}: {error:?}");
    }
}

/// GCC would take the header as it was compiled before, whatever it says now.
#[test]
fn what_was_compiled_elsewhere_is_not_taken() {
    let Some(kit) = kit() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("mine.h"), "#define GenerateRandomPhotonRay Other\n").expect("can be written");
    let command = kit.command(STANDARD);
    let mut compiler = Command::new(&command[0]);
    compiler.args(&command[1..]).args(["-x", "c++-header"]).arg(at("mine.h"));
    assert!(compiler.status().expect("a compiler").success());
    fs::write(at("mine.h"), "").expect("can be written");
    let light = format!("#include \"{}\"\n{}", at("mine.h").display(), read(LIGHT));
    fs::write(at(LIGHT), light).expect("can be written");
    fs::write(at(RENDERER), read(RENDERER)).expect("can be written");
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let settings = CheckSettings { photons: 100, ..CheckSettings::default() };
    let report = check(&submission, kit, &settings).expect("it can be checked");
    assert_eq!(report.builds, Builds::Yes);
}

#[test]
fn a_compiler_that_never_ends_is_ended() {
    let Some(kit) = kit() else { return };
    let endless = "template <int n, class T> struct Tree { static const int count = \
                   Tree<n - 1, T*>::count ^ Tree<n - 1, T[2]>::count; };\n\
                   template <class T> struct Tree<0, T> { static const int count = 1; };\n\
                   static const int count = Tree<40, char>::count;\n";
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
        fs::write(folder.path().join(name), endless).expect("can be written");
    }
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let time = Duration::from_secs(1);
    let settings = CheckSettings { time, ..CheckSettings::default() };
    let report = check(&submission, kit, &settings).expect("it can be checked");
    let told = report.builds.sentence();
    assert!(told.contains("needs more than 1 s of processor time"), "{told}");
}

#[test]
fn a_compiler_that_waits_for_a_busy_machine_has_time() {
    if kit().is_none() {
        return;
    }
    let mut kit = Kit::kept_in(target().as_deref(), None).expect("there was one");
    let folder = tempfile::tempdir().expect("a folder");
    let slow = folder.path().join("slow");
    let script = format!(
        "#!/bin/sh\ncase \"$*\" in *PointLight.cpp) sleep 3;; esac\nexec {} \"$@\"\n",
        kit.compiler.display()
    );
    fs::write(&slow, script).expect("can be written");
    fs::set_permissions(&slow, fs::Permissions::from_mode(0o755)).expect("can be changed");
    kit.compiler = slow;
    let submission =
        CppSubmission::find(&handed_in().join("submissions/one_function")).expect("one");
    let settings =
        CheckSettings { time: Duration::from_secs(2), photons: 100, ..CheckSettings::default() };
    let report = check(&submission, &kit, &settings).expect("it can be checked");
    assert_eq!(report.builds, Builds::Yes);
}

/// What stands before the first header may change it, so that all is read anew.
#[test]
fn headers_are_precompiled_for_what_includes_them_as_they_are() {
    let Some(kit) = kit() else { return };
    if kit.is_clang {
        return;
    }
    let members = "PhotonMappingRenderer.h";
    let text = |path: PathBuf| fs::read_to_string(path).expect("a header");
    let of_members = text(handed_in().join("styles/members").join(members));
    let of_photon = text(kit.path().join("standin").join(RENDERER_FOLDER).join("Photon.h"));
    let other = "#include \"other.h\"\n";
    let system = "#include <random> // one\n";
    let define = "#define NUMBERS 3\n";
    let [light, renderer] = [LIGHT, RENDERER].map(read);
    // What stands before the light and before the renderer, a header that is handed in, and whether
    // the light, the renderer and the harness read what is precompiled. One in each of two cases is
    // compiled, lest GCC refuse it.
    for (before_light, before_renderer, (name, header), is_taken, compiled) in [
        ("// one\n", system, ("", ""), [true, true, true], None),
        (define, "#ifdef NO\n#endif\n", ("", ""), [false, false, true], Some(0)),
        ("", "", (members, &*of_members), [true, true, true], Some(2)),
        ("", "", (members, &*(system.to_owned() + &of_members)), [true, true, true], None),
        // The harness reads another header of the framework first.
        ("", "", (members, &*(define.to_owned() + &of_members)), [true, false, true], None),
        ("", "", (members, &*(other.to_owned() + &of_members)), [true, false, true], None),
        ("", "", ("Photon.h", &*(define.to_owned() + &of_photon)), [true, true, false], None),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = |name: &str, text: String| {
            fs::write(folder.path().join(name), text).expect("can be written");
        };
        file(LIGHT, before_light.to_owned() + &light);
        file(RENDERER, before_renderer.to_owned() + &renderer);
        if !name.is_empty() {
            file(name, header.to_owned());
            file("other.h", define.to_owned());
        }
        let [light, renderer] = [LIGHT, RENDERER].map(|name| folder.path().join(name));
        let submission = CppSubmission::default();
        let workshop = Workshop::new(kit, &light, &renderer, &submission, TIME).expect("it is new");
        let at = |place: &str| workshop.path().join("submission").join(place);
        let sources = [
            (at(LIGHT_FOLDER).join(LIGHT), false),
            (at(RENDERER_FOLDER).join(RENDERER), false),
            (kit.path().join(HARNESS[0]), true),
        ];
        let taken = sources.each_ref().map(|(source, _)| workshop.header_before(source) == COMMON);
        assert_eq!(taken, is_taken, "{before_light:?}, {before_renderer:?}, {header}");
        if let Some(at) = compiled {
            let (source, is_harness) = &sources[at];
            let object = workshop.compile(source, *is_harness).expect("a compiler");
            let list = object.expect("it compiles").path.with_extension("d");
            let is_read = fs::read_to_string(list).expect("a list").contains("/glm.hpp");
            assert_eq!(is_read, !is_taken[at], "{}", source.display());
        }
    }
    let mut kit = Kit::kept_in(None, None).expect("there was one");
    let precompiled = kit.path().join(COMMON.to_owned() + ".gch");
    kit.prepare_for(1);
    assert!(!precompiled.exists());
    // Whose harness is kept checks again and again.
    kit.compiler = "true".into();
    fs::write(kit.object(0), "").expect("can be written");
    kit.prepare_for(1);
    assert!(precompiled.exists());
}

/// Else it would have to be compiled anew where a student's header takes the place of one.
#[test]
fn what_is_kept_reads_no_header_that_a_student_may_change() {
    let Some(kit) = kit() else { return };
    let command = kit.command(STANDARD);
    let mut list = Command::new(&command[0]);
    list.args(&command[1..]).arg("-M").arg("-I").arg(kit.path().join("standin"));
    let output = list.arg(kit.path().join(HARNESS[1])).output().expect("a compiler");
    let read = String::from_utf8_lossy(&output.stdout);
    assert!(read.contains("common/Scene/Scene.h"), "{read}");
    for folder in [LIGHT_FOLDER, RENDERER_FOLDER] {
        assert!(!read.contains(&format!("{folder}/")), "{read}");
    }
}

#[test]
fn the_next_run_compiles_no_harness() {
    let Some(report) = report(&[]) else { return };
    assert_eq!(report.builds, Builds::Yes);
    let next = Kit::kept_in(target().as_deref(), None).expect("there was one");
    for at in 0..HARNESS.len() {
        let kept = next.harness::<()>(at, || panic!("it is compiled again")).expect("can be read");
        assert!(kept.is_ok());
    }
}
