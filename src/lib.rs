//! A deterministic reference of Stanford CS148's Assignment 8, photon mapping.
//!
//! This package is the assignment and nothing else. Start with [`assignment8`], then follow a
//! photon: [`scene::point_light`] emits it, and [`rendering::photon_mapping_renderer`] traces,
//! stores and shows it. `ASSIGNMENT.md` reads along, section by section.

pub mod assignment8;
pub mod photon_list;
pub mod random;
pub mod rendering;
pub mod scene;

pub use photon_list::trace;
