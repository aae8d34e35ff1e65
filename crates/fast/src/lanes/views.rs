//! What camera and shadow rays may meet, found out once for all of them.

use std::collections::HashMap;

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::cells::{CELLS, cell_of};
use super::closest_hit::SharedCorners;
use super::neighborhood::Neighborhood;
use super::occlusion::{find_candidates, seen_from};
use super::rays::{GROUP, Rays};
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::Scene;
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::point_light::PointLight;

/// What may be met on a straight way to a point, by the cell in which that way lies seen from
/// there: a bit for every triangle. The cell after all is that of ways on which nothing goes.
pub struct Sightlines([u128; CELLS + 1]);

/// What a picture's rays may meet.
pub struct Views {
    /// On the way from the camera.
    pub of_camera: Box<Sightlines>,
    /// On the way to each light.
    pub of_lights: Vec<Box<Sightlines>>,
    /// Where dots may be.
    pub dots: Neighborhood,
    /// What is seen, by triangle.
    pub surfaces: Vec<SeenSurface>,
}

/// What a picture shows of a triangle.
pub struct SeenSurface {
    /// Its unit normal.
    pub normal: [f32; 3],
    /// Its diffuse response.
    pub response: [f32; 3],
    /// [`Scene::offset`], if it is the same for all of its points that the camera sees.
    pub offset: Option<f32>,
}

impl Views {
    /// What a camera at `origin` and the lights may see of `renderer`'s scene and dots.
    pub fn new(renderer: &PhotonMappingRenderer, origin: Vec3) -> Self {
        let scene = &renderer.stored_scene;
        let of_light = |light: &PointLight| Sightlines::new(scene, light.position);
        Self {
            of_camera: Sightlines::new(scene, origin),
            of_lights: scene.lights().iter().map(of_light).collect(),
            dots: Neighborhood::new(&renderer.diffuse_map, PHOTON_DOT_RADIUS),
            surfaces: (0..scene.triangles().len())
                .map(|triangle| SeenSurface::new(scene, triangle, origin))
                .collect(),
        }
    }
}

impl SeenSurface {
    fn new(scene: &Scene, index: usize, origin: Vec3) -> Self {
        let triangle = &scene.triangles()[index];
        let mesh_object = &scene.mesh_objects()[triangle.parent_mesh_object];
        let corners = triangle.vertices;
        let distance =
            corners.map(|corner| corner.distance(origin)).into_iter().fold(0.0, f32::max);
        let place =
            corners.map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f32::max);
        // Rounding is monotonic, and moves a point much less than this.
        let (farthest, place) = (1.001 * distance, place + 0.001 * distance);
        let least = scene.offset(index, Vec3::ZERO, 0.0);
        let greatest = scene.offset(index, Vec3::splat(place), farthest);
        Self {
            normal: triangle.normal.to_array(),
            response: mesh_object.material.base_diffuse_reflection().to_array(),
            offset: (least == greatest).then_some(least),
        }
    }
}

impl Sightlines {
    /// What may be met in `scene` on the way to `origin`.
    pub fn new(scene: &Scene, origin: Vec3) -> Box<Self> {
        let mut of_cells = Box::new(Self([0; CELLS + 1]));
        find_candidates(&seen_from(scene, origin), &mut |cell, triangles| {
            of_cells.0[cell] = triangles.iter().fold(0, |bits, triangle| bits | 1 << triangle);
        });
        of_cells
    }

    /// What rays in one of `cells` may meet.
    pub fn bits(&self, cells: &[u32]) -> u128 {
        cells.iter().fold(0, |bits, cell| bits | self.0[*cell as usize])
    }
}

/// The triangles that are looked for together, by their bits.
pub struct SearchedTriangles<'a> {
    scene: &'a Scene,
    of_bits: HashMap<u128, SharedCorners>,
}

impl<'a> SearchedTriangles<'a> {
    /// None so far, of `scene`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, of_bits: HashMap::new() }
    }

    /// Those with a bit in `bits`.
    pub fn get(&mut self, bits: u128) -> &SharedCorners {
        self.of_bits.entry(bits).or_insert_with(|| {
            let triangles = (0..self.scene.triangles().len() as u32).filter(|t| bits >> t & 1 == 1);
            SharedCorners::of(self.scene, triangles)
        })
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
    /// Where the cells of their directions go.
    pub cells: &'a mut [u32; GROUP],
}

impl NullaryFnOnce for CameraRays<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { camera, size: [width, height], first: [column, row], rays, cells } = self;
        let upwards = (1.0 - 2.0 * (row as f32 / height as f32)) * camera.half_height;
        let [x, y, z] = &mut rays.direction;
        for lane in 0..GROUP {
            let across = (column + lane as u32) as i32 as f32 / width as f32;
            let across = (2.0 * across - 1.0) * camera.half_width;
            let direction = camera.forward + across * camera.right + upwards * camera.up;
            let direction = direction.normalize();
            cells[lane] = cell_of(direction);
            (x[lane], y[lane], z[lane]) = (direction.x, direction.y, direction.z);
        }
        for (starts, start) in rays.origin.iter_mut().zip(camera.position.to_array()) {
            starts.fill(start);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::width::Width;
    use photon_mapping::assignment8;
    use photon_mapping::rendering::image_writer::camera_ray;

    #[test]
    fn camera_rays_are_those_of_the_port() {
        let (width, height) = (203, 97);
        let camera = &assignment8::create_camera(width, height);
        let (mut rays, mut cells) = (Rays::default(), [0; GROUP]);
        for lanes in Width::available() {
            for row in 0..height {
                for column in (0..width).step_by(GROUP) {
                    let (size, first) = ([width, height], [column, row]);
                    lanes.run(CameraRays {
                        camera,
                        size,
                        first,
                        rays: &mut rays,
                        cells: &mut cells,
                    });
                    for lane in 0..GROUP {
                        let expected = camera_ray(camera, column + lane as u32, row, width, height);
                        assert_eq!(rays.ray(lane), expected);
                    }
                }
            }
        }
    }
}
