//! How sure the grader is: what pages say is what the tables in `golden/` have.

use super::computed::assert_says;
use super::numbers::table;
use super::read;

/// The rows of a section, without spaces and the commas of large numbers.
fn rows(page: &str, heading: &str) -> Vec<Vec<String>> {
    let plain = |cell: String| cell.trim().replace(',', "");
    let rows = table(&read(page), heading).into_iter();
    rows.map(|row| row.into_iter().map(plain).collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("no number: {cell}"))
}

#[test]
fn correct_submissions_called_incorrect_are_those_of_the_tables() {
    let lists = rows("golden/grading.md", "Correct submissions called incorrect");
    let shown = rows("docs/grading.md", "How sure it is");
    for row in &lists {
        assert!(shown.contains(row), "{row:?}");
    }
    let all = lists.last().expect("a sum");
    let [count, alarms] = [number(&all[1]), number(&all[5])];
    assert_says("README.md", "calls incorrect|# of #|", &[alarms, count]);

    let pictures = read("golden/grading-pictures.md");
    let row = |line: &str| -> Option<[f64; 3]> {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let is_correct =
            cells.get(2).is_some_and(|it| it.contains("surface") || it.contains("off"));
        is_correct.then(|| [number(cells[3]), number(cells[4]), number(cells[5])])
    };
    let rows = pictures.lines().filter_map(row);
    let sums = rows.fold([0.0; 3], |sums, row| std::array::from_fn(|at| sums[at] + row[at]));
    let words = "Of # correct pictures, # are called incorrect, and # are undecided";
    assert_says("docs/grading.md", words, &sums);
}

#[test]
fn power_is_that_of_the_table() {
    let shown = rows("docs/grading.md", "How sure it is");
    for row in rows("golden/grading.md", "What more would cost") {
        assert!(shown.contains(&row), "{row:?}");
    }
    let found = rows("golden/grading.md", "Found and named");
    let of_size =
        |size: &'static str| found.iter().filter(move |row| row[1] == size && row[0] != "`fair`");
    let numbers = |cell: &str| -> Vec<String> {
        cell.split('/').map(|part| part.trim().to_owned()).collect()
    };
    // Eight lists a row.
    let small = of_size("10000").fold([0.0; 3], |[found, all, named], row| {
        let cell = numbers(&row[3]);
        [found + number(&cell[1]), all + 8.0, named + number(&cell[2])]
    });
    let words = "finds # of # wrong lists by positions and the number emitted, and names # of them";
    assert_says("docs/grading.md", words, &small);

    // Of what the best tests find of all misreadings together, how much the judge finds.
    for size in ["10000", "100000", "200000", "1000000"] {
        let mut sums = [[0.0; 2]; 2];
        for row in of_size(size) {
            for (sum, cell) in sums.iter_mut().zip(&row[2..]) {
                let numbers = numbers(cell);
                // Of self-hits, no best test is known.
                if numbers[0] != "-" {
                    sum[0] += number(&numbers[0]);
                    sum[1] += number(&numbers[1]);
                }
            }
        }
        let parts = sums.map(|[best, found]| format!("{:.0} %", 100.0 * found / best));
        let row = [size, &parts[0], &parts[1]].map(str::to_owned).to_vec();
        assert!(shown.contains(&row), "{row:?}");
    }
}
