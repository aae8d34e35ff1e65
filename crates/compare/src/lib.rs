//! Where two photon lists part, and at which step of the handout.
//!
//! [`alignment`] pairs the records, [`differences`] counts what the pairs differ in, [`divergence`]
//! picks the first difference and asks [`verdict`] which [section](variants::section) of the
//! handout it belongs to, which in turn tries the
//! [misreadings](variants::misreadings::directions) of one photon; [`whole`] looks at all
//! differences together. [`fair_search`] tries whether another [`fair`] way
//! explains the differences, so that [`divergence`] looks at what is left of them. [`conventions`]
//! undoes other axes and numbers first, and [`numbering`] finds the photons of lists that do not
//! tell them. [`report`] puts it together; [`pictures`] compares pictures instead.

pub mod alignment;
mod common_subsequence;
mod compared;
mod conventions;
mod deeds;
pub mod differences;
mod divergence;
pub mod explain;
mod explanation;
mod fair;
mod fair_offsets;
mod fair_search;
mod known;
mod measured_frame;
mod numbering;
pub mod numbers;
mod partners;
pub mod pictures;
pub mod position_index;
pub mod report;
mod same_rows;
mod text;
mod tries;
mod verdict;
mod verdict_of_direction;
mod whole;
