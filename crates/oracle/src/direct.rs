//! First hits: where the emitters shine, how densely, and the density of second hits they cause.

use super::polygon::{Plane, Polygon, keep, range, side_planes};
use super::scene::{PlateScene, Side};
use super::solid_angle::{form_factor, solid_angle};
use super::triangle_rules::TriangleRule;
use super::visibility::{seen_from_plate, seen_from_point};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// The part of a plate one emitter shines on, a convex piece of it.
pub struct LitPiece {
    pub plate: usize,
    pub emitter: usize,
    pub corners: Polygon,
    /// Planes along its edges, normals inward.
    sides: Vec<Plane>,
}

/// First hits of a scene.
pub struct Direct {
    pub pieces: Vec<LitPiece>,
    /// Indices of `pieces` on each plate.
    by_plate: Vec<Vec<usize>>,
    /// Expected first hits on each plate per emitted photon.
    pub hits: Vec<f64>,
    rule: TriangleRule,
    ratio: f64,
}

impl Direct {
    /// Closed form: share times solid angle of the lit pieces over 4 pi.
    pub fn new(scene: &PlateScene, rule: TriangleRule, ratio: f64) -> Self {
        let count = scene.plates.len();
        let lit: Vec<Vec<LitPiece>> = (0..count)
            .into_par_iter()
            .map(|plate| {
                let emitters = scene.emitters.iter().enumerate();
                emitters
                    .flat_map(|(emitter, &(position, _))| {
                        seen_from_point(scene, position, plate).into_iter().map(move |corners| {
                            let sides = side_planes(&corners, scene.plates[plate].plane.normal);
                            LitPiece { plate, emitter, corners, sides }
                        })
                    })
                    .collect()
            })
            .collect();
        let pieces: Vec<LitPiece> = lit.into_iter().flatten().collect();
        let mut by_plate = vec![Vec::new(); count];
        let mut hits = vec![0.0; count];
        for (index, piece) in pieces.iter().enumerate() {
            by_plate[piece.plate].push(index);
            let (position, share) = scene.emitters[piece.emitter];
            hits[piece.plate] += share * solid_angle(&piece.corners, position) / (4.0 * PI);
        }
        Self { pieces, by_plate, hits, rule, ratio }
    }

    /// Density of first hits from one emitter at a lit point of a plate, per emitted photon and
    /// scene unit of area: share |cos| / (4 pi r^2).
    pub fn density(&self, scene: &PlateScene, emitter: usize, plate: usize, point: DVec3) -> f64 {
        let (position, share) = scene.emitters[emitter];
        let towards = position - point;
        let squared = towards.length_squared();
        let cosine = scene.plates[plate].plane.normal.dot(towards).abs() / squared.sqrt();
        share * cosine / (4.0 * PI * squared)
    }

    /// Density of second hits at `point` of plate `at`, per emitted photon and scene unit of area.
    /// It is the integral over the lit points x of P_r n1(x) cos cos / (pi r^2), of those that
    /// scatter towards the point.
    ///
    /// Exactly visible pieces, so that the integrand is smooth. The closed form factor of each
    /// piece times the mean of n1 over it; only the mean is a quadrature.
    pub fn second_hit_density(&self, scene: &PlateScene, at: usize, point: DVec3) -> f64 {
        let mut density = 0.0;
        for side in [Side::Front, Side::Back] {
            for from in 0..scene.plates.len() {
                let source = &scene.plates[from];
                let scatters_here = source.survival > 0.0 && source.plane.distance(point) > 0.0;
                if !scatters_here
                    || self.by_plate[from].is_empty()
                    || !scene.is_on_side(at, side, from)
                {
                    continue;
                }
                for seen in seen_from_plate(scene, at, side, point, from) {
                    for &index in &self.by_plate[from] {
                        density += source.survival
                            * self.gather_piece(scene, at, point, &seen, &self.pieces[index]);
                    }
                }
            }
        }
        density
    }

    fn gather_piece(
        &self,
        scene: &PlateScene,
        at: usize,
        point: DVec3,
        seen: &[DVec3],
        lit: &LitPiece,
    ) -> f64 {
        if lit.sides.iter().any(|side| range(seen, side).1 <= 0.0) {
            return 0.0;
        }
        let mut both = seen.to_vec();
        for side in &lit.sides {
            both = keep(&both, side);
            if both.len() < 3 {
                return 0.0;
            }
        }
        let source = scene.plates[lit.plate].plane.normal;
        let normal = scene.plates[at].plane.normal;
        let factor = form_factor(&both, point, normal);
        let (mut weighted, mut weights) = (0.0, 0.0);
        let poles = [point, scene.emitters[lit.emitter].0];
        self.rule.graded(&both, &poles, self.ratio, &mut |x, weight| {
            let kernel = weight * kernel(x - point, normal, source);
            weighted += kernel * self.density(scene, lit.emitter, lit.plate, x);
            weights += kernel;
        });
        if weights > 0.0 { factor * weighted / weights } else { 0.0 }
    }
}

/// |cos cos| / r^2 between two surface points `between` apart, but for the constant 1 / pi.
pub fn kernel(between: DVec3, at: DVec3, source: DVec3) -> f64 {
    let squared = between.length_squared();
    (between.dot(at) * between.dot(source)).abs() / (squared * squared)
}
