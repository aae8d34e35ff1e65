//! Section 4 and its data follow from the runs.

use super::claims::{Claim, Exact, Rounded, assert_section, claim, fixed};
use super::data::{
    Interval, Row, Table, different, exp, interval, mean, mean_square, of, rms, rows, slope,
};

const QUANTITIES: [(&str, &str); 5] = [
    ("first hits", "hits1"),
    ("second hits", "hits2"),
    ("third hits", "hits3"),
    ("fourth hits", "hits4"),
    ("stored", "stored"),
];

struct Data {
    expected: Row,
    runs: Vec<Row>,
    sizes: Vec<f64>,
}

impl Data {
    fn new() -> Self {
        let mut runs = rows("sampler-runs.csv");
        let expected = runs.remove(0);
        Self { expected, sizes: different(&runs, "emitted"), runs }
    }

    fn runs_of(&self, sampler: &str, size: f64) -> Vec<&Row> {
        let is_it = |row: &&Row| row["sampler"] == sampler && of(row, "emitted") == size;
        self.runs.iter().filter(is_it).collect()
    }

    fn squares(&self, sampler: &str, head: &str) -> Table {
        let expected = of(&self.expected, head);
        let of_size = |size: &f64| {
            let square = |row: &Row| vec![(of(row, head) / (size * expected) - 1.0).powi(2)];
            self.runs_of(sampler, *size).into_iter().map(square).collect()
        };
        self.sizes.iter().map(of_size).collect()
    }

    fn seconds(&self, sampler: &str, size: f64) -> f64 {
        mean(&self.runs_of(sampler, size).iter().map(|row| of(row, "seconds")).collect::<Vec<_>>())
    }
}

fn variance_ratio(above: &[Vec<f64>], below: &[Vec<f64>]) -> Interval {
    let table = vec![above.to_vec(), below.to_vec()];
    exp(interval(&table, &|table| (mean_square(&table[0]) / mean_square(&table[1])).ln()))
}

#[test]
fn every_number_follows_from_the_runs() {
    let data = Data::new();
    let largest = *data.sizes.last().unwrap();
    let seeds = data.runs_of("sobol", largest).len() as f64;
    let times = ["chacha", "sobol"].map(|sampler| data.seconds(sampler, largest));
    let time_ratio = times[1] / times[0];
    let mut claims: Vec<Claim> = vec![
        fixed("4. Sampler", &[4.0]),
        fixed("RMS relative error of all hits", &[seeds, largest, 95.0, 1.0]),
        fixed("| ChaCha |", &[95.0]),
        claim("- Time:", [times[0], times[1], time_ratio].map(Rounded)),
        fixed("- Limits of this", &[2.0, 32.0, 24.0, 2.0, 24.0]),
    ];
    for (name, head) in QUANTITIES {
        let [chacha, sobol] = ["chacha", "sobol"].map(|sampler| data.squares(sampler, head));
        let last = data.sizes.len() - 1;
        let ratio = variance_ratio(&chacha[last], &sobol[last]);
        let errors = [&chacha, &sobol].map(|squares| Rounded(100.0 * rms(&squares[last])[0]));
        let slopes = [&chacha, &sobol].into_iter().flat_map(|squares| {
            let slope = slope(&data.sizes, squares, &[of(&data.expected, head)]);
            slope.into_iter().flatten().map(Exact)
        });
        let numbers = errors.into_iter().chain(ratio.map(Rounded)).chain(slopes);
        claims.push(claim(format!("| {name} |"), numbers.chain([Rounded(ratio[0] / time_ratio)])));
    }
    assert_section(4, &claims);
}

#[test]
fn table_by_bounce_follows_from_the_runs() {
    let data = Data::new();
    let rows = rows("sampler.csv");
    assert_eq!(rows.len(), QUANTITIES.len() * data.sizes.len());
    for row in &rows {
        let (_, head) =
            *QUANTITIES.iter().find(|(name, _)| name.replace(' ', "_") == row["quantity"]).unwrap();
        let size = of(row, "emitted");
        let number = data.sizes.iter().position(|other| *other == size).unwrap();
        let [chacha, sobol] =
            ["chacha", "sobol"].map(|sampler| data.squares(sampler, head).swap_remove(number));
        let ratio = variance_ratio(&chacha, &sobol);
        let known = [
            ("chacha_rms", rms(&chacha)[0]),
            ("sobol_rms", rms(&sobol)[0]),
            ("variance_ratio", ratio[0]),
            ("ratio_low", ratio[1]),
            ("ratio_high", ratio[2]),
            ("chacha_seconds", data.seconds("chacha", size)),
            ("sobol_seconds", data.seconds("sobol", size)),
        ];
        for (head, known) in known {
            assert!((of(row, head) / known - 1.0).abs() < 1e-3, "{size} {head}");
        }
    }
}

#[test]
fn sobol_is_much_better_at_first_hits() {
    let data = Data::new();
    let [chacha, sobol] =
        ["chacha", "sobol"].map(|sampler| rms(data.squares(sampler, "hits1").last().unwrap())[0]);
    assert!(sobol < chacha / 5.0, "{sobol} is not much better than {chacha}");
}
