//! How large a polygon looks from a point: plain and cosine-weighted solid angle, in closed form.

use super::polygon::{edges, fan};
use glam::DVec3;
use std::f64::consts::PI;

/// Solid angle of a convex polygon seen from `eye`, in steradians, never negative.
///
/// Van Oosterom and Strackee, "The solid angle of a plane triangle" (1983), summed over a fan.
pub fn solid_angle(polygon: &[DVec3], eye: DVec3) -> f64 {
    fan(polygon)
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| corner - eye);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let volume = a.dot(b.cross(c)).abs();
            let corner = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * volume.atan2(corner)
        })
        .sum()
}

/// Form factor from the surface point `eye` with unit normal `normal` to a convex polygon that lies
/// wholly above the point's horizon: the chance that a cosine-distributed ray meets it. In [0, 1].
///
/// Lambert (1760): F = 1/(2 pi) sum of g_i (n . G_i), g_i the angle an edge subtends, G_i the unit
/// normal of the plane through edge and eye.
pub fn form_factor(polygon: &[DVec3], eye: DVec3, normal: DVec3) -> f64 {
    let sum: f64 = edges(polygon)
        .map(|(a, b)| {
            let (a, b) = (a - eye, b - eye);
            let across = a.cross(b);
            let length = across.length();
            if length > 0.0 { length.atan2(a.dot(b)) * normal.dot(across) / length } else { 0.0 }
        })
        .sum();
    sum.abs() / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facing_square(half: f64, distance: f64) -> Vec<DVec3> {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| DVec3::new(x * half, y * half, distance))
            .to_vec()
    }

    #[test]
    fn a_cube_face_fills_a_sixth_of_the_sphere() {
        let angle = solid_angle(&facing_square(1.0, 1.0), DVec3::ZERO);
        assert!((angle - 4.0 * PI / 6.0).abs() < 1e-14);
    }

    /// Howell's catalog, C-11 quadrupled: square of half side 1 at distance 1 gives 4/pi *
    /// atan(1/sqrt 2)/sqrt 2.
    #[test]
    fn a_square_overhead_has_the_catalogd_form_factor() {
        let expected = 4.0 / PI * (0.5f64.sqrt()).atan() * 0.5f64.sqrt();
        let found = form_factor(&facing_square(1.0, 1.0), DVec3::ZERO, DVec3::Z);
        assert!((found - expected).abs() < 1e-15);
    }

    #[test]
    fn a_huge_ceiling_takes_everything() {
        assert!((form_factor(&facing_square(1e8, 1.0), DVec3::ZERO, DVec3::Z) - 1.0).abs() < 1e-7);
    }
}
