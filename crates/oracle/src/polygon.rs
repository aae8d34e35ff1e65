//! Convex polygons in space: planes, cutting, area.
//!
//! All lengths are in scene units, where the scene's larger half extent is 1 (see
//! [`super::scene`]).

use glam::DVec3;

/// Corners of a convex planar polygon, in order.
pub type Polygon = Vec<DVec3>;

/// Corners nearer than this to a cutting plane count as on it, so that cuts along shared edges
/// leave no slivers.
pub const ON_PLANE: f64 = 1e-13;

/// An oriented plane: points with `normal . p = offset`.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Unit normal.
    pub normal: DVec3,
    pub offset: f64,
}

impl Plane {
    /// The plane through `point` with unit normal `normal`.
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }

    /// Signed distance, positive on the side the normal points to.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    pub fn flipped(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }
}

/// Cuts `polygon` into the part on the positive side of `plane` and the part on the negative side.
///
/// Either may be empty; a polygon that only touches the plane goes whole to one side.
pub fn split(polygon: &[DVec3], plane: &Plane) -> (Polygon, Polygon) {
    let (lowest, highest) = range(polygon, plane);
    if lowest >= -ON_PLANE {
        return (polygon.to_vec(), Polygon::new());
    }
    if highest <= ON_PLANE {
        return (Polygon::new(), polygon.to_vec());
    }
    let mut positive = Polygon::with_capacity(polygon.len() + 2);
    let mut negative = Polygon::with_capacity(polygon.len() + 2);
    let mut previous = polygon[polygon.len() - 1];
    let mut before = plane.distance(previous);
    for &corner in polygon {
        let here = plane.distance(corner);
        if (before > ON_PLANE && here < -ON_PLANE) || (before < -ON_PLANE && here > ON_PLANE) {
            let crossing = previous + (corner - previous) * (before / (before - here));
            positive.push(crossing);
            negative.push(crossing);
        }
        if here >= -ON_PLANE {
            positive.push(corner);
        }
        if here <= ON_PLANE {
            negative.push(corner);
        }
        previous = corner;
        before = here;
    }
    (positive, negative)
}

/// The part of `polygon` on the positive side of `plane`.
pub fn keep(polygon: &[DVec3], plane: &Plane) -> Polygon {
    split(polygon, plane).0
}

/// Least and greatest signed distance of the corners to `plane`.
pub fn range(polygon: &[DVec3], plane: &Plane) -> (f64, f64) {
    polygon.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lowest, highest), &corner| {
        let distance = plane.distance(corner);
        (lowest.min(distance), highest.max(distance))
    })
}

/// Replaces each of `pieces` by what lies outside the convex region `inside every plane`, as convex
/// pieces.
pub fn subtract(pieces: &mut Vec<Polygon>, planes: &[Plane]) {
    if pieces.iter().all(|piece| is_outside(piece, planes)) {
        return;
    }
    let mut left = Vec::with_capacity(pieces.len() + 2);
    for piece in pieces.drain(..) {
        if is_outside(&piece, planes) {
            left.push(piece);
            continue;
        }
        let mut rest = piece;
        for plane in planes {
            let (inside, outside) = split(&rest, plane);
            if outside.len() >= 3 {
                left.push(outside);
            }
            rest = inside;
            if rest.len() < 3 {
                break;
            }
        }
    }
    *pieces = left;
}

fn is_outside(piece: &[DVec3], planes: &[Plane]) -> bool {
    planes.iter().any(|plane| piece.iter().all(|&corner| plane.distance(corner) <= ON_PLANE))
}

/// The planes that bound a polygon within its own plane, normals pointing inward.
///
/// `polygon` must run counterclockwise about `normal`.
pub fn side_planes(polygon: &[DVec3], normal: DVec3) -> Vec<Plane> {
    edges(polygon)
        .filter_map(|(a, b)| {
            normal.cross(b - a).try_normalize().map(|inward| Plane::through(a, inward))
        })
        .collect()
}

/// Consecutive pairs of corners, closing the loop.
pub fn edges(polygon: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]))
}

/// Twice the area times the normal (Newell 1972), from corners taken relative to the first to spare
/// digits.
pub fn area_vector(polygon: &[DVec3]) -> DVec3 {
    let Some(&first) = polygon.first() else {
        return DVec3::ZERO;
    };
    edges(polygon).map(|(a, b)| (a - first).cross(b - first)).sum()
}

/// Triangles that tile a convex polygon, as a fan from its first corner.
pub fn fan(polygon: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    (1..polygon.len().saturating_sub(1)).map(|i| [polygon[0], polygon[i], polygon[i + 1]])
}

/// Edges that differ by less than this part count as equally long, so that rounding does not decide
/// how to cut.
const SAME_LENGTH: f64 = 1e-8;

/// Index of the longest edge of a triangle (edge i runs from corner i to corner i + 1), and its
/// length squared.
pub fn longest_edge(triangle: &[DVec3; 3]) -> (usize, f64) {
    let lengths = [0, 1, 2].map(|i| (triangle[(i + 1) % 3] - triangle[i]).length_squared());
    let longer = |i: usize, best: usize| lengths[i] > lengths[best] * (1.0 + SAME_LENGTH);
    let longest = (1..3).fold(0, |best, i| if longer(i, best) { i } else { best });
    (longest, lengths[longest])
}

/// Two halves of a triangle, cut at the middle of its longest edge.
pub fn bisect(triangle: &[DVec3; 3]) -> [[DVec3; 3]; 2] {
    let (edge, _) = longest_edge(triangle);
    let (a, b, c) = (triangle[edge], triangle[(edge + 1) % 3], triangle[(edge + 2) % 3]);
    let middle = 0.5 * (a + b);
    [[a, middle, c], [middle, b, c]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Polygon {
        vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]
    }

    fn area(polygon: &[DVec3]) -> f64 {
        0.5 * area_vector(polygon).length()
    }

    #[test]
    fn split_halves_keep_the_area() {
        let plane = Plane::through(DVec3::new(0.3, 0.0, 0.0), DVec3::new(0.8, 0.6, 0.0));
        let (positive, negative) = split(&square(), &plane);
        assert!((area(&positive) + area(&negative) - 1.0).abs() < 1e-15);
        assert!(range(&positive, &plane).0 >= -1e-13 && range(&negative, &plane).1 <= 1e-13);
    }

    #[test]
    fn a_square_hole_leaves_the_rest() {
        let hole: Polygon = square().iter().map(|&p| 0.5 * p + DVec3::new(0.2, 0.3, 0.0)).collect();
        let mut pieces = vec![square()];
        subtract(&mut pieces, &side_planes(&hole, DVec3::Z));
        assert!((pieces.iter().map(|p| area(p)).sum::<f64>() - 0.75).abs() < 1e-15);
    }

    #[test]
    fn subtracting_itself_leaves_nothing() {
        let mut pieces = vec![square()];
        subtract(&mut pieces, &side_planes(&square(), DVec3::Z));
        assert!(pieces.is_empty());
    }

    #[test]
    fn fans_and_halves_tile() {
        let total: f64 = fan(&square()).flat_map(|t| bisect(&t)).map(|t| area(&t)).sum();
        assert!((total - 1.0).abs() < 1e-15);
    }
}
