//! Where pictures are read, and their dots seen.

/// What the camera sees.
pub(crate) mod view {
    /// Patches are the pixels of one facet in one square of the picture of so many pixels a side:
    /// small enough for the density of photons to be the same all over it.
    pub(crate) const PATCH: usize = 16;
    /// Cubes around pixels that are farther apart than this, in pixels, share nothing: the closest
    /// facet is 3.1 units away, where pixels are 0.003 apart, and a cube is 0.006 wide.
    pub(crate) const NEIGHBORS: isize = 2;
    /// How finely the parts that two cubes share are told apart.
    pub(crate) const SHARES: usize = 16;
}

/// Files with pictures.
pub(crate) mod pictures {
    use photon_mapping::assignment8::{HEIGHT, WIDTH};

    /// A larger file is not read: 16 bits for each of four channels, not compressed at all, are 2.5
    /// MB. It bounds what a decoder has to unpack, too.
    pub const MOST_BYTES: u64 = 4_000_000;
    /// The same for pictures of any size: the largest that `render` draws, hardly compressed.
    pub(crate) const MOST_BYTES_OF_ANY: u64 = 1_000_000_000;
    /// The largest picture that `render` draws has so many pixels.
    pub(crate) const MOST_PIXELS: u64 = 16_384 * 16_384;
    /// A picture that is all alike is far shorter than this, unless nothing of it is compressed in
    /// the longest format.
    pub(crate) const MOST_UNPACKED: usize = (WIDTH * HEIGHT * 8) as usize;
    /// What the decoder may allocate besides the picture.
    pub(crate) const MOST_MEMORY: u64 = 16 << 20;
}

/// What is a dot.
pub(crate) mod dots {
    /// A channel of the direct light may differ by this much: programs round in other ways.
    pub(crate) const ROUNDING: u8 = 1;
    /// With a curve, such as gamma, a little more.
    pub(crate) const ROUNDING_OF_CURVE: u8 = 3;
    /// After a curve, the brightest red of more pixels than a few is that of dots.
    pub(crate) const FEWEST_FULL: usize = 3;
    /// A dot raises a channel by at least this much: the framework's red raises it by 71 or more.
    pub(crate) const LEAST_RAISE: u8 = 20;
    /// The part of the pixels that may be neither direct light nor dot, where programs disagree on
    /// which surface is seen at its edge, or lies in shadow.
    pub(crate) const MOST_ASTRAY: f64 = 0.004;
    /// The part of the surfaces' pixels where no dot could be seen: fewer than there are dots that
    /// chance adds or takes.
    pub(crate) const MOST_BLIND: f64 = 0.001;
    /// From this part on, another camera is tried.
    pub(crate) const FEW_ASTRAY: f64 = 0.0005;
    /// The part of the background that may be lit: at edges, programs disagree on what is
    /// background.
    pub(crate) const MOST_LIT_BACKGROUND: f64 = 0.02;
    /// Where dots as dark as this replace the direct light, they cannot be told from shadows.
    pub(crate) const DARK: u8 = 16;
    /// With this correlation with the direct light, it is the handout's view after all.
    pub(crate) const SAME_VIEW: f64 = 0.8;
}

/// Fewer dots, where photons are off their surfaces, are what may be left of any number of them:
/// the verdict is undecided. Ten dots of noise on a box were once called correct.
pub(crate) const FEWEST_DOTS: f64 = 60.0;

/// How large dots are.
pub(crate) mod dot_size {
    /// Up to this distance, in pixels, two pixels are looked at together.
    pub(crate) const FARTHEST: usize = 8;
    /// With fewer dots nothing is told of their size.
    pub(crate) const FEWEST_RED: usize = 200;
    /// Correlation of pixels that share nothing, from which on dots are too large. Density that
    /// differs within a patch, and paths that leave two photons side by side, come to 0.02; half as
    /// large a radius again to 0.07.
    pub(crate) const TOO_MUCH: f64 = 0.05;
}

/// How photons show as dots.
pub(crate) mod dots_of_photons {
    /// Photons of one path that are closer together than this, in world units, show as one dot.
    pub(crate) const SAME_PLACE: f32 = 1e-4;
    /// Without an offset, which part of the scattered photons meets its own surface depends on
    /// rounding: on facets that are at right angles to an axis, and on the others.
    pub(crate) const SELF_HITS: ([f32; 3], [f32; 3]) = ([0.1, 0.25, 0.4], [0.3, 0.45, 0.6]);
}
