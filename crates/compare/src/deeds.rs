//! What a photon does at a bounce, in words.

use crate::explain::{Ending, Hit, Story, vector};
use photon_mapping::photon_list::PhotonRecord;

pub(crate) fn place(record: &PhotonRecord) -> String {
    vector(&record.position.to_array())
}

pub(crate) fn submission_does(record: Option<&PhotonRecord>) -> String {
    match record {
        Some(record) => format!("stores a photon at {}", place(record)),
        None => "stores no such photon".to_owned(),
    }
}

/// What the reference's photon does between the hit before bounce `bounce` and that one.
pub(crate) fn reference_does(story: &Story, bounce: usize) -> String {
    let Some(last) = story.hits.last() else {
        return "leaves the light without hitting anything".to_owned();
    };
    let Some(before) = bounce.checked_sub(1) else {
        return at_first_hit(&story.hits[0]);
    };
    let Some(before) = story.hits.get(before) else {
        return format!("has ended at bounce {} on {}", last.bounce, last.surface);
    };
    let Some(hit) = story.hits.get(bounce) else {
        return match story.ending {
            Ending::Absorbed => format!(
                "is absorbed at bounce {} on {} ({} >= P_r {})",
                before.bounce, before.surface, before.roulette, before.survival
            ),
            Ending::LeftTheScene => format!(
                "scatters at bounce {} on {} and leaves the scene",
                before.bounce, before.surface
            ),
            Ending::BounceLimit => {
                format!("ends at bounce {} on {}, the last one allowed", last.bounce, last.surface)
            }
        };
    };
    format!(
        "scatters at bounce {} on {} ({} < P_r {}) and is stored on {} at {}",
        before.bounce,
        before.surface,
        before.roulette,
        before.survival,
        hit.surface,
        vector(&hit.position)
    )
}

/// What the reference's photon does at `hit`, which comes straight from the light: of this hit
/// speaks bounce 0 of a submission that stores it, or counts from 0.
fn at_first_hit(hit: &Hit) -> String {
    let (decision, sign) = if hit.scattered { ("scatters", "<") } else { ("is absorbed", ">=") };
    format!(
        "does not store the hit straight from the light on {}, and {decision} there ({} {sign} P_r \
         {})",
        hit.surface, hit.roulette, hit.survival
    )
}
