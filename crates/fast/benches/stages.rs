//! The table of stages in docs/speed.md: `cargo bench -p photon-mapping-fast --bench stages`.

use std::time::Instant;

use fast::lanes::chacha;
use fast::lanes::width::Width;
use fast::lanes::{LaneTracer, Stage, picture};
use photon_list::writer::{Format, ListWriter};
use photon_mapping::assignment8;
use photon_mapping::photon_list::{ListHash, PhotonRecord};
use photon_mapping::rendering::photon_map::PhotonMap;
use pulp::NullaryFnOnce;

const ROUNDS: usize = 41;
const PIECE: u64 = 16384;
const PIECES: u64 = 4;
const STAGES: [Stage; 6] = [
    Stage::Emission,
    Stage::FirstHit,
    Stage::Numbers,
    Stage::Scattering,
    Stage::LaterHits,
    Stage::Records,
];

/// Only the first blocks of photons: what emission takes for random numbers.
struct Blocks<'a> {
    first: u32,
    words: &'a mut [u32; 128],
}

impl NullaryFnOnce for Blocks<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for lane in 0..self.words.len() {
            let block = chacha::block(assignment8::SEED, self.first + lane as u32, 0);
            // Of every word, so that none is left out.
            self.words[lane] = block.iter().fold(0, |all, word| all ^ word);
        }
    }
}

/// Seconds that `work` takes.
fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    std::hint::black_box(work());
    start.elapsed().as_secs_f64()
}

/// Cycles in a second, from additions each of which waits for the one before.
fn frequency() -> f64 {
    const ADDITIONS: u64 = 4_000_000;
    let mut sum = std::hint::black_box(1_u64);
    let step = std::hint::black_box(3_u64);
    let taken = seconds(|| {
        for _ in 0..ADDITIONS / 8 {
            // A rotation and a subtraction cannot be drawn together with the next.
            for _ in 0..4 {
                sum = sum.rotate_left(7);
                sum = sum.wrapping_sub(step);
            }
        }
        sum
    });
    ADDITIONS as f64 / taken
}

fn main() {
    let photons = PIECES * PIECE;
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let width = Width::widest();
    let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
    // Rounds beside one another, and of each stage the least disturbed.
    let mut least = [f64::INFINITY; 10];
    let cycles = (0..ROUNDS).map(|_| frequency()).fold(0.0, f64::max);
    println!("{cycles:e} Hz");
    let mut records: Vec<PhotonRecord> = Vec::new();
    for _ in 0..ROUNDS {
        let mut round = [0.0; 10];
        let mut words = [0; 128];
        round[0] = seconds(|| {
            for first in (0..photons).step_by(128) {
                width.run(Blocks { first: first as u32, words: &mut words });
            }
            words[0]
        });
        records.clear();
        for piece in 0..PIECES {
            let mut start = Instant::now();
            let done = |stage: Stage| {
                let end = Instant::now();
                let place = STAGES.iter().position(|other| *other == stage).expect("a stage");
                round[1 + place] += (end - start).as_secs_f64();
                start = end;
            };
            let piece = piece * PIECE..(piece + 1) * PIECE;
            records.extend(lanes.trace_piece_by_stages(piece, done));
        }
        round[7] = seconds(|| {
            for piece in 0..PIECES {
                std::hint::black_box(lanes.trace_piece(piece * PIECE..(piece + 1) * PIECE));
            }
        });
        round[8] = seconds(|| {
            let mut hash = ListHash::default();
            hash.update(&records);
            hash.hex()
        });
        round[9] = seconds(|| {
            let sink = std::io::Cursor::new(Vec::new());
            let mut writer = ListWriter::new(sink, Format::Ply, Vec::new()).expect("memory");
            writer.write(&records).expect("memory");
            writer.finish().expect("memory").into_inner().len()
        });
        for (least, round) in least.iter_mut().zip(round) {
            *least = least.min(round * cycles / photons as f64);
        }
    }
    println!("{least:?} {}", records.len() as f64 / photons as f64);
    let mut renderer = renderer.clone();
    let camera = assignment8::create_camera(160, 120);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for photons in [1000, photons as usize] {
        let positions = records.iter().filter(|r| (r.photon as usize) < photons);
        renderer.diffuse_map = PhotonMap::new(positions.map(|record| record.position));
        let mut least = f64::INFINITY;
        for _ in 0..ROUNDS {
            let taken = one.install(|| {
                seconds(|| picture::take_picture(&renderer, width, &camera, 160, 120, || ()))
            });
            least = least.min(taken * cycles / (160.0 * 120.0));
        }
        println!("picture of {photons}: {least} cycles a pixel");
    }
}
