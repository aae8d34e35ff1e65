//! The picture in lanes, to the bytes of [`image_writer::take_picture`].

use glam::Vec3;
use pulp::NullaryFnOnce;
use rayon::prelude::*;

use super::closest_hit::{Closest, Hits, NONE};
use super::rays::{GROUP, Rays};
use super::shadows::{Arrive, MetPoints, SeenPoints, ShadowRays, Towards};
use super::views::{CameraRays, SearchedTriangles, Views};
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
            tracer.draw(camera, [width, height], row as u32, pixels);
            row_done();
        },
    );
    let pixels = (0..width as usize * height as usize).into_par_iter();
    let difference = pixels
        .step_by(PIXELS_BETWEEN_CHECKS)
        .map(|pixel| (pixel % width as usize, pixel / width as usize))
        .find_first(|(column, row)| {
            let of_lanes = picture.get_pixel(*column as u32, *row as u32).0;
            of_lanes != of_port(&camera_ray(*column, *row))
        })
        .map(|(column, row)| (column as u32, row as u32));
    if difference.is_some() {
        picture = take_with_port();
    }
    CheckedPicture { picture, difference }
}

/// Makes the bytes of [`image_writer::to_bytes`].
struct PixelBytes<'a> {
    colors: &'a [[f32; GROUP]; 3],
    bytes: &'a mut [[u8; GROUP]; 3],
}

impl NullaryFnOnce for PixelBytes<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (bytes, channel) in self.bytes.iter_mut().zip(self.colors) {
            for lane in 0..GROUP {
                bytes[lane] = (channel[lane] * 255.0).clamp(0.0, 255.0) as u8;
            }
        }
    }
}

struct PictureTracer<'a> {
    renderer: &'a PhotonMappingRenderer,
    lanes: Width,
    views: &'a Views,
    searched: SearchedTriangles<'a>,
    rays: Rays,
    cells: [u32; GROUP],
    hits: Hits,
    seen: SeenPoints,
    shadows: ShadowRays,
    colors: [[f32; GROUP]; 3],
    bytes: [[u8; GROUP]; 3],
}

impl<'a> PictureTracer<'a> {
    fn new(renderer: &'a PhotonMappingRenderer, lanes: Width, views: &'a Views) -> Self {
        Self {
            renderer,
            lanes,
            views,
            searched: SearchedTriangles::new(&renderer.stored_scene),
            rays: Rays::default(),
            cells: [0; GROUP],
            hits: Hits::default(),
            seen: SeenPoints::default(),
            shadows: ShadowRays::default(),
            colors: [[0.0; GROUP]; 3],
            bytes: [[0; GROUP]; 3],
        }
    }

    /// Writes what [`PhotonMappingRenderer::compute_sample_color`] gives for the pixels of a row of
    /// the picture of `size` that `camera` takes.
    fn draw(&mut self, camera: &PerspectiveCamera, size: [u32; 2], row: u32, pixels: &mut [u8]) {
        for (first, pixels) in (0..).step_by(GROUP).zip(pixels.chunks_mut(3 * GROUP)) {
            let Self { rays, cells, .. } = self;
            self.lanes.run(CameraRays { camera, size, first: [first, row], rays, cells });
            let count = pixels.len() / 3;
            let bits = self.views.of_camera.bits(&cells[..count]);
            if bits == 0 {
                // A new picture is black.
                continue;
            }
            self.look(bits, count);
            self.ask_lights(count);
            self.add_dots();
            let Self { lanes, colors, bytes, .. } = self;
            lanes.run(PixelBytes { colors, bytes });
            for (lane, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                let [red, green, blue] = &*bytes;
                [pixel[0], pixel[1], pixel[2]] = [red[lane], green[lane], blue[lane]];
            }
        }
    }

    /// Finds what the first `count` camera rays see of the triangles in `bits`.
    fn look(&mut self, bits: u128, count: usize) {
        let Self { renderer, lanes, views, searched, rays, hits, seen, .. } = self;
        let scene = &renderer.stored_scene;
        lanes.run(Closest { scene: searched.get(bits), rays, hits });
        hits.settle(scene, rays, count);
        hits.triangle[count..].fill(NONE);
        lanes.run(MetPoints { rays, hits, points: &mut seen.points });
        for (lane, triangle) in hits.triangle.iter().enumerate() {
            let Some(surface) = views.surfaces.get(*triangle as usize) else {
                seen.responses.iter_mut().for_each(|channel| channel[lane] = 0.0);
                continue;
            };
            for axis in 0..3 {
                seen.normals[axis][lane] = surface.normal[axis];
                seen.responses[axis][lane] = surface.response[axis];
            }
            seen.needed[lane] = surface.offset.unwrap_or_else(|| {
                let point = Vec3::from_array([0, 1, 2].map(|axis| seen.points[axis][lane]));
                scene.offset(*triangle as usize, point, hits.t[lane])
            });
        }
    }

    /// Finds which light shines on what is seen.
    fn ask_lights(&mut self, count: usize) {
        let Self { renderer, lanes, views, searched, seen, shadows, colors, .. } = self;
        *colors = [[0.0; GROUP]; 3];
        let scene = &renderer.stored_scene;
        for (light, view) in scene.lights().iter().zip(&views.of_lights) {
            lanes.run(Towards { seen, light, shadows });
            let bits = view.bits(&shadows.cells);
            let ShadowRays { rays, obstacles: hits, .. } = shadows;
            lanes.run(Closest { scene: searched.get(bits), rays, hits });
            hits.settle(scene, rays, count);
            lanes.run(Arrive { shadows, colors });
        }
    }

    /// Turns red what is seen near a photon.
    fn add_dots(&mut self) {
        let Self { renderer, views, hits, seen, colors, .. } = self;
        for (lane, triangle) in hits.triangle.iter().enumerate() {
            let point = Vec3::from_array([0, 1, 2].map(|axis| seen.points[axis][lane]));
            if *triangle != NONE
                && views.dots.may_have(point)
                && renderer.diffuse_map.any_within_cube(point, PHOTON_DOT_RADIUS)
            {
                colors[0][lane] += 1.0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_those_of_the_port() {
        let special = [f32::NAN, f32::INFINITY, -f32::INFINITY, -0.0, -1e-9, 1.0, 1.1, 1e-40];
        let channels: Vec<f32> =
            (0..=20_000).map(|step| 1e-4 * step as f32 - 0.5).chain(special).collect();
        for width in Width::available() {
            for channels in channels.chunks(GROUP) {
                let channel = std::array::from_fn(|lane| channels[lane % channels.len()]);
                let mut bytes = [[0; GROUP]; 3];
                width.run(PixelBytes { colors: &[channel; 3], bytes: &mut bytes });
                for (lane, channel) in channel.into_iter().enumerate() {
                    let expected = image_writer::to_bytes(Vec3::splat(channel));
                    assert_eq!(bytes.map(|bytes| bytes[lane]), expected, "{channel}");
                }
            }
        }
    }
}
