//! The picture in lanes, to the bytes of [`image_writer::take_picture`].

use std::collections::HashMap;

use glam::Vec3;
use pulp::NullaryFnOnce;
use rayon::prelude::*;

use super::closest_hit::{Closest, GROUP, Hits, NONE, Rays, SharedCorners};
use super::views::{CameraRays, CameraView, Views};
use super::width::Width;
use photon_mapping::rendering::image_writer;
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::ray::Ray;

/// Every so many pixels, one is computed by the port too.
const PIXELS_BETWEEN_CHECKS: usize = 101;

/// A picture, and whether lanes and port agree on it.
#[derive(Clone, Debug)]
pub struct CheckedPicture {
    /// The picture.
    pub picture: image::RgbImage,
    /// Column and row of a pixel on which lanes and port differ. The whole picture is then the
    /// port's.
    pub difference: Option<(u32, u32)>,
}

/// The picture of `width` x `height` pixels that `camera` takes, on all threads, with vectors of
/// `lanes`. `row_done` is called after every row, on any thread.
///
/// Scenes that are too large for lanes go through the port, and so do all pixels where a sample of
/// the lanes' pixels differs from the port's.
pub fn take_picture(
    renderer: &PhotonMappingRenderer,
    lanes: Width,
    camera: &PerspectiveCamera,
    width: u32,
    height: u32,
    row_done: impl Fn() + Sync,
) -> CheckedPicture {
    let camera_ray = |column: usize, row: usize| {
        image_writer::camera_ray(camera, column as u32, row as u32, width, height)
    };
    let of_port = |ray: &Ray| image_writer::to_bytes(renderer.compute_sample_color(ray));
    let take_with_port = || {
        let mut picture = image::RgbImage::new(width, height);
        let rows = picture.par_chunks_exact_mut(3 * width as usize).enumerate();
        rows.for_each(|(row, pixels)| {
            for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                pixel.copy_from_slice(&of_port(&camera_ray(column, row)));
            }
            row_done();
        });
        picture
    };
    if renderer.stored_scene.triangles().len() > super::MOST_TRIANGLES {
        return CheckedPicture { picture: take_with_port(), difference: None };
    }
    let views = Views::new(renderer, camera_ray(0, 0).position());
    let mut picture = image::RgbImage::new(width, height);
    picture.par_chunks_exact_mut(3 * width as usize).enumerate().for_each_init(
        || PictureTracer::new(renderer, lanes, &views),
        |tracer, (row, pixels)| {
            let colors = tracer.sample_colors(camera, [width, height], row as u32);
            for (pixel, color) in pixels.chunks_exact_mut(3).zip(colors) {
                pixel.copy_from_slice(&image_writer::to_bytes(*color));
            }
            row_done();
        },
    );
    let checked = (0..width as usize * height as usize).step_by(PIXELS_BETWEEN_CHECKS);
    let difference = checked
        .map(|pixel| (pixel % width as usize, pixel / width as usize))
        .find(|(column, row)| {
            let of_lanes = picture.get_pixel(*column as u32, *row as u32).0;
            of_lanes != of_port(&camera_ray(*column, *row))
        })
        .map(|(column, row)| (column as u32, row as u32));
    if difference.is_some() {
        picture = take_with_port();
    }
    CheckedPicture { picture, difference }
}

/// The points that a group of camera rays sees, one after another.
#[derive(Default)]
struct SeenPoints {
    points: [[f32; GROUP]; 3],
    normals: [[f32; GROUP]; 3],
    /// [`photon_mapping::scene::Scene::offset`] there.
    needed: [f32; GROUP],
    triangles: [u32; GROUP],
    count: usize,
}

impl SeenPoints {
    fn push(&mut self, point: Vec3, normal: Vec3, needed: f32, triangle: u32) {
        for axis in 0..3 {
            self.points[axis][self.count] = point[axis];
            self.normals[axis][self.count] = normal[axis];
        }
        (self.needed[self.count], self.triangles[self.count]) = (needed, triangle);
        self.count += 1;
    }
}

/// The shadow rays of [`photon_mapping::rendering::backward_renderer::light_towards`], and the
/// cosines at which they leave.
struct Towards<'a> {
    seen: &'a SeenPoints,
    light: Vec3,
    rays: &'a mut Rays,
    cosines: &'a mut [f32; GROUP],
}

impl NullaryFnOnce for Towards<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { seen: SeenPoints { points, normals, needed, .. }, light, rays, cosines } = self;
        for lane in 0..GROUP {
            let point = Vec3::new(points[0][lane], points[1][lane], points[2][lane]);
            let normal = Vec3::new(normals[0][lane], normals[1][lane], normals[2][lane]);
            let start = point + needed[lane] * normal;
            let to_light = light - start;
            let distance = to_light.length();
            let direction = to_light / distance;
            cosines[lane] = normal.dot(direction).max(0.0);
            rays.origin[0][lane] = start.x;
            rays.origin[1][lane] = start.y;
            rays.origin[2][lane] = start.z;
            rays.direction[0][lane] = direction.x;
            rays.direction[1][lane] = direction.y;
            rays.direction[2][lane] = direction.z;
            rays.max_t[lane] = distance;
        }
    }
}

