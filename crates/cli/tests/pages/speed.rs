//! Numbers of the pages on speed: what the benches printed is kept beside them.

use super::computed::assert_says;
use super::numbers::{csv, is_rounded, table};
use super::read;

/// The rows of `results/program.csv`, which `program.py` wrote: median, least and greatest.
fn program(what: &str) -> [f64; 3] {
    let data = csv("crates/fast/benches/results/program.csv");
    let row = data.iter().find(|row| row["what"] == what);
    let row = row.unwrap_or_else(|| panic!("program.csv has no '{what}'"));
    ["median", "least", "greatest"].map(|name| row[name].parse().expect("a number"))
}

#[test]
fn times_and_memory_are_those_of_the_program() {
    let page = "docs/speed.md";
    let words = "|`render --photons 1000`|12 ms|# ms [# .. #]|";
    assert_says(page, words, &program("1000 photons (ms)"));
    let words = "|`render`: 1,000,000 photons, list, picture, files|200 ms|# ms [# .. #]|";
    assert_says(page, words, &program("1000000 photons (ms)"));
    let [ratio, ..] = program("2 threads beside two runs (ratio)");
    assert_says(page, "of one thread each|within 5 %|# times as long|", &[ratio]);
    for (photons, name) in [("10^7", "10000000"), ("10^8", "100000000")] {
        let kinds = [("`--count-only`", "count only"), ("list and picture", "list and picture")];
        for (shown, kind) in kinds {
            let numbers = ["MB", "ns a photon"]
                .map(|unit| program(&format!("{name} photons: {kind} ({unit})"))[0]);
            assert_says(page, &format!("|{shown}|{photons}|# MB|# ns|"), &numbers);
        }
    }
    let [size, ..] = program("100000000 photons: on disk (MB)");
    assert_says(page, "The files of 10^8 photons take # MB on disk", &[size]);
    let port = program("the port (s)");
    assert_says(page, "written to be read: 1,000,000 photons||# s [# .. #]|", &port);
    assert_says("README.md", "|`trace_photon`, one core|# us a photon|", &port[..1]);
}

/// What bounds a large scene is what the same photons take less in a small one.
#[test]
fn photons_among_many_triangles_are_those_of_the_program() {
    let page = "docs/speed.md";
    let room =
        |triangles: &str, what: &str| program(&format!("room of {triangles} triangles: {what}"))[0];
    for (shown, triangles, by) in [
        ("128", "128", "lanes"),
        ("288", "288", "port and tree"),
        ("1,002,528", "1002528", "port and tree"),
    ] {
        let kept =
            ["count only (ns a photon)", "list and picture (ns a photon)", "list and picture (MB)"]
                .map(|what| room(triangles, what));
        assert_says(page, &format!("|{shown}|{by}|# ns|# ns|# MB|"), &kept);
    }
    let rays = room("1002528", "rays a photon");
    assert_says(page, "4,000,000 photons of # rays.", &[rays]);
    let reading = room("1002528", "read and build (s)");
    assert_says(page, "To read the largest and to build its tree takes # s more.", &[reading]);
    let [few, many] = ["288", "1002528"].map(|room_of| room(room_of, "count only (ns a photon)"));
    assert_says(page, "the same photons take # % less", &[100.0 * (1.0 - few / many)]);
}

#[test]
fn instructions_on_the_page_are_those_counted() {
    let data = csv("crates/fast/benches/results/instructions.csv");
    let counted = |what: &str| {
        let row = data.iter().find(|row| row["what"] == what);
        let row = row.unwrap_or_else(|| panic!("instructions.csv has no '{what}'"));
        row["instructions a photon"].parse::<f64>().expect("a number")
    };
    for (words, names) in [
        ("|x86-64, SSE2|#|#|", &["x86-64 port", "x86-64 Baseline"][..]),
        ("|x86-64, AVX2||#|", &["x86-64 Avx2"]),
        ("|aarch64, NEON|#|#|", &["aarch64 port", "aarch64 Baseline"]),
    ] {
        let counted: Vec<f64> = names.iter().map(|name| counted(name)).collect();
        assert_says("docs/speed.md", words, &counted);
    }
}

/// What the benches printed is kept beside them.
fn result(name: &str) -> String {
    read(format!("crates/fast/benches/results/{name}.txt"))
}

