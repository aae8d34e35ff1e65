//! `photon-mapping expect`: how many hits are expected, computed without tracing.

use clap::Args;

use super::beside_expected::shares;
use super::error::{CliError, print};
use super::progress;
use super::run_args::SceneArgs;
use oracle::Accuracy;
use oracle::table::ExpectedTable;
use oracle::text_table::align;
use photon_mapping::assignment8::{PHOTON_COUNT, SEED};
use variants::run::Run;

/// The options of `expect`.
#[derive(Debug, Args)]
pub struct ExpectArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Fewer digits, but in about a second for the handout's scene instead of about two minutes of
    /// processor time and 1.6 GB
    #[arg(long)]
    quick: bool,
    /// Print the table as JSON
    #[arg(long)]
    json: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Computes the table, and prints it.
///
/// # Errors
/// When the scene cannot be read.
pub fn run(arguments: &ExpectArgs) -> Result<u8, CliError> {
    let accuracy = if arguments.quick { Accuracy::Quick } else { Accuracy::Full };
    let (scene, placement) = arguments.scene.load()?;
    let run = Run::of_scene(scene, placement, SEED, PHOTON_COUNT);
    let shares = shares(&run, 0..run.renderer.emitted());
    let waiting = progress::waiting(arguments.quiet, "computing");
    let table = ExpectedTable::compute(run.scene(), &shares, accuracy);
    waiting.finish_and_clear();
    if arguments.json {
        let json = serde_json::to_string_pretty(&table).expect("a table has only plain values");
        print(&(json + "\n"))?;
    } else {
        print(&text(&table))?;
    }
    Ok(0)
}

/// Hits that have a column of their own.
const COLUMNS: usize = 3;

fn text(table: &ExpectedTable) -> String {
    let mut rows =
        vec![["surface", "facet", "N1", "N2", "N3", "N4 + ...", "stored"].map(String::from)];
    let mut push = |surface: &str, facet: String, hits: &[f64], error: &[f64]| {
        let cell = |first: usize, last: usize| {
            // An empty sum of floats is -0.
            let sum =
                |numbers: &[f64]| numbers.iter().take(last).skip(first).fold(0.0, |a, b| a + b);
            with_error(sum(hits), sum(error))
        };
        let all = hits.len();
        let [first, second, third] = [0, 1, 2].map(|k| cell(k, k + 1));
        let (later, stored) = (cell(COLUMNS, all), cell(1, all));
        rows.push([surface.to_owned(), facet, first, second, third, later, stored]);
    };
    for row in &table.surfaces {
        push(&row.name, String::new(), &row.hits, &row.error);
        let facets: Vec<_> =
            table.facets.iter().filter(|facet| facet.surface == row.name).collect();
        for facet in facets.iter().filter(|_| facets.len() > 1) {
            push("", facet.facet.to_string(), &facet.hits, &facet.error);
        }
    }
    push("total", String::new(), &table.total.hits, &table.total.error);
    let rows: Vec<_> = rows.into_iter().map(Vec::from).collect();
    format!(
        "Expected hits per emitted photon: first hits N1, second hits N2, and so on; all but the \
         first are stored.\nIn brackets, how far the last digits may be off.\n\n{}",
        align(&rows)
    )
}

/// `value` with two digits of its error in brackets: 0.0053243(12) is 0.0053243 +- 0.0000012. What
/// is exact, because no photon can get there, is 0.
fn with_error(value: f64, error: f64) -> String {
    if value == 0.0 && error == 0.0 {
        return "0".to_owned();
    }
    let digits = if error > 0.0 { (1.0 - error.log10().floor()).clamp(3.0, 13.0) } else { 13.0 };
    let last_digits = (error * 10_f64.powf(digits)).ceil();
    format!("{value:.*}({last_digits})", digits as usize)
}
