//! What a run is held against.

use std::ops::Range;

use model::facets::facets;
use oracle::Accuracy;
use oracle::summary::{SurfaceSummary, Tally};
use oracle::table::ExpectedTable;
use variants::reading::Reading;
use variants::run::Run;
use variants::sampler::Sampler;

/// Expecting takes seconds at this many faces, and grows with their square; tracing does not.
const MOST_FACETS_TO_EXPECT: usize = 40;

/// The tally of the photons `photons` beside what is expected, and all surfaces together.
pub fn beside_expected(
    is_built_in: bool,
    run: &Run,
    photons: &Range<u64>,
    tally: &Tally,
) -> (Vec<SurfaceSummary>, SurfaceSummary) {
    let emitted = photons.end - photons.start;
    let expected = expected(is_built_in, run, photons);
    let max_bounces = run.renderer.max_photon_bounces as usize;
    let (mut surfaces, mut total) = tally.surfaces(emitted, max_bounces, expected.as_ref());
    if run.sampler != Sampler::ChaCha {
        // Standard deviations are those of independent photons.
        surfaces.iter_mut().chain([&mut total]).for_each(SurfaceSummary::forget_z);
    }
    (surfaces, total)
}

/// What the photons of a run are expected to do, where that is known or soon computed.
fn expected(is_built_in: bool, run: &Run, photons: &Range<u64>) -> Option<ExpectedTable> {
    let scene = run.scene();
    if run.reading != Reading::REFERENCE {
        return None;
    }
    if is_built_in {
        return Some(ExpectedTable::of_assignment8());
    }
    (facets(scene).count() <= MOST_FACETS_TO_EXPECT)
        .then(|| ExpectedTable::compute(scene, &shares(run, photons.clone()), Accuracy::Quick))
}

/// How many of the photons `photons` each light emits.
pub fn shares(run: &Run, photons: Range<u64>) -> Vec<u64> {
    let of_lights = run.renderer.photons_of_lights().into_iter();
    let in_range = of_lights.map(|of_light| {
        let start = of_light.start.max(photons.start);
        of_light.end.min(photons.end).saturating_sub(start)
    });
    in_range.collect()
}
