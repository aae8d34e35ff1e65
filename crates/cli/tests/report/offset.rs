//! Section 3 follows from its data.

use super::claims::{Claim, Exact, Rounded, assert_section, claim, fixed};
use super::data::{Row, of, rows};

const WRONGS: [&str; 4] = ["self_hits", "leaks", "lost", "extra"];

fn find<'a>(rows: &'a [Row], rule: &str, place: &str, amount: f64) -> &'a Row {
    let is_it =
        |row: &&Row| row["rule"] == rule && row["place"] == place && of(row, "amount") == amount;
    rows.iter().find(is_it).unwrap()
}

#[test]
fn every_number_follows_from_the_data() {
    let rows = rows("offset.csv");
    let per_million = |row: &Row, head: &str| of(row, head) * 1e6 / of(row, "emitted");
    for row in &rows {
        let wrong: f64 = WRONGS.iter().map(|head| per_million(row, head)).sum();
        assert!((of(row, "wrong_per_million") - wrong).abs() <= 1e-8 * wrong);
    }
    let emitted = of(&rows[0], "emitted");
    let scales = [1e-4, 1e-2, 1.0, 1e2, 1e4];
    let moves = [1e2, 1e4, 1e5];
    let places: Vec<_> = (scales.map(|factor| ("scaled", factor)).into_iter())
        .chain(moves.map(|distance| ("moved", distance)))
        .collect();
    let heads: Vec<_> = places.iter().map(|place| place.1).chain([1.0, 1.0]).collect();
    // Half a unit in the last place of an f32 at 1e5.
    let rounding = f64::from(1e5_f32.next_up() - 1e5) / 2.0;
    let of_reference = rows.iter().filter(|row| row["rule"] == "reference");
    let worst = of_reference.map(|row| of(row, "wrong_per_million")).fold(0.0, f64::max);
    let mut claims: Vec<Claim> = vec![
        fixed("3. Offset", &[3.0]),
        claim(
            "Per million emitted photons",
            [Exact(1e-9), Exact(emitted), Exact(0.0), Rounded(3e6 / emitted), Exact(95.0)],
        ),
        fixed("| offset |", &heads),
        claim("in its worst place", [Rounded(worst)]),
        fixed("A moved scene", &[rounding, 1e5]),
    ];
    let mut rules: Vec<_> = rows.iter().map(|row| row["rule"].clone()).collect();
    rules.dedup();
    rules.truncate(11);
    for rule in rules {
        let length = rule.strip_suffix(" n").map(|length| Exact(length.parse().unwrap()));
        let counts = places.iter().flat_map(|(place, amount)| {
            let row = find(&rows, &rule, place, *amount);
            WRONGS.map(|head| Exact(per_million(row, head)))
        });
        let home = find(&rows, &rule, "scaled", 1.0);
        let change = 100.0 * (of(home, "stored") / of(home, "true_stored") - 1.0);
        let last = [Exact(change), Rounded(of(home, "nanoseconds_per_photon"))];
        claims.push(claim(format!("| {rule} |"), length.into_iter().chain(counts).chain(last)));
    }
    assert_section(3, &claims);
}

#[test]
fn what_is_known_of_offsets_shows() {
    let rows = rows("offset.csv");
    let home = |rule: &str| find(&rows, rule, "scaled", 1.0);
    let wrong = |rule: &str| of(home(rule), "wrong_per_million");
    assert!(wrong("none") > 10_000.0);
    // One photon in ten thousand crosses an edge at most.
    assert!(wrong("reference") <= 200.0, "{}", wrong("reference"));
    assert!(of(home("1e-1 n"), "lost") > 5.0 * of(home("1e-2 n"), "lost").max(1.0));
    for row in rows.iter().filter(|row| row["rule"] == "reference") {
        assert_eq!((of(row, "self_hits"), of(row, "leaks")), (0.0, 0.0));
    }
}
