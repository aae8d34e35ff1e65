//! What the harness is to do: small scenes with known answers, one section of the handout at a
//! time, and the handout's scene.

use std::fmt::Write as _;

use glam::Vec3;

use crate::scenes::{CENTER, add_scene, line, vector_text};

/// Numbers in steps of 2^-24, as the harness draws them.
pub const UNITS: f32 = 16_777_216.0;
/// The intensity that the harness hands to `TracePhoton`.
pub const INTENSITY: Vec3 = Vec3::new(1e-3, 2e-3, 3e-3);
/// Where the light stands in the steps for Photon Emission.
pub const LIGHT: Vec3 = Vec3::new(0.3, -0.2, 1.5);
/// A direction that the emission may find at its second try, before it is normalized.
pub const SECOND_TRY: [f32; 3] = [0.25, -0.5, 0.125];
/// The diffuse responses that tell one rule for P_r from another: every channel is the largest
/// once, and one response is so dark that its sum is below 1.
pub const COLORS: [Vec3; 4] = [
    Vec3::new(0.2, 0.5, 0.8),
    Vec3::new(0.8, 0.2, 0.5),
    Vec3::new(0.5, 0.8, 0.2),
    Vec3::new(0.1, 0.3, 0.2),
];
/// How often a photon may bounce at most in steps where that must not matter.
const FAR: i32 = 1000;
/// As many calls show every misreading far beyond chance.
const CALLS: u64 = 4000;
/// As many calls show what 360 degrees leave: ten standard deviations.
pub(crate) const CALLS_AROUND: u64 = 1_500_000;

/// How much the long steps do.
#[derive(Clone, Copy, Debug)]
pub struct PlanCounts {
    /// The photons of the whole run.
    pub photons: u64,
    /// The directions around an axis.
    pub around: u64,
}

/// One step of the plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlanStep {
    /// Many rays from the light.
    Emit,
    /// The first three draws are a point in the corner of the cube; the next are [`SECOND_TRY`].
    EmitCorner,
    /// The first three draws are a point on the sphere.
    EmitOnSphere,
    /// The first three draws are zero.
    EmitZero,
    /// So many rays from the light that angles in degrees show.
    AroundLight,
    /// The first hit of a path on a black wall.
    StoreFirst,
    /// A later hit, with a path of this length before it.
    StoreLater(usize),
    /// A ray that meets nothing.
    StoreMiss,
    /// Closed white cubes, with this many remaining bounces, and two elements in the path.
    Remaining(i32),
    /// Closed white cubes, from the light on.
    GrowPath,
    /// A floor that absorbs everything.
    Black,
    /// A floor that absorbs nothing.
    White,
    /// A floor with one of the [`COLORS`].
    Color(usize),
    /// Closed gray cubes, from the light on.
    GrayCube,
    /// A gray floor; the first number drawn is 0.5 and this much more, in units of 2^-24.
    Threshold(i32),
    /// A gray floor: directions around (0, 0, 1).
    Floor,
    /// A gray wall with this normal.
    Wall(Vec3),
    /// A white floor, and so many directions that angles in degrees show.
    Around,
    /// The handout's scene.
    Whole,
}

impl PlanStep {
    /// Whether it only asks the light for rays.
    pub fn is_emission(self) -> bool {
        matches!(
            self,
            Self::Emit | Self::EmitCorner | Self::EmitOnSphere | Self::EmitZero | Self::AroundLight
        )
    }
}

/// The normals of the walls: the scene's own, those along the axes, and one that is along nothing.
pub fn wall_normals() -> Vec<Vec3> {
    [
        Vec3::new(-1.0, 0.0, 0.0),
        Vec3::new(0.6, 0.0, 0.8),
        Vec3::new(-0.9536, 0.3011, 0.0).normalize(),
        Vec3::new(0.3011, -0.9536, 0.0).normalize(),
        Vec3::new(0.36, 0.48, 0.8),
        Vec3::new(1.0, 0.0, 0.0),
    ]
    .to_vec()
}

/// The steps that probe what is stored.
pub(crate) const STORAGE: [PlanStep; 9] = [
    PlanStep::StoreFirst,
    PlanStep::StoreLater(2),
    PlanStep::StoreLater(3),
    PlanStep::StoreMiss,
    PlanStep::Remaining(-1),
    PlanStep::Remaining(0),
    PlanStep::Remaining(1),
    PlanStep::Remaining(1000),
    PlanStep::GrowPath,
];
/// The steps that probe the roulette.
pub(crate) const SCATTERING: [PlanStep; 10] = [
    PlanStep::Black,
    PlanStep::White,
    PlanStep::Color(0),
    PlanStep::Color(1),
    PlanStep::Color(2),
    PlanStep::Color(3),
    PlanStep::GrayCube,
    PlanStep::Threshold(-1024),
    PlanStep::Threshold(0),
    PlanStep::Threshold(1024),
];

