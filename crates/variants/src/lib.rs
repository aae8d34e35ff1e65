//! Every tracer that is not the reference: fair readings of the handout, misreadings, another
//! sampler.
//!
//! [`run::Run`] is what the toolkit traces. Where it is the reference, the port or the fast path
//! does it.

pub mod frame;
pub mod hypotheses;
pub mod misreadings;
pub mod pairs;
pub mod reading;
pub mod run;
pub mod sampler;
pub mod sampling;
pub mod section;
mod simulation;
mod sobol;
pub mod tracer;
pub mod variation;
