//! Where lists are read and counted.

/// Where on the scene a photon lies.
pub(crate) mod places {
    /// How far off its surface a stored position may be, in world units: the handout does not say
    /// where exactly, and the largest distance that counts as fair is 7e-3.
    pub(crate) const FAR_OFF: f64 = 7.5e-3;
    /// Photons this close to where another facet meets theirs are counted apart: which of the two
    /// they belong to cannot be told of a position that is slightly off.
    pub const MARGIN: f64 = 0.012;
    /// A facet is large by its longest edge, and has so many cells along each side.
    pub(crate) const LARGE: f64 = 1.5;
    pub(crate) const CELLS_OF_LARGE: usize = 4;
    pub(crate) const CELLS_OF_SMALL: usize = 2;
    /// Along each side of a facet, to measure its cells: 256 in a small cell's.
    pub(crate) const PROBES: usize = 64;
}

/// Paths that are counted, for few photons.
pub(crate) mod few {
    /// With so many photons emitted: 20,000 are stored, and what one in a thousand of them does is
    /// known within a quarter.
    pub(crate) const EMITTED: u64 = 400_000;
    /// Their seed.
    pub(crate) const SEED: u64 = 0x9_2020;
}

/// Lists in the model's axes.
pub(crate) mod axes {
    /// How many records are looked at.
    pub(crate) const PROBES: usize = 10_000;
    /// In the axes they are in, [`super::super::NEARLY_ALL`] photons lie on surfaces; in others,
    /// hardly more than half do.
    pub(crate) const HARDLY_ALL: f64 = 0.8;
}

/// Lists that follow the streams of the reference.
pub(crate) mod exact {
    /// The part of the records that may differ by rounding alone, where light grazes an edge.
    pub(crate) const BY_ROUNDING: f32 = 1e-3;
    /// How many photons are looked at to see whether a list follows our streams.
    pub(crate) const PROBES: usize = 200;
    /// How far apart two hits may be that count as one, in world units.
    pub(crate) const SAME_HIT: f32 = 1e-2;
    /// A run of more photons is not traced again, and a list of more records not held against it:
    /// both lists are in memory then.
    pub(crate) const MOST_PHOTONS: u64 = 20_000_000;
    pub(crate) const MOST_COMPARED: usize = 2_000_000;
}

/// What lists say of themselves.
pub(crate) mod observation {
    /// An intensity whose inverse is less is none of so many photons, but a color left as it is,
    /// perhaps times a constant.
    pub(crate) const LEAST_NUMBER: f64 = 100.0;
    /// In a list with fewer decimals than this, photons lie at the same place by rounding alone:
    /// with three, three in a hundred of the photons of ten million emitted.
    pub(crate) const FEWEST_DECIMALS: i32 = 4;
    /// With fewer decimals than this, a self-hit close by may be rounded to the very place it left.
    pub(crate) const EXACT_DECIMALS: i32 = 6;
}

/// Lists and pictures of this program.
pub(crate) mod own {
    /// The seeds that people take, besides the one that the course names.
    pub(crate) const SEEDS: u64 = 256;
    /// Of each run the photons of so many emitted are looked for. They do not depend on how many
    /// there are in all.
    pub(crate) const EMITTED: u64 = 4000;
    /// So far apart is a photon that was moved a little, in each coordinate.
    pub(crate) const NEAR: f32 = 3e-3;
    /// Of a run's photons, this part must be there: also a tenth of a list has it. In pictures,
    /// dots lie upon each other.
    pub(crate) const FOUND: f64 = 0.08;
    pub(crate) const FOUND_IN_PICTURES: f64 = 0.4;
    /// So many standard deviations more than what chance finds of any run: of 257 runs, the best
    /// has 3.5, and more where chance finds few.
    pub(crate) const ABOVE_CHANCE: f64 = 7.0;
}

/// The number of photons that fits best.
pub(crate) mod expected {
    /// The numbers of photons emitted between which it is sought, where it is not known.
    pub(crate) const SIZES: [f64; 2] = [1.0, 1e9];
    /// The steps of Gauss and Newton towards it.
    pub(crate) const STEPS: usize = 3;
    /// Of fewer counts than this, the total tells the number best: most cells have none.
    pub(crate) const FEW: f64 = 250.0;
    /// A count is known up to one photon, or pixel: more than the normal law has where few are
    /// expected.
    pub(crate) const VARIANCE_OF_ONE: f64 = 1.0;
}

/// A list beside a picture.
pub(crate) mod submission {
    /// A list and a picture of one run have more than this part of their red pixels in common.
    pub(crate) const TOGETHER: f64 = 0.5;
    /// Of fewer red pixels, it is not said that they do not.
    pub(crate) const FEWEST_DOTS: f64 = 100.0;
    /// A longer list is not read to its end: one of the whole assignment has 50,000 records, one
    /// with ten million photons and every mistake at once has fewer than this.
    pub const MOST_RECORDS: usize = 5_000_000;
    /// Of [`super::super::FEW_EMITTED`] photons, so many are stored: one in twenty.
    pub(crate) const FEW_STORED: u32 = super::super::FEW_EMITTED as u32 / 20;
}
