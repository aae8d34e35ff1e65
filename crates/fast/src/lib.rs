//! The reference, faster and to the same bits.
//!
//! [`photon_mapping`] is the specification. Nobody needs this crate to understand photon mapping.
//! [`trace::trace_list`] and [`lanes::picture::take_picture`] are what others call. They trace
//! photons and camera rays side by side in the lanes of the processor's vectors, on all cores. They
//! also trace a sample with the port, to see that the bits are the same. [`tree`] is for scenes of
//! many triangles.

pub mod dots;
pub mod in_order;
pub mod lanes;
pub mod trace;
pub mod tree;

#[cfg(test)]
mod tests;
