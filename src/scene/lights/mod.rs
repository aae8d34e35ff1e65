//! Where photons come from.

pub mod point_light;
