//! Where the judge draws its lines: each by an error rate, a resolution, or a measurement.

mod of_lists;
mod of_pictures;

pub(crate) use of_lists::*;
pub(crate) use of_pictures::*;

// Error rates.

/// A submission that is as strange as this by chance alone is called incorrect, in its places, in
/// its bounces, or in its marks. Of ten thousand submissions that are correct, one may be: these
/// tests and `RATE_OF_WAYS`, in two parts, with the number of photons and without, add up to
/// that.
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
/// A constant factor of the intensity with which the number of photons is less likely than this
/// does not excuse it: a list that lost as many photons by chance is as likely.
pub(crate) const LEAST_LIKELY_SLIP: f64 = 0.02;
/// A correct submission is called incorrect on its way to one of the misreadings, each of which has
/// a test, as often as this.
pub const RATE_OF_WAYS: f64 = 2e-5;
/// Before all are fitted into that, one of them has at least this: 5.6 standard deviations, which
/// nothing that is farther away fails to reach.
pub(crate) const LEAST_OF_WAY: f64 = 1e-8;
/// Of the lists of a misreading that the best test of it alone finds, its test is to find this
/// part: 0.95, and a little for what the best one knows besides, as which fair reading it is.
pub(crate) const POWER_KEPT: f64 = 0.97;
/// Where the best test finds fewer lists than this, a misreading is hidden, and has none.
pub(crate) const LEAST_POWER: f64 = 0.15;

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

// What is no photon map.

/// Photons at fewer different places are too few to recognize a photon map: hundreds of hypotheses
/// leave about as many here and there. Of 24 lists of 100 points strewn over all surfaces, three
/// are named, of 125 points one, and of 150 to 300 none.
pub(crate) const FEWEST_PLACES: f64 = 150.0;
/// When a larger part lies on one surface, no light left them. Of the planted faults, one leaves
/// 0.961 there: rays towards the point hit. Of the misreadings, one leaves 0.945.
pub(crate) const ONE_SURFACE: f64 = 0.98;
/// Where photons crowd on spots or lines, this takes the place of [`MADE_UP`]. The one planted
/// fault that crowds, numbers that come again soon, needs 0.28 at most.
pub(crate) const CROWDED: f64 = 0.4;
/// When more than this part of the photons would have to move to become those of any hypothesis,
/// nothing of the photon map is in them. Of 92 planted faults, one of two at once needs the most,
/// 0.73, and clouds of 1,000 points need 0.89 and more.
pub(crate) const MADE_UP: f64 = 0.8;
/// Where the rows and the columns with so much of the dots in their middle make up a smaller part
/// of the picture, no light left them. Patches of noise of 80 by 80 pixels come to 0.014 at most.
/// Of the misreadings with 10,000 photons emitted and more, `start-not-moved` comes to 0.021. Of
/// 5,000 correct pictures with 12 dots or more, on their surfaces and off, one comes to 0.025; but
/// with 11 dots, six of 1,300 come to less.
pub(crate) const MIDDLE: f64 = 0.8;
pub(crate) const SMALL_PART: f64 = 0.018;
pub(crate) const FEWEST_CROWDED: f64 = 20.0;
/// When less than this part would have to move to lie evenly all over every facet, and so much less
/// than to become those of any hypothesis, no light left them. Points strewn by hand need 0.015 at
/// most, and 0.09 less. Of the planted faults, the one for which this is nearest needs 0.038 and
/// more at 1,000 places: rays stop at the first triangle in the file.
pub(crate) const EVEN: f64 = 0.02;
pub(crate) const MORE_EVEN: f64 = 0.08;
/// Photons at fewer places are even by chance, and what has no name may be made up: 800 points
/// strewn evenly, with the right number on each surface, were taken for a photon map in 12 of 12
/// lists, and 1,000 in none. Of 135 misreadings with 10,000 photons emitted and known, 102 are
/// found; 45 of these have fewer photons and no name.
pub(crate) const MANY_PLACES: f64 = 1000.0;

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
/// A list with fewer different positions for each photon is a few places again and again. Copies by
/// thread have one for as many photons as there are threads.
pub(crate) const FEW_PLACES: f64 = 0.02;
/// Most, as of the records that lie on surfaces where their number is held against the intensity.
pub(crate) const MOSTLY: f64 = 0.5;
/// Nearly all, and hardly any, as of directions to the light: what is done throughout is done for
/// all but a few, at edges and by rounding.
pub(crate) const NEARLY_ALL: f64 = 0.95;
pub(crate) const HARDLY_ANY: f64 = 0.01;
/// Where a frame of the wall is not a number, a larger part of the positions is none.
pub(crate) const NAN_FRAME: f64 = 0.2;

// Single photons.

