//! The tests of all sections, in one program: `cargo test` stops after the first program with a
//! failure, and whoever breaks a step wants to see every section.

mod bits;
mod common;
mod emission;
mod hemisphere;
mod numerics;
mod picture;
mod roulette;
mod storage;
mod transformation;
mod whole;
