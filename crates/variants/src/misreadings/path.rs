//! Misreadings of how photons leave the light, and of which are stored.

use super::{BOUNCE_OFF_BY_ONE, Entry};
use crate::sampling::Emission;
use crate::section::Section;
use crate::variation::{Storage, Variation};

pub(super) fn emission() -> Vec<Entry> {
    let of = |emission| Variation { emission, ..Variation::default() };
    let section = Section::PhotonEmission;
    let signs = "Every direction is as likely: x, y and z each go from -1 to 1, as 2 u - 1 does.";
    vec![
        Entry::new(
            "cube-directions",
            section,
            "Draw x, y and z again while x^2 + y^2 + z^2 > 1, before you normalize.",
            [
                (
                    "directions from the light come from the whole cube, not the sphere",
                    of(Emission::Cube),
                ),
                ("x + y + z is compared with 1, without squares", of(Emission::BelowPlane)),
            ],
        ),
        Entry::new(
            "octant-directions",
            section,
            signs,
            [(
                "photons leave the light into one octant: x, y and z are never negative",
                of(Emission::Octant),
            )],
        ),
        Entry::new(
            "half-directions",
            section,
            signs,
            [
                ("photons leave the light downward only", of(Emission::Down)),
                ("photons leave the light upward only", of(Emission::Up)),
            ],
        ),
        Entry::new(
            "polar-directions",
            section,
            "An even polar angle crowds directions at the poles. Draw x, y and z in [-1, 1), again \
             while x^2 + y^2 + z^2 > 1, and normalize.",
            [
                (
                    "the polar angle from the light is even, about the z axis",
                    of(Emission::PolarAboutZ),
                ),
                (
                    "the polar angle from the light is even, about the y axis",
                    of(Emission::PolarAboutY),
                ),
            ],
        ),
        Entry::new(
            "rejection-reversed",
            section,
            "The loop keeps the points that it should reject: repeat WHILE x^2 + y^2 + z^2 > 1.",
            [(
                "directions from the light come from outside the sphere",
                of(Emission::OutsideSphere),
            )],
        ),
    ]
}

pub(super) fn storage() -> Vec<Entry> {
    let plain = Variation::default();
    let of = |storage| Variation { storage, ..Variation::default() };
    let section = Section::PhotonStorage;
    let not_direct = "Store a photon only where the size of 'path' is larger than 1, and let \
                      'path' grow with every call.";
    vec![
        Entry::new(
            "direct-stored",
            section,
            not_direct,
            [("photons straight from the light are stored as well", of(Storage::All))],
        ),
        Entry::new(
            "direct-only",
            section,
            "Photons are stored before they bounce, and not after. Store a photon where the size \
             of 'path' is LARGER than 1, and call TracePhoton again after it.",
            [("photons straight from the light are stored, and no others", of(Storage::Direct))],
        ),
        Entry::new(
            "first-bounce-only",
            section,
            "Only the first bounce of a path is stored. Let TracePhoton call itself after every \
             bounce, with the same 'path', and store while its size is larger than 1.",
            [("of every path, only the first bounce is stored", of(Storage::FirstBounce))],
        ),
        Entry::new(
            "third-hit-on",
            section,
            "The first bounce is not stored. The light is the first entry of 'path': store where \
             its size is larger than 1, not 2.",
            [("photons are stored from the third hit on, not the second", of(Storage::FromThird))],
        ),
        Entry::new(
            "absorbed-not-stored",
            section,
            "Store a photon before the roulette decides what becomes of it.",
            [("photons are stored only if they are scattered again", of(Storage::Scattered))],
        ),
        Entry::new(
            BOUNCE_OFF_BY_ONE,
            section,
            "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0.",
            [("paths end one bounce too early", Variation { fewer_bounces: 1, ..plain })],
        ),
    ]
}
