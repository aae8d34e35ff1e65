//! Where the judge draws its lines: each by an error rate, a resolution, or a measurement.

use std::ops::RangeInclusive;

// Error rates.

/// A submission that is as strange as this by chance alone is called incorrect, in its places, on the
/// way to a misreading, or in its marks. Of ten thousand submissions that are correct, one may be;
/// these tests and their two parts, with the number of photons and without, add up to half of
/// that. The rest leaves room for what they assume.
pub const SIGNIFICANCE: f64 = 1e-5;
/// A list with which a misreading would show what is seen, or something stranger, less often than
/// this is not explained by it.
pub(crate) const LEAST_LIKELY: f64 = 3e-3;
/// The same of pictures: two misreadings together often look a little like one.
pub(crate) const LEAST_LIKELY_IN_PICTURES: f64 = 0.02;
/// The same of self-hits, whose law is only roughly known.
pub(crate) const SELF_HITS_LEAST: f64 = 1e-4;
/// A misreading that is as rare as this is ruled out, whatever its cells say.
pub(crate) const RULED_OUT: f64 = 1e-9;
/// A name is given when it is as sure as this.
pub(crate) const SURE: f64 = 0.95;
/// Nothing is surer than this: there may be mistakes of which nobody has thought.
pub(crate) const SUREST: f64 = 0.999;
/// A constant factor of the intensity with which the photons are less likely than this does not
/// excuse them: a list that lost as many photons by chance is as likely.
pub(crate) const LEAST_LIKELY_SLIP: f64 = 0.02;

// How much rarer one thing is than another before a submission is seen.

/// By hundreds of planted faults: how much likelier all faults that are not in the table are
/// together than one that is.
pub(crate) const OUTSIDE: f64 = 0.01;
/// The same beside self-hits, whose law is only roughly known: much seems to be elsewhere.
pub(crate) const SELF_HITS_OUTSIDE: f64 = 1e-4;
/// The logarithm of how much rarer than one misreading of the table two of them at once are.
pub(crate) const RARER_PAIR: f64 = -6.0;
/// The same of each roulette that has no name.
pub(crate) const RARER_ROULETTE: f64 = -3.0;
/// The same of photons that are right but for their number.
pub(crate) const RARER_NUMBER: f64 = -2.0;

// What a course cannot fault.

/// By which part of itself the number of photons on a facet may be off for reasons that a course
/// cannot fault: where exactly a ray starts, and how far off the surface a position is stored. Of
/// 4,000,000 photons emitted, an offset of 1e-3 and positions 0.007 off moved 0.5 % of a facet's
/// photons, or 1 % where they are few. They are lost and won along edges, of which a cell has
/// more for its area: as many times more as there are cells along a side.
pub(crate) const LEEWAY: f64 = 0.006;
/// The same of the photons in corners: how many are close to one depends on how far off the surface
/// they are stored.
pub(crate) const LEEWAY_OF_CORNERS: f64 = 0.5;
/// The same of self-hits, which depend on rounding, from facet to facet.
pub(crate) const LEEWAY_OF_SELF_HITS: f64 = 0.25;
/// By how much the part of a facet's photons that show may differ from what it is thought to be,
/// where positions are off their surfaces.
pub(crate) const LEEWAY_OF_COVERAGE: f64 = 0.02;

// Resolutions.

/// So many standard deviations is a misreading away where a test of its own is needed. Closer, it is
/// seen once in 20 times; farther, a test of 72 cells sees it 999 times in 1000.
pub(crate) const NEEDED: RangeInclusive<f64> = 3.0..=14.0;

/// Counts are joined until they are expected to be so many standard deviations from none, and from
/// all that there can be: below, they are too far from normal. Of photons, 25.
pub(crate) const LEAST_DEVIATIONS: f64 = 5.0;
/// As many photons are few: the number on each facet is tested exactly.
pub(crate) const FEW_PHOTONS: usize = 125;
/// Of more bounces than these, hardly a path has the last.
pub(crate) const SMALL_LIMIT: i32 = 12;
/// When as large a part of all photons is at the same place as another one, self-hits are looked
/// for, and misreadings without them explain nothing.
pub(crate) const MANY_REPEATED: f64 = 0.03;
/// Of identical positions, more than this part of all makes every path a copy of another.
pub(crate) const ALL_COPIED: f64 = 0.95;
/// Of the records, at least this part lies on surfaces where their number is held against the
/// intensity.
pub(crate) const MOSTLY: f64 = 0.5;
