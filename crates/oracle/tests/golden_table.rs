//! The table that the root package prints beside its counts is the oracle's.

use std::fmt::Write as _;
use std::path::Path;

use oracle::table::ExpectedTable;

/// Bounces with a column of their own; the later ones share one.
const COLUMNS: usize = 3;

#[test]
fn golden_table_is_the_oracles() {
    let mut text = "surface,bounce 1,bounce 2,bounce 3,bounce 4+\n".to_owned();
    for row in ExpectedTable::of_assignment8().surfaces {
        // The first hit is not stored.
        let stored = &row.hits[1..];
        let later: f64 = stored[COLUMNS..].iter().sum();
        let cells = stored[..COLUMNS].iter().chain([&later]);
        let cells: Vec<_> = cells.map(|cell| format!("{cell:.9}")).collect();
        writeln!(text, "{},{}", row.name, cells.join(",")).unwrap();
    }
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden/expected.csv");
    if std::env::var("INSTA_UPDATE").is_ok_and(|mode| mode == "always") {
        std::fs::write(&golden, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(golden).unwrap(), text);
}
