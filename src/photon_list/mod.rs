//! Exact photon lists: what was stored, by which photon, after how many bounces, on which surface.
//!
//! A list is in order of photon, then bounce, whatever the number of threads. Its name is the
//! SHA-256 of its rows ([`record::PhotonRecord::to_row`]), whatever the format it is written in.

pub mod csv;
mod dialect;
pub mod error;
pub mod in_order;
pub mod ply;
pub mod reader;
pub mod record;
pub mod run;
pub mod trace;
pub mod writer;
