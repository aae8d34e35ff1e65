//! The frames that are a fair reading of equations (7) and (8): every way to choose two vectors at
//! right angles to the normal, with or without length 1.

use glam::{Mat3, Vec3};
use photon_mapping::rendering::sampling::CLOSE_TO_PARALLEL;

use crate::reading::{Reading, TangentBasis};

/// A scene with more different normals than this is tried with fewer thresholds.
const MOST_THRESHOLDS: usize = 8;

/// The lengths of t and b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lengths {
    /// Both have length 1.
    Unit,
    /// As equations (7) and (8) give them.
    AsWritten,
}

/// How t and b are turned or exchanged. Directions are as even around the normal as before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror {
    /// Whether t and b are exchanged.
    pub exchanged: bool,
    /// Whether t points to the other side.
    pub t_turned: bool,
    /// Whether b points to the other side.
    pub b_turned: bool,
}

/// A fair way to a frame around the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The lengths of t and b.
    pub lengths: Lengths,
    /// The axis of equation (7).
    pub axis: Vec3,
    /// How close to 1 the absolute dot product of normal and axis may come before the fallback is
    /// taken.
    pub threshold: f32,
    /// The axis that takes the first one's place where that is close to parallel with the normal.
    pub fallback: Vec3,
    /// How t and b are turned or exchanged.
    pub mirror: Mirror,
}

impl Frame {
    /// The reference's.
    pub const REFERENCE: Self = Self {
        lengths: Lengths::Unit,
        axis: Vec3::X,
        threshold: CLOSE_TO_PARALLEL,
        fallback: Vec3::Y,
        mirror: Mirror { exchanged: false, t_turned: false, b_turned: false },
    };

    /// The frame of `reading`, unless that is no fair one.
    pub fn of(reading: &Reading) -> Option<Self> {
        let lengths = match reading.tangent_basis {
            TangentBasis::Normalized => Lengths::Unit,
            TangentBasis::LetterOfTheHandout => Lengths::AsWritten,
            TangentBasis::Transposed => return None,
        };
        let (threshold, fallback) = (reading.fallback_threshold, reading.fallback_axis);
        Some(Self { lengths, threshold, fallback, ..Self::REFERENCE })
    }

    /// The matrix from tangent space to world space at a surface with the unit vector `normal`.
    pub fn matrix(&self, normal: Vec3) -> Mat3 {
        let is_parallel = normal.dot(self.axis).abs() > self.threshold;
        let axis = if is_parallel { self.fallback } else { self.axis };
        let (mut t, mut b) = match self.lengths {
            Lengths::AsWritten => {
                let t = normal.cross(axis);
                (t, normal.cross(t))
            }
            Lengths::Unit => {
                let t = normal.cross(axis).normalize();
                (t, normal.cross(t).normalize())
            }
        };
        if self.mirror.exchanged {
            (t, b) = (b, t);
        }
        let turn = |vector: Vec3, is_turned: bool| if is_turned { -vector } else { vector };
        Mat3::from_cols(turn(t, self.mirror.t_turned), turn(b, self.mirror.b_turned), normal)
    }

    /// All fair frames that differ on surfaces with these `normals`, the simplest first.
    pub fn all(normals: &[Vec3]) -> Vec<Self> {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let sides = [false, true];
        let mut all = Vec::new();
        for lengths in [Lengths::Unit, Lengths::AsWritten] {
            for axis in axes {
                for threshold in thresholds(normals, axis) {
                    for fallback in axes.into_iter().filter(|fallback| *fallback != axis) {
                        for exchanged in sides {
                            for (t_turned, b_turned) in
                                [(false, false), (false, true), (true, false), (true, true)]
                            {
                                let mirror = Mirror { exchanged, t_turned, b_turned };
                                all.push(Self { lengths, axis, threshold, fallback, mirror });
                            }
                        }
                    }
                }
            }
        }
        all.sort_by_key(|frame| frame.changes(&Self::REFERENCE, normals).len());
        all
    }

