//! The edition for students: the root package with five bodies left to write.
//!
//! The port's step comments are the marks. The body of a section goes from its comment to the next
//! one, or to the end of the function.

use super::KitFile;
use super::lock::Lock;

/// The files of the root package, and what is in them.
const PORT: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/port.rs"));

/// A body that students write.
struct Blank {
    /// The handout's section, which is the step comment.
    section: &'static str,
    file: &'static str,
    /// What the body must do, as the failing tests say it. A line of code for each.
    expected: [&'static str; 2],
}

const BLANKS: [Blank; 5] = [
    Blank {
        section: "Photon Emission",
        file: "src/scene/point_light.rs",
        expected: [
            "expected a ray that starts at the light,",
            "in a unit direction that is uniform on the sphere",
        ],
    },
    Blank {
        section: "Photon Storage",
        file: "src/rendering/photon_mapping_renderer.rs",
        expected: [
            "expected the hit in `state` and at the end of `path`, and a photon in",
            "`photon_map`, unless it comes straight from the light",
        ],
    },
    Blank {
        section: "Photon Scattering/Absorption",
        file: "src/rendering/photon_mapping_renderer.rs",
        expected: [
            "expected to scatter with the probability P_r:",
            "draw a number, then, to scatter, u1 and u2, and trace `diffuse_reflection_ray`",
        ],
    },
    Blank {
        section: "Hemisphere Sampling",
        file: "src/rendering/sampling.rs",
        expected: [
            "expected a unit direction in tangent space",
            "from u1 and u2, by equations (2) to (6)",
        ],
    },
    Blank {
        section: "Hemisphere Ray Transformation",
        file: "src/rendering/sampling.rs",
        expected: [
            "expected a matrix with the unit columns t, b and n,",
            "by equations (7) and (8), for every normal",
        ],
    },
];

/// The files of the edition.
pub fn files() -> Vec<KitFile> {
    let lock = Lock::parse(port("Cargo.lock"));
    let mut files = vec![
        KitFile::new("Cargo.toml", manifest(&lock)),
        KitFile::new("Cargo.lock", lock.of("photon-mapping")),
        KitFile::new("README.md", include_str!("../../assets/student/README.md")),
        KitFile::new(".gitignore", "/target\n/out\n"),
        KitFile::new(".cargo/config.toml", include_str!("../../assets/student/config.toml")),
    ];
    for (path, content) in PORT {
        if *path == "Cargo.lock" || is_of_this_project(path) {
            continue;
        }
        let of_file = BLANKS.iter().filter(|blank| blank.file == *path);
        let text = of_file.fold(None, |text: Option<String>, blank| {
            Some(leave_blank(text.as_deref().unwrap_or_else(|| port(path)), blank))
        });
        let text = match *path {
            "src/random.rs" => Some(with_limit(port(path))),
            "src/main.rs" => Some(without_toolkit(port(path))),
            _ => text,
        };
        let content = text.map_or_else(|| content.to_vec(), String::into_bytes);
        files.push(KitFile::new(path, content));
    }
    files
}

/// The random numbers with an end, so that a loop which accepts no direction says so.
fn with_limit(text: &str) -> String {
    let (before, number) = text.split_once("    move || ").expect("a closure gives the numbers");
    let number = number.split('\n').next().expect("it has a line");
    format!(
        "{before}    let mut drawn = 0;
    move || {{
        drawn += 1;
        assert!(drawn <= 100_000, \"photon {{photon}} draws 100,000 numbers: does a loop end?\");
        {number}
    }}
}}
"
    )
}

/// The run without its last line: students have no toolkit.
fn without_toolkit(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.contains("use the toolkit"));
    lines.map(|line| format!("{line}\n")).collect()
}

/// Whether the file `path` of the port tests the project, not the assignment.
fn is_of_this_project(path: &str) -> bool {
    path.starts_with("tests/mutations") || path == "tests/readme.rs"
}

/// The text of a file of the port.
fn port(path: &str) -> &'static str {
    let found = PORT.iter().find(|(name, _)| *name == path);
    let content = found.map(|(_, content)| std::str::from_utf8(content));
    content.and_then(Result::ok).unwrap_or_else(|| panic!("{path}: expected a text of the port"))
}

/// `text` with a `todo!` in place of the body of `blank`.
///
/// # Panics
/// When the port has no such step comment, which a test of every edition would show.
fn leave_blank(text: &str, blank: &Blank) -> String {
    let Blank { section, file, expected } = blank;
    let lines: Vec<&str> = text.lines().collect();
    let is_mark = |line: &str, section: &str| line.trim_start() == format!("// {section}");
    let mark = lines.iter().position(|line| is_mark(line, section));
    let mark = mark.unwrap_or_else(|| panic!("{file}: expected the comment '// {section}'"));
    let indent = lines[mark].len() - lines[mark].trim_start().len();
    let is_after = |line: &&str| {
        let is_outside = !line.is_empty() && !line.starts_with(&" ".repeat(indent));
        is_outside || BLANKS.iter().any(|blank| is_mark(line, blank.section))
    };
    let length = lines[mark + 1..].iter().take_while(|line| !is_after(line)).count();
    let end = mark + 1 + length;
    let [first, second] = expected;
    let mut todo = vec![
        "todo!(".to_owned(),
        format!("    \"{section}: {first} \\"),
        format!("     {second}\""),
        ");".to_owned(),
    ];
    todo.iter_mut().for_each(|line| line.insert_str(0, &" ".repeat(indent)));
    if lines[end - 1].is_empty() {
        todo.push(String::new());
    }
    let kept = |lines: &[&str]| lines.iter().map(|line| format!("{line}\n")).collect::<String>();
    kept(&lines[..=mark]) + &todo.join("\n") + "\n" + &kept(&lines[end..])
}

/// The manifest, with the versions of the port.
fn manifest(lock: &Lock) -> String {
    let mut text = include_str!("../../assets/student/Cargo.toml.in").to_owned();
    text = text.replace("{rust-version}", env!("CARGO_PKG_RUST_VERSION"));
    while let Some((before, after)) = text.split_once("{version of ") {
        let (name, after) = after.split_once('}').expect("a name has an end");
        text = format!("{before}{}{after}", lock.version(name));
    }
    text
}
