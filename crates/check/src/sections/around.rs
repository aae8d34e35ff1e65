//! Directions around an axis, counted over millions of calls, for those who draw from `<random>`:
//! their numbers are unknown. 360 degrees, taken for radians, go around 57.296 times. So 0.296 of
//! the circle gets 58 turns, and the rest 57.

use std::f64::consts::TAU;

use super::turns::NO_EFFECT;
use crate::statistics::kuiper_limit;

/// An arc with more directions than this many standard deviations is no chance: 7.6e-7 for any of
/// 1,440 arcs, each with 5.3e-10.
const SCORE: f64 = 6.1;
/// Neighbors in the circle differ by so many standard deviations where numbers are few, as in
/// `dist(engine) % 100`.
const JUMP: f64 = 6.0;
/// An arc has two ends. More jumps come from numbers that are few.
const MOST_JUMPS: usize = 8;

/// Where directions are more than elsewhere, as degrees leave it.
#[derive(Debug, PartialEq)]
struct Arc {
    /// What the random number was multiplied with.
    degrees: f64,
    /// The part of the circle.
    width: f64,
    /// The part of the directions that it has.
    found: f64,
    /// The part that it has if degrees are taken for radians.
    expected: f64,
}

/// Why an angle looks like degrees: the sentence on it.
pub(super) fn degrees(counts: &[u32], angle: &str) -> Option<String> {
    let Arc { degrees, width, found, expected } = arc(counts)?;
    let total: u64 = counts.iter().copied().map(u64::from).sum();
    Some(format!(
        "{angle} looks like degrees, {degrees} times the random number: {:.2} % of the circle has \
         {:.2} % of {total} directions; degrees taken for radians leave {:.2} % there",
        100.0 * width,
        100.0 * found,
        100.0 * expected
    ))
}

/// What an arc of the circle has more than its share, as a part of all directions; nothing where
/// chance or few numbers explain it.
pub(super) fn unevenness(counts: &[u32]) -> Option<f64> {
    let total: f64 = counts.iter().copied().map(f64::from).sum();
    let uneven = range(excess(counts).into_iter());
    let is_even = uneven < kuiper_limit(total) + NO_EFFECT;
    (!is_even && !is_coarse(counts)).then_some(uneven)
}

fn is_coarse(counts: &[u32]) -> bool {
    let counts: Vec<_> = counts.iter().copied().map(f64::from).collect();
    let sigma = (2.0 * counts.iter().sum::<f64>() / counts.len() as f64).sqrt();
    let jumps = counts.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > JUMP * sigma);
    jumps.count() > MOST_JUMPS
}

/// The part of the directions before each place on the circle, less what is even.
fn excess(counts: &[u32]) -> Vec<f64> {
    let total = counts.iter().copied().map(f64::from).sum::<f64>().max(1.0);
    let even = 1.0 / counts.len() as f64;
    let steps = counts.iter().scan(0.0, |sum, count| {
        let before = *sum;
        *sum += f64::from(*count) / total - even;
        Some(before)
    });
    steps.collect()
}

fn range(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
}

/// The arc that degrees leave, if they explain the directions and chance does not.
fn arc(counts: &[u32]) -> Option<Arc> {
    let total: f64 = counts.iter().copied().map(f64::from).sum();
    let bins = counts.len();
    let excess = excess(counts);
    let mut best: Option<(f64, Arc)> = None;
    for degrees in [360.0, 180.0] {
        let turns = degrees / TAU;
        let whole = (turns.fract() * bins as f64).round() as usize;
        let width = whole as f64 / bins as f64;
        let expected = width * turns.ceil() / turns;
        let more = expected - width;
        for start in 0..bins {
            let found = width + excess[(start + whole) % bins] - excess[start];
            if (found - width) * total.sqrt() < SCORE * (width * (1.0 - width)).sqrt() {
                continue;
            }
            // What is left where the arc's excess is taken away.
            let rest = range((0..bins).map(|i| {
                let after = excess[(start + i) % bins];
                let along =
                    (i as f64 / whole as f64).min((bins - i) as f64 / (bins - whole) as f64);
                after - more * along
            }));
            if rest < kuiper_limit(total) && best.as_ref().is_none_or(|(least, _)| rest < *least) {
                best = Some((rest, Arc { degrees, width, found, expected }));
            }
        }
    }
    Some(best?.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::AROUND_BINS;
    use photon_mapping::random::photon_random;

    /// Of so many directions, each from a number in [0, 1), in turns.
    fn counts(directions: u32, angle: impl Fn(f64) -> f64) -> Vec<u32> {
        let mut rand = photon_random(7, 0);
        let mut counts = vec![0; AROUND_BINS];
        for _ in 0..directions {
            let turn = angle(f64::from(rand())).rem_euclid(1.0);
            counts[(turn * AROUND_BINS as f64) as usize % AROUND_BINS] += 1;
        }
        counts
    }

    #[test]
    fn degrees_are_told_from_what_is_even_and_from_other_gaps() {
        for (factor, directions) in [(360.0, 2_000_000), (360.0, 1_200_000), (180.0, 500_000)] {
            for (begin, sign) in [(0.0, 1.0), (0.3, -1.0)] {
                let found = arc(&counts(directions, |u| begin + sign * factor / TAU * u));
                assert_eq!(found.expect("an arc").degrees, factor);
            }
        }
        // The second one is that of pi = 3.14.
        for turns in [1.0, 1.0 - 5e-4, 2.0] {
            let even = counts(2_000_000, |u| turns * u);
            assert_eq!((arc(&even), unevenness(&even)), (None, None), "{turns}");
        }
        let gap = counts(2_000_000, |u| 2.0 * 3.1 / TAU * u);
        assert!(arc(&gap).is_none() && unevenness(&gap).is_some());
    }

    #[test]
    fn few_numbers_are_even() {
        for few in [100.0, 360.0, 1000.0] {
            let coarse = counts(2_000_000, |u| (few * u).floor() / few);
            assert_eq!((arc(&coarse), unevenness(&coarse)), (None, None), "{few}");
        }
        assert_eq!((arc(&[0; AROUND_BINS]), unevenness(&[0; AROUND_BINS])), (None, None));
    }
}
