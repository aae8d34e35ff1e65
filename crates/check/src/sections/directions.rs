//! The scattered rays that were seen, and the frames that explain their directions.

use glam::{Mat3, Vec3};

use super::sampling::{AngleLaw, LAWS};
use crate::events::{Call, Trace};
use crate::plan::{self, PlanStep};
use crate::run::Observed;
use crate::statistics::{are_alike, is_uniform};

/// Fewer directions tell nothing.
pub const FEWEST: usize = 100;

/// A scattered ray and the hit that it leaves.
#[derive(Clone, Copy, Debug)]
pub struct Scattered {
    /// The number of the call.
    pub call: u64,
    /// The point hit.
    pub hit: Vec3,
    /// The ray's start.
    pub from: Vec3,
    /// Its direction, as it was handed to `Trace`.
    pub direction: Vec3,
    /// The direction of the ray that came in, of length 1.
    pub incoming: Vec3,
    /// Whether the ray met the wall it left.
    pub met_again: bool,
    /// Whether it is the ray that came in, unchanged.
    pub is_old: bool,
}

/// How tangent space is turned into the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameForm {
    /// t, b and n are the columns, of length 1.
    Normalized,
    /// t and b as equations (7) and (8) have them.
    AsWritten,
    /// t as written, b of length 1.
    HalfAsWritten,
    /// n points to the other side.
    Flipped,
    /// t, b and n are the rows.
    Transposed,
    /// n is the first or second column.
    OtherOrder,
    /// There is no frame: the direction in tangent space is taken as it is.
    None,
}

impl FrameForm {
    /// Whether it is a fair reading of the handout.
    pub fn is_fair(self) -> bool {
        matches!(self, Self::Normalized | Self::AsWritten)
    }
}

/// Directions over the gray floor and the gray walls, and what the floor says about the sampling.
#[derive(Debug, Default)]
pub struct Directions {
    /// Whether all scattered rays are those that came in, unchanged.
    pub are_old: bool,
    /// Over the floor with the normal (0, 0, 1).
    pub floor: Vec<Scattered>,
    /// Over every wall.
    pub walls: Vec<(Vec3, Vec<Scattered>)>,
    /// The frame under which the floor's directions follow a known law; nothing if none does.
    pub frame_of_floor: Option<FrameForm>,
    /// The law that they follow in that frame, where it is not the cosine.
    pub law: Option<&'static AngleLaw>,
    /// The square of the sine of the floor's directions to the normal, in tangent space.
    pub sines: Vec<f64>,
    /// The floor's directions around the normal, in tangent space, in turns.
    pub around: Vec<f64>,
    /// Whether the floor's directions are even around the normal.
    pub is_even_around: bool,
    /// Whether the floor's directions all lie on one side of it.
    pub is_one_sided: bool,
}

impl Directions {
    /// What was seen.
    pub fn of(observed: &Observed) -> Self {
        let scattered = |step: PlanStep| {
            (0..).zip(observed.calls(step)).filter_map(of_call).collect::<Vec<_>>()
        };
        let floor = scattered(PlanStep::Floor);
        let walls = plan::wall_normals();
        let walls = walls.into_iter().map(|n| (n, scattered(PlanStep::Wall(n)))).collect();
        let are_old = !floor.is_empty() && floor.iter().all(|ray| ray.is_old);
        let mut directions = Self { are_old, floor, walls, ..Self::default() };
        directions.judge_floor();
        directions
    }

    fn judge_floor(&mut self) {
        let candidates = frames(Vec3::Z);
        // On the floor, several frames are the same.
        let tried = || {
            candidates.iter().filter(|(frame, _)| {
                matches!(frame, FrameForm::Normalized | FrameForm::Flipped | FrameForm::OtherOrder)
            })
        };
        let seen: Vec<_> =
            tried().map(|(_, matrix)| self.seen_from(&self.floor, *matrix)).collect();
        let even: Vec<_> = (seen.iter().enumerate())
            .filter(|(_, [_, around, above])| above[0] > 0.999 && is_uniform(around))
            .collect();
        // The cosine comes first: what follows it in any frame follows nothing else.
        let laws = std::iter::once(None).chain(LAWS.iter().map(Some));
        let found = laws.filter(|_| !even.is_empty()).find_map(|law| {
            let due = law.map(AngleLaw::squared_sines);
            let (number, _) = even.iter().find(|(_, [sines, ..])| match &due {
                Some(due) => are_alike(sines, due),
                None => is_uniform(sines),
            })?;
            Some((*number, law))
        });
        if let Some((number, law)) = found {
            self.frame_of_floor = tried().nth(number).map(|(frame, _)| *frame);
            self.law = law;
        }
        let [sines, around, above] =
            seen.into_iter().nth(found.map_or(0, |(number, _)| number)).expect("frames are tried");
        self.sines = sines;
        self.is_even_around = is_uniform(&around);
        self.around = around;
        self.is_one_sided = above[0] > 0.999 || above[0] < 0.001;
    }

