//! How often directions go around an axis while a random number goes from 0 to 1, for those who
//! draw from `rand()`: whoever takes degrees for radians goes around 57 times, which looks even.

use std::f64::consts::TAU;

use photon_mapping::assignment8;
use photon_mapping::random::photon_random;

use crate::statistics::mean;

/// An angle may follow from any of the first numbers of a call.
const FIRST_NUMBERS: usize = 4;
/// So far may an angle lie from where its number puts it, in turns: close to the axis, rounding
/// moves it.
const ROUNDING: f64 = 5e-3;
/// So few of the angles may lie farther.
const FEW: f64 = 0.02;
/// A gap or an overlap of this part of a circle has no effect: pi = 3.14 leaves half of it.
pub(super) const NO_EFFECT: f64 = 1e-3;

/// The turns that `angles` make while a number goes from 0 to 1, if they follow from one of the
/// first numbers of their calls and nothing else. Each angle, in turns, comes with the number of
/// its call.
pub(super) fn turns(angles: &[(u64, f64)]) -> Option<f64> {
    let numbers: Vec<[f64; FIRST_NUMBERS]> = angles
        .iter()
        .map(|(call, _)| {
            let mut rand = photon_random(assignment8::SEED, *call);
            std::array::from_fn(|_| f64::from(rand()))
        })
        .collect();
    (0..FIRST_NUMBERS).find_map(|index| {
        let mut pairs: Vec<_> = numbers
            .iter()
            .zip(angles)
            .map(|(numbers, (_, angle))| (numbers[index], *angle))
            .collect();
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        slope(&pairs)
    })
}

/// The slope of a straight line around a circle, through pairs of a number and an angle in turns.
fn slope(pairs: &[(f64, f64)]) -> Option<f64> {
    let steps: Vec<_> =
        pairs.windows(2).map(|pair| (pair[1].0 - pair[0].0, near(pair[1].1 - pair[0].1))).collect();
    let mut slopes: Vec<_> = steps.iter().filter(|(u, _)| *u > 0.0).map(|(u, a)| a / u).collect();
    slopes.sort_unstable_by(f64::total_cmp);
    let median = *slopes.get(slopes.len() / 2)?;
    let rest: f64 = steps.iter().map(|(u, a)| near(a - median * u)).sum();
    let slope = median + rest / (pairs.last()?.0 - pairs.first()?.0);
    // Where the line begins: the mean of angles around a circle.
    let begins = || pairs.iter().map(|(u, angle)| angle - slope * u);
    let (sines, cosines) =
        begins().map(|turn| libm::sincos(turn * TAU)).collect::<(Vec<_>, Vec<_>)>();
    let begin = libm::atan2(mean(&sines), mean(&cosines)) / TAU;
    let far = begins().filter(|turn| near(turn - begin).abs() > ROUNDING).count();
    // An angle that stays the same follows from nothing.
    (far as f64 <= FEW * pairs.len() as f64 && slope.abs() > 1e-3).then_some(slope.abs())
}

/// `angle` without whole turns, as near to 0 as can be.
fn near(angle: f64) -> f64 {
    angle - angle.round()
}

/// What is wrong with an angle that makes `turns`: the name, and what was seen.
pub(super) fn fault(turns: f64, angle: &str) -> Option<(&'static str, String)> {
    if turns > 0.5 && near(turns).abs() < NO_EFFECT {
        return None;
    }
    let factor = turns * TAU;
    let degrees = [360.0, 180.0].into_iter().find(|degrees| (factor / degrees - 1.0).abs() < 1e-3);
    Some(match degrees {
        Some(degrees) => (
            "angle-in-degrees",
            format!("{angle} is {degrees} times the random number, in radians: degrees are meant"),
        ),
        None if (turns - 0.5).abs() < NO_EFFECT => {
            ("half-azimuth", format!("{angle} is pi times the random number; expected 2 pi times"))
        }
        None => (
            "not-even-around",
            format!("{angle} is {factor:.3} times the random number; expected 2 pi = 6.283 times"),
        ),
    })
}

/// What is worth saying of an angle that makes about a whole number of `turns`.
pub(super) fn remark(turns: f64, angle: &str) -> Option<String> {
    let factor = turns * TAU;
    (near(turns).abs() > 1e-5).then(|| {
        format!(
            "{angle} is {factor:.4} times the random number, and 2 pi is 6.2832: take more digits \
             of pi. It costs nothing."
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(angle: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let angles = (0..4000).map(|call| {
            let mut rand = photon_random(assignment8::SEED, call);
            let _roulette = rand();
            let (u1, u2) = (f64::from(rand()), f64::from(rand()));
            (call, angle(u1, u2).rem_euclid(1.0))
        });
        turns(&angles.collect::<Vec<_>>())
    }

    #[test]
    fn turns_are_found_whatever_the_number_and_the_direction() {
        for turns in [0.5, 22.0 / 7.0 / std::f64::consts::PI, 1.0, 2.0, 360.0 / TAU] {
            for angle in [
                seen(|_, u2| 0.3 + turns * u2),
                seen(|u1, _| turns * u1),
                seen(|_, u2| -turns * u2),
            ] {
                assert!((angle.expect("a line") - turns).abs() < 1e-6, "{angle:?} {turns}");
            }
            let is_fault = fault(turns, "theta").is_some();
            assert_eq!(is_fault, !(0.9..=2.0).contains(&turns), "{turns}");
            assert_eq!(remark(turns, "theta").is_some(), turns.fract() != 0.0, "{turns}");
        }
    }

    #[test]
    fn what_follows_from_no_single_number_has_no_turns() {
        assert_eq!(seen(|u1, u2| u1 * u2), None);
        assert_eq!(seen(|_, u2| u2.sqrt()), None);
        assert_eq!(seen(|_, _| 0.25), None);
    }
}
