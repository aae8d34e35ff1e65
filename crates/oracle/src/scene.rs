//! The scene as the oracle sees it. Facets have unit size, and planes are turned to the scattering
//! side. Every pair of facets has the short list of others that can stand between them.

use super::polygon::{Plane, Polygon, area_vector, keep, range, side_planes, subtract};
use super::{Emitter, Facet};
use glam::DVec3;
use rayon::prelude::*;

/// Nearer than this to a plane counts as in it. Larger than the rounding of a unit-size scene moved
/// 1e5 away.
pub const IN_PLANE: f64 = 1e-9;

/// So far facets are moved apart that lie in one another and look opposite ways. Each is met from
/// its front alone then, as in the tracer.
pub const GAP: f64 = 1e-7;

/// A usable facet.
pub struct Plate {
    /// Its place in the caller's list.
    pub facet: usize,
    /// Its plane, normal to the side photons scatter to.
    pub plane: Plane,
    /// Mean of the corners.
    pub center: DVec3,
    /// Distance of the farthest corner from the center.
    pub radius: f64,
    /// Corners, counterclockwise about the normal.
    pub corners: Polygon,
    /// The part of it that receives photons: all but what an earlier coplanar facet covers.
    pub parts: Vec<Polygon>,
    /// Chance that a photon that hits it is scattered.
    pub survival: f64,
}

/// Which side of a plate, seen from its scattering normal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    Front,
    Back,
}

pub struct PlateScene {
    pub plates: Vec<Plate>,
    /// Position in scene units, and share of the emitted photons.
    pub emitters: Vec<(DVec3, f64)>,
    /// Whether facets were moved by [`GAP`].
    pub is_parted: bool,
    /// Least and greatest distance of the corners of plate `b` from the plane of plate `a`, at
    /// `a * n + b`.
    ranges: Vec<(f64, f64)>,
    /// Possible occluders, at `(a * 2 + side) * n + target`.
    between: Vec<Vec<u32>>,
}

impl PlateScene {
    /// Facets with a coordinate that is not finite or without area are left out, as are emitters
    /// that are not finite or have no share.
    pub fn new(facets: &[Facet], emitters: &[Emitter]) -> Self {
        let (center, unit) = frame(facets);
        let to_scene = |point: DVec3| (point - center) / unit;
        let mut plates: Vec<Plate> = Vec::new();
        for (index, facet) in facets.iter().enumerate() {
            if let Some(plate) = plate(index, facet, to_scene) {
                plates.push(plate);
            }
        }
        let emitters = emitters
            .iter()
            .filter(|emitter| {
                emitter.position.is_finite() && emitter.share.is_finite() && emitter.share > 0.0
            })
            .map(|emitter| (to_scene(emitter.position), emitter.share))
            .collect();
        let is_parted = part_back_to_back(&mut plates);
        let ranges = plates
            .iter()
            .flat_map(|a| plates.iter().map(|b| range(&b.corners, &a.plane)))
            .collect();
        let mut scene = Self { plates, emitters, is_parted, ranges, between: Vec::new() };
        scene.drop_covered_parts();
        scene.list_occluders();
        scene
    }

    /// How far off, or how large, is the smallest thing near `triangle` of plate `own`: another
    /// facet, or a light. Densities on the triangle vary over such lengths.
    pub fn detail_near(&self, own: usize, triangle: &[DVec3; 3]) -> f64 {
        let middle = triangle.iter().sum::<DVec3>() / 3.0;
        let radius = triangle.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        let plates = self.plates.iter().enumerate().filter(|(index, _)| *index != own);
        let plates = plates.map(|(_, plate)| (plate.center, plate.radius));
        let height = |light: DVec3| self.plates[own].plane.distance(light).abs();
        let lights = self.emitters.iter().map(|(light, _)| (*light, height(*light)));
        let distance = |(center, size): (DVec3, f64)| (middle.distance(center) - radius).max(size);
        plates.chain(lights).map(distance).fold(f64::INFINITY, f64::min)
    }

