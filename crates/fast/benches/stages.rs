//! The table of stages in docs/speed.md: `cargo bench -p photon-mapping-fast --bench stages`.
//!
//! Each stage beside the least time that this kind of processor could need: its operations, divided
//! by how many are done in a cycle. A stage counts in its fastest round, which nothing disturbed.

use std::collections::HashSet;
use std::time::Instant;

use fast::lanes::chacha;
use fast::lanes::width::Width;
use fast::lanes::{LaneTracer, Stage, picture};
use fast::trace::PIECE;
use photon_list::writer::{Format, ListWriter};
use photon_mapping::assignment8;
use photon_mapping::photon_list::{ListHash, PhotonRecord, ROW_BYTES};
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use pulp::NullaryFnOnce;

const ROUNDS: usize = 41;
const PIECES: u64 = 2;
const PHOTONS: u64 = PIECES * PIECE;
const GROUP: usize = 128;

/// A row of the table.
struct Row {
    name: &'static str,
    /// How many of the photons come to it.
    share: f64,
    /// Cycles a photon.
    measured: f64,
    /// Cycles for each that comes to it.
    least: f64,
    reason: String,
}

/// Only the first blocks of photons: what emission takes for random numbers.
struct Blocks<'a> {
    first: u32,
    words: &'a mut [u32; GROUP],
}

