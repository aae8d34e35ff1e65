//! From two C++ files to a grade: compiles `PointLight.cpp` and `PhotonMappingRenderer.cpp` as they
//! were handed in, runs them, and says which sections of the handout they get right.
//!
//! The files are compiled against a small stand-in for the course framework ([`kit`], with the C++
//! under `assets/`). The stand-in's harness carries out a [`plan`]: small scenes with known
//! answers, and the handout's scene. It tells what the student's code does as [`events`], and
//! [`sections`] judge them; [`grade`] makes it a grade. What strangers' code may do is limited by
//! [`sandbox`].

mod checking;
mod compile;
mod diagnostics;
pub mod error;
mod events;
pub mod find;
mod first;
mod foreign;
pub mod grade;
mod headers;
mod kept;
pub mod kit;
mod link;
mod messages;
mod plan;
mod report;
mod run;
mod sandbox;
mod scenes;
mod sections;
mod statistics;
#[cfg(test)]
mod tests;
pub mod text;
pub mod wall;
mod workshop;

pub use checking::{CheckSettings, check};
pub use diagnostics::BuildError;
pub use report::{Builds, CheckReport, Whole};
pub use sections::{Fault, SectionVerdict, Status};
