//! Photons leave a surface: hemisphere sampling and transformation in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::chacha::number;
use super::closest_hit::{GROUP, Rays};
use super::trigonometry::sine_and_cosine;
use crate::rendering::reading::Offset;

/// Scatters [`GROUP`] photons.
pub struct Scatter<'a> {
    /// Their words for u1 and u2.
    pub words: &'a [[u32; GROUP]; 2],
    /// The points hit.
    pub point: &'a [[f32; GROUP]; 3],
    /// The columns of `tangent_frame` there: t, b and n, each by coordinate.
    pub frame: &'a [[f32; GROUP]; 9],
    /// Where the rays start.
    pub offset: Offset,
    /// Where the rays go.
    pub rays: &'a mut Rays,
}

impl NullaryFnOnce for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { words, point, frame, offset, rays } = self;
        let [origin_x, origin_y, origin_z] = &mut rays.origin;
        let [direction_x, direction_y, direction_z] = &mut rays.direction;
        for lane in 0..GROUP {
            let (u1, u2) = (number(words[0][lane]), number(words[1][lane]));
            let r = u1.sqrt();
            let (sine, cosine) = sine_and_cosine(2.0 * std::f32::consts::PI * u2);
            let (x, y, z) = (r * cosine, r * sine, (1.0 - u1).sqrt());
            // Mat3 * Vec3 sums its columns from the first to the last.
            let across = |axis: usize| {
                frame[axis][lane] * x + frame[axis + 3][lane] * y + frame[axis + 6][lane] * z
            };
            let direction = Vec3::new(across(0), across(1), across(2)).normalize();
            let of_lane = |columns: [&[f32; GROUP]; 3]| {
                Vec3::new(columns[0][lane], columns[1][lane], columns[2][lane])
            };
            let normal = of_lane([&frame[6], &frame[7], &frame[8]]);
            let start = offset.start(of_lane([&point[0], &point[1], &point[2]]), normal, direction);
            (direction_x[lane], direction_y[lane], direction_z[lane]) =
                (direction.x, direction.y, direction.z);
            (origin_x[lane], origin_y[lane], origin_z[lane]) = (start.x, start.y, start.z);
        }
    }
}