#[test]
fn stages_on_the_page_are_those_of_the_bench() {
    let printed = result("stages");
    let rows = printed.lines().filter(|line| line.starts_with('|')).skip(2);
    let rows: Vec<Vec<&str>> = rows.map(|row| row.trim_matches('|').split('|').collect()).collect();
    let page = table(&read("docs/speed.md"), "Where a photon's time goes");
    assert_eq!(page.len(), rows.len());
    for (shown, row) in page.iter().zip(&rows) {
        for (shown, number) in shown[1..5].iter().zip(&row[1..5]) {
            let agree = match number.parse() {
                Ok(number) => is_rounded(shown, number),
                Err(_) => shown == number,
            };
            assert!(agree, "{shown} is not {number}: {row:?}");
        }
    }
    let number = |before: &str, after: &str| -> f64 {
        let (start, _) = printed.split_once(after).unwrap_or_else(|| panic!("no '{after}'"));
        let (_, number) = start.rsplit_once(before).expect("what is before it");
        number.parse().expect("a number")
    };
    let (ghz, cycles, milliseconds) =
        (number(", ", " GHz"), number(", ", " cycles a pixel"), number(": ", " ms,"));
    assert_says("docs/speed.md", "takes # cycles a pixel, # ms on one", &[cycles, milliseconds]);
    let row = |name: &str, column: usize| -> f64 {
        let row = rows.iter().find(|row| row[0] == name);
        row.unwrap_or_else(|| panic!("no {name}"))[column].parse().expect("a number")
    };
    let (all, baseline) = (row("all of a photon, Avx512", 2), row("all of a photon, Baseline", 2));
    assert_says("docs/speed.md", "SSE2 takes # ns a photon", &[baseline / ghz]);
    let [ours, theirs, _] = peers().remove(0).1;
    let words = "At # GHz, a quarter of Mitsuba's fastest round is # cycles. The stages take # in \
                 their fastest rounds, and a whole run takes #.";
    assert_says("docs/speed.md", words, &[ghz, 0.25 * ghz * theirs[1], all, ghz * ours[1]]);
}

/// The numbers within `text`.
fn numbers(text: &str) -> Vec<f64> {
    let is_part = |c: char| !c.is_ascii_digit() && !".e+".contains(c);
    text.split(is_part).filter_map(|word| word.trim_matches('.').parse().ok()).collect()
}

/// What `run.sh` kept: its lines, with ours, theirs and the ratio, each as median, least and
/// greatest.
fn peers() -> Vec<(String, [Vec<f64>; 3])> {
    let printed = result("peers");
    let lines = printed.lines().filter_map(|line| Some((line, line.split_once(": ours ")?.1)));
    let of_line = |(line, text): (&str, &str)| {
        let parts: Vec<_> = text.split(", ").map(numbers).collect();
        (line.to_owned(), parts.try_into().expect("ours, theirs, and their ratio"))
    };
    lines.map(of_line).collect()
}

/// Asserts that `cells` show `kept`, each in a cell of its own, rounded to the digits shown.
fn assert_shows(cells: &[String], (line, kept): &(String, [Vec<f64>; 3])) {
    assert_eq!(cells.len(), kept.len(), "{cells:?}");
    for (cell, kept) in cells.iter().zip(kept) {
        // The name and version of the peer come before a colon.
        let shown = cell.rsplit(": ").next().expect("a time");
        let unit = if shown.contains(" us ") { 1e-3 } else { 1.0 };
        let is_part = |c: char| !c.is_ascii_digit() && c != '.';
        let shown = shown.split(is_part).map(|number| number.trim_matches('.'));
        let shown: Vec<_> = shown.filter(|number| !number.is_empty()).collect();
        assert!(!shown.is_empty(), "{cells:?}");
        for (shown, kept) in shown.iter().zip(kept) {
            assert!(is_rounded(shown, unit * kept), "{shown} is not {kept}: {line}");
        }
    }
}

#[test]
fn times_on_the_pages_are_those_of_the_peers() {
    let kept = peers();
    // The build is that of the last mesh, the largest.
    let [one_thread, threads, meshes @ .., build] = &kept[..] else { panic!("{kept:?}") };
    let rows = table(&read("crates/fast/benches/README.md"), "Closest hits in meshes");
    assert_eq!(meshes.len(), rows.len());
    for (row, rays) in rows.iter().zip(meshes) {
        let triangles = numbers(rays.0.split(": ").next().expect("what was measured"));
        assert!(is_rounded(&row[0], triangles[0]), "{row:?} is not of {triangles:?}");
        assert_shows(&row[1..], rays);
    }
    let shown = [one_thread, threads, &meshes[meshes.len() - 1], build];
    let page = table(&read("docs/speed.md"), "Beside other programs");
    assert_eq!(page.len(), shown.len());
    for (row, kept) in page.iter().zip(shown) {
        assert_shows(&row[2..], kept);
    }
    let printed = result("peers");
    let date = printed.split(',').next().expect("a date");
    assert!(read("docs/speed.md").contains(&format!("2 cores, {date}.")), "{date}");
}