/// Self-hits of a correct submission, whose rays may start 1e-5 along their direction, are fewer.
pub(crate) const MOST_REPEATED: f64 = 0.01;
/// Photons at the same place to the last bit are no matter of where rays start: of 7 million
/// photons emitted from all fair offsets, none was, and by chance, with six digits, it is one of
/// ten million photons. A thousandth is left to programs that round more than the reference.
pub(crate) const MOST_IDENTICAL: f64 = 1e-3;
/// The part of scattered photons that come from where the light stands, within a thousandth of a
/// radian: none of 500,896, since it is one in a million by the solid angle.
pub(crate) const MOST_STRAIGHT: f64 = 1e-4;
/// A stray photon or two is left to rounding.
pub(crate) const MOST_ASTRAY: f64 = 5e-4;
/// Of a column that numbers paths, fewer records than this lack the one before.
pub(crate) const MOST_GAPS: f64 = 0.5;
/// A list of photons without a count is shorter than what the handout asks for when it fits fewer
/// photons emitted than this; with fewer than the second, what is stored is a dozen photons, which
/// tell nothing.
pub(crate) const FEW_EMITTED: f64 = 5000.0;
pub(crate) const LEAST_EMITTED: f64 = 250.0;

// Photons at the same place.

/// Photons closer together than this lie at the same place: self-hits do, and hardly any others.
pub(crate) const SAME_PLACE: f64 = 2e-5;
/// How many neighbors are looked at before a photon counts as alone.
pub(crate) const MOST_NEIGHBORS: usize = 256;
/// Rounding brings a hit no farther than this from the hit it repeats: four units in the last place
/// of an f32 between 1 and 2. Rays that start 1e-5 above a surface and go below it come back
/// farther away.
pub(crate) const BY_ROUNDING: f64 = 1e-6;

// Crowds.

/// Edges of the cubes, in world units.
pub(crate) const EDGES: [f64; 5] = [2e-5, 2e-4, 2e-3, 2e-2, 0.1];
/// Of all photons, so many at most lie on a unit of area: three times what the reference has where
/// they are densest.
pub(crate) const DENSEST: f64 = 1.0;
/// The largest area of facets in a cube of edge 1: three faces that meet.
pub(crate) const AREA_IN_CUBE: f64 = 3.0;
/// This part of the photons is left to self-hits and to paths along edges.
pub(crate) const LEFT_TO_SELF_HITS: f64 = 0.03;
/// The weights of the supermartingales that are tried.
pub(crate) const WEIGHTS_OF_SHARED: [f64; 4] = [0.5, 1.0, 2.0, 3.0];
/// Counts that are fewer standard deviations from their mean than this, as of photons that come on
/// their own, are not worth a test: of 26, one is as far by chance.
pub(crate) const WORTH: f64 = 2.5;

// Photons straight from the light.

/// So many standard deviations apart are the counts with such photons and without, at least, before
/// the counts decide: each half is far out in either tail.
pub(crate) const APART: f64 = 8.0;
/// A facet has so many times the share that it has under any mistake but this one, before it tells.
pub(crate) const PLAINLY: f64 = 5.0;
/// On so few photons, it does not.
pub(crate) const FEWEST_ON_FACET: f64 = 50.0;
/// Of the photons that come straight from the light, this part at least is left on every facet.
pub(crate) const LEFT_OF_DIRECT: f64 = 0.7;

// Self-hits.

/// How many standard deviations the places of self-hits must be towards those of first hits: what
/// is stored twice for another reason is not.
pub(crate) const FIRST_HITS_SHOW: f64 = 6.0;
/// Of the photons that a hit should scatter, self-hits leave at least so many; and of the first
/// hits, which are not stored, they make at most so many known. Both are out of reach for rounding,
/// which brings half of the starts below the surface.
pub(crate) const LEAST_SCATTERED: f64 = 0.5;
pub(crate) const MOST_FIRST_HITS: f64 = 0.5;
/// By which part of itself the number of photons that self-hits leave may be off: its prediction
/// takes the same loss for all ways to a facet. A roulette with the mean would leave a quarter
/// fewer.
pub(crate) const LEEWAY_OF_LOSS: f64 = 0.12;

// Bounces.

/// Hits are counted from 0 or from 1, and the second is the first that is stored: so the first
/// bounce of a list is 2 at most.
pub(crate) const LAST_FIRST_BOUNCE: u16 = 2;
/// By which part of itself the number of long paths may be smaller: beyond the bounces of a
/// signature, they are taken to end at the same rate.
pub(crate) const LEEWAY_OF_LONG_PATHS: f64 = 0.15;

// Numbers of photons.

/// No mistake stores more than this part of the photons emitted, unless it stores some twice: with
/// those straight from the light, it is 0.29.
pub(crate) const MOST_STORED: f64 = 1.0 / 3.0;

// Pictures.

/// Another way to do it right is tried for what is as rare as this.
pub(crate) const RARE: f64 = 0.01;
/// A few odd pixels are no dots, and as few photons no map.
pub(crate) const FEWEST_RED: f64 = 10.0;
/// When no more than this part of the pixels is left, all are red.
pub(crate) const ALL_RED: f64 = 1e-3;
/// With so many photons that less than this part of the pixels is expected to be left, nothing can
/// be told.
pub(crate) const SATURATED: f64 = 0.05;
/// By which part of itself a number of photons is not known from a picture.
pub(crate) const NUMBER_LEEWAY: f64 = 0.06;
/// With fewer groups of cells than this, anything fits that has this many numbers to choose.
pub(crate) const FEWEST_GROUPS: usize = 4;
/// But so few red pixels have no more groups.
pub(crate) const FEW_RED: f64 = 1000.0;
