//! A verdict on a submission, and the reason for it: which, of the ways in which the assignment may
//! have been done, explains the photons of any program, with any random numbers?
//!
//! Every way is a [`variants::hypotheses::Hypothesis`]: a fair reading of the handout, or a
//! misreading seen in real submissions. Each is a small [variation](variants::variation) of one
//! step of the reference, run through the same tracer, and its [`signature`] says how many photons
//! it leaves where.
//!
//! **One judge.** What a submission shows is counts in cells, with what is known of the number of
//! photons emitted: `evidence`. A list and a [`picture`] differ in how their cells are made and how
//! hypotheses are projected on them, and in nothing else. `trial` asks whether any fair reading
//! explains the counts, `naming` which misreading does, and `limits` has every line that is drawn.
//! What shows without counting is in `facts`, and [`recognized`] tells what was made up from a map
//! with mistakes.
//!
//! **Statistics.** Photons of one path are not independent, so counts are held against means and
//! *covariance* over paths: the test of Wald, for facets, for cells, for the total, and along the
//! way to each misreading. The fair reading that fits best counts. Up to 125
//! photons are tested exactly. A submission is incorrect below [`judge_list::SIGNIFICANCE`], a
//! tenth of what a class could bear: at small counts the tails of these tests are a little heavier
//! than the normal law's. Means have a leeway, since where a ray starts, and how far off its
//! surface a position is stored, are nobody's fault; it matters only beyond a million photons. A
//! misreading is named when its own counts agree with the submission's, by facet and by cell, and
//! neither another's do as well nor those of two at once ([`variants::pairs`]), which are told
//! without a name. `golden/grading.md` has what all of this achieves.

mod axes;
mod beside;
mod bounces;
mod crowding;
mod direct;
mod evidence;
mod exact;
pub mod expected;
mod facts;
mod few;
pub mod judge_list;
mod kept;
mod limits;
mod list;
pub mod naming;
mod number;
pub mod observation;
mod own;
pub mod picture;
pub mod places;
pub mod policy;
pub mod recognized;
mod repeats;
mod self_hits;
pub mod short;
pub mod signature;
pub mod statistics;
pub mod submission;
#[cfg(test)]
extern crate self as grading; // as the files that examples and tests share call it
#[cfg(test)]
mod tests;
pub mod text;
mod trial;
mod unjudged;
pub mod verdict;
