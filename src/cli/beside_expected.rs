//! What a run is held against.

use std::ops::Range;

use crate::accuracy::Accuracy;
use crate::accuracy::table::ExpectedTable;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use crate::rendering::reading::Reading;
use crate::rendering::sampler::Sampler;
use crate::scene::Scene;
use crate::scene::triangle::Triangle;
use crate::summary::{SurfaceSummary, Tally};

/// Expecting takes seconds at this many faces, and grows with their square; tracing does not.
const MOST_FACETS_TO_EXPECT: usize = 40;

/// The tally of the photons `photons` beside what is expected, and all surfaces together.
pub fn beside_expected(
    is_built_in: bool,
    renderer: &PhotonMappingRenderer,
    photons: &Range<u64>,
    tally: &Tally,
) -> (Vec<SurfaceSummary>, SurfaceSummary) {
    let emitted = photons.end - photons.start;
    let expected = expected(is_built_in, renderer, photons);
    let max_bounces = renderer.max_photon_bounces as usize;
    let (mut surfaces, mut total) = tally.surfaces(emitted, max_bounces, expected.as_ref());
    if renderer.sampler != Sampler::ChaCha {
        // Standard deviations are those of independent photons.
        surfaces.iter_mut().chain([&mut total]).for_each(SurfaceSummary::forget_z);
    }
    (surfaces, total)
}

/// What the photons of a run are expected to do, where that is known or soon computed.
fn expected(
    is_built_in: bool,
    renderer: &PhotonMappingRenderer,
    photons: &Range<u64>,
) -> Option<ExpectedTable> {
    let scene = &renderer.stored_scene;
    if renderer.reading != Reading::REFERENCE {
        return None;
    }
    if is_built_in {
        return Some(ExpectedTable::of_assignment8());
    }
    (facets(scene) <= MOST_FACETS_TO_EXPECT).then(|| {
        let mut first = 0;
        let in_range = renderer.photons_per_light().into_iter().map(|count| {
            let of_light = first..first + count;
            first = of_light.end;
            let end = of_light.end.min(photons.end);
            end.saturating_sub(of_light.start.max(photons.start))
        });
        ExpectedTable::compute(scene, &in_range.collect::<Vec<_>>(), Accuracy::Quick)
    })
}

/// How many faces the model has.
fn facets(scene: &Scene) -> usize {
    let face = |triangle: &Triangle| (triangle.parent_mesh_object, triangle.facet);
    scene.triangles().chunk_by(|a, b| face(a) == face(b)).count()
}
