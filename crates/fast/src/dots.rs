//! Red dots for any number of photons, in memory that does not grow with them.

use glam::Vec3;
use image::RgbImage;

use photon_mapping::rendering::image_writer::camera_ray;
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;
use photon_mapping::scene::Scene;
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::ray::IntersectionState;

/// How many photons come together before they are looked up: 5 million emitted ones of the
/// handout's scene.
const MOST_WAITING: usize = 1 << 18;

/// The photons of a run as they come, and the pixels of a picture that those before them turn red.
///
/// A photon map of all photons would hold 12 bytes and more for each. Whether a pixel is red is an
/// *or* over photons, so a map of some of them at a time gives the same picture. Of earlier
/// photons, only the red pixels are kept.
#[derive(Clone, Debug)]
pub struct Dots {
    camera: PerspectiveCamera,
    width: u32,
    height: u32,
    waiting: Vec<Vec3>,
    most_waiting: usize,
    pixels: Option<Pixels>,
}

#[derive(Clone, Debug)]
struct Pixels {
    /// Those that see a surface, and where, as long as no photon is near.
    plain: Vec<(u32, u32, Vec3)>,
    red: Vec<(u32, u32)>,
}

impl Dots {
    /// No photon yet, for a picture of `width` x `height` pixels that `camera` takes.
    pub fn new(camera: PerspectiveCamera, width: u32, height: u32) -> Self {
        let most_waiting = MOST_WAITING;
        Self { camera, width, height, waiting: Vec::new(), most_waiting, pixels: None }
    }

    /// Adds the photon at `position`, in the space of `scene`.
    pub fn add(&mut self, scene: &Scene, position: Vec3) {
        self.waiting.push(position);
        if self.waiting.len() == self.most_waiting {
            let photon_map = self.remaining();
            self.pixels
                .get_or_insert_with(|| Pixels::new(scene, &self.camera, self.width, self.height));
            let Pixels { plain, red } = self.pixels.as_mut().expect("just made");
            plain.retain(|&(column, row, point)| {
                let is_red = photon_map.any_within_cube(point, PHOTON_DOT_RADIUS);
                if is_red {
                    red.push((column, row));
                }
                !is_red
            });
        }
    }

    /// The photons that were not looked up, for a picture taken with them.
    pub fn remaining(&mut self) -> PhotonMap {
        PhotonMap::new(std::mem::take(&mut self.waiting))
    }

    /// Turns the pixels red that the photons looked up so far are near. To add 1 to a red that is
    /// not negative, as [`photon_mapping::rendering::photon_mapping_renderer`] does, makes it
    /// the brightest red there is.
    pub fn draw(&self, picture: &mut RgbImage) {
        for (column, row) in self.pixels.iter().flat_map(|pixels| &pixels.red) {
            picture.get_pixel_mut(*column, *row).0[0] = 255;
        }
    }
}

impl Pixels {
    fn new(scene: &Scene, camera: &PerspectiveCamera, width: u32, height: u32) -> Self {
        let mut plain = Vec::new();
        for row in 0..height {
            for column in 0..width {
                let mut state = IntersectionState::new();
                let ray = camera_ray(camera, column, row, width, height);
                if scene.trace(&ray, Some(&mut state)) {
                    plain.push((column, row, state.intersection_point()));
                }
            }
        }
        Self { plain, red: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use photon_mapping::assignment8;
    use photon_mapping::rendering::image_writer::take_picture;

    #[test]
    fn photons_looked_up_some_at_a_time_give_the_picture_of_all() {
        let (width, height) = (97, 61);
        let camera = assignment8::create_camera(width, height);
        let mut renderer = assignment8::create_renderer(assignment8::create_scene());
        let mut photon_map = Vec::new();
        renderer.generic_photon_map_generation(&mut photon_map, 0..40_000, |_, _, _| ());
        let positions: Vec<Vec3> = photon_map.iter().map(|photon| photon.position).collect();
        let positions = &positions[..positions.len() / 4 * 4];
        renderer.diffuse_map = PhotonMap::new(positions.to_vec());
        let whole = take_picture(&renderer, &camera, width, height);
        // All at once, some left over, none left over.
        for most_waiting in [usize::MAX, 700, positions.len() / 4, positions.len()] {
            let mut dots = Dots { most_waiting, ..Dots::new(camera, width, height) };
            positions.iter().for_each(|position| dots.add(&renderer.stored_scene, *position));
            renderer.diffuse_map = dots.remaining();
            let mut picture = take_picture(&renderer, &camera, width, height);
            dots.draw(&mut picture);
            assert!(picture == whole, "{most_waiting}");
        }
    }
}
