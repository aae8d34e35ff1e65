//! What a camera may see, found out once for all of its rays.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::closest_hit::{GROUP, Rays, SharedCorners, mask};
use super::neighbourhood::Neighbourhood;
use super::outlook::{self, Outlook};
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};

/// What a camera may see in which direction.
pub struct Views {
    /// Of each cell of its [`Outlook`], a bit for every triangle. The last one, for
    /// [`outlook::UNKNOWN`], has all.
    pub of_cells: Vec<u128>,
    /// All triangles.
    pub all: SharedCorners,
    /// Where dots may be.
    pub dots: Neighbourhood,
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
        let dots = Neighbourhood::new(&renderer.diffuse_map, PHOTON_DOT_RADIUS);
        Self { of_cells, all: SharedCorners::new(scene), dots }
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
    use photon_mapping::scene::ray::Ray;

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
