//! How large are the dots of a picture?
//!
//! Photons lie where they do on their own, so of two pixels whose cubes share nothing, one is as
//! often red beside the other as it is alone. Where dots are larger than the handout's, the same
//! photon makes both red: their correlation tells that dots are larger, and how far it reaches how
//! large.

use super::reading::WANTED;
use super::view::{PIXELS, View};
use crate::limits::dot_size::{FARTHEST, FEWEST_RED, TOO_MUCH};
use photon_mapping::assignment8::{HEIGHT, WIDTH};
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;

/// The dots of a picture, with how often each patch of the view is red.
#[derive(Clone, Debug)]
pub struct DotSize<'a> {
    red: &'a [bool],
    view: &'a View,
    /// By patch, the part of its pixels that is red.
    parts: Vec<f64>,
}

/// Two pixels of one patch, along a row or a column.
struct Pair {
    pixels: [usize; 2],
    patch: usize,
    distance: usize,
}

impl<'a> DotSize<'a> {
    /// The dots `red`, by pixel of `view`; nothing for few dots.
    pub fn new(red: &'a [bool], view: &'a View) -> Option<Self> {
        let mut of_patch = vec![0.0; view.patches.len()];
        let mut count = 0;
        for patch in (0..PIXELS).filter(|at| red[*at]).filter_map(|at| view.patch(at)) {
            of_patch[patch] += 1.0;
            count += 1;
        }
        let part = |(red, patch): (f64, &super::view::Patch)| red / f64::from(patch.pixels.max(1));
        let parts = of_patch.into_iter().zip(&view.patches).map(part).collect();
        (count >= FEWEST_RED).then_some(Self { red, view, parts })
    }

    /// Whether the dots are larger than the handout's radius makes them: to the right, and
    /// downwards.
    pub fn is_too_large(&self) -> bool {
        [[1, 0], [0, 1]].into_iter().all(|step| self.beyond(step) > TOO_MUCH)
    }

    /// The correlation, along one direction, of the pixels closest to each other that share
    /// nothing, less that of pixels that are far apart.
    fn beyond(&self, step: [usize; 2]) -> f64 {
        let (mut near, mut far) = ([0.0; 2], [0.0; 2]);
        let mut last = None;
        self.for_each_pair(step, |pair| {
            let [product, variance] = self.covariance(pair);
            if pair.distance == FARTHEST {
                far = [far[0] + product, far[1] + variance];
            }
            let share = self.view.share(pair.pixels[0], pair.pixels[1], pair.patch);
            if share == 0.0 && last != Some(pair.pixels[0]) {
                near = [near[0] + product, near[1] + variance];
                last = Some(pair.pixels[0]);
            }
        });
        near[0] / near[1].max(1e-9) - far[0] / far[1].max(1e-9)
    }

    /// How wide and how high dots are, in pixels: where two pixels cease to go together.
    pub fn extent(&self) -> [usize; 2] {
        [[1, 0], [0, 1]].map(|step| {
            let mut sums = [[0.0; 2]; FARTHEST];
            self.for_each_pair(step, |pair| {
                let [product, variance] = self.covariance(pair);
                sums[pair.distance - 1][0] += product;
                sums[pair.distance - 1][1] += variance;
            });
            let correlations = sums.map(|[product, variance]| product / variance.max(1e-9));
            let far = correlations[FARTHEST - 1];
            let is_apart = |correlation: &f64| correlation - far <= TOO_MUCH;
            1 + correlations.iter().position(is_apart).unwrap_or(FARTHEST)
        })
    }

    /// Why dots that are too large are not judged.
    pub fn reason(&self) -> String {
        let [wide, high] = self.extent();
        format!(
            "its dots are too large, up to {wide} x {high} pixels: with the framework's \
             PHOTON_DOT_RADIUS of {PHOTON_DOT_RADIUS} they are 1 or 2 pixels wide, and do not hide \
             each other: {WANTED}, with that radius"
        )
    }

    /// The product of how far both pixels are from how red their patch is, and its largest mean.
    fn covariance(&self, pair: &Pair) -> [f64; 2] {
        let part = self.parts[pair.patch];
        let [a, b] = pair.pixels.map(|pixel| f64::from(u8::from(self.red[pixel])) - part);
        [a * b, part * (1.0 - part)]
    }

    fn for_each_pair(&self, [right, down]: [usize; 2], mut found: impl FnMut(&Pair)) {
        for pixel in 0..PIXELS {
            let Some(patch) = self.view.patch(pixel) else { continue };
            let (column, row) = (pixel % WIDTH as usize, pixel / WIDTH as usize);
            for distance in 1..=FARTHEST {
                let (column, row) = (column + distance * right, row + distance * down);
                if column >= WIDTH as usize || row >= HEIGHT as usize {
                    break;
                }
                let other = row * WIDTH as usize + column;
                if self.view.patch(other) != Some(patch) {
                    break;
                }
                found(&Pair { pixels: [pixel, other], patch, distance });
            }
        }
    }
}
