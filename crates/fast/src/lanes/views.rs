//! What a camera may see, found out once for all of its rays.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::closest_hit::{GROUP, Rays, SharedCorners, mask};
use super::neighborhood::Neighborhood;
use super::outlook::{self, Outlook};
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::camera::PerspectiveCamera;

/// What a camera may see in which direction.
pub struct Views {
    /// Of each cell of its [`Outlook`], a bit for every triangle. The last one, for
    /// [`outlook::UNKNOWN`], has all.
    pub of_cells: Vec<u128>,
    /// All triangles.
    pub all: SharedCorners,
    /// Where dots may be.
    pub dots: Neighborhood,
}

impl Views {
    /// What a camera at `origin` may see of `renderer`'s scene and dots.
    pub fn new(renderer: &PhotonMappingRenderer, origin: Vec3) -> Self {
        let scene = &renderer.stored_scene;
        let triangles = scene.triangles().len();
        let outlook = Outlook::new(scene, origin, &vec![0.0; triangles]);
        let bits = |triangles: &[u32]| triangles.iter().fold(0, |bits, t| bits | 1_u128 << t);
        let of_cell = |cell: u32| bits(outlook.candidates(outlook.list(cell)).1);
        let mut of_cells: Vec<u128> = (0..outlook::UNKNOWN).map(of_cell).collect();
        of_cells.push(bits(&(0..triangles as u32).collect::<Vec<_>>()));
        let dots = Neighborhood::new(&renderer.diffuse_map, PHOTON_DOT_RADIUS);
        Self { of_cells, all: SharedCorners::new(scene), dots }
    }
}

/// Sends rays from `camera` through neighboring pixels, as
/// [`photon_mapping::rendering::image_writer::camera_ray`] does.
pub struct CameraRays<'a> {
    /// The camera.
    pub camera: &'a PerspectiveCamera,
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// Column and row of the first pixel.
    pub first: [u32; 2],
    /// Where the rays go.
    pub rays: &'a mut Rays,
}

impl NullaryFnOnce for CameraRays<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { camera, size: [width, height], first: [column, row], rays } = self;
        let upwards = (1.0 - 2.0 * (row as f32 / height as f32)) * camera.half_height;
        let [x, y, z] = &mut rays.direction;
        for lane in 0..GROUP {
            let across = (column + lane as u32) as i32 as f32 / width as f32;
            let across = (2.0 * across - 1.0) * camera.half_width;
            let direction = camera.forward + across * camera.right + upwards * camera.up;
            let direction = direction.normalize();
            (x[lane], y[lane], z[lane]) = (direction.x, direction.y, direction.z);
        }
        for (starts, start) in rays.origin.iter_mut().zip(camera.position.to_array()) {
            starts.fill(start);
        }
    }
}

/// Finds the cells of rays from the camera.
pub struct CameraView<'a> {
    /// The rays.
    pub rays: &'a Rays,
    /// Where the cells go.
    pub cells: &'a mut [u32; GROUP],
}

impl NullaryFnOnce for CameraView<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let [x, y, z] = &self.rays.direction;
        for lane in 0..GROUP {
            let (cell, shear) = outlook::aim(Vec3::new(x[lane], y[lane], z[lane]));
            // An outlook counts with shears like those of a photon.
            let is_small = |shear: f32| (shear != 0.0) & (shear.abs() < outlook::SMALLEST_SHEAR);
            let is_unknown = mask(is_small(shear.x) | is_small(shear.y));
            self.cells[lane] = (cell & !is_unknown) | (outlook::UNKNOWN & is_unknown);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::width::Width;
    use photon_mapping::assignment8;
    use photon_mapping::rendering::image_writer::camera_ray;
    use photon_mapping::scene::ray::Ray;

    #[test]
    fn camera_rays_are_those_of_the_port() {
        let (width, height) = (203, 97);
        let camera = &assignment8::create_camera(width, height);
        let mut rays = Rays::default();
        for lanes in Width::available() {
            for row in 0..height {
                for column in (0..width).step_by(GROUP) {
                    let (size, first) = ([width, height], [column, row]);
                    lanes.run(CameraRays { camera, size, first, rays: &mut rays });
                    for lane in 0..GROUP {
                        let expected = camera_ray(camera, column + lane as u32, row, width, height);
                        assert_eq!(rays.ray(lane), expected);
                    }
                }
            }
        }
    }

    /// With shears as small as no photon has them, the signs that an outlook tells may underflow.
    #[test]
    fn rays_with_the_smallest_shears_may_see_everything() {
        let mut rays = Rays::default();
        for (lane, x) in [0.0, 1e-30, -1e-9, 1e-7, 0.5].into_iter().enumerate() {
            rays.set(lane, &Ray::new(Vec3::ZERO, Vec3::new(x, 0.0, 1.0).normalize()));
            rays.set(lane + 5, &Ray::new(Vec3::ZERO, Vec3::new(0.0, x, -1.0).normalize()));
        }
        for width in Width::available() {
            let mut cells = [0; GROUP];
            width.run(CameraView { rays: &rays, cells: &mut cells });
            let is_unknown = cells.map(|cell| cell == outlook::UNKNOWN);
            assert_eq!(is_unknown[..5], [false, true, true, false, false]);
            assert_eq!(is_unknown[5..10], [false, true, true, false, false]);
        }
    }
}
