//! Which lines of the port belong to which step, and beside which line a value stands.
//!
//! The build script looks all of them up in the port's source. It fails, and says what it expected,
//! when a function was renamed, a step comment is missing, or a line is no longer there.

use std::fmt::Write as _;

/// The titles of the handout's sections, which are the port's step comments.
const SECTIONS: [&str; 5] = [
    "Photon Emission",
    "Photon Storage",
    "Photon Scattering/Absorption",
    "Hemisphere Sampling",
    "Hemisphere Ray Transformation",
];

/// A step of a photon's story.
struct PortStep {
    /// Its name in links.
    name: &'static str,
    /// Its name on a button.
    short: &'static str,
    /// The section of the handout.
    section: &'static str,
    parts: &'static [PortPart],
}

/// What a step runs of one function.
struct PortPart {
    function: &'static str,
    lines: LitLines,
    /// What a line contains, and the value that stands beside it.
    values: &'static [(&'static str, &'static str)],
}

/// The lines that a step lights.
enum LitLines {
    /// All under the step comment of a section.
    Section(&'static str),
    /// Of the lines under a step comment, from the first that contains one text to the next that
    /// contains another.
    Within(&'static str, &'static str, &'static str),
    /// The whole function.
    Body,
}

const EMISSION: &str = SECTIONS[0];
const STORAGE: &str = SECTIONS[1];
const SCATTERING: &str = SECTIONS[2];
const SAMPLING: &str = SECTIONS[3];
const TRANSFORMATION: &str = SECTIONS[4];

/// The functions shown, and their files.
const FUNCTIONS: [(&str, &str); 6] = [
    ("generate_random_photon_ray", "src/scene/point_light.rs"),
    ("trace_photon", "src/rendering/photon_mapping_renderer.rs"),
    ("diffuse_reflection_ray", "src/rendering/photon_mapping_renderer.rs"),
    ("sample_hemisphere", "src/rendering/sampling.rs"),
    ("tangent_frame", "src/rendering/sampling.rs"),
    ("spawn_ray", "src/scene/numerics.rs"),
];

const STEPS: [PortStep; 9] = [
    PortStep {
        name: "emission",
        short: "Emission",
        section: EMISSION,
        parts: &[PortPart {
            function: "generate_random_photon_ray",
            lines: LitLines::Section(EMISSION),
            values: &[
                ("let x = ", "x"),
                ("let y = ", "y"),
                ("let z = ", "z"),
                ("let length_squared", "length_squared"),
                ("direction.normalize()", "direction"),
            ],
        }],
    },
    PortStep {
        name: "hit",
        short: "Hit",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if remaining_bounces < 0", "let intersection_point"),
            values: &[
                ("if remaining_bounces < 0", "remaining_bounces"),
                (".trace(photon_ray", "trace()"),
                ("let intersection_point", "intersection_point"),
            ],
        }],
    },
    PortStep {
        name: "stored",
        short: "Stored?",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if path.len() > 1", "path.push("),
            values: &[
                ("if path.len() > 1", "path.len()"),
                ("photon_map.push(", "photon_map.push()"),
                ("to_light_ray", "to_light"),
            ],
        }],
    },
    PortStep {
        name: "roulette",
        short: "Roulette",
        section: SCATTERING,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(SCATTERING, SCATTERING, "return;"),
            values: &[
                ("let diffuse_response", "diffuse_response"),
                ("let probability_of_reflection", "probability_of_reflection"),
                ("if rand() >=", "rand()"),
            ],
        }],
    },
    PortStep {
        name: "hemisphere",
        short: "Hemisphere",
        section: SAMPLING,
        parts: &[
            PortPart {
                function: "trace_photon",
                lines: LitLines::Within(SCATTERING, "let (u1, u2)", "let diffuse_reflection_ray"),
                values: &[("let (u1, u2)", "u1"), ("let (u1, u2)", "u2")],
            },
            PortPart {
                function: "sample_hemisphere",
                lines: LitLines::Body,
                values: &[
                    ("let r = ", "r"),
                    ("let theta = ", "theta"),
                    ("let x = ", "x"),
                    ("let y = ", "y"),
                    ("let z = ", "z"),
                ],
            },
        ],
    },
    PortStep {
        name: "frame",
        short: "Frame",
        section: TRANSFORMATION,
        parts: &[
            PortPart {
                function: "diffuse_reflection_ray",
                lines: LitLines::Within(TRANSFORMATION, "let normal", "let world_space_direction"),
                values: &[("let normal", "normal")],
            },
            PortPart {
                function: "tangent_frame",
                lines: LitLines::Body,
                values: &[
                    ("let is_parallel", "is_parallel"),
                    ("let axis", "axis"),
                    ("let tangent", "tangent"),
                    ("let bitangent", "bitangent"),
                ],
            },
        ],
    },
    PortStep {
        name: "ray",
        short: "New ray",
        section: TRANSFORMATION,
        parts: &[
            PortPart {
                function: "diffuse_reflection_ray",
                lines: LitLines::Within(TRANSFORMATION, "spawn_ray(", "spawn_ray("),
                values: &[("spawn_ray(", "world_space_direction")],
            },
            PortPart {
                function: "spawn_ray",
                lines: LitLines::Body,
                values: &[("let (start, offset)", "start"), ("let (start, offset)", "offset")],
            },
            PortPart {
                function: "trace_photon",
                lines: LitLines::Within(SCATTERING, "self.trace_photon(", "remaining_bounces - 1"),
                values: &[("remaining_bounces - 1", "remaining_bounces")],
            },
        ],
    },
    PortStep {
        name: "miss",
        short: "No hit",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, ".trace(photon_ray", "return;"),
            values: &[(".trace(photon_ray", "trace()")],
        }],
    },
    PortStep {
        name: "limit",
        short: "Bounce limit",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if remaining_bounces < 0", "return;"),
            values: &[("if remaining_bounces < 0", "remaining_bounces")],
        }],
    },
];

