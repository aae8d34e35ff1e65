//! A deterministic reference of Stanford CS148's Assignment 8, photon mapping.
//!
//! This package is the assignment and nothing else. Start with
//! [`rendering::photon_mapping_renderer`], which traces, stores and shows photons.
//! [`scene::point_light`] emits them, and [`assignment8`] builds the scene. `ASSIGNMENT.md` reads
//! along, section by section.
//!
//! A program that wants the photons alone asks [`trace`] for them:
//!
//! ```
//! use photon_mapping::photon_list::ListHash;
//!
//! let scene = photon_mapping::assignment8::create_scene();
//! let list = photon_mapping::trace(148, 20_000);
//! for (surface, mesh) in scene.mesh_objects().iter().enumerate() {
//!     let stored = list.iter().filter(|photon| usize::from(photon.surface) == surface).count();
//!     println!("{:10} {stored}", mesh.name);
//! }
//! let mut hash = ListHash::default();
//! hash.update(&list);
//! println!("SHA-256 {}", hash.hex());
//! assert_eq!(list.len(), 1000);
//! ```

pub mod assignment8;
pub mod photon_list;
pub mod random;
pub mod rendering;
pub mod scene;

pub use photon_list::trace;
