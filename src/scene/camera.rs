//! The camera, from a place in the picture to a ray into the scene: C++ `PerspectiveCamera.cpp`.

use glam::Vec3;

use super::ray::Ray;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveCamera {
    /// Where it stands, in world space.
    pub position: Vec3,
    /// The unit vector along which it looks.
    pub forward: Vec3,
    /// The unit vector to the right of the picture.
    pub right: Vec3,
    /// The unit vector to the top of the picture.
    pub up: Vec3,
    /// Half the width of the picture at distance 1.
    pub half_width: f32,
    /// Half the height of the picture at distance 1.
    pub half_height: f32,
}

impl PerspectiveCamera {
    /// A camera at `position` that looks along the unit vector `forward`, with the unit vector `up`
    /// at a right angle to it. `field_of_view` is vertical and in degrees, `aspect_ratio` is
    /// width / height.
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

    /// The ray through (`x`, `y`) of the picture, both from 0 to 1, with (0, 0) its top left
    /// corner.
    pub fn generate_ray_for_normalized_coordinates(&self, x: f32, y: f32) -> Ray {
        let across = (2.0 * x - 1.0) * self.half_width;
        let upwards = (1.0 - 2.0 * y) * self.half_height;
        let direction = self.forward + across * self.right + upwards * self.up;
        Ray::new(self.position, direction.normalize())
    }
}
