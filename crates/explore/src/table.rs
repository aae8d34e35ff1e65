//! The table of stored photons as HTML.

use compare::numbers::thousands;
use oracle::summary::{SummaryCell, SurfaceSummary};

use super::comparison::ListComparison;
use super::html::escape;

const HEADINGS: [&str; 5] = ["bounce 1", "bounce 2", "bounce 3", "bounce 4+", "stored"];

/// A row for each of `surfaces` and one for `total`, with what the list of `comparison` stores.
/// The value of a cell's button names the surface and the bounce, both from 0; -1 is any.
pub fn table(
    (surfaces, total): (&[SurfaceSummary], &SurfaceSummary),
    comparison: Option<&ListComparison>,
) -> String {
    let others = comparison.map(|comparison| comparison.table(surfaces.len()));
    let rows = surfaces.iter().chain([total]).enumerate().map(|(index, row)| {
        let SurfaceSummary { name, stored, expected, z, .. } = row;
        let name = escape(name);
        let whole = SummaryCell { bounce: 0, stored: *stored, expected: *expected, z: *z };
        let cells = row.by_bounce.iter().take(3).chain([&row.late, &whole]).zip(HEADINGS);
        let cells = cells.enumerate().map(|(column, (cell, heading))| {
            let place = |at: usize, last: usize| if at == last { -1 } else { at as i32 };
            let (surface, bounce) =
                (place(index, surfaces.len()), place(column, HEADINGS.len() - 1));
            let other = others.as_ref().and_then(|table| table[index][column]);
            format!(
                "<td><button value=\"{surface} {bounce}\" title=\"{name}, {heading}\" \
                 aria-pressed=\"false\">{}</button></td>",
                numbers(cell, other)
            )
        });
        let head = if index < surfaces.len() { choice(index, &name) } else { name.clone() };
        format!("<tr><th scope=\"row\">{head}</th>{}</tr>", cells.collect::<String>())
    });
    let rows: String = rows.collect();
    let headings = HEADINGS.iter().enumerate().map(|(bounce, name)| {
        let is_bounce = bounce < HEADINGS.len() - 1;
        let head = if is_bounce { choice(bounce, name) } else { (*name).to_owned() };
        format!("<th scope=\"col\">{head}</th>")
    });
    let headings: String = headings.collect();
    format!("<thead><tr><th scope=\"col\">surface</th>{headings}</tr></thead><tbody>{rows}</tbody>")
}

/// A box to tick, with the name of the row or column that it shows.
fn choice(value: usize, name: &str) -> String {
    format!("<label><input type=\"checkbox\" value=\"{value}\" checked>{name}</label>")
}

fn numbers(cell: &SummaryCell, other: Option<u64>) -> String {
    let mut html = format!("<b>{}</b>", thousands(cell.stored));
    if let Some(other) = other {
        html += &format!("<b class=\"extra\">{}</b>", thousands(other));
    }
    if let Some(expected) = cell.expected {
        let tenths = (expected * 10.0).round() as u64;
        html += &format!("<span>{}.{}</span>", thousands(tenths / 10), tenths % 10);
    }
    if let Some(z) = cell.z {
        let tag = if z.abs() > 4.0 { "strong" } else { "span" };
        let deviations = format!("{z:+.1} σ").replace('-', "−");
        html += &format!("<{tag}>{deviations}</{tag}>");
    }
    html
}
