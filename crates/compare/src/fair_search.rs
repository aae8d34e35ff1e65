//! Which fair way to do the assignment explains what a submission stores?
//!
//! First the draws, which decide what photons are stored at all; then the frame, with a tolerance
//! so wide that no offset matters; then the offsets, by least squares.

use glam::Vec3;
use rayon::prelude::*;

use crate::fair::{Fair, HitDraws, normals};
use crate::position_index::PositionIndex;
use crate::tries::Tries;
use variants::frame::Frame;
use variants::run::Run;

/// A longer offset loses photons near edges, and is no fair one. As a part of the scene's longest
/// edge.
pub const LONGEST_OFFSET: f32 = 3.5e-3;
/// Positions this far apart may be the same hit seen from another start. As a part of the longest
/// edge.
pub(crate) const LOOSE: f32 = 0.025;
/// So many photons decide which frames are looked at closely.
const FIRST_LOOK: usize = 24;
/// So many frames are looked at closely.
const FINALISTS: usize = 8;
/// Fewer records that match under a reading, and not before, prove nothing.
const FEWEST: usize = 3;

/// What the submission may have stored of one photon.
#[derive(Clone, Debug)]
pub struct Window {
    /// The photon.
    pub photon: u64,
    /// Its positions; where the list does not tell the photon, those near its place in the list.
    pub positions: Vec<Vec3>,
    /// Whether these are this photon's and no others.
    pub is_exact: bool,
}

/// What is searched with.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    /// The reference's run.
    pub run: &'a Run,
    /// How far apart two positions may be that count as one, in world units.
    pub tolerance: f32,
    /// The scene's longest edge, in world units.
    pub size: f32,
}

/// How well a reading explains the windows, step by step along each path, up to the first that does
/// not fit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Score {
    /// Records in about the right place.
    pub(crate) loose: usize,
    /// Records in the right place.
    pub(crate) tight: usize,
    /// Photons that went elsewhere.
    elsewhere: usize,
    /// The sum of the distances.
    pub(crate) distance: f32,
}

impl Score {
    fn add(mut self, other: Self) -> Self {
        self.loose += other.loose;
        self.tight += other.tight;
        self.elsewhere += other.elsewhere;
        self.distance += other.distance;
        self
    }

    /// Whether the directions are right, whatever the roulette does.
    pub(crate) fn is_right_way(&self) -> bool {
        self.loose >= FEWEST && self.loose >= 9 * self.elsewhere
    }

    /// Whether hardly a record is only about in place.
    pub(crate) fn is_tight(&self) -> bool {
        100 * self.tight >= 97 * self.loose
    }
}

