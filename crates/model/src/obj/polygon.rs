//! Polygons as triangles.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// The sine of a turn to the wrong side that may be the rounding of a straight edge.
const STRAIGHT: f64 = 1e-6;
/// The part of its area by which a polygon's triangles may differ from it in rounding.
const SAME_AREA: f64 = 1e-6;

/// Exporters round to six decimals, or to six digits.
const SIX_DECIMALS: f64 = 1e-6;
const SIX_DIGITS: f64 = 1e-5;
/// This part of the size of a face bends it by less than photons show.
const BEND: f64 = 1e-4;

/// The time for a concave polygon grows with the square of its corners.
pub const MOST_CORNERS: usize = 10_000;

/// The triangles that fill the polygon `corners`, as indices: a fan about the first corner if it is
/// convex. `None` when edges cross, or a concave one has more corners than [`MOST_CORNERS`].
pub fn triangulate(corners: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let fan: Vec<[usize; 3]> = (1..corners.len() - 1).map(|k| [0, k, k + 1]).collect();
    if corners.len() == 3 {
        return Some(fan);
    }
    let area =
        |[a, b, c]: &[usize; 3]| (corners[*b] - corners[*a]).cross(corners[*c] - corners[*a]) / 2.0;
    let normal: DVec3 = fan.iter().map(area).sum();
    let largest = fan.iter().map(|triangle| area(triangle).length()).fold(0.0, f64::max);
    if normal.length() <= SAME_AREA * largest {
        // A line and a point have no area; a bow has two that cancel.
        return (largest == 0.0).then_some(fan);
    }
    let flat = flatten(corners, normal);
    if is_convex(&flat) {
        return Some(fan);
    }
    if corners.len() > MOST_CORNERS || crosses_itself(&flat) {
        return None;
    }
    let mut indices: Vec<usize> = Vec::new();
    Earcut::new().earcut(flat.iter().map(|corner| corner.to_array()), &[], &mut indices);
    let (triangles, _) = indices.as_chunks::<3>();
    let of_flat = |[a, b, c]: &[usize; 3]| (flat[*b] - flat[*a]).perp_dot(flat[*c] - flat[*a]);
    let whole: f64 = fan.iter().map(of_flat).sum();
    let filled: f64 = triangles.iter().map(of_flat).sum();
    let is_filled = (filled - whole).abs() <= SAME_AREA * whole;
    is_filled.then(|| triangles.to_vec())
}

/// How far the farthest of `corners` is from the plane that fits them, if rounding does not explain
/// that.
pub fn off_plane(corners: &[DVec3]) -> Option<f64> {
    let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let from_middle = |at: usize| corners[at % corners.len()] - middle;
    let normal: DVec3 =
        (0..corners.len()).map(|at| from_middle(at).cross(from_middle(at + 1))).sum();
    let normal = normal.try_normalize()?;
    let (mut off, mut size, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for corner in corners {
        off = off.max(normal.dot(corner - middle).abs());
        size = size.max(corner.distance(middle));
        largest = largest.max(corner.abs().max_element());
    }
    (off > SIX_DECIMALS + SIX_DIGITS * largest + BEND * size).then_some(off)
}

/// `corners` seen from the side to which `normal` points, along the axis it is closest to.
fn flatten(corners: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let axis = (0..3).fold(
        0,
        |most, axis| {
            if normal[axis].abs() > normal[most].abs() { axis } else { most }
        },
    );
    let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
    let side = normal[axis].signum();
    let seen = |corner: &DVec3| {
        let corner = *corner - corners[0];
        DVec2::new(side * corner[right], corner[up])
    };
    corners.iter().map(seen).collect()
}

/// Whether a counterclockwise polygon turns nowhere to the right, and all around just once.
fn is_convex(corners: &[DVec2]) -> bool {
    let next = |at: usize| corners[(at + 1) % corners.len()];
    let edges = (0..corners.len()).map(|at| next(at) - corners[at]);
    let edges: Vec<DVec2> = edges.filter(|edge| *edge != DVec2::ZERO).collect();
    let is_lower = |edge: DVec2| edge.y < 0.0 || (edge.y == 0.0 && edge.x < 0.0);
    let mut halves = 0;
    for (edge, next) in edges.iter().zip(edges.iter().cycle().skip(1)) {
        let turn = edge.perp_dot(*next);
        let is_right = turn < -STRAIGHT * edge.length() * next.length();
        let is_back = turn <= 0.0 && edge.dot(*next) < 0.0;
        if is_right || is_back {
            return false;
        }
        halves += usize::from(is_lower(*edge) != is_lower(*next));
    }
    halves == 2
}

/// Whether two edges cross, or are the same one in the same direction. They may touch and run back
/// along each other, as where a hole is cut out.
fn crosses_itself(corners: &[DVec2]) -> bool {
    let next = |at: usize| corners[(at + 1) % corners.len()];
    let edges: Vec<[DVec2; 2]> = (0..corners.len()).map(|at| [corners[at], next(at)]).collect();
    let parts = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
        let (left, right) = ((b - a).perp_dot(c - a), (b - a).perp_dot(d - a));
        (left > 0.0 && right < 0.0) || (left < 0.0 && right > 0.0)
    };
    edges.iter().enumerate().any(|(at, edge)| {
        edges[at + 1..].iter().any(|other| {
            (edge == other && edge[0] != edge[1]) || (parts(*edge, *other) && parts(*other, *edge))
        })
    })
}
