//! Tables of the report: as CSV for programs, as Markdown for people.

/// Rows under heads.
#[derive(Clone, Debug, Default)]
pub struct Table {
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table with these heads, separated by spaces.
    pub fn new(heads: &str) -> Self {
        Self::with_heads(heads.split(' '))
    }

    /// An empty table with these heads.
    pub fn with_heads<'a>(heads: impl IntoIterator<Item = &'a str>) -> Self {
        Self { heads: heads.into_iter().map(str::to_owned).collect(), rows: Vec::new() }
    }

    /// Adds a row; no cell may hold a comma.
    pub fn push(&mut self, row: impl IntoIterator<Item = String>) {
        let row: Vec<_> = row.into_iter().collect();
        assert_eq!(row.len(), self.heads.len(), "a cell for every head");
        assert!(row.iter().all(|cell| !cell.contains(',')), "cells hold no commas");
        self.rows.push(row);
    }

    /// The table as CSV, with a line of heads.
    pub fn csv(&self) -> String {
        let lines = [&self.heads].into_iter().chain(&self.rows);
        lines.map(|line| line.join(",") + "\n").collect()
    }

    /// The table as Markdown, its first column flush left.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let mut text = line(&self.heads);
        text += "|---|";
        text += &"---:|".repeat(self.heads.len() - 1);
        text += "\n";
        text + &self.rows.iter().map(|row| line(row)).collect::<String>()
    }
}

/// `number` with ten digits that count: for CSV.
pub fn digits(number: f64) -> String {
    if number == 0.0 { "0".to_owned() } else { format!("{number:.9e}") }
}

/// `number` as people write it, with `count` digits that count.
pub fn short(number: f64, count: i32) -> String {
    if number == 0.0 || !number.is_finite() {
        return if number == 0.0 { "0".to_owned() } else { "-".to_owned() };
    }
    let power = number.abs().log10().floor() as i32;
    if !(-3..6).contains(&power) {
        return format!("{number:.*e}", (count - 1).max(0) as usize);
    }
    // Digits before the point that do not count are zeros.
    let unit = 10_f64.powi((power + 1 - count).max(0));
    let rounded = (number / unit).round() * unit;
    let rounded = if unit > 1.0 { rounded } else { number };
    format!("{rounded:.*}", (count - 1 - power).max(0) as usize)
}

/// A fraction as percent.
pub fn percent(fraction: f64) -> String {
    format!("{} %", short(100.0 * fraction, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_the_digits_that_count() {
        let known = [
            (0.0, "0"),
            (1.0, "1.00"),
            (252_962.0, "253000"),
            (25_300_000.0, "2.53e7"),
            (-0.012_34, "-0.0123"),
            (0.000_123_4, "1.23e-4"),
            (f64::INFINITY, "-"),
        ];
        for (number, text) in known {
            assert_eq!(short(number, 3), text);
        }
        assert_eq!(percent(0.0199), "1.99 %");
    }

    #[test]
    fn tables_as_csv_and_markdown() {
        let mut table = Table::new("a b");
        table.push(["1", "2"].map(str::to_owned));
        assert_eq!(table.csv(), "a,b\n1,2\n");
        assert_eq!(table.markdown(), "| a | b |\n|---|---:|\n| 1 | 2 |\n");
    }
}