/// The steps, in the order in which they are carried out.
pub fn steps() -> Vec<PlanStep> {
    let mut steps =
        vec![PlanStep::Emit, PlanStep::EmitCorner, PlanStep::EmitOnSphere, PlanStep::EmitZero];
    steps.extend(STORAGE);
    steps.extend(SCATTERING);
    steps.push(PlanStep::Floor);
    steps.extend(wall_normals().into_iter().map(PlanStep::Wall));
    // These two end by the clock, which must change no number before.
    steps.extend([PlanStep::Whole, PlanStep::Around, PlanStep::AroundLight]);
    steps
}

/// The file for the harness.
pub fn file(counts: PlanCounts) -> String {
    let PlanCounts { photons, around } = counts;
    let mut file = String::new();
    for (scenes, step) in steps().into_iter().enumerate() {
        add_scene(step, &mut file);
        let what = match step {
            PlanStep::Emit => format!("emit {scenes} {CALLS} 0"),
            PlanStep::EmitCorner | PlanStep::EmitOnSphere | PlanStep::EmitZero => {
                let first = first_try(step).unwrap_or_default();
                let numbers = [first, SECOND_TRY].map(|xyz| xyz.map(units_of_minus_1_to_1));
                let numbers = numbers.as_flattened().iter().map(u32::to_string);
                format!("emit {scenes} 1 6 {}", numbers.collect::<Vec<_>>().join(" "))
            }
            PlanStep::AroundLight => format!("around-light {scenes} {around}"),
            PlanStep::Whole => format!("whole {scenes} {photons}"),
            _ => trace(step, scenes, around),
        };
        line(&mut file, &what);
    }
    file
}

/// The first point that is drawn in a step with scripted draws.
pub fn first_try(step: PlanStep) -> Option<[f32; 3]> {
    match step {
        PlanStep::EmitCorner => Some([0.9375, -0.9375, 0.875]),
        PlanStep::EmitOnSphere => Some([-1.0, 0.0, 0.0]),
        PlanStep::EmitZero => Some([0.0; 3]),
        _ => None,
    }
}

fn units_of_minus_1_to_1(x: f32) -> u32 {
    ((x + 1.0) * 0.5 * UNITS) as u32
}

/// The rays of a step that traces photons.
pub fn rays(step: PlanStep) -> Vec<[Vec3; 2]> {
    let normal = match step {
        PlanStep::Wall(normal) => normal,
        PlanStep::StoreMiss => return vec![[Vec3::new(0.0, 0.0, 1.0), Vec3::Z]],
        _ => Vec3::Z,
    };
    // Towards the wall from above it, along different slants: no rounding is then typical.
    let across = normal.any_orthonormal_vector();
    let along = normal.cross(across);
    (0..16)
        .map(|i| {
            let angle = i as f32 * 2.4;
            let slant = 0.1 + 0.05 * i as f32;
            let aside = slant * (libm::cosf(angle) * across + libm::sinf(angle) * along);
            let start = CENTER + 0.7 * normal + 0.3 * aside;
            [start, (aside - normal).normalize()]
        })
        .collect()
}

fn trace(step: PlanStep, scene: usize, around: u64) -> String {
    let (calls, path, remaining) = match step {
        PlanStep::StoreFirst => (16, 1, FAR),
        PlanStep::StoreLater(path) => (16, path, FAR),
        PlanStep::StoreMiss => (4, 2, FAR),
        PlanStep::Remaining(remaining) => (8, 2, remaining),
        PlanStep::GrowPath => (16, 1, 5),
        PlanStep::Black | PlanStep::White => (400, 1, FAR),
        PlanStep::Threshold(_) => (1, 1, FAR),
        // Half of the paths end at every hit, unless there is no roulette.
        PlanStep::GrayCube => (2000, 1, 50),
        PlanStep::Floor => (2 * CALLS, 1, FAR),
        PlanStep::Around => (around, 1, FAR),
        _ => (CALLS, 1, FAR),
    };
    let what = if step == PlanStep::Around { "around" } else { "trace" };
    let mut text = format!("{what} {scene} {calls} {path} {remaining}");
    let rays = rays(step);
    write!(text, " {}", rays.len()).expect("a string takes everything");
    for vector in rays.as_flattened() {
        text += &vector_text(*vector);
    }
    match step {
        PlanStep::Threshold(more) => {
            let number = (UNITS as i64 / 2 + i64::from(more)) as u32;
            write!(text, " 1 {number}").expect("a string takes everything");
        }
        _ => text += " 0",
    }
    text
}
