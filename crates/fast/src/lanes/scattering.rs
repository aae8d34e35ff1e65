//! Photons leave a surface: hemisphere sampling and transformation in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::chacha::number;

use super::offset::Offset;
use super::rays::{GROUP, Rays};
use super::trigonometry::sine_and_cosine;

/// Scatters [`GROUP`] photons.
pub struct Scatter<'a> {
    /// Their words for u1 and u2.
    pub words: &'a [[u32; GROUP]; 2],
    /// The points hit.
    pub point: &'a [[f32; GROUP]; 3],
    /// The columns of `tangent_frame` there: t, b and n, each by coordinate.
    pub frame: &'a [[f32; GROUP]; 9],
    /// [`photon_mapping::scene::Scene::offset`] there.
    pub needed: &'a [f32; GROUP],
    /// Where the rays start.
    pub offset: Offset,
    /// Where the rays go.
    pub rays: &'a mut Rays,
}

impl NullaryFnOnce for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { words, point, frame, needed, offset, rays } = self;
        for lane in 0..GROUP {
            let (u1, u2) = (number(words[0][lane]), number(words[1][lane]));
            let r = u1.sqrt();
            let (sine, cosine) = sine_and_cosine(2.0 * std::f32::consts::PI * u2);
            let (x, y, z) = (r * cosine, r * sine, (1.0 - u1).sqrt());
            // Mat3 * Vec3 sums its columns from the first to the last.
            let dx = frame[0][lane] * x + frame[3][lane] * y + frame[6][lane] * z;
            let dy = frame[1][lane] * x + frame[4][lane] * y + frame[7][lane] * z;
            let dz = frame[2][lane] * x + frame[5][lane] * y + frame[8][lane] * z;
            let direction = Vec3::new(dx, dy, dz).normalize();
            rays.direction[0][lane] = direction.x;
            rays.direction[1][lane] = direction.y;
            rays.direction[2][lane] = direction.z;
        }
        // Apart, because the kind of the offset is a branch.
        for lane in 0..GROUP {
            let hit = Vec3::new(point[0][lane], point[1][lane], point[2][lane]);
            let normal = Vec3::new(frame[6][lane], frame[7][lane], frame[8][lane]);
            let [x, y, z] = &rays.direction;
            let direction = Vec3::new(x[lane], y[lane], z[lane]);
            let start = offset.start(hit, normal, direction, needed[lane]);
            rays.origin[0][lane] = start.x;
            rays.origin[1][lane] = start.y;
            rays.origin[2][lane] = start.z;
            rays.start_error[lane] = offset.start_error(needed[lane]);
        }
    }
}
