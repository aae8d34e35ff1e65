//! The camera: from a place in the picture to a ray into the scene.

use glam::Vec3;

use super::frame::Frame;
use super::ray::Ray;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveCamera {
    position: Vec3,
    forward: Vec3,
    right: Vec3,
    up: Vec3,
    half_width: f32,
    half_height: f32,
}

impl PerspectiveCamera {
    /// A camera at `position` looking along the unit vector `forward`, with the unit vector `up`
    /// across it; `field_of_view` is vertical and in degrees, `aspect_ratio` is width / height.
    pub fn new(
        position: Vec3,
        forward: Vec3,
        up: Vec3,
        field_of_view: f32,
        aspect_ratio: f32,
    ) -> Self {
        let half_height = libm::tanf(field_of_view.to_radians() / 2.0);
        Self {
            position,
            forward,
            right: forward.cross(up),
            up,
            half_width: half_height * aspect_ratio,
            half_height,
        }
    }

    /// The camera where it stands in the space of a scene with `frame`; its place was in world space.
    pub fn in_frame(self, frame: &Frame) -> Self {
        Self { position: frame.to_scene(self.position.as_dvec3()), ..self }
    }

    /// The ray through (`x`, `y`) of the picture, both from 0 to 1, with (0, 0) its top left corner.
    pub fn generate_ray_for_normalized_coordinates(&self, x: f32, y: f32) -> Ray {
        let across = (2.0 * x - 1.0) * self.half_width;
        let upwards = (1.0 - 2.0 * y) * self.half_height;
        let direction = self.forward + across * self.right + upwards * self.up;
        Ray::new(self.position, direction.normalize())
    }

    /// Where `point`, in the space of the camera, appears in the picture: the coordinates of
    /// [`Self::generate_ray_for_normalized_coordinates`]; nothing for a point that is not before the
    /// camera.
    pub fn project(&self, point: Vec3) -> Option<[f32; 2]> {
        let from = point - self.position;
        let depth = from.dot(self.forward);
        let across = from.dot(self.right) / (depth * self.half_width);
        let upwards = from.dot(self.up) / (depth * self.half_height);
        (depth > 0.0).then(|| [(across + 1.0) / 2.0, (1.0 - upwards) / 2.0])
    }
}
