//! What of a facet can be seen from a point: exact, as convex pieces.

use super::polygon::{Plane, Polygon, edges, keep, range, subtract};
use super::scene::{IN_PLANE, Plate, PlateScene, Side};
use glam::DVec3;

/// Pieces of plate `target` seen from `eye`, a point of plate `from`, looking out on `side` of it.
pub fn seen_from_plate(
    scene: &PlateScene,
    from: usize,
    side: Side,
    eye: DVec3,
    target: usize,
) -> Vec<Polygon> {
    if !scene.is_on_side(from, side, target) || is_edge_on(scene, target, eye) {
        return Vec::new();
    }
    let horizon = scene.plates[from].horizon(side);
    let mut pieces: Vec<Polygon> = scene.plates[target]
        .parts
        .iter()
        .map(|part| keep(part, &horizon))
        .filter(|piece| piece.len() >= 3)
        .collect();
    for &occluder in scene.occluders(from, side, target) {
        if pieces.is_empty() {
            break;
        }
        remove_shadow(scene, eye, target, occluder as usize, &mut pieces);
    }
    pieces
}

/// Pieces of plate `target` seen from `eye`, a point in free space.
pub fn seen_from_point(scene: &PlateScene, eye: DVec3, target: usize) -> Vec<Polygon> {
    if is_edge_on(scene, target, eye) {
        return Vec::new();
    }
    let mut pieces = scene.plates[target].parts.clone();
    for occluder in (0..scene.plates.len()).filter(|&o| o != target) {
        remove_shadow(scene, eye, target, occluder, &mut pieces);
    }
    pieces
}

fn is_edge_on(scene: &PlateScene, plate: usize, eye: DVec3) -> bool {
    scene.plates[plate].plane.distance(eye).abs() < IN_PLANE
}

/// Takes from `pieces` of `target` what `occluder` hides from `eye`.
///
/// A point q of the target is hidden if the ray to it meets the occluder before the target's plane.
/// So the occluder is cut at that plane; the rays through the near part fill a convex cone, bounded
/// by planes through eye and edge. No projection is needed, and a part behind the eye does no harm:
/// the cone lies on one side of the occluder's plane.
fn remove_shadow(
    scene: &PlateScene,
    eye: DVec3,
    target: usize,
    occluder: usize,
    pieces: &mut Vec<Polygon>,
) {
    let screen = &scene.plates[occluder];
    let height = screen.plane.distance(eye);
    if height.abs() < IN_PLANE || look_apart(eye, &scene.plates[target], screen) {
        return;
    }
    let target_plane = scene.plates[target].plane;
    let near_side =
        if target_plane.distance(eye) > 0.0 { target_plane } else { target_plane.flipped() };
    let (lowest, highest) = range(&screen.corners, &near_side);
    if highest < IN_PLANE {
        return;
    }
    if lowest < 0.0 {
        let near = keep(&screen.corners, &near_side);
        subtract(pieces, &cone(&near, eye, height));
    } else {
        subtract(pieces, &cone(&screen.corners, eye, height));
    }
}

/// Whether the balls around two plates fill cones of directions that do not meet, seen from `eye`.
fn look_apart(eye: DVec3, a: &Plate, b: &Plate) -> bool {
    let (to_a, to_b) = (a.center - eye, b.center - eye);
    let (squared_a, squared_b) = (to_a.length_squared(), to_b.length_squared());
    let (tangent_a, tangent_b) = (squared_a - a.radius * a.radius, squared_b - b.radius * b.radius);
    if tangent_a <= 0.0 || tangent_b <= 0.0 {
        return false;
    }
    // cos of the angle between, against cos of the sum of both half angles, over the product of the
    // distances.
    to_a.dot(to_b) < (tangent_a * tangent_b).sqrt() - a.radius * b.radius - IN_PLANE
}

/// Planes through `eye` and each edge, normals into the cone. `height` is the eye's distance from
/// the polygon's plane, about whose normal the corners run counterclockwise.
fn cone(polygon: &[DVec3], eye: DVec3, height: f64) -> Vec<Plane> {
    edges(polygon)
        .filter_map(|(a, b)| {
            let inward = (a - eye).cross(b - eye).try_normalize()? * -height.signum();
            Some(Plane::through(eye, inward))
        })
        .collect()
}