impl NullaryFnOnce for Blocks<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for lane in 0..GROUP {
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

/// Seconds of processor time that this thread has taken.
fn processor_seconds() -> f64 {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = statistics.split(' ').next().and_then(|word| word.parse().ok());
    1e-9 * nanoseconds.unwrap_or(f64::NAN)
}

/// The least seconds of many rounds.
fn least_seconds<T>(mut work: impl FnMut() -> T) -> f64 {
    (0..ROUNDS).map(|_| seconds(&mut work)).fold(f64::INFINITY, f64::min)
}

/// Cycles in a second, from operations each of which takes one and waits for the one before.
fn frequency() -> f64 {
    const OPERATIONS: u64 = 2_000_000;
    let step = std::hint::black_box(3_u64);
    let taken = least_seconds(|| {
        let mut sum = std::hint::black_box(1_u64);
        for _ in 0..OPERATIONS / 2 {
            sum = sum.rotate_left(7).wrapping_sub(step);
        }
        sum
    });
    OPERATIONS as f64 / taken
}

fn main() {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let width = Width::widest();
    let cycles = frequency();
    println!("{width:?}, {:.2} GHz, the fastest of {ROUNDS} rounds", cycles * 1e-9);
    println!("|stage|share of the photons|cycles a photon|at least|ratio|why|");
    println!("|---|---:|---:|---:|---:|---|");
    for row in &rows(&renderer, width, cycles) {
        print(row);
    }
    for width in Width::available().into_iter().rev() {
        // The numbers of the first row are part of the emission.
        let rows = &rows(&renderer, width, cycles)[1..];
        let sum: f64 = rows.iter().map(|row| row.measured).sum();
        let least: f64 = rows.iter().map(|row| row.share * row.least).sum();
        println!("|all of a photon, {width:?}||{sum:.1}|{least:.1}|{:.1}||", sum / least);
    }
    let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
    let records: Vec<PhotonRecord> =
        (0..PIECES).flat_map(|p| lanes.trace_piece(p * PIECE..(p + 1) * PIECE)).collect();
    let share = records.len() as f64 / PHOTONS as f64;
    let bytes = ROW_BYTES as f64;
    let a_photon = cycles / PHOTONS as f64;
    print(&Row {
        name: "name of the list",
        share,
        measured: a_photon
            * least_seconds(|| {
                let mut hash = ListHash::default();
                hash.update(&records);
                hash.hex()
            }),
        least: 2.0 * bytes,
        reason: format!("SHA-256 of {bytes} bytes, 64 rounds of 2 cycles for 64 bytes"),
    });
    print(&Row {
        name: "writing",
        share,
        measured: a_photon * least_seconds(|| write(&records)),
        least: 2.0 * bytes / 16.0,
        reason: format!("{bytes} bytes read, turned and written, 16 at once"),
    });
    picture(&renderer, width, &records, cycles);
}

fn print(Row { name, share, measured, least, reason }: &Row) {
    let least = share * least;
    let ratio = measured / least;
    println!("|{name}|{share:.3}|{measured:.1}|{least:.1}|{ratio:.1}|{reason}|");
}

fn write(records: &[PhotonRecord]) -> usize {
    let sink = std::io::Cursor::new(Vec::with_capacity(2 * ROW_BYTES * records.len()));
    let mut writer = ListWriter::new(sink, Format::Ply, Vec::new()).expect("memory");
    writer.write(records).expect("memory");
    writer.finish().expect("memory").into_inner().len()
}

const STAGES: [Stage; 6] = [
    Stage::Emission,
    Stage::FirstHit,
    Stage::Numbers,
    Stage::Scattering,
    Stage::LaterHits,
    Stage::Records,
];

/// The least seconds of each stage for all photons, and how many come to it. What it takes to ask
/// for the time is not counted.
fn measure_stages(lanes: &LaneTracer) -> [(f64, f64); 6] {
    let clock = least_seconds(Instant::now);
    let mut least = [(f64::INFINITY, 0.0); 6];
    for _ in 0..ROUNDS {
        let mut round = [(0.0, 0); 6];
        for piece in 0..PIECES {
            let mut start = Instant::now();
            let done = |stage: Stage, count: usize| {
                let end = Instant::now();
                let place = STAGES.iter().position(|other| *other == stage).expect("a stage");
                round[place].0 += (end - start).as_secs_f64() - clock;
                round[place].1 += count;
                start = end;
            };
            let piece = piece * PIECE..(piece + 1) * PIECE;
            std::hint::black_box(lanes.trace_piece_by_stages(piece, done));
        }
        for (least, (seconds, count)) in least.iter_mut().zip(round) {
            *least = (least.0.min(seconds), count as f64 / PHOTONS as f64);
        }
    }
    least
}

/// The stages of a photon: the first is a part of the second.
fn rows(renderer: &PhotonMappingRenderer, width: Width, cycles: f64) -> Vec<Row> {
    let lanes = LaneTracer::new(renderer, width).expect("the scene is small");
    let mut words = [0; GROUP];
    let numbers = least_seconds(|| {
        for first in (0..PHOTONS).step_by(GROUP) {
            width.run(Blocks { first: first as u32, words: &mut words });
        }
        words[0]
    });
    // Of Zen 4, which has four units of 256 bits. Operations of 512 bits take two, and only they
    // rotate at once.
    let (at_once, rotations) = match width {
        Width::Baseline => (16.0, 4.0 * 3.0),
        Width::Avx2 => (32.0, 2.0 + 2.0 * 3.0),
        Width::Avx512 => (32.0, 4.0),
    };
    // A division or root takes as long as 20 other operations.
    const DIVISION: f64 = 20.0;
    let block = 4.0 * 8.0 * (8.0 + rotations) + 16.0;
    let tries = 5.0 * 27.0 + 25.0 + DIVISION;
    let aim = 40.0 + 5.0 * DIVISION + 1.3 * (47.0 + DIVISION);
    let scatter = 60.0 + 2.0 * 40.0 + 5.0 * DIVISION;
    let triangles = renderer.stored_scene.triangles();
    let corners: HashSet<[u32; 3]> = triangles
        .iter()
        .flat_map(|triangle| triangle.vertices.map(|corner| corner.to_array().map(f32::to_bits)))
        .collect();
    let (corners, triangles) = (corners.len() as f64, triangles.len() as f64);
    let closest = 14.0 * corners + (30.0 + DIVISION) * triangles;
    let [emission, first_hit, later_numbers, scattering, later_hits, records] =
        measure_stages(&lanes);
    let row = |name, (measured, share): (f64, f64), operations: f64, moves: f64, reason| Row {
        name,
        share,
        measured: measured * cycles / PHOTONS as f64,
        // Two moves in a cycle.
        least: operations / at_once + moves / 2.0,
        reason,
    };
    vec![
        row("random numbers", (numbers, 1.0), block, 0.0, format!("{block} operations a block")),
        row(
            "emission, with these",
            emission,
            block + tries,
            2.0,
            format!("5 tries and a cell: {tries} operations more; sorting out: 2 moves"),
        ),
        row(
            "first hit",
            first_hit,
            aim,
            36.0,
            format!("{aim:.0} operations for a direction and 1.3 triangles; 36 moves"),
        ),
        row(
            "later numbers",
            later_numbers,
            block,
            10.0,
            format!("{block} operations a block; 10 moves"),
        ),
        row(
            "roulette, scattering",
            scattering,
            scatter,
            26.0,
            format!("{scatter} operations, sine and cosine in f64; 26 moves"),
        ),
        row(
            "later hits",
            later_hits,
            closest,
            24.0,
            format!(
                "{closest} operations for {triangles} triangles with {corners} corners; 24 moves"
            ),
        ),
        row("records", records, 0.0, 24.0, "44 bytes made, then put in order: 24 moves".into()),
    ]
}

/// The whole picture of the handout, on one thread.
fn picture(renderer: &PhotonMappingRenderer, width: Width, records: &[PhotonRecord], cycles: f64) {
    let mut renderer = renderer.clone();
    renderer.diffuse_map = PhotonMap::new(records.iter().map(|record| record.position));
    let camera = assignment8::create_camera(640, 480);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    // Longer than a thread is left alone on a busy machine, so the processor's time counts.
    const PICTURES: u32 = 20;
    let taken = one.install(|| {
        let start = processor_seconds();
        for _ in 0..PICTURES {
            picture::take_picture(&renderer, width, &camera, 640, 480, || ());
        }
        (processor_seconds() - start) / f64::from(PICTURES)
    });
    let milliseconds = taken * 1e3;
    let a_pixel = taken * cycles / (640.0 * 480.0);
    println!();
    println!("The picture, 1 thread: {milliseconds:.1} ms, {a_pixel:.0} cycles a pixel");
}
