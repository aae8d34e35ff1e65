//! ChaCha against the scrambled Sobol sequence: error and time, by bounce.

use std::fmt::Write as _;
use std::time::Instant;

use super::PageSection;
use super::csv::{Table, digits, percent, short};
use super::hits::hits_by_bounce;
use super::plan::Plan;
use super::plot::{Axes, Mark, PlotLine, draw};
use super::statistics::{Estimate, Runs, log_log_slope, rms, variance_ratio};
use oracle::table::ExpectedTable;
use variants::run::Run;
use variants::sampler::Sampler;

/// How many hits are compared one by one. The last quantity is the stored photons.
const HITS: usize = 4;
const NAMES: [&str; HITS + 1] =
    ["first hits", "second hits", "third hits", "fourth hits", "stored"];

/// One run with one sampler.
struct SamplerRun {
    sampler: Sampler,
    emitted: u64,
    seed: u64,
    seconds: f64,
    counts: [u64; HITS + 1],
}

/// All runs, and their expected values.
pub struct Samplers {
    sizes: Vec<u64>,
    seeds: u64,
    expected: [f64; HITS + 1],
    runs: Vec<SamplerRun>,
}

/// Runs both samplers in turn, with the same tracer.
pub fn measure(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Samplers {
    let table = ExpectedTable::of_assignment8();
    let mut expected = [table.total.stored; HITS + 1];
    expected[..HITS].copy_from_slice(&table.total.hits[..HITS]);
    let mut runs = Vec::new();
    for (number, emitted) in plan.sampler_sizes.iter().enumerate() {
        for seed in 0..plan.sampler_seeds {
            for sampler in [Sampler::ChaCha, Sampler::Sobol] {
                let seed = Plan::seed(100 + number, seed);
                let run = Run { sampler, ..Run::handout(seed, *emitted) };
                let start = Instant::now();
                let (hits, stored) = hits_by_bounce::<HITS>(&run, 0..*emitted);
                let seconds = start.elapsed().as_secs_f64();
                let mut counts = [stored; HITS + 1];
                counts[..HITS].copy_from_slice(&hits);
                runs.push(SamplerRun { sampler, emitted: *emitted, seed, seconds, counts });
            }
            progress(2 * emitted);
        }
    }
    Samplers { sizes: plan.sampler_sizes.clone(), seeds: plan.sampler_seeds, expected, runs }
}

impl Samplers {
    fn runs_of(&self, sampler: Sampler, size: u64) -> impl Iterator<Item = &SamplerRun> {
        self.runs.iter().filter(move |run| run.sampler == sampler && run.emitted == size)
    }

    /// The squared relative errors of one quantity, by size and run.
    fn squares(&self, sampler: Sampler, quantity: usize) -> Vec<Runs> {
        let expected = self.expected[quantity];
        let square = |run: &SamplerRun| {
            vec![(run.counts[quantity] as f64 / run.emitted as f64 / expected - 1.0).powi(2)]
        };
        let sizes = self.sizes.iter();
        sizes.map(|size| self.runs_of(sampler, *size).map(square).collect()).collect()
    }

    fn seconds(&self, sampler: Sampler, size: u64) -> f64 {
        self.runs_of(sampler, size).map(|run| run.seconds).sum::<f64>() / self.seeds as f64
    }

    fn curve(&self, sampler: Sampler, quantity: usize) -> Vec<Estimate> {
        self.squares(sampler, quantity).iter().map(rms).collect()
    }

    fn runs_table(&self) -> Table {
        let mut table = Table::new("sampler emitted seed seconds hits1 hits2 hits3 hits4 stored");
        let blank = ["expected", "-", "-", "-"].map(str::to_owned);
        table.push(blank.into_iter().chain(self.expected.map(digits)));
        for run in &self.runs {
            let first = [run.sampler.name().to_owned(), run.emitted.to_string()];
            let then = [run.seed.to_string(), digits(run.seconds)];
            let counts = run.counts.map(|count| count.to_string());
            table.push(first.into_iter().chain(then).chain(counts));
        }
        table
    }
}

/// The section of the page.
pub fn section(samplers: &Samplers) -> PageSection {
    let mut csv = Table::new(
        "emitted quantity chacha_rms sobol_rms variance_ratio ratio_low ratio_high chacha_seconds \
         sobol_seconds",
    );
    let both = [Sampler::ChaCha, Sampler::Sobol];
    for (quantity, name) in NAMES.iter().enumerate() {
        let [chacha, sobol] = both.map(|sampler| samplers.squares(sampler, quantity));
        for (number, size) in samplers.sizes.iter().enumerate() {
            let ratio = variance_ratio(&chacha[number], &sobol[number]);
            let errors = [&chacha, &sobol].map(|squares| rms(&squares[number]).value);
            let seconds = both.map(|sampler| samplers.seconds(sampler, *size));
            let numbers = errors.into_iter().chain([ratio.value, ratio.low, ratio.high]);
            let names = [size.to_string(), name.replace(' ', "_")];
            csv.push(names.into_iter().chain(numbers.chain(seconds).map(digits)));
        }
    }
    let files = vec![
        ("sampler-runs.csv", samplers.runs_table().csv()),
        ("sampler.csv", csv.csv()),
        ("sampler.svg", plot(samplers)),
    ];
    PageSection { markdown: markdown(samplers), files }
}

fn markdown(samplers: &Samplers) -> String {
    let mut text =
        String::from("## 4. Sampler\n\n![Error of both samplers, by bounce](sampler.svg)\n\n");
    let largest = *samplers.sizes.last().expect("a plan has sizes");
    let [chacha_time, sobol_time] =
        [Sampler::ChaCha, Sampler::Sobol].map(|s| samplers.seconds(s, largest));
    let time_ratio = sobol_time / chacha_time;
    let _ = writeln!(
        text,
        "RMS relative error of all hits in the scene, over {} seeds, at {largest} emitted photons \
         (sizes are powers of two, where a Sobol sequence is a net). Intervals (95 %) and the \
         cells left out of slopes are as in section 1.\n",
        samplers.seeds
    );
    let mut table = Table::with_heads([
        "",
        "ChaCha",
        "Sobol",
        "variance ratio",
        "95 % interval",
        "slope, ChaCha",
        "slope, Sobol",
        "efficiency ratio",
    ]);
    for (quantity, name) in NAMES.iter().enumerate() {
        let [chacha, sobol] =
            [Sampler::ChaCha, Sampler::Sobol].map(|sampler| samplers.squares(sampler, quantity));
        let slope = |squares: &[Runs]| {
            let slope = log_log_slope(&samplers.sizes, squares, &[samplers.expected[quantity]]);
            slope.map_or_else(
                || "-".to_owned(),
                |slope| format!("{:.2} ({:.2} to {:.2})", slope.value, slope.low, slope.high),
            )
        };
        let last = samplers.sizes.len() - 1;
        let ratio = variance_ratio(&chacha[last], &sobol[last]);
        table.push([
            (*name).to_owned(),
            percent(rms(&chacha[last]).value),
            percent(rms(&sobol[last]).value),
            short(ratio.value, 3),
            format!("{} to {}", short(ratio.low, 3), short(ratio.high, 3)),
            slope(&chacha),
            slope(&sobol),
            short(ratio.value / time_ratio, 3),
        ]);
    }
    text += &table.markdown();
    let _ = writeln!(
        text,
        "\n- Time: {} s with ChaCha, {} s with Sobol, a ratio of **{}**. Both trace one \
         photon after another, on all cores.",
        short(chacha_time, 3),
        short(sobol_time, 3),
        short(time_ratio, 3)
    );
    text += "- Limits of this Sobol sequence: 2^32 photons. Numbers have 24 bits, as the \
             reference's, so past 2^24 photons a single dimension is not stratified further. \
             Emission and two bounces share one point of eight dimensions. Every later bounce has \
             a sequence of its own, where little is gained. Its photons are not independent, so a \
             summary gives no standard deviations.\n- Again: `photon-mapping render --sampler \
             sobol --seed S --photons N`.\n\nData: [every run](sampler-runs.csv), \
             [errors](sampler.csv).\n";
    text
}

fn plot(samplers: &Samplers) -> String {
    let mut lines = Vec::new();
    for (color, quantity) in [0, 1, 2, HITS].into_iter().enumerate() {
        for (sampler, mark) in [(Sampler::ChaCha, Mark::Hollow), (Sampler::Sobol, Mark::Circles)] {
            let points = samplers.sizes.iter().zip(samplers.curve(sampler, quantity));
            lines.push(PlotLine {
                name: format!("{}, {}", NAMES[quantity], sampler.name()),
                color,
                mark,
                points: points.map(|(size, error)| (*size as f64, error.value.max(1e-9))).collect(),
                bars: Vec::new(),
            });
        }
    }
    let axes = Axes {
        title: "ChaCha (dashed) and Owen-scrambled Sobol".to_owned(),
        x: "emitted photons".to_owned(),
        y: "RMS relative error".to_owned(),
    };
    draw(&[(axes, lines)])
}
