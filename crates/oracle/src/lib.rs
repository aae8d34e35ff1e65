//! Expected hits without tracing: how often photons from point lights hit every facet, bounce by
//! bounce.
//!
//! A deterministic calculation in f64 from the geometry alone, to judge a photon tracer by. The
//! density of first hits per emitted photon is n1(x) = |cos| V / (4 pi r^2). Every later density is
//! n_{k+1}(y) = integral over x of P_r(x) n_k(x) cos_x |cos_y| V / (pi r^2) dA. N_k is the integral
//! of n_k.
//!
//! - N1 is a closed form: solid angles of the exactly lit pieces. Its error is rounding.
//! - N2 is an adaptive cubature of n1 P_r F. F is the closed form factor of the exactly visible
//!   pieces. The refinement bounds its error.
//! - N3 is an adaptive cubature of n2 P_r F at full accuracy. n2 is gathered from the exactly
//!   visible lit pieces. The refinement bounds its error.
//! - Later hits and the covariance come from piecewise linear collocation with exact form factors
//!   on two meshes. Their error is a part of the difference between the meshes.
//!
//! Facets block and receive on both sides and scatter to the side of their normal only, with a
//! cosine law. Light comes from points, equally in all directions. Results do not depend on units,
//! place, or number of threads.

mod between_meshes;
mod bounces;
mod cuts;
mod direct;
mod expectation;
#[cfg(test)]
mod fixtures;
mod for_scene;
mod mesh;
mod polygon;
mod scene;
mod settings;
mod solid_angle;
mod solve;
pub mod summary;
pub mod table;
#[cfg(test)]
mod tests;
pub mod text_table;
mod triangle_rules;
mod visibility;

pub use expectation::{Bounded, Expectation, FacetHits};
use glam::DVec3;
pub use solve::expect;

/// A flat convex polygon that scatters diffusely.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Number of the surface it belongs to: results can be asked for by it.
    pub surface: usize,
    /// Corners in order, either way round, in any unit. Projected onto their mean plane.
    pub vertices: Vec<DVec3>,
    /// Any vector on the side photons are scattered to. Its length and exact direction do not
    /// matter: the lobe stands on the plane. If zero, the side about which the corners run
    /// counterclockwise.
    pub normal: DVec3,
    /// P_r, the chance that a hit is scattered; brought into [0, 1].
    pub survival: f64,
}

/// A point that emits uniformly in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Where it is, in the facets' unit.
    pub position: DVec3,
    /// Part of the emitted photons that start here.
    pub share: f64,
}

/// How much work to spend.
///
/// Time grows a little faster than the square of the number of facets, because each facet is seen
/// from points on every other, past those between. Up to 40 facets are cut along each other's
/// planes. Larger scenes get coarser meshes for their size, and larger errors. They are about 5 %
/// of the hits after the third for a hundred facets, and as large as these hits for three hundred.
/// Judge by the errors given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accuracy {
    /// About a second for a dozen facets, bounds about 1e-3 of the stored hits.
    Quick,
    /// About two minutes of processor time and 1.6 GB for a dozen facets; bounds about 3e-10 on
    /// second hits, 3e-8 on third and 3e-6 on all later ones.
    Full,
}
