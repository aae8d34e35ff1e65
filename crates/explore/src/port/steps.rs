//! The steps of a photon's story: which lines of the port each runs, and beside which line a value
//! stands.

/// The titles of the handout's sections, which are the port's step comments.
pub const SECTIONS: [&str; 5] = [
    "Photon Emission",
    "Photon Storage",
    "Photon Scattering/Absorption",
    "Hemisphere Sampling",
    "Hemisphere Ray Transformation",
];

/// A step of a photon's story.
#[derive(Debug)]
pub struct PortStep {
    /// Its name in links.
    pub name: &'static str,
    /// The section of the handout.
    pub section: &'static str,
    pub parts: &'static [PortPart],
}

/// What a step runs of one function.
#[derive(Debug)]
pub struct PortPart {
    pub function: &'static str,
    pub lines: LitLines,
    /// The values: each stands beside the line that starts with `let` and its name, or else that
    /// contains the text after it.
    pub values: &'static [&'static str],
}

/// The lines that a step lights.
#[derive(Debug)]
pub enum LitLines {
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
pub const FUNCTIONS: [(&str, &str); 6] = [
    ("generate_random_photon_ray", "src/scene/point_light.rs"),
    ("trace_photon", "src/rendering/photon_mapping_renderer.rs"),
    ("diffuse_reflection_ray", "src/rendering/photon_mapping_renderer.rs"),
    ("sample_hemisphere", "src/rendering/sampling.rs"),
    ("tangent_frame", "src/rendering/sampling.rs"),
    ("spawn_ray", "src/scene/numerics.rs"),
];

/// Each `if` of these functions, and the name under which a story tells whether it holds.
pub const CONDITIONS: [(&str, &str); 6] = [
    ("if length_squared <= 1.0 && length_squared > 0.0 {", "in_sphere"),
    ("if remaining_bounces < 0 {", "bounce_limit"),
    ("if !self.stored_scene.trace(photon_ray, Some(&mut state)) {", "no_hit"),
    ("if path.len() > 1 {", "has_bounced"),
    ("if rand() >= probability_of_reflection {", "absorbed"),
    ("if is_parallel {", "is_parallel"),
];

pub static STEPS: [PortStep; 9] = [
    PortStep {
        name: "emission",
        section: EMISSION,
        parts: &[PortPart {
            function: "generate_random_photon_ray",
            lines: LitLines::Section(EMISSION),
            values: &[
                "loop: let direction = loop",
                "x",
                "y",
                "z",
                "length_squared",
                "direction: direction.normalize()",
            ],
        }],
    },
    PortStep {
        name: "hit",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if remaining_bounces < 0", "let intersection_point"),
            values: &[
                "remaining_bounces: if remaining_bounces < 0",
                "trace(): .trace(photon_ray",
                "intersection_point",
            ],
        }],
    },
    PortStep {
        name: "stored",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if path.len() > 1", "path.push("),
            values: &[
                "path.len(): if path.len() > 1",
                "photon_map.push(): photon_map.push(",
                "to_light: to_light_ray",
            ],
        }],
    },
    PortStep {
        name: "roulette",
        section: SCATTERING,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(SCATTERING, SCATTERING, "return;"),
            values: &[
                "hit_primitive",
                "hit_mesh_object",
                "diffuse_response",
                "probability_of_reflection",
                "u: if rand() >=",
            ],
        }],
    },
    PortStep {
        name: "hemisphere",
        section: SAMPLING,
        parts: &[
            PortPart {
                function: "trace_photon",
                lines: LitLines::Within(SCATTERING, "let (u1, u2)", "let diffuse_reflection_ray"),
                values: &[
                    "u1: let (u1, u2)",
                    "u2: let (u1, u2)",
                    "ray_direction(): let diffuse_reflection_ray",
                ],
            },
            PortPart {
                function: "sample_hemisphere",
                lines: LitLines::Body,
                values: &["r", "theta", "x", "y", "z"],
            },
        ],
    },
    PortStep {
        name: "frame",
        section: TRANSFORMATION,
        parts: &[
            PortPart {
                function: "diffuse_reflection_ray",
                lines: LitLines::Within(TRANSFORMATION, "let normal", "let world_space_direction"),
                values: &["normal", "nearly: let world_space_direction = "],
            },
            PortPart {
                function: "tangent_frame",
                lines: LitLines::Body,
                values: &["is_parallel", "axis", "tangent", "bitangent"],
            },
        ],
    },
    PortStep {
        name: "ray",
        section: TRANSFORMATION,
        parts: &[
            PortPart {
                function: "diffuse_reflection_ray",
                lines: LitLines::Within(TRANSFORMATION, "spawn_ray(", "spawn_ray("),
                values: &["world_space_direction: spawn_ray("],
            },
            PortPart {
                function: "spawn_ray",
                lines: LitLines::Body,
                values: &[
                    "start: let (start, offset)",
                    "offset: let (start, offset)",
                    "start_error: ray.start_error",
                ],
            },
            PortPart {
                function: "trace_photon",
                lines: LitLines::Within(SCATTERING, "self.trace_photon(", "remaining_bounces - 1"),
                values: &["bounces_left: remaining_bounces - 1"],
            },
        ],
    },
    PortStep {
        name: "miss",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, ".trace(photon_ray", "return;"),
            values: &["trace(): .trace(photon_ray"],
        }],
    },
    PortStep {
        name: "limit",
        section: STORAGE,
        parts: &[PortPart {
            function: "trace_photon",
            lines: LitLines::Within(STORAGE, "if remaining_bounces < 0", "return;"),
            values: &["remaining_bounces: if remaining_bounces < 0"],
        }],
    },
];
