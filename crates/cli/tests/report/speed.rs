//! Section 1 and its data follow from the runs.

use super::claims::{Claim, Exact, Number, Rounded, assert_section, claim, fixed};
use super::data::{
    Interval, Row, Table, different, exp, interval, mean, mean_square, of, rms, rows, slope,
};

/// One density that is judged: its name, the columns that it sums, and what it expects.
struct Quantity {
    name: String,
    heads: Vec<String>,
    expected: f64,
}

struct Data {
    sizes: Vec<f64>,
    runs: Vec<Row>,
    total: Vec<Quantity>,
    surfaces: Vec<Quantity>,
    facets: Vec<Quantity>,
}

impl Data {
    fn new() -> Self {
        let mut runs = rows("speed-runs.csv");
        let expected = runs.remove(0);
        let mut heads: Vec<_> =
            expected.keys().filter(|head| head.contains('/')).cloned().collect();
        heads.sort();
        let quantity = |name: &str, heads: Vec<String>| Quantity {
            name: name.to_owned(),
            expected: heads.iter().map(|head| of(&expected, head)).sum(),
            heads,
        };
        let lit = |quantity: &Quantity| quantity.expected > 0.0;
        let mut names: Vec<_> =
            heads.iter().map(|head| head.split('/').next().unwrap().to_owned()).collect();
        names.dedup();
        let surface = |name: &String| {
            let prefix = format!("{name}/");
            quantity(name, heads.iter().filter(|head| head.starts_with(&prefix)).cloned().collect())
        };
        let surfaces = names.iter().map(surface).filter(lit).collect();
        let facets = heads.iter().map(|head| quantity(head, vec![head.clone()]));
        Self {
            sizes: different(&runs, "emitted"),
            total: vec![quantity("total", heads.clone())],
            surfaces,
            facets: facets.filter(lit).collect(),
            runs,
        }
    }

    fn runs_of(&self, size: f64) -> Vec<&Row> {
        self.runs.iter().filter(|row| of(row, "emitted") == size).collect()
    }

    fn squares(&self, quantities: &[Quantity]) -> Table {
        let square = |row: &Row, quantity: &Quantity, size: f64| {
            let stored: f64 = quantity.heads.iter().map(|head| of(row, head)).sum();
            (stored / (size * quantity.expected) - 1.0).powi(2)
        };
        let of_size = |size: &f64| {
            let cells = |row: &Row| quantities.iter().map(|q| square(row, q, *size)).collect();
            self.runs_of(*size).into_iter().map(cells).collect()
        };
        self.sizes.iter().map(of_size).collect()
    }

    fn seconds(&self, size: f64) -> f64 {
        mean(&self.runs_of(size).iter().map(|row| of(row, "seconds")).collect::<Vec<_>>())
    }

    fn slope(&self, quantities: &[Quantity]) -> Option<Interval> {
        let expected: Vec<_> = quantities.iter().map(|quantity| quantity.expected).collect();
        slope(&self.sizes, &self.squares(quantities), &expected)
    }
}

/// The relative standard deviation of one photon's total, by theory.
fn theory() -> f64 {
    let total = |row: &&Row| row["scope"] == "total";
    let rows = rows("speed.csv");
    let row = rows.iter().find(total).unwrap();
    of(row, "theory") * of(row, "emitted").sqrt()
}