    /// What is done in another way than in `base`, on surfaces with these `normals`.
    pub fn changes(&self, base: &Self, normals: &[Vec3]) -> Vec<String> {
        let mut changes = Vec::new();
        if self.lengths != base.lengths {
            changes.push(
                match self.lengths {
                    Lengths::Unit => "t and b normalized",
                    Lengths::AsWritten => "t and b to the letter of the handout, not normalized",
                }
                .to_owned(),
            );
        }
        if self.axis != base.axis {
            changes.push(format!("the axis {} in equation (7)", vector(self.axis)));
        }
        if self.threshold != base.threshold {
            let (below, above) = around(normals, self.axis, self.threshold);
            changes.push(format!(
                "the fallback axis in equation (7) at absolute dot products of {above} or more \
                 (not at {below})"
            ));
        }
        let other_fallback = if self.axis == base.axis { base.fallback } else { Vec3::X };
        if self.fallback != other_fallback {
            changes.push(format!("fallback axis {}", vector(self.fallback)));
        }
        if self.mirror.exchanged != base.mirror.exchanged {
            changes.push("t and b exchanged".to_owned());
        }
        let turned = match (
            self.mirror.t_turned != base.mirror.t_turned,
            self.mirror.b_turned != base.mirror.b_turned,
        ) {
            (false, false) => return changes,
            (true, false) => "t",
            (false, true) => "b",
            (true, true) => "t and b",
        };
        changes.push(format!("{turned} turned to the other side"));
        changes
    }
}

fn vector(v: Vec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

/// The absolute dot products of `normals` and `axis`, each once.
fn closeness(normals: &[Vec3], axis: Vec3) -> Vec<f32> {
    let mut all: Vec<_> = normals.iter().map(|normal| normal.dot(axis).abs()).collect();
    all.sort_unstable_by(f32::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-4);
    all
}

/// The reference's threshold, then one between each two dot products that the scene has: those with
/// the most room first, since a student's is likelier to lie there.
fn thresholds(normals: &[Vec3], axis: Vec3) -> Vec<f32> {
    let closeness = closeness(normals, axis);
    let mut gaps: Vec<_> = closeness.windows(2).map(|pair| (pair[1] - pair[0], pair[0])).collect();
    gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
    gaps.truncate(MOST_THRESHOLDS);
    let reference = around(normals, axis, CLOSE_TO_PARALLEL);
    let between = gaps.into_iter().map(|(gap, below)| below + 0.5 * gap);
    let others = between.filter(|between| around(normals, axis, *between) != reference);
    [CLOSE_TO_PARALLEL].into_iter().chain(others).collect()
}

/// The dot products of the scene next to `threshold`, to four digits.
fn around(normals: &[Vec3], axis: Vec3, threshold: f32) -> (f32, f32) {
    let closeness = closeness(normals, axis);
    let place = closeness.partition_point(|close| *close <= threshold);
    let digits = |close: f32| (close * 1e4).round() / 1e4;
    let below = place.checked_sub(1).map_or(0.0, |before| digits(closeness[before]));
    (below, closeness.get(place).map_or(1.0, |close| digits(*close)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_of_unit_length_are_orthonormal_and_end_with_the_normal() {
        let normals = [Vec3::NEG_X, Vec3::Z, Vec3::new(0.6, 0.0, 0.8)];
        let frames = Frame::all(&normals);
        assert_eq!(frames[0], Frame::REFERENCE);
        for frame in frames.iter().filter(|frame| frame.lengths == Lengths::Unit) {
            for normal in normals {
                let matrix = frame.matrix(normal);
                let product = matrix.transpose() * matrix;
                assert!(product.abs_diff_eq(Mat3::IDENTITY, 1e-5), "{frame:?} at {normal}");
                assert_eq!(matrix.z_axis, normal);
            }
        }
    }

    #[test]
    fn a_reading_has_the_same_frame() {
        for reading in [Reading::REFERENCE, Reading::LETTER_OF_THE_HANDOUT] {
            let frame = Frame::of(&reading).expect("a fair frame");
            for normal in [Vec3::NEG_X, Vec3::Z, Vec3::new(0.6, 0.0, 0.8)] {
                assert_eq!(frame.matrix(normal), reading.tangent_frame(normal));
            }
        }
    }
}
