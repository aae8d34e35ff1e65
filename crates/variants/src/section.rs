//! The handout's sections, as far as a difference can belong to one.

use serde::Serialize;

/// The sections of the handout in which a photon's path is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Section {
    /// How the photon leaves the light.
    #[serde(rename = "Photon Emission")]
    PhotonEmission,
    /// Which hits are stored, and when the path must end.
    #[serde(rename = "Photon Storage")]
    PhotonStorage,
    /// The roulette.
    #[serde(rename = "Photon Scattering/Absorption")]
    PhotonScatteringAbsorption,
    /// The direction in tangent space.
    #[serde(rename = "Hemisphere Sampling")]
    HemisphereSampling,
    /// The direction in world space, and the ray that is traced along it.
    #[serde(rename = "Hemisphere Ray Transformation")]
    HemisphereRayTransformation,
}

impl Section {
    /// All of them, in the handout's order.
    pub const ALL: [Self; 5] = [
        Self::PhotonEmission,
        Self::PhotonStorage,
        Self::PhotonScatteringAbsorption,
        Self::HemisphereSampling,
        Self::HemisphereRayTransformation,
    ];

    /// The section's title in the handout.
    pub fn title(self) -> &'static str {
        match self {
            Self::PhotonEmission => "Photon Emission",
            Self::PhotonStorage => "Photon Storage",
            Self::PhotonScatteringAbsorption => "Photon Scattering/Absorption",
            Self::HemisphereSampling => "Hemisphere Sampling",
            Self::HemisphereRayTransformation => "Hemisphere Ray Transformation",
        }
    }
}
