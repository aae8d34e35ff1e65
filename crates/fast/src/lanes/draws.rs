//! The next three numbers of photons that have left their first block.

use pulp::NullaryFnOnce;

use super::chacha::{self, WORDS};
use super::width::Width;

/// How many photons get a block at a time.
const GROUP: usize = 16;
const BLOCK: u32 = WORDS as u32;

/// Three words in a row from the stream of one photon.
#[derive(Clone, Copy, Debug, Default)]
pub struct Draws {
    /// The photon's number.
    pub photon: u32,
    /// How many words of its stream come before.
    pub drawn: u32,
    /// The words.
    pub words: [u32; 3],
}

impl Draws {
    /// Whether one block has all three words.
    pub fn fit_a_block(&self) -> bool {
        self.drawn % BLOCK + 3 <= BLOCK
    }
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
        for lane in 0..GROUP {
            let w = chacha::block(self.seed, self.photons[lane], self.blocks[lane]);
            for (row, word) in self.words.iter_mut().zip(w) {
                row[lane] = word;
            }
        }
    }
}

/// Fills in the words of all `draws`.
pub fn fill(width: Width, seed: u64, draws: &mut [Draws]) {
    let mut words = [[0; GROUP]; WORDS];
    let mut astride = [0; GROUP];
    let mut waiting = 0;
    for start in (0..draws.len()).step_by(GROUP) {
        let mut places = [0; GROUP];
        let count = GROUP.min(draws.len() - start);
        for (lane, place) in places[..count].iter_mut().enumerate() {
            *place = start + lane;
        }
        fill_from(width, seed, draws, &places[..count], 0, &mut words);
        for place in start..start + count {
            if !draws[place].fit_a_block() {
                astride[waiting] = place;
                waiting += 1;
                if waiting == GROUP {
                    fill_from(width, seed, draws, &astride, 1, &mut words);
                    waiting = 0;
                }
            }
        }
    }
    if waiting > 0 {
        fill_from(width, seed, draws, &astride[..waiting], 1, &mut words);
    }
}

/// Fills in what the draws at `places` take from the block `later` blocks after that of their first
/// word.
fn fill_from(
    width: Width,
    seed: u64,
    draws: &mut [Draws],
    places: &[usize],
    later: u32,
    words: &mut [[u32; GROUP]; WORDS],
) {
    let mut photons = [0; GROUP];
    let mut blocks = [0; GROUP];
    for (lane, place) in places.iter().enumerate() {
        (photons[lane], blocks[lane]) = (draws[*place].photon, draws[*place].drawn / BLOCK + later);
    }
    width.run(Blocks { seed, photons: &photons, blocks: &blocks, words });
    for (lane, place) in places.iter().enumerate() {
        let draws = &mut draws[*place];
        for (at, word) in (draws.drawn..).zip(&mut draws.words) {
            if at / BLOCK == blocks[lane] {
                *word = words[at as usize % WORDS][lane];
            }
        }
    }
}
