//! Are the dots of a picture where the handout leads to expect them?

use std::borrow::Cow;

use super::dotted::OfPicture;
use super::expectations::PictureExpectations;
use super::view::{PIXELS, View};
use super::words;
use crate::evidence::Evidence;
use crate::facts::ENOUGH_PHOTONS;
use crate::limits::{
    ALL_RED, FEW_EMITTED, FEWEST_CROWDED, FEWEST_DOTS, FEWEST_RED, MIDDLE, RARE, SATURATED,
    SIGNIFICANCE, SMALL_PART,
};
use crate::naming::{Explanation, candidates, most_likely};
use crate::recognized::{RECOGNIZED, made_up, not_recognized};
use crate::trial::best_trial;
use crate::verdict::{Finding, Verdict};
use photon_mapping::assignment8::WIDTH;

/// What the dots of a picture say.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureJudgment {
    /// Whether there are dots at all.
    pub has_dots: bool,
    /// The findings.
    pub findings: Vec<Finding>,
    /// The misreading, if a known one explains them.
    pub explanation: Option<Explanation>,
    /// Two misreadings that explain them together, if none does alone.
    pub pair: Option<Explanation>,
    /// How many photons were emitted: as known, or as it fits best; nothing where nothing fits.
    pub emitted: Option<f64>,
    /// The smallest p-value, corrected for the number of tests, where there were any.
    pub p_value: Option<f64>,
}

impl PictureJudgment {
    /// Whether there are dots, but not those of the handout.
    pub fn is_incorrect(&self) -> bool {
        self.has_dots && self.findings.iter().any(Finding::is_fault)
    }

    /// What these findings come to.
    pub fn verdict(&self) -> Verdict {
        let mut faults = self.findings.iter().filter(|finding| finding.is_fault()).peekable();
        match (faults.peek().is_some(), self.has_dots) {
            (false, _) => Verdict::Correct,
            (true, false) => Verdict::NoDots,
            (true, true) if faults.all(|fault| fault.check == ENOUGH_PHOTONS) => Verdict::Undecided,
            (true, true) => Verdict::Incorrect,
        }
    }
}

/// Judges the dots `red`, by pixel of `view`, where `emitted` photons were emitted, if that is
/// known.
pub fn judge_dots(
    red: &[bool],
    view: &View,
    emitted: Option<f64>,
    expectations: &PictureExpectations,
) -> PictureJudgment {
    let mut counts = vec![0.0; view.cells.len()];
    for (pixel, _) in red.iter().enumerate().filter(|(_, is_red)| **is_red) {
        if let Some(patch) = view.patch(pixel) {
            counts[view.patches[patch].cell] += 1.0;
        }
    }
    let found = counts.iter().sum::<f64>();
    let all: f64 = view.patches.iter().map(|patch| f64::from(patch.pixels)).sum();
    let mut picture = OfPicture::new(&counts, emitted, view, expectations);
    let elsewhere = red.iter().filter(|is_red| **is_red).count() as f64 - found;
    picture.elsewhere = elsewhere;
    let early = |has_dots, finding: Finding, explanation| PictureJudgment {
        has_dots,
        findings: vec![finding],
        explanation,
        pair: None,
        emitted,
        p_value: None,
    };
    if found < FEWEST_RED {
        return early(false, words::no_dots(found, elsewhere), None);
    }
    let reference = &expectations.signatures.fair[0];
    if let Some(emitted) = emitted
        && all - picture.means(reference, emitted).iter().sum::<f64>() < SATURATED * all
    {
        return early(true, words::saturated(emitted), None);
    }
    if all - found <= ALL_RED * all {
        // No number of photons of any other known misreading leaves nothing unlit.
        let mut misreadings = expectations.signatures.misreadings.iter();
        let nan = misreadings.find(|known| known.hypothesis.id == "nan-frame");
        let explanation = nan.map(|nan| Explanation::by_marks(nan.hypothesis.clone(), 0.0));
        return early(true, words::all_red(), explanation);
    }
    let mut judgment = judge_pattern(&picture);
    let part = part_with_most(red, view);
    let is_told = judgment.findings.iter().any(|finding| finding.check == RECOGNIZED);
    if found >= FEWEST_CROWDED && part < SMALL_PART && !is_told {
        let words = format!("most red pixels lie in {:.1} % of the picture", 100.0 * part);
        judgment.findings.insert(0, made_up(words));
    }
    judgment
}

/// Which part of the picture the rows and the columns make up that have most of `red` in their
/// middle.
fn part_with_most(red: &[bool], view: &View) -> f64 {
    let dots =
        red.iter().enumerate().filter(|(pixel, is_red)| **is_red && view.patch(*pixel).is_some());
    let dots: Vec<usize> = dots.map(|(pixel, _)| pixel).collect();
    let length = |along: fn(usize) -> usize| {
        let mut places: Vec<usize> = dots.iter().map(|pixel| along(*pixel)).collect();
        places.sort_unstable();
        let at = |part: f64| places[((places.len() - 1) as f64 * part).round() as usize];
        (at(0.5 + 0.5 * MIDDLE) - at(0.5 - 0.5 * MIDDLE) + 1) as f64
    };
    length(|pixel| pixel / WIDTH as usize) * length(|pixel| pixel % WIDTH as usize) / PIXELS as f64
}

fn judge_pattern(picture: &OfPicture) -> PictureJudgment {
    let mut trial = best_trial(picture);
    let mut standoff = None;
    let is_off = trial.p_value < RARE && picture.may_be_off_surface(&trial);
    let is_sparse = picture.emitted.is_none() && trial.emitted < FEW_EMITTED;
    let off_surface = (is_off || is_sparse).then(|| picture.best_trial_off_surface()).flatten();
    if let Some((off, by)) = off_surface.filter(|(off, _)| is_sparse || off.p_value > trial.p_value)
    {
        (trial, standoff) = (off, Some(by));
    }
    let is_wrong = trial.p_value < SIGNIFICANCE;
    let explained = is_wrong.then(|| {
        let joined = picture.joined();
        most_likely(picture, &joined, candidates(picture, &joined))
    });
    let [explanation, pair] = Explanation::alone_or_pair(explained.flatten());
    let unexplained: Cow<'static, str> = match &pair {
        Some(pair) => pair.two_at_once().into(),
        None => OfPicture::WORDS.unexplained.into(),
    };
    let reading = &picture.table().fair[trial.reading].hypothesis;
    let recognized =
        is_wrong.then(|| not_recognized(picture, false, explanation.is_some())).flatten();
    let of_trial = trial.findings(&reading.title, explanation.as_ref(), &unexplained);
    let mut findings: Vec<Finding> = recognized.into_iter().chain(of_trial).collect();
    let found = picture.counts.iter().sum();
    // A few dots are what may be left of any number of photons off their surfaces.
    if picture.emitted.is_none() || standoff.is_some() && found < FEWEST_DOTS {
        findings.push(words::enough(found, trial.emitted, !is_wrong));
    }
    findings.extend(standoff.map(words::off_surface));
    if let Some(Explanation { hypothesis, emitted, .. }) = &explanation {
        if picture.emitted.is_none() {
            findings.push(words::number_under(hypothesis.id, *emitted));
        }
        if hypothesis.id == "no-offset" {
            findings.push(words::self_hits());
        }
    }
    PictureJudgment {
        has_dots: true,
        findings,
        explanation,
        pair,
        emitted: Some(trial.emitted),
        p_value: Some(trial.p_value),
    }
}
