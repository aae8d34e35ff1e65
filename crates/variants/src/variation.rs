//! One step of the assignment done in another way.

use glam::{Mat3, Vec3};

use crate::reading::{Reading, TangentBasis};

pub use crate::sampling::{Emission, Hemisphere};
pub use crate::simulation::{Simulation, survival_of_facets};

/// How many facets the assignment's scene has.
pub const FACETS: usize = 12;
/// A number for each of them. Of [`FACETS`], the compiler loses its way in closures that capture
/// it.
pub type PerFacet = [f32; 12];

/// What decides whether a photon is scattered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Roulette {
    /// The largest channel of the diffuse response: the handout's.
    #[default]
    Largest,
    /// The mean of its channels.
    Mean,
    /// Its red channel.
    Red,
    /// The smallest of its channels: in this scene, blue everywhere.
    Smallest,
    /// The sum of its channels, with these weights: its luminance.
    Weighted([f32; 3]),
    /// The square of the largest channel.
    Squared,
    /// The largest channel and this much more.
    Shifted(f32),
    /// A number in [-1, 1) is compared with the largest channel.
    Signed,
    /// A photon is scattered where the number is above the largest channel.
    Inverted,
    /// This chance, on every material; with 1, every photon is scattered.
    Constant(f32),
    /// These chances, on materials of which the red is above a half, and on others.
    ByMaterial([f32; 2]),
}

impl Roulette {
    /// The chance that a photon is scattered by a material of this diffuse response.
    pub fn survival(self, diffuse: Vec3) -> f32 {
        let largest = diffuse.max_element();
        let chance = match self {
            Self::Largest => largest,
            Self::Mean => diffuse.element_sum() / 3.0,
            Self::Red => diffuse.x,
            Self::Smallest => diffuse.min_element(),
            Self::Weighted(weights) => diffuse.dot(Vec3::from_array(weights)),
            Self::Squared => largest * largest,
            Self::Shifted(more) => largest + more,
            Self::Signed => 0.5 + 0.5 * largest,
            Self::Inverted => 1.0 - largest,
            Self::Constant(chance) => chance,
            Self::ByMaterial([bright, dark]) => {
                if diffuse.x > 0.5 {
                    bright
                } else {
                    dark
                }
            }
        };
        chance.clamp(0.0, 1.0)
    }
}

/// What becomes of the matrix from tangent space to world space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transformation {
    /// Its columns are t, b and n.
    #[default]
    AsRead,
    /// It is forgotten.
    Forgotten,
    /// Its columns are these of t, b and n.
    Columns([usize; 3]),
    /// Its rows are t, b and n.
    Rows,
    /// b has length 1, t is as it is written.
    HalfNormalized,
}

/// Which hits are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Storage {
    /// All but the first: the handout's.
    #[default]
    Indirect,
    /// All.
    All,
    /// The first alone.
    Direct,
    /// The second alone.
    FirstBounce,
    /// All from the third on.
    FromThird,
    /// All but the first, where the photon is scattered again.
    Scattered,
}

impl Storage {
    /// Whether the hit after `bounces` others is stored.
    pub fn stores(self, bounces: u16, is_scattered: bool) -> bool {
        match self {
            Self::Indirect => bounces > 0,
            Self::All => true,
            Self::Direct => bounces == 0,
            Self::FirstBounce => bounces == 1,
            Self::FromThird => bounces > 1,
            Self::Scattered => bounces > 0 && is_scattered,
        }
    }

    /// The number of bounces before the first hit that is stored.
    pub fn first(self) -> u16 {
        match self {
            Self::All | Self::Direct => 0,
            Self::FromThird => 2,
            _ => 1,
        }
    }
}

/// Where scattered rays start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// Where the photon hit.
    #[default]
    Hit,
    /// Where the light stands.
    Light,
    /// At (0, 0, 0).
    Zero,
}

/// One step, or none, of the reference done in another way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Variation {
    /// How the handout is read where it leaves something open.
    pub reading: Reading,
    /// How a direction from the light is sampled.
    pub emission: Emission,
    /// What decides whether a photon is scattered.
    pub roulette: Roulette,
    /// How many hits scatter every photon before the roulette begins.
    pub sure_hits: u16,
    /// How a direction over the surface is sampled.
    pub hemisphere: Hemisphere,
    /// What becomes of the matrix to world space.
    pub frame: Transformation,
    /// Where scattered rays start.
    pub start: Start,
    /// Which hits are stored.
    pub storage: Storage,
    /// Whether u1 and u2 come again as the next numbers of the path.
    pub repeats_numbers: bool,
    /// Whether photons leave along the normal where t and b are not numbers, as where a safe
    /// normalization leaves them at zero.
    pub zero_frame: bool,
    /// Whether normals point to the other side.
    pub flipped_normal: bool,
    /// How many bounces fewer than allowed.
    pub fewer_bounces: i32,
    /// How often a photon may bounce at most, if not as often as allowed.
    pub most_bounces: Option<i32>,
    /// For each facet, the part of its scattered photons that meet it again, by rounding.
    pub self_hits: PerFacet,
}

impl Variation {
    /// Whether the fast path can trace it: it knows readings, materials and normals.
    pub fn is_fast(&self) -> bool {
        let known = Self {
            reading: self.reading,
            roulette: self.roulette,
            zero_frame: self.zero_frame,
            flipped_normal: self.flipped_normal,
            fewer_bounces: self.fewer_bounces,
            most_bounces: self.most_bounces,
            ..Self::default()
        };
        *self == known
            && self.reading.tangent_basis != TangentBasis::Transposed
            && !self.makes_nan()
    }

    /// Whether photons straight from the light are stored.
    pub fn stores_direct(&self) -> bool {
        self.storage.first() == 0
    }

    /// Whether photons get below surfaces, or meet those they leave: a scattered direction may
    /// point there.
    pub fn goes_below(&self) -> bool {
        self.flipped_normal
            || self.reading.tangent_basis == TangentBasis::Transposed
            || matches!(
                self.frame,
                Transformation::Forgotten | Transformation::Columns(_) | Transformation::Rows
            )
            || self.hemisphere.goes_below()
            || self.start != Start::Hit
    }

    /// The matrix from tangent space to world space at a surface with the unit vector `normal`.
    pub fn tangent_frame(&self, normal: Vec3) -> Mat3 {
        let read = self.reading.tangent_frame(normal);
        match self.frame {
            Transformation::AsRead => read,
            Transformation::Forgotten => Mat3::IDENTITY,
            Transformation::Rows => read.transpose(),
            Transformation::Columns(columns) => {
                let [x, y, z] = columns.map(|column| read.col(column));
                Mat3::from_cols(x, y, z)
            }
            Transformation::HalfNormalized => {
                let letter =
                    Reading { tangent_basis: TangentBasis::LetterOfTheHandout, ..self.reading };
                let written = letter.tangent_frame(normal);
                Mat3::from_cols(written.x_axis, written.y_axis.normalize(), normal)
            }
        }
    }

    /// Whether the frame of the right wall has columns that are not numbers.
    pub(crate) fn makes_nan(&self) -> bool {
        self.tangent_frame(Vec3::NEG_X).is_nan()
    }
}
