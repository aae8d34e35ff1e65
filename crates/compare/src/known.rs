//! The run that a list is compared with, as far as it is known.

use rayon::prelude::*;

use crate::explain::{Story, explain};
use crate::fair::Fair;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use variants::run::Run;

/// So many photons are traced at once.
const PIECE: u64 = 4096;

/// The reference's run, read in a fair way.
#[derive(Clone, Copy, Debug)]
pub struct KnownRun<'run> {
    /// The run.
    pub run: &'run Run,
    /// The fair way; nothing for the run's own.
    pub fair: Option<Fair>,
}

impl KnownRun<'_> {
    /// The story of photon `photon`; nothing when the run has no such photon.
    pub fn story(&self, photon: u64) -> Option<Story> {
        match &self.fair {
            None => explain(self.run, photon),
            Some(fair) => fair.story(self.run, photon),
        }
    }

    /// The fair way, that of the run itself included; nothing where the run's reading is no fair
    /// one.
    pub fn fair(&self) -> Option<Fair> {
        self.fair.or_else(|| Fair::of(self.run))
    }

    /// The list of the run read in the way `fair`.
    pub fn list(&self, fair: &Fair) -> PhotonList {
        let emitted = self.run.renderer.emitted();
        let pieces: Vec<_> = (0..emitted.div_ceil(PIECE)).collect();
        let records = pieces.into_par_iter().flat_map_iter(|piece| {
            let photons = piece * PIECE..((piece + 1) * PIECE).min(emitted);
            photons
                .filter_map(|photon| fair.story(self.run, photon))
                .flat_map(|story| self.records(fair, &story))
        });
        PhotonList::of(records.collect())
    }

    fn records(&self, fair: &Fair, story: &Story) -> Vec<PhotonRecord> {
        if story.hits.len() < 2 {
            return Vec::new();
        }
        let light = story.emission.light;
        let renderer = &self.run.renderer;
        let photons = &renderer.photons_of_lights()[light];
        let intensity =
            self.run.scene().lights()[light].color / (photons.end - photons.start) as f32;
        let hits = story.hits.windows(2).zip(fair.stored(story));
        hits.map(|(pair, position)| {
            let incoming = pair[0].direction.expect("it scattered there");
            PhotonRecord {
                position,
                intensity,
                to_light: -glam::Vec3::from_array(incoming),
                photon: story.photon as u32,
                bounce: pair[1].bounce as u16,
                surface: pair[1].surface_index as u16,
            }
        })
        .collect()
    }
}