impl Search<'_> {
    /// The part of `photons`, which the submission stores, that scatter at their first hit under
    /// `fair`: all do where the draws are the same.
    pub fn scattered_part(&self, fair: &Fair, photons: &[u64]) -> f32 {
        let scatters = |photon: &&u64| {
            let story = fair.story(self.run, **photon);
            story.is_some_and(|story| story.hits.first().is_some_and(|hit| hit.scattered))
        };
        photons.iter().filter(scatters).count() as f32 / photons.len().max(1) as f32
    }

    /// The part of `photons`, which the submission stores, that hit anything under `fair`.
    pub fn hitting_part(&self, fair: &Fair, photons: &[u64]) -> f32 {
        let hits = |photon: &&u64| {
            fair.story(self.run, **photon).is_some_and(|story| !story.hits.is_empty())
        };
        photons.iter().filter(hits).count() as f32 / photons.len().max(1) as f32
    }

    /// `base` with the draws in the order in which nearly all of `photons` scatter; nothing where
    /// none is.
    pub fn draws(&self, base: &Fair, photons: &[u64]) -> Option<Fair> {
        let orders = [[0, 1, 2], [2, 1, 0], [1, 0, 2], [0, 2, 1], [1, 2, 0], [2, 0, 1]];
        let mut all = Vec::new();
        for roulette in [[0, 1, 2], [2, 0, 1], [1, 0, 2]] {
            for order in orders {
                for signs in 0..8 {
                    let turned = [1, 2, 4].map(|bit| signs & bit != 0);
                    let draws = HitDraws { order: roulette, complement: false };
                    all.push(Fair { tries: Tries { order, turned, ..base.tries }, draws, ..*base });
                }
            }
        }
        let parts: Vec<_> = all.par_iter().map(|fair| self.scattered_part(fair, photons)).collect();
        let best = parts.iter().copied().fold(0.0, f32::max);
        let first = parts.iter().position(|part| *part >= best - 0.005)?;
        (best > 0.9).then(|| all[first])
    }

    /// The fair way with the draws of `base` that explains most of `windows`; nothing where none
    /// explains clearly more than `base` does.
    pub fn best(&self, base: &Fair, windows: &[Window]) -> Option<Fair> {
        let told: Vec<_> =
            windows.iter().filter(|window| !window.positions.is_empty()).cloned().collect();
        let before = self.score(base, &told);
        let mut finalists = self.frames(base, &told);
        if finalists.is_empty() {
            let [roulette, a, b] = base.draws.order;
            for (order, complement) in
                [([roulette, b, a], false), ([roulette, a, b], true), ([roulette, b, a], true)]
            {
                let draws = HitDraws { order, complement };
                finalists = self.frames(&Fair { draws, ..*base }, &told);
                if !finalists.is_empty() {
                    break;
                }
            }
        }
        let fitted: Vec<_> =
            finalists.par_iter().map(|fair| self.fit_offsets(fair, &told)).collect();
        let mut best: Option<(Fair, Score)> = None;
        for (fair, score) in fitted {
            // A clear margin: rounding alone must not prefer what comes later, which is less
            // simple.
            if best.is_none_or(|(_, best)| score.tight as f32 > 1.01 * best.tight as f32 + 0.5) {
                best = Some((fair, score));
            }
        }
        let (fair, score) = best?;
        let gain = score.tight.saturating_sub(before.tight);
        let all = told.iter().filter(|window| window.is_exact).count();
        (gain >= FEWEST && 5 * gain >= all && score.is_right_way()).then_some(fair)
    }

    /// The fair way under which most of `photons` are stored where the list, which does not tell
    /// its photons, has any record; nothing where a quarter of them are not, or `base` does about
    /// as well.
    pub fn best_by_place(&self, base: &Fair, photons: &[u64], positions: &[Vec3]) -> Option<Fair> {
        let index = PositionIndex::new(positions, self.tolerance);
        let found = |fair: &Fair| {
            let stories = photons.iter().filter_map(|photon| fair.story(self.run, *photon));
            let stored: Vec<_> = stories.flat_map(|story| fair.stored(&story)).collect();
            let near = stored.iter().filter(|position| !index.near(**position, 0).is_empty());
            near.count() as f32 / stored.len().max(FEWEST) as f32
        };
        let fairs: Vec<_> = Frame::all(&normals(self.run))
            .into_iter()
            .map(|frame| Fair { frame, ..*base })
            .collect();
        let parts: Vec<_> = fairs.par_iter().map(found).collect();
        let most = parts.iter().copied().fold(0.0, f32::max);
        let first = parts.iter().position(|part| *part >= most)?;
        (most > 0.75 && most > 1.5 * found(base)).then(|| fairs[first])
    }

    /// How many of `windows` are explained in full under `fair`.
    pub fn explained(&self, fair: &Fair, windows: &[Window]) -> usize {
        let is_explained = |window: &&Window| {
            let Some(story) = fair.story(self.run, window.photon) else { return false };
            let stored = fair.stored(&story);
            let found = matches(&stored, window, self.tolerance);
            found.len() == stored.len()
                && (!window.is_exact || stored.len() == window.positions.len())
        };
        windows.iter().filter(is_explained).count()
    }

    /// The frames under which photons go about where the submission's went, the likeliest first.
    fn frames(&self, base: &Fair, windows: &[Window]) -> Vec<Fair> {
        let normals = normals(self.run);
        let step = windows.len() / FIRST_LOOK + 1;
        let few: Vec<_> = windows.iter().step_by(step).cloned().collect();
        let frames = Frame::all(&normals);
        let looked: Vec<_> = frames
            .par_iter()
            .map(|frame| Fair { frame: *frame, ..*base })
            .filter(|fair| {
                let score = self.score(fair, &few);
                score.loose >= 2 * score.elsewhere && score.loose > 0
            })
            .map(|fair| (fair, self.score(&fair, windows)))
            .filter(|(_, score)| score.is_right_way())
            .collect();
        let mut ranked = looked;
        ranked.sort_by(|(_, a), (_, b)| {
            let key = |score: &Score| score.distance / score.loose as f32;
            (a.elsewhere, key(a)).partial_cmp(&(b.elsewhere, key(b))).expect("finite")
        });
        // Frames that are the same on these surfaces count once: the simplest.
        let place = |fair: &Fair| frames.iter().position(|frame| *frame == fair.frame);
        let mut finalists: Vec<(Fair, Score)> = Vec::new();
        for (fair, score) in ranked {
            let same = finalists.iter_mut().find(|(_, other)| {
                (other.distance - score.distance).abs() <= 1e-4 * score.distance
                    && other.elsewhere == score.elsewhere
            });
            match same {
                Some((other, _)) if place(&fair) < place(other) => *other = fair,
                Some(_) => {}
                None => finalists.push((fair, score)),
            }
            if finalists.len() > FINALISTS {
                break;
            }
        }
        finalists.truncate(FINALISTS);
        finalists.sort_by_key(|(fair, _)| place(fair));
        finalists.into_iter().map(|(fair, _)| fair).collect()
    }

    pub(crate) fn score(&self, fair: &Fair, windows: &[Window]) -> Score {
        windows.iter().map(|window| self.score_one(fair, window)).fold(Score::default(), Score::add)
    }

    fn score_one(&self, fair: &Fair, window: &Window) -> Score {
        let mut score = Score::default();
        let Some(story) = fair.story(self.run, window.photon) else { return score };
        let stored = fair.stored(&story);
        let found = matches(&stored, window, LOOSE * self.size);
        for (model, place) in &found {
            let distance = stored[*model].distance(window.positions[*place]);
            score.loose += 1;
            score.tight += usize::from(distance <= self.tolerance);
            score.distance += distance;
        }
        let is_lost = found.len() < stored.len()
            || (window.is_exact
                && story.ending == crate::explain::Ending::LeftTheScene
                && found.len() < window.positions.len());
        // What comes after the last record of a window may be absorbed: that is the roulette's
        // matter.
        let has_more = found.last().map_or(0, |(_, place)| place + 1) < window.positions.len();
        score.elsewhere += usize::from(is_lost && has_more);
        score
    }
}

/// Which of `stored` are found within `reach` in the window, in its order, up to the first that is
/// not.
pub(crate) fn matches(stored: &[Vec3], window: &Window, reach: f32) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut from = 0;
    for (model, position) in stored.iter().enumerate() {
        let candidates = window.positions.iter().enumerate().skip(from);
        let nearest = candidates
            .map(|(place, other)| (place, other.distance(*position)))
            .filter(|(_, distance)| *distance <= reach)
            .min_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some((place, _)) = nearest else { break };
        found.push((model, place));
        from = place + 1;
    }
    found
}