    /// Where two coplanar facets overlap, the earlier one takes the photons, so that duplicates
    /// count once.
    fn drop_covered_parts(&mut self) {
        for b in 1..self.plates.len() {
            for a in 0..b {
                let (lowest, highest) = self.range(a, b);
                if lowest > -IN_PLANE && highest < IN_PLANE {
                    let sides = side_planes(&self.plates[a].corners, self.plates[a].plane.normal);
                    subtract(&mut self.plates[b].parts, &sides);
                }
            }
        }
    }

    /// Nearest to the target first: a facet on the far side of a closed body is soon found hidden
    /// by the near side.
    fn list_occluders(&mut self) {
        let count = self.plates.len();
        let lists = (0..count * 2 * count).into_par_iter().map(|index| {
            let (a, target) = (index / (2 * count), index % count);
            let side = if (index / count).is_multiple_of(2) { Side::Front } else { Side::Back };
            let mut list: Vec<u32> = (0..count)
                .filter(|&o| self.may_block(a, side, target, o))
                .map(|o| o as u32)
                .collect();
            let goal = self.plates[target].center;
            list.sort_by(|&a, &b| {
                let [a, b] = [a, b].map(|o| self.plates[o as usize].center.distance_squared(goal));
                a.total_cmp(&b)
            });
            list
        });
        self.between = lists.collect();
    }

    /// Whether a plane parallel to the line between the middles of `a` and `target` has both on one
    /// side and `o` on the other.
    fn passes_by(&self, a: usize, target: usize, o: usize) -> bool {
        let [a, target, o] = [a, target, o].map(|plate| &self.plates[plate]);
        let along = target.center - a.center;
        let towards = o.center - a.center;
        let across = towards - along * (towards.dot(along) / along.length_squared());
        let Some(axis) = across.try_normalize() else { return false };
        let beam = a
            .corners
            .iter()
            .chain(&target.corners)
            .map(|&p| axis.dot(p))
            .fold(f64::NEG_INFINITY, f64::max);
        o.corners.iter().all(|&p| axis.dot(p) > beam + IN_PLANE)
    }

    /// False only when `o` cannot meet a segment from plate `a`, leaving on `side`, to plate
    /// `target`.
    fn may_block(&self, a: usize, side: Side, target: usize, o: usize) -> bool {
        let beyond = |(lowest, highest): (f64, f64), side| match side {
            Side::Front => highest > IN_PLANE,
            Side::Back => lowest < -IN_PLANE,
        };
        if o == a
            || o == target
            || !beyond(self.range(a, o), side)
            || !beyond(self.range(a, target), side)
        {
            return false;
        }
        let (a_lowest, a_highest) = self.range(target, a);
        let from_front = a_highest > IN_PLANE && beyond(self.range(target, o), Side::Front);
        let from_back = a_lowest < -IN_PLANE && beyond(self.range(target, o), Side::Back);
        if !from_front && !from_back {
            return false;
        }
        let (source, goal) = (self.range(o, a), self.range(o, target));
        let both_in_front = source.0 > -IN_PLANE && goal.0 > -IN_PLANE;
        let both_behind = source.1 < IN_PLANE && goal.1 < IN_PLANE;
        !both_in_front && !both_behind && !self.passes_by(a, target, o)
    }

    /// Least and greatest distance of the corners of `plate` from the plane of `reference`.
    pub fn range(&self, reference: usize, plate: usize) -> (f64, f64) {
        self.ranges[reference * self.plates.len() + plate]
    }

    /// Plates that may stand between a point of plate `a`, looking out on `side`, and plate
    /// `target`.
    pub fn occluders(&self, a: usize, side: Side, target: usize) -> &[u32] {
        &self.between[(a * 2 + usize::from(side == Side::Back)) * self.plates.len() + target]
    }

