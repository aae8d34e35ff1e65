//! Where two photon lists part, and at which step of the handout.
//!
//! [`alignment`] pairs the records, [`differences`] counts what the pairs differ in, [`divergence`]
//! picks the first difference and asks [`verdict`] which [section](variants::section) of the handout it belongs to,
//! which in turn tries the [`hypotheses`] of what students do instead; [`whole`] looks at all differences together. [`readings`] tries whether
//! another fair reading of the handout explains the differences. [`report`] puts it together;
//! [`pictures`] compares pictures instead.

pub mod alignment;
pub mod differences;
pub mod divergence;
pub mod explain;
pub mod hypotheses;
pub mod numbers;
pub mod pictures;
pub mod position_index;
pub mod readings;
pub mod report;
mod text;
pub mod verdict;
pub mod whole;
