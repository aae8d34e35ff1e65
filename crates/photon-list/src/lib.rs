//! Photon lists as files: reading what programs write, writing, and joining the parts of a run.
//!
//! The records themselves, their hash and their order are those of [`photon_mapping::photon_list`].

mod csv;
mod dialect;
pub mod error;
mod naming;
pub mod ply;
pub mod reader;
pub mod record;
pub mod run;
mod text;
mod units;
pub mod writer;
