//! The next three numbers of photons that have left their first block.

use pulp::NullaryFnOnce;

use super::chacha::{self, WORDS};
use super::width::Width;

const GROUP: usize = 16;

/// Three words in a row from the stream of one photon.
#[derive(Clone, Copy, Debug)]
pub struct Draws {
    /// The photon's number.
    pub photon: u32,
    /// How many words of its stream come before.
    pub drawn: u32,
    /// The words.
    pub words: [u32; 3],
}

struct Blocks<'a> {
    seed: u64,
    photons: &'a [u32; GROUP],
    blocks: &'a [u32; GROUP],
    words: &'a mut [[u32; GROUP]; WORDS],
}

impl NullaryFnOnce for Blocks<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        chacha::blocks(self.seed, self.photons, self.blocks, self.words);
    }
}

/// Fills in the words of all `draws`.
pub fn fill(width: Width, seed: u64, draws: &mut [Draws]) {
    let block_words = WORDS as u32;
    let mut astride = Vec::new();
    for (start, group) in (0..).step_by(GROUP).zip(draws.chunks_mut(GROUP)) {
        let blocks: Vec<_> = group.iter().map(|draws| draws.drawn / block_words).collect();
        fill_from(width, seed, group.iter_mut(), &blocks);
        let ends_later = |draws: &Draws| draws.drawn % block_words + 2 >= block_words;
        astride.extend(
            (start..)
                .zip(group.iter())
                .filter(|(_, draws)| ends_later(draws))
                .map(|(index, _)| index),
        );
    }
    for group in astride.chunks(GROUP) {
        let mut copies: Vec<Draws> = group.iter().map(|index: &usize| draws[*index]).collect();
        let blocks: Vec<_> = copies.iter().map(|draws| draws.drawn / block_words + 1).collect();
        fill_from(width, seed, copies.iter_mut(), &blocks);
        for (index, copy) in group.iter().zip(copies) {
            draws[*index] = copy;
        }
    }
}

/// Fills in what each of `draws` takes from its block of `blocks`.
fn fill_from<'a>(
    width: Width,
    seed: u64,
    draws: impl Iterator<Item = &'a mut Draws>,
    block_of: &[u32],
) {
    let draws: Vec<_> = draws.collect();
    let mut photons = [0; GROUP];
    let mut blocks = [0; GROUP];
    for (lane, (draws, block)) in draws.iter().zip(block_of).enumerate() {
        (photons[lane], blocks[lane]) = (draws.photon, *block);
    }
    let mut words = [[0; GROUP]; WORDS];
    width.run(Blocks { seed, photons: &photons, blocks: &blocks, words: &mut words });
    for (lane, draws) in draws.into_iter().enumerate() {
        for (place, word) in (draws.drawn..).zip(&mut draws.words) {
            if place / WORDS as u32 == blocks[lane] {
                *word = words[place as usize % WORDS][lane];
            }
        }
    }
}
