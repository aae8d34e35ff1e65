//! The offsets under which records come to lie in place, by least squares.

use glam::{DMat4, DVec4, Vec3};

use crate::explain::Story;
use crate::fair::{Fair, Shift, needed};
use crate::fair_search::{LONGEST_OFFSET, LOOSE, Score, Search, Window, matches};

/// The steps of the least squares.
const STEPS: usize = 6;

impl Search<'_> {
    /// `fair` with the simplest offsets under which records come to lie in place.
    pub(crate) fn fit_offsets(&self, fair: &Fair, windows: &[Window]) -> (Fair, Score) {
        let [start_n, start_b, stored_n, stored_b] = [1_u8, 2, 4, 8];
        let supports = [
            0,
            start_n,
            start_b,
            stored_n,
            stored_b,
            start_n | stored_n,
            start_b | stored_b,
            start_n | stored_b,
            start_b | stored_n,
            start_n | start_b | stored_b,
            15,
        ];
        let mut best = (*fair, self.score(fair, windows));
        for support in &supports[1..] {
            if best.1.is_tight() {
                break;
            }
            let fitted = self.fit(fair, *support, windows);
            let score = self.score(&fitted, windows);
            let margin = 0.02 * score.loose as f32 + 1.0;
            if score.tight as f32 > best.1.tight as f32 + margin {
                best = (fitted, score);
            }
        }
        // Whoever starts the ray elsewhere may have no offset along the normal.
        let mut bare = best.0;
        bare.start.along_normal = -needed(self.run);
        let bare = if support_of(&best.0) == 0 {
            bare
        } else {
            self.fit(&bare, support_of(&best.0) & !1, windows)
        };
        let score = self.score(&bare, windows);
        if score.loose >= best.1.loose && score.distance < 0.8 * best.1.distance {
            best = (bare, score);
        }
        best
    }

    /// Least squares, each residual weighted by the inverse of its length: of the offsets in
    /// `support`.
    fn fit(&self, fair: &Fair, support: u8, windows: &[Window]) -> Fair {
        let step = 5e-5 * self.size;
        let mut fair = *fair;
        let lowest = -needed(self.run);
        for _ in 0..STEPS {
            let mut matrix = [[0.0_f64; 4]; 4];
            let mut right = [0.0_f64; 4];
            for window in windows {
                let Some(story) = fair.story(self.run, window.photon) else { continue };
                let stored = fair.stored(&story);
                let shifted: [Option<(Story, Vec<Vec3>)>; 4] = std::array::from_fn(|at| {
                    let moved = moved(&fair, at, step);
                    let story = (support >> at & 1 == 1)
                        .then(|| moved.story(self.run, window.photon))??;
                    let stored = moved.stored(&story);
                    Some((story, stored))
                });
                for (model, place) in matches(&stored, window, LOOSE * self.size) {
                    let residual = window.positions[place] - stored[model];
                    let weight = 1.0 / f64::from(residual.length().max(1e-6 * self.size));
                    let slope = |at: usize| {
                        let Some((other, positions)) = &shifted[at] else { return Vec3::ZERO };
                        let same = other.hits.get(model + 1).is_some_and(|hit| {
                            let here = &story.hits[model + 1];
                            (hit.surface_index, hit.facet) == (here.surface_index, here.facet)
                        });
                        if same { (positions[model] - stored[model]) / step } else { Vec3::ZERO }
                    };
                    let slopes: [Vec3; 4] = std::array::from_fn(slope);
                    for row in 0..4 {
                        right[row] += weight * f64::from(slopes[row].dot(residual));
                        for column in 0..4 {
                            matrix[row][column] +=
                                weight * f64::from(slopes[row].dot(slopes[column]));
                        }
                    }
                }
            }
            let change = solve(matrix, right);
            for (at, change) in change.into_iter().enumerate() {
                let longest = f64::from(LONGEST_OFFSET * self.size);
                fair = moved(&fair, at, change.clamp(-longest, longest) as f32);
            }
            // Below the surface, no ray could leave it.
            fair.start.along_normal = fair.start.along_normal.max(lowest);
        }
        let longest = fair.start.length().max(fair.stored.length());
        // What is longer is no fair offset: it is not tried any further.
        if longest > 1.1 * LONGEST_OFFSET * self.size {
            (fair.start, fair.stored) = (Shift::default(), Shift::default());
        }
        fair
    }
}

/// Which offsets of `fair` are not 0.
fn support_of(fair: &Fair) -> u8 {
    let lengths =
        [fair.start.along_normal, fair.start.back, fair.stored.along_normal, fair.stored.back];
    lengths.iter().enumerate().map(|(at, length)| u8::from(*length != 0.0) << at).sum()
}

/// `fair` with its offset number `at` longer by `change`.
fn moved(fair: &Fair, at: usize, change: f32) -> Fair {
    let mut fair = *fair;
    match at {
        0 => fair.start.along_normal += change,
        1 => fair.start.back += change,
        2 => fair.stored.along_normal += change,
        _ => fair.stored.back += change,
    }
    fair
}

/// The solution of four linear equations; 0 for unknowns that nothing depends on.
fn solve(mut matrix: [[f64; 4]; 4], right: [f64; 4]) -> [f64; 4] {
    let largest = (0..4).map(|at| matrix[at][at]).fold(f64::MIN_POSITIVE, f64::max);
    for (at, row) in matrix.iter_mut().enumerate() {
        // A ridge keeps two offsets that do the same from growing against each other.
        row[at] += if row[at] == 0.0 { largest } else { 1e-9 * largest };
    }
    (DMat4::from_cols_array_2d(&matrix).inverse() * DVec4::from_array(right)).to_array()
}
