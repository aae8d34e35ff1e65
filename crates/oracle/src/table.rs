//! What the oracle says of a scene, as a table that people and programs read.

use serde::{Deserialize, Serialize};

use super::for_scene::{FacetId, expect_for_scene};
use super::{Accuracy, Bounded, Expectation};
use photon_mapping::scene::Scene;

/// Expected hits per emitted photon, by surface, by facet and by bounce.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExpectedTable {
    /// The mesh objects, in the model file's order.
    pub surfaces: Vec<SurfaceRow>,
    /// The faces, in the model file's order.
    pub facets: Vec<FacetRow>,
    /// All of them together.
    pub total: TotalRow,
    /// Covariance, over emitted photons, of the numbers of photons stored on two surfaces.
    pub covariance: Vec<Vec<f64>>,
}

/// Hits on a mesh object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceRow {
    /// The mesh object's name.
    pub name: String,
    /// First, second, third, ... hits per emitted photon. The k-th had bounced k - 1 times.
    pub hits: Vec<f64>,
    /// A bound on the error of each.
    pub error: Vec<f64>,
    /// All hits but the first.
    pub stored: f64,
}

/// Hits on one face of a mesh object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FacetRow {
    /// The mesh object's name.
    pub surface: String,
    /// The face's number within it, from 0.
    pub facet: usize,
    /// As in [`SurfaceRow`].
    pub hits: Vec<f64>,
    /// As in [`SurfaceRow`].
    pub error: Vec<f64>,
}

/// Hits on everything.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TotalRow {
    /// As in [`SurfaceRow`].
    pub hits: Vec<f64>,
    /// As in [`SurfaceRow`].
    pub error: Vec<f64>,
    /// As in [`SurfaceRow`].
    pub stored: f64,
}

impl ExpectedTable {
    /// Computes the table of `scene` when its lights send out `photons_per_light`.
    pub fn compute(scene: &Scene, photons_per_light: &[u64], accuracy: Accuracy) -> Self {
        let (ids, expectation) = expect_for_scene(scene, photons_per_light, accuracy);
        Self::of(scene, &ids, &expectation)
    }

    /// The table of the handout's scene, computed beforehand: `photon-mapping expect --json`. A
    /// test computes it again.
    pub fn of_assignment8() -> Self {
        let json = include_str!("assignment8.json");
        serde_json::from_str(json).expect("the table that is part of the program is well formed")
    }

    fn of(scene: &Scene, ids: &[FacetId], expectation: &Expectation) -> Self {
        let bounces = 1..=expectation.bounces();
        let name = |surface: usize| scene.mesh_objects()[surface].name.clone();
        let stored = |hits: &[f64]| hits.iter().skip(1).sum();
        let surfaces = (0..scene.mesh_objects().len()).map(|surface| {
            let on_surface = |bounce| expectation.on_surface(surface, bounce);
            let (hits, error): (Vec<_>, Vec<_>) =
                bounces.clone().map(on_surface).map(value_and_error).unzip();
            SurfaceRow { name: name(surface), stored: stored(&hits), hits, error }
        });
        let facets = ids.iter().zip(&expectation.facets).map(|(id, facet)| {
            let (hits, error) = bounces.clone().map(|k| value_and_error(facet.hit(k))).unzip();
            FacetRow { surface: name(id.surface), facet: id.facet, hits, error }
        });
        let total = bounces.clone().map(|bounce| value_and_error(expectation.total(bounce)));
        let (hits, error): (Vec<_>, Vec<_>) = total.unzip();
        // A mesh object without a triangle is not in the expectation: nothing varies there.
        let row_of = |surface| expectation.surfaces.iter().position(|known| *known == surface);
        let covariance = |a, b| match (row_of(a), row_of(b)) {
            (Some(a), Some(b)) => expectation.covariance[a][b].value,
            _ => 0.0,
        };
        let count = scene.mesh_objects().len();
        Self {
            surfaces: surfaces.collect(),
            facets: facets.collect(),
            total: TotalRow { stored: stored(&hits), hits, error },
            covariance: (0..count)
                .map(|a| (0..count).map(|b| covariance(a, b)).collect())
                .collect(),
        }
    }
}

fn value_and_error(bounded: Bounded) -> (f64, f64) {
    (bounded.value, bounded.error)
}