    /// Whether any part of `target` lies on `side` of plate `a`.
    pub fn is_on_side(&self, a: usize, side: Side, target: usize) -> bool {
        let (lowest, highest) = self.range(a, target);
        match side {
            Side::Front => highest > IN_PLANE,
            Side::Back => lowest < -IN_PLANE,
        }
    }
}

impl Plate {
    /// Outward plane of the half space on `side`: the horizon of a point of this plate.
    pub fn horizon(&self, side: Side) -> Plane {
        match side {
            Side::Front => self.plane,
            Side::Back => self.plane.flipped(),
        }
    }
}

/// Moves facets apart that lie in one another and look opposite ways; whether there are any.
fn part_back_to_back(plates: &mut [Plate]) -> bool {
    let overlap = |a: &Plate, b: &Plate| {
        let (lowest, highest) = range(&b.corners, &a.plane);
        let is_back_to_back =
            lowest > -IN_PLANE && highest < IN_PLANE && a.plane.normal.dot(b.plane.normal) < 0.0;
        is_back_to_back && {
            let sides = side_planes(&a.corners, a.plane.normal);
            let common = sides.iter().fold(b.corners.clone(), |piece, side| keep(&piece, side));
            common.len() >= 3 && area_vector(&common).length() > LEAST_AREA
        }
    };
    let has_back = |a: &usize| plates.iter().any(|b| overlap(&plates[*a], b));
    let parted: Vec<usize> = (0..plates.len()).filter(has_back).collect();
    for &index in &parted {
        let plate = &mut plates[index];
        let step = GAP * plate.plane.normal;
        plate.center += step;
        plate.corners.iter_mut().for_each(|corner| *corner += step);
        plate.parts = vec![plate.corners.clone()];
        plate.plane = Plane::through(plate.center, plate.plane.normal);
    }
    !parted.is_empty()
}

/// Center and larger half extent of all usable facets.
fn frame(facets: &[Facet]) -> (DVec3, f64) {
    let corners = || {
        facets.iter().filter(|facet| is_usable(facet)).flat_map(|facet| &facet.vertices).copied()
    };
    let lowest = corners().fold(DVec3::INFINITY, DVec3::min);
    let highest = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    let unit = (0.5 * highest - 0.5 * lowest).max_element();
    if unit.is_finite() && unit > 0.0 {
        (0.5 * lowest + 0.5 * highest, unit)
    } else {
        (DVec3::ZERO, 1.0)
    }
}

/// Whether a facet has finite corners and an area.
fn is_usable(facet: &Facet) -> bool {
    let Some(&first) = facet.vertices.first() else { return false };
    if !facet.vertices.iter().all(|vertex| vertex.is_finite()) {
        return false;
    }
    let reach = facet
        .vertices
        .iter()
        .map(|&vertex| (vertex - first).abs().max_element())
        .fold(0.0, f64::max);
    let unit_sized: Polygon =
        facet.vertices.iter().map(|&vertex| (vertex - first) / reach).collect();
    reach.is_finite() && area_vector(&unit_sized).length() > LEAST_AREA
}

/// Twice the area over the length squared; a sliver thinner than this has no direction left in its
/// normal.
const LEAST_AREA: f64 = 1e-10;

fn plate(index: usize, facet: &Facet, to_scene: impl Fn(DVec3) -> DVec3) -> Option<Plate> {
    if !is_usable(facet) {
        return None;
    }
    let mut corners: Polygon = facet.vertices.iter().map(|&vertex| to_scene(vertex)).collect();
    let mut normal = area_vector(&corners).try_normalize()?;
    if facet.normal.dot(normal) < 0.0 {
        normal = -normal;
        corners.reverse();
    }
    let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let plane = Plane::through(center, normal);
    for corner in &mut corners {
        *corner -= normal * plane.distance(*corner);
    }
    let survival = if facet.survival.is_finite() { facet.survival.clamp(0.0, 1.0) } else { 0.0 };
    let radius = corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
    Some(Plate {
        facet: index,
        plane,
        center,
        radius,
        parts: vec![corners.clone()],
        corners,
        survival,
    })
}
