//! A frame around the normals that is measured, not known: whoever takes any two unit vectors at
//! right angles to the normal and to each other samples the same directions.

use std::f32::consts::TAU;

use glam::{Mat3, Vec3};

use crate::fair::Fair;
use crate::fair_search::{LOOSE, Search, Window};
use variants::frame::Frame;

/// So many normals are told apart; a scene with more of them is not measured.
const MOST_NORMALS: usize = 16;
/// So many bounces away from the light, surfaces are measured.
const ROUNDS: usize = 4;
/// Fewer directions around a normal do not say whether the frame is mirrored.
const FEWEST: usize = 2;
/// So many have to agree; where there are fewer and they do not, nothing is known.
const ENOUGH: usize = 6;
/// The height over the surface may be this far off: a ray may start elsewhere.
const HEIGHT: f32 = 0.03;
/// Angles this far apart, in radians, are not of one frame.
const ANGLE: f32 = 0.05;

/// For each normal, by how much the frame is turned around it against the reference's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredFrame {
    count: usize,
    normals: [Vec3; MOST_NORMALS],
    /// In radians.
    angles: [f32; MOST_NORMALS],
    mirrored: [bool; MOST_NORMALS],
}

impl MeasuredFrame {
    /// The matrix from the measured tangent space to the reference's at `normal`.
    pub fn turn(&self, normal: Vec3) -> Mat3 {
        let known = self.normals[..self.count].iter().position(|n| n.abs_diff_eq(normal, 1e-4));
        let Some(at) = known else { return Mat3::IDENTITY };
        let side = if self.mirrored[at] { -1.0 } else { 1.0 };
        Mat3::from_rotation_z(self.angles[at]) * Mat3::from_diagonal(Vec3::new(1.0, side, 1.0))
    }
}

/// Of one photon that scatters at its first hit: the azimuth due, and the one found.
struct Azimuths {
    normal: Vec3,
    due: f32,
    found: f32,
}

impl Search<'_> {
    /// The fair way with the draws of `base` and a frame that is measured in `many` windows, with
    /// the offsets that fit `few` of them; nothing where there is none, or it explains no more than
    /// `base`.
    pub fn best_measured(&self, base: &Fair, many: &[Window], few: &[Window]) -> Option<Fair> {
        let measured = self.measured_frame(base, many)?;
        let before = self.score(base, few);
        let (offset, _) = self.fit_offsets(&measured, few);
        // Where rays start is known now, and their directions better.
        let again = self.measure(&offset, many)?;
        let unset = Fair { start: base.start, stored: base.stored, ..again };
        let (fair, score) = self.fit_offsets(&unset, few);
        (score.is_right_way() && score.tight > 2 * before.tight).then_some(fair)
    }

    /// `base` with the frame that is measured in `windows`, if there is one in which nearly all
    /// photons leave their first hit at the right height and, around each normal, at one angle to
    /// the right one.
    fn measured_frame(&self, base: &Fair, windows: &[Window]) -> Option<Fair> {
        let mut fair = Fair { frame: Frame::REFERENCE, ..*base };
        // What is hit only after a bounce can be measured when the frames before are known.
        for _ in 0..ROUNDS {
            fair = self.measure(&fair, windows)?;
        }
        Some(fair)
    }

    fn measure(&self, fair: &Fair, windows: &[Window]) -> Option<Fair> {
        let mut all = Vec::new();
        let mut wrong = 0;
        for window in windows.iter().filter(|window| window.is_exact) {
            wrong += self.azimuths(fair, window, &mut all);
        }
        if all.len() < ENOUGH || 10 * wrong > all.len() {
            return None;
        }
        let mut frame = MeasuredFrame {
            count: 0,
            normals: [Vec3::ZERO; MOST_NORMALS],
            angles: [0.0; MOST_NORMALS],
            mirrored: [false; MOST_NORMALS],
        };
        let mut of_normals: Vec<Vec<Azimuths>> = Vec::new();
        while let Some(normal) = all.first().map(|first| first.normal) {
            let (here, others): (Vec<_>, Vec<_>) =
                all.into_iter().partition(|one| one.normal.abs_diff_eq(normal, 1e-4));
            all = others;
            of_normals.push(here);
        }
        of_normals.sort_by_key(|here| std::cmp::Reverse(here.len()));
        for here in of_normals {
            let normal = here[0].normal;
            // One direction alone does not say whether the frame is mirrored: it is as around the
            // others.
            let is_alone_mirrored = here.len() < FEWEST && frame.mirrored[0];
            if frame.count == MOST_NORMALS {
                return None;
            }
            let plain = one_angle(here.iter().map(|one| one.found - one.due));
            let turned = || one_angle(here.iter().map(|one| one.found + one.due));
            let plain = plain.filter(|_| !is_alone_mirrored);
            let found = plain.map(|a| (a, false)).or_else(|| turned().map(|a| (a, true)));
            let (angle, mirrored) = match found {
                Some(found) => found,
                None if here.len() < ENOUGH => continue,
                None => return None,
            };
            frame.normals[frame.count] = normal;
            frame.angles[frame.count] = angle;
            frame.mirrored[frame.count] = mirrored;
            frame.count += 1;
        }
        (frame.count > 0).then_some(Fair { measured: Some(frame), ..*fair })
    }

    /// Adds the azimuths of a photon at every hit that is still where it should be; how many of
    /// them are at a wrong height.
    fn azimuths(&self, fair: &Fair, window: &Window, all: &mut Vec<Azimuths>) -> usize {
        let Some(story) = fair.story(self.run, window.photon) else { return 0 };
        let mut wrong = 0;
        let next = fair.stored(&story).into_iter().map(Some).chain([None]);
        let mut incoming = Vec3::from_array(story.emission.direction);
        for ((hit, position), model) in story.hits.iter().zip(&window.positions).zip(next) {
            let (Some(u1), Some(u2)) = (hit.u1, hit.u2) else { break };
            let normal = Vec3::from_array(hit.normal);
            let way = *position - hit.point() - fair.start.vector(normal, incoming);
            incoming = hit.direction.map_or(incoming, Vec3::from_array);
            let local = fair.frame.matrix(normal).transpose() * way.normalize_or_zero();
            // Near the normal, and near the hit, an azimuth means nothing.
            if way.length() > 0.1 * self.size && u1 > 0.1 {
                if (local.z - (1.0 - u1).sqrt()).abs() > HEIGHT {
                    wrong += 1;
                    break;
                }
                let found = libm::atan2f(local.y, local.x);
                all.push(Azimuths { normal, due: TAU * u2, found });
            }
            if model.is_none_or(|model| model.distance(*position) > LOOSE * self.size) {
                break;
            }
        }
        wrong
    }
}

/// The angle about which nearly all of `angles` are, in radians; nothing where they are spread.
fn one_angle(angles: impl Iterator<Item = f32>) -> Option<f32> {
    let angles: Vec<_> = angles.collect();
    let away = |a: f32, b: f32| {
        let turns = (a - b) / TAU;
        TAU * (turns - turns.round())
    };
    let near =
        |angle: f32| angles.iter().filter(|other| away(**other, angle).abs() < ANGLE).count();
    let middle = angles.iter().copied().max_by_key(|angle| near(*angle))?;
    if 10 * near(middle) < 9 * angles.len() {
        return None;
    }
    let mut offsets: Vec<_> = angles.iter().map(|angle| away(*angle, middle)).collect();
    offsets.sort_unstable_by(f32::total_cmp);
    Some(middle + offsets[offsets.len() / 2])
}