    /// In the tangent space of `matrix`: the squared sines to the normal, the angles around it as
    /// parts of the circle, and, alone in its list, the part that is above the surface.
    fn seen_from(&self, rays: &[Scattered], matrix: Mat3) -> [Vec<f64>; 3] {
        let inverse = matrix.inverse();
        let local: Vec<_> = rays
            .iter()
            .filter(|ray| ray.direction.is_finite())
            .map(|ray| (inverse * ray.direction).normalize_or_zero())
            .collect();
        let sines = local.iter().map(|v| f64::from(v.x * v.x + v.y * v.y).min(1.0)).collect();
        let around =
            local.iter().map(|v| f64::from(libm::atan2f(v.y, v.x)) / std::f64::consts::TAU + 0.5);
        let around = around.collect();
        let above = local.iter().filter(|v| v.z > 0.0).count() as f64 / local.len().max(1) as f64;
        [sines, around, vec![above]]
    }

    /// Whether the directions over a wall are those over the floor, seen through `matrix`.
    pub fn fits(&self, rays: &[Scattered], matrix: Mat3) -> bool {
        if matrix.determinant().abs() < 1e-6 {
            return false;
        }
        let [sines, around, above] = self.seen_from(rays, matrix);
        // Samples that all lie on one side lie above, in the right frame.
        let is_above = above[0] > 0.999 || !self.is_one_sided;
        is_above && are_alike(&sines, &self.sines) && (!self.is_even_around || is_uniform(&around))
    }

    /// The frame that explains the directions over a wall; fair ones come first.
    pub fn frame_of(&self, normal: Vec3, rays: &[Scattered]) -> Option<FrameForm> {
        let candidates = frames(normal);
        let found = candidates.iter().find(|(_, matrix)| self.fits(rays, *matrix));
        found.map(|(frame, _)| *frame)
    }
}

/// The first scattered ray of a call.
fn of_call((number, call): (u64, &Call)) -> Option<Scattered> {
    let mut of_path = call.traces.iter().filter(|trace| trace.has_state);
    let first: &Trace = of_path.next().filter(|trace| trace.met)?;
    let second: &Trace = of_path.next()?;
    Some(Scattered {
        call: number,
        hit: first.hit(),
        from: second.from,
        direction: second.direction,
        incoming: first.direction.normalize_or_zero(),
        met_again: second.met,
        is_old: second.from == first.from && second.direction == first.direction,
    })
}

/// All frames that are tried over a wall with this normal, with the matrix of each.
pub fn frames(normal: Vec3) -> Vec<(FrameForm, Mat3)> {
    let mut frames = Vec::new();
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let axes: Vec<_> = axes.into_iter().filter(|axis| normal.dot(*axis).abs() < 0.9999).collect();
    let as_written = |axis: Vec3| {
        let t = normal.cross(axis);
        (t, normal.cross(t))
    };
    let normalized = |axis: Vec3| {
        let (t, b) = as_written(axis);
        (t.normalize(), b.normalize())
    };
    for axis in &axes {
        let (t, b) = normalized(*axis);
        frames.push((FrameForm::Normalized, Mat3::from_cols(t, b, normal)));
    }
    for axis in &axes {
        let (t, b) = as_written(*axis);
        frames.push((FrameForm::AsWritten, Mat3::from_cols(t, b, normal)));
        frames.push((FrameForm::HalfAsWritten, Mat3::from_cols(t, b.normalize(), normal)));
    }
    for axis in &axes {
        for (t, b) in [normalized(*axis), as_written(*axis)] {
            frames.push((FrameForm::Flipped, Mat3::from_cols(t, b, -normal)));
            frames.push((FrameForm::Transposed, Mat3::from_cols(t, b, normal).transpose()));
            // b = t x n points the other way.
            for sign in [1.0, -1.0] {
                frames.extend(
                    [[t, normal, b], [normal, t, b], [normal, b, t], [b, normal, t]]
                        .map(|[x, y, z]| (FrameForm::OtherOrder, Mat3::from_cols(x, y, sign * z))),
                );
            }
        }
    }
    frames.push((FrameForm::None, Mat3::IDENTITY));
    frames
}