/// A function of the port as it stands in its file.
#[derive(Debug)]
pub struct FoundFunction {
    name: &'static str,
    file: &'static str,
    /// The number of its first line in the file, from 1.
    first: usize,
    /// Its lines, without the indentation that all have.
    lines: Vec<String>,
}

/// A step with its lines.
#[derive(Debug)]
pub struct FoundStep {
    name: &'static str,
    short: &'static str,
    section: &'static str,
    parts: Vec<FoundPart>,
}

#[derive(Debug)]
struct FoundPart {
    function: usize,
    /// The first and the last line lit, counted from the function's first line.
    lit: [usize; 2],
    values: Vec<(usize, &'static str)>,
}

/// The port's functions and where each step is in them.
#[derive(Debug)]
pub struct PortSource {
    functions: Vec<FoundFunction>,
    steps: Vec<FoundStep>,
}

/// Finds everything in the files that `read` gives by their paths within the repository.
///
/// # Errors
/// A sentence that says what was expected and where.
pub fn find(read: impl Fn(&str) -> Result<String, String>) -> Result<PortSource, String> {
    let functions: Vec<_> = FUNCTIONS
        .iter()
        .map(|(name, file)| find_function(name, file, &read(file)?))
        .collect::<Result<_, _>>()?;
    let steps = STEPS
        .iter()
        .map(|step| {
            let parts = step.parts.iter().map(|part| find_part(step, part, &functions));
            Ok(FoundStep {
                name: step.name,
                short: step.short,
                section: step.section,
                parts: parts.collect::<Result<_, String>>()?,
            })
        })
        .collect::<Result<_, String>>()?;
    Ok(PortSource { functions, steps })
}

fn find_function(
    name: &'static str,
    file: &'static str,
    text: &str,
) -> Result<FoundFunction, String> {
    let lines: Vec<_> = text.lines().collect();
    let opening = [format!("fn {name}("), format!("fn {name}<")];
    let is_opening = |line: &&str| opening.iter().any(|opening| line.contains(opening));
    let first = lines
        .iter()
        .position(is_opening)
        .ok_or_else(|| format!("{file}: expected a function '{name}', found none"))?;
    let indent = lines[first].len() - lines[first].trim_start().len();
    let closing = format!("{}}}", " ".repeat(indent));
    let length = lines[first..]
        .iter()
        .position(|line| *line == closing)
        .ok_or_else(|| format!("{file}:{}: expected the end of '{name}'", first + 1))?;
    let body = lines[first..=first + length].iter();
    let lines = body.map(|line| line.get(indent..).unwrap_or_default().to_owned()).collect();
    Ok(FoundFunction { name, file, first: first + 1, lines })
}

fn find_part(
    step: &PortStep,
    part: &PortPart,
    functions: &[FoundFunction],
) -> Result<FoundPart, String> {
    let index = functions
        .iter()
        .position(|function| function.name == part.function)
        .expect("a step names one of the functions shown");
    let FoundFunction { name, file, first, lines } = &functions[index];
    let is_comment = |line: &String, section: &str| line.trim() == format!("// {section}");
    let last = lines.len() - 1;
    let (start, end) = match part.lines {
        LitLines::Body => (0, last),
        LitLines::Section(section) | LitLines::Within(section, ..) => {
            let start =
                lines.iter().position(|line| is_comment(line, section)).ok_or_else(|| {
                    format!("{file}:{first}: expected the step comment '// {section}' in '{name}'")
                })?;
            let is_next = |line: &String| SECTIONS.iter().any(|section| is_comment(line, section));
            let next = lines[start + 1..].iter().position(is_next);
            (start, next.map_or(last - 1, |next| start + next))
        }
    };
    let line_with = |from: usize, needle: &str| {
        let found = lines[from..=end].iter().position(|line| line.contains(needle));
        found.map(|found| from + found).ok_or_else(|| {
            format!(
                "{file}:{}: expected a line with '{needle}' for the step '{}' of '{name}'",
                first + from,
                step.name
            )
        })
    };
    let lit = match part.lines {
        LitLines::Section(_) | LitLines::Body => [start, end],
        LitLines::Within(_, from, to) => {
            let from = line_with(start, from)?;
            [from, line_with(from, to)?]
        }
    };
    // A blank line that ends a section is none of its lines.
    let blank = lines[..=lit[1]].iter().rev().take_while(|line| line.trim().is_empty()).count();
    let values = part.values.iter().map(|(needle, key)| Ok((line_with(start, needle)?, *key)));
    Ok(FoundPart {
        function: index,
        lit: [lit[0], lit[1] - blank],
        values: values.collect::<Result<_, String>>()?,
    })
}

impl PortSource {
    /// The value of `crate::source::SOURCE` as Rust code.
    pub fn to_rust(&self) -> String {
        let mut code = String::from("Source {\n    functions: &[\n");
        for FoundFunction { name, file, first, lines } in &self.functions {
            let lines = format!("&{lines:?}");
            let fields = format!("name: {name:?}, file: {file:?}, first: {first}, lines: {lines}");
            writeln!(code, "        Function {{ {fields} }},").expect("a string takes everything");
        }
        code += "    ],\n    steps: &[\n";
        for FoundStep { name, short, section, parts } in &self.steps {
            let parts: Vec<_> = parts
                .iter()
                .map(|FoundPart { function, lit, values }| {
                    format!("Part {{ function: {function}, lit: {lit:?}, values: &{values:?} }}")
                })
                .collect();
            let parts = parts.join(", ");
            let fields = format!("short: {short:?}, title: {section:?}, parts: &[{parts}]");
            writeln!(code, "        Step {{ name: {name:?}, {fields} }},")
                .expect("a string takes everything");
        }
        code + "    ],\n}\n"
    }
}
