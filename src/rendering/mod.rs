//! From photons and camera rays to a picture.

pub mod backward_renderer;
pub mod image_writer;
pub mod photon_map;
pub mod photon_mapping_renderer;
pub mod sampling;