struct PictureTracer<'a> {
    renderer: &'a PhotonMappingRenderer,
    lanes: Width,
    views: &'a Views,
    /// The triangles that were looked for together so far, by their bits.
    searched: HashMap<u128, SharedCorners>,
    rays: Rays,
    cells: [u32; GROUP],
    hits: Hits,
    shadows: Rays,
    obstacles: Hits,
    /// The pixels of the waiting shadow rays, and the colors that arrive unless something is in
    /// between.
    shaded: Vec<(usize, Vec3)>,
    colors: Vec<Vec3>,
    /// The pixels that see a surface, and where.
    points: Vec<(usize, Vec3)>,
}

impl<'a> PictureTracer<'a> {
    fn new(renderer: &'a PhotonMappingRenderer, lanes: Width, views: &'a Views) -> Self {
        Self {
            renderer,
            lanes,
            views,
            searched: HashMap::new(),
            rays: Rays::default(),
            cells: [0; GROUP],
            hits: Hits::default(),
            shadows: Rays::default(),
            obstacles: Hits::default(),
            shaded: Vec::with_capacity(GROUP),
            colors: Vec::new(),
            points: Vec::new(),
        }
    }

    /// What [`PhotonMappingRenderer::compute_sample_color`] gives for the pixels of a row of the
    /// picture of `size` that `camera` takes.
    fn sample_colors(&mut self, camera: &PerspectiveCamera, size: [u32; 2], row: u32) -> &[Vec3] {
        let scene = &self.renderer.stored_scene;
        let width = size[0] as usize;
        self.colors.clear();
        self.colors.resize(width, Vec3::ZERO);
        self.points.clear();
        for first in (0..width).step_by(GROUP) {
            let count = GROUP.min(width - first);
            let (rays, first_pixel) = (&mut self.rays, [first as u32, row]);
            self.lanes.run(CameraRays { camera, size, first: first_pixel, rays });
            self.look(count);
            let mut seen = SeenPoints::default();
            for lane in 0..count {
                if let Some(triangle) = scene.triangles().get(self.hits.triangle[lane] as usize) {
                    let t = self.hits.t[lane];
                    let point = self.rays.point(lane, t);
                    let needed = scene.offset(self.hits.triangle[lane] as usize, point, t);
                    seen.push(point, triangle.normal, needed, self.hits.triangle[lane]);
                    self.points.push((first + lane, point));
                }
            }
            self.ask_lights(&seen);
        }
        self.shade();
        for (pixel, point) in &self.points {
            if self.views.dots.may_have(*point)
                && self.renderer.diffuse_map.any_within_cube(*point, PHOTON_DOT_RADIUS)
            {
                self.colors[*pixel] += Vec3::X;
            }
        }
        &self.colors
    }

    /// Adds a shadow ray for every light that shines on one of the last points, which are `seen`.
    fn ask_lights(&mut self, seen: &SeenPoints) {
        let scene = &self.renderer.stored_scene;
        let pixels = self.points.len() - seen.count;
        let (mut rays, mut cosines) = (Rays::default(), [0.0; GROUP]);
        for light in scene.lights() {
            let (rays, cosines) = (&mut rays, &mut cosines);
            self.lanes.run(Towards { seen, light: light.position, rays, cosines });
            for (lane, cosine) in cosines.iter().enumerate().take(seen.count) {
                let triangle = &scene.triangles()[seen.triangles[lane] as usize];
                let mesh_object = &scene.mesh_objects()[triangle.parent_mesh_object];
                let diffuse_response = mesh_object.material.base_diffuse_reflection();
                let color = diffuse_response * light.color * *cosine;
                if color == Vec3::ZERO {
                    continue;
                }
                self.shadows.copy(self.shaded.len(), rays, lane);
                self.shaded.push((self.points[pixels + lane].0, color));
                if self.shaded.len() == GROUP {
                    self.shade();
                }
            }
        }
    }

    /// Finds what the first `count` camera rays meet.
    fn look(&mut self, count: usize) {
        let Self { renderer, lanes, views, searched, rays, cells, hits, .. } = self;
        let scene = &renderer.stored_scene;
        lanes.run(CameraView { rays, cells });
        let bits = cells[..count].iter().fold(0, |bits, c| bits | views.of_cells[*c as usize]);
        let triangles = (0..scene.triangles().len() as u32).filter(|t| bits >> t & 1 == 1);
        let seen = searched.entry(bits).or_insert_with(|| SharedCorners::of(scene, triangles));
        lanes.run(Closest { scene: seen, rays, hits });
        hits.settle(scene, rays, count);
    }

    /// Adds the colors that arrive along the waiting shadow rays.
    fn shade(&mut self) {
        let Self { renderer, lanes, views, shadows, obstacles: hits, shaded, colors, .. } = self;
        lanes.run(Closest { scene: &views.all, rays: shadows, hits });
        hits.settle(&renderer.stored_scene, shadows, shaded.len());
        for (lane, (pixel, color)) in shaded.drain(..).enumerate() {
            // Any obstacle before the light hides it, so the closest one does.
            if hits.triangle[lane] == NONE || hits.t[lane] >= shadows.max_t[lane] {
                colors[pixel] += color;
            }
        }
    }
}
