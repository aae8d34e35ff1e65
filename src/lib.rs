//! A deterministic reference of Stanford CS148's Assignment 8, photon mapping.
//!
//! The ground floor is the assignment, in the handout's order: [`assignment8`] builds the scene and
//! the renderer, [`scene::lights::point_light`] sends photons out, and
//! [`rendering::photon_mapping_renderer`] follows, stores and shows them. `ASSIGNMENT.md` reads
//! along. The rooms above look on and are not needed to understand it: [`photon_list`] keeps exact
//! lists, [`lanes`] traces them faster and to the same bits, [`accuracy`] computes what is expected
//! without tracing, [`summary`] holds a run against it, [`explain`] tells the story of one photon,
//! [`compare`] says where two lists part and why, [`report`] measures what accuracy costs, and [`cli`]
//! is the command line.

pub mod accuracy;
pub mod assignment8;
pub mod cli;
pub mod compare;
pub mod explain;
pub mod grading;
pub mod lanes;
pub mod photon_list;
pub mod random;
pub mod rendering;
pub mod report;
pub mod scene;
pub mod summary;
pub mod text_table;
