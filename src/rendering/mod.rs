//! From photons and camera rays to a picture.

pub mod backward_renderer;
pub mod dots;
pub mod image_writer;
pub mod photon;
pub mod photon_map;
pub mod photon_mapping_renderer;
pub mod reading;
pub mod sampler;
pub mod sampling;
pub mod sobol;