#[test]
fn every_number_follows_from_the_runs() {
    let data = Data::new();
    let seeds = data.runs_of(data.sizes[0]).len() as f64;
    let mut claims: Vec<Claim> = vec![
        fixed("1. Speed against error", &[1.0]),
        fixed("Relative error of the stored", &[seeds, 95.0, 20.0]),
        fixed("| emitted |", &[95.0, 1.0]),
        fixed("The photons to a goal", &[-2.0]),
    ];
    let squares = [&data.total, &data.surfaces, &data.facets].map(|scope| data.squares(scope));
    for (number, size) in data.sizes.iter().enumerate() {
        let [total, surface, facet] = squares.each_ref().map(|squares| rms(&squares[number]));
        let seconds = data.seconds(*size);
        let percents = total.into_iter().chain([theory() / size.sqrt(), surface[0], facet[0]]);
        let numbers = [Exact(*size)].into_iter().chain(percents.map(|part| Rounded(100.0 * part)));
        let times = [seconds, size / seconds, 1.0 / (total[0].powi(2) * seconds)].map(Rounded);
        let head = if *size < 1e6 { size.to_string() } else { format!("{size:e}") };
        claims.push(claim(format!("| {head} | "), numbers.chain(times)));
    }
    let scopes =
        [("total", &data.total), ("each surface", &data.surfaces), ("each facet", &data.facets)];
    for (name, scope) in scopes {
        let numbers = data
            .slope(scope)
            .into_iter()
            .flat_map(|[value, low, high]| [value, 95.0, low, high].map(Exact));
        claims.push(claim(format!("Log-log slope, {name}:"), numbers.chain([Exact(-0.5)])));
    }
    let of_one = exp(interval(&squares[0], &|table| {
        let of_size = |(size, runs): (&f64, &Vec<Vec<f64>>)| size * mean_square(runs);
        mean(&data.sizes.iter().zip(table).map(of_size).collect::<Vec<_>>()).ln()
    }));
    let largest = *data.sizes.last().unwrap();
    let speed = largest / data.seconds(largest);
    for (goal, part) in [(0.01, "To 1 %"), (0.001, "To 0.1 %")] {
        let [photons, low, high] = of_one.map(|variance| variance / (goal * goal));
        let first: [Number; 2] = [Exact(100.0 * goal), Rounded(photons)];
        let then = [photons / speed, speed, 95.0, low, high, (theory() / goal).powi(2)];
        claims.push(claim(part, first.into_iter().chain(then.map(Rounded))));
    }
    assert_section(1, &claims);
}

#[test]
fn table_by_surface_and_facet_follows_from_the_runs() {
    let data = Data::new();
    let scopes = [&data.total, &data.surfaces, &data.facets];
    let rows = rows("speed.csv");
    let mut seen = 0;
    let mut compare = |size: f64, scope: &str, name: &str, found: Interval, fewest: f64| {
        let row = rows
            .iter()
            .find(|row| of(row, "emitted") == size && row["scope"] == scope && row["name"] == name);
        let row = row.unwrap_or_else(|| panic!("{size} {scope} {name}"));
        seen += 1;
        assert!((of(row, "rms_error") / found[0] - 1.0).abs() < 1e-8);
        for (head, known) in ["low", "high"].into_iter().zip(&found[1..]) {
            if size * fewest < 20.0 {
                assert_eq!(row[head], "-", "{size} {name}");
            } else {
                assert!((of(row, head) / known - 1.0).abs() < 1e-4, "{size} {name} {head}");
            }
        }
    };
    for (scope, quantities) in ["total", "surface", "facet"].into_iter().zip(scopes) {
        for quantity in quantities {
            let squares = data.squares(std::slice::from_ref(quantity));
            for (size, runs) in data.sizes.iter().zip(&squares) {
                compare(*size, scope, &quantity.name, rms(runs), quantity.expected);
            }
        }
        if scope != "total" {
            let fewest = quantities.iter().map(|q| q.expected).fold(f64::INFINITY, f64::min);
            for (size, runs) in data.sizes.iter().zip(&data.squares(quantities)) {
                compare(*size, "all", &format!("each_{scope}"), rms(runs), fewest);
            }
        }
    }
    assert_eq!(seen, rows.len());
    for row in rows.iter().filter(|row| row["scope"] == "facet") {
        let size = of(row, "emitted");
        let quantity = data.facets.iter().filter(|facet| facet.name == row["name"]);
        let squares = quantity.flat_map(|q| data.squares(std::slice::from_ref(q)));
        let runs = squares.zip(&data.sizes).find(|(_, other)| **other == size).unwrap().0;
        let errors: Vec<_> = runs.concat().iter().map(|square| square.sqrt()).collect();
        let middle = mean(&errors);
        let variance = mean(&errors.iter().map(|e| (e - middle).powi(2)).collect::<Vec<_>>());
        assert!((of(row, "spread") - variance.sqrt()).abs() < 1e-7);
    }
}

#[test]
fn error_falls_as_it_must() {
    let data = Data::new();
    for scope in [&data.total, &data.surfaces, &data.facets] {
        // Half again the 95 % interval: three standard deviations.
        let [value, low, high] = data.slope(scope).unwrap();
        assert!((value + 0.5).abs() < 0.75 * (high - low), "{value} {low} {high}");
    }
}
