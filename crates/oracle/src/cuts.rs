//! Where to cut facets so that densities are smooth on the pieces: along the planes of other
//! facets, and in strips along edges where facets touch.

use super::polygon::{Plane, Polygon, side_planes, split};
use super::scene::{IN_PLANE, PlateScene, Side};
use glam::DVec3;

/// Planes `widths` scene units away from those edges of `polygon`, a piece of `plate`, at which it
/// touches a facet that it sees.
pub fn strips(scene: &PlateScene, plate: usize, polygon: &[DVec3], widths: &[f64]) -> Vec<Plane> {
    let mut planes = Vec::new();
    for side in side_planes(polygon, scene.plates[plate].plane.normal) {
        let edge: Vec<DVec3> =
            polygon.iter().copied().filter(|&p| side.distance(p).abs() < IN_PLANE).collect();
        if (0..scene.plates.len()).any(|other| touches(scene, plate, other, &edge)) {
            planes.extend(widths.iter().map(|width| Plane { offset: side.offset + width, ..side }));
        }
    }
    planes
}

/// Whether `other`, in view of `plate`, holds a piece of `edge`.
fn touches(scene: &PlateScene, plate: usize, other: usize, edge: &[DVec3]) -> bool {
    let (&[start, end] | &[start, .., end]) = edge else {
        return false;
    };
    let there = &scene.plates[other];
    let sees =
        scene.is_on_side(plate, Side::Front, other) && scene.is_on_side(other, Side::Front, plate);
    sees && edge.iter().all(|&p| there.plane.distance(p).abs() < IN_PLANE) && {
        let sides = side_planes(&there.corners, there.plane.normal);
        [0.1, 0.3, 0.5, 0.7, 0.9]
            .map(|t| start.lerp(end, t))
            .iter()
            .any(|&p| sides.iter().all(|side| side.distance(p) > -IN_PLANE))
    }
}

/// Planes in which another facet lies and that cross this one.
pub fn cutting_planes(scene: &PlateScene, plate: usize) -> Vec<Plane> {
    let mut planes: Vec<Plane> = Vec::new();
    for other in 0..scene.plates.len() {
        let (lowest, highest) = scene.range(other, plate);
        if lowest < -IN_PLANE && highest > IN_PLANE {
            planes.push(scene.plates[other].plane);
        }
        // A coplanar facet ends along its edges, and with it what it covers.
        let (lowest, highest) = scene.range(plate, other);
        if other != plate && lowest > -IN_PLANE && highest < IN_PLANE {
            planes.extend(side_planes(
                &scene.plates[other].corners,
                scene.plates[other].plane.normal,
            ));
        }
    }
    planes
}

/// Convex pieces of `polygon` cut along all `planes`.
pub fn cut_all(polygon: Polygon, planes: &[Plane]) -> Vec<Polygon> {
    let mut pieces = vec![polygon];
    for plane in planes {
        pieces = pieces
            .into_iter()
            .flat_map(|piece| {
                let (positive, negative) = split(&piece, plane);
                [positive, negative]
            })
            .filter(|piece| piece.len() >= 3)
            .collect();
    }
    pieces
}
