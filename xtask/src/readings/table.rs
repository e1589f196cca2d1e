//! Markdown tables, and numbers with three digits.

use std::fmt::Write as _;

/// Errors beyond this are those of triangles whose area is a rounding error: no digit of them means anything.
pub(super) const MEANINGLESS: f64 = 1e15;
/// Smaller numbers are rounding errors, too.
const NOTHING: f64 = 1e-9;

/// Rows under a head.
pub(super) struct Table {
    text: String,
    columns: usize,
}

impl Table {
    /// The titles of the columns, separated by `|`.
    pub(super) fn new(head: &str) -> Self {
        let columns = head.split('|').count();
        let text = format!("| {head} |\n|{}\n", " --- |".repeat(columns));
        Self { text, columns }
    }

    pub(super) fn row(&mut self, cells: &[String]) {
        assert_eq!(cells.len(), self.columns, "one cell for each column: {cells:?}");
        // Writing to a string does not fail.
        let _ = writeln!(self.text, "| {} |", cells.join(" | "));
    }

    pub(super) fn text(self) -> String {
        self.text
    }
}

/// Three significant digits.
pub(super) fn digits(x: f64) -> String {
    if x.abs() > MEANINGLESS {
        return format!("> {MEANINGLESS:.0e}");
    }
    if x == 0.0 {
        return "0".to_owned();
    }
    if x.abs() < NOTHING {
        return format!("< {NOTHING:.0e}");
    }
    // What rounds to 1000 has one digit more than 999.
    let rounded: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    match rounded.abs().log10().floor() as i32 {
        magnitude @ -3..=2 => format!("{rounded:.*}", (2 - magnitude) as usize),
        3..=4 => format!("{rounded:.0}"),
        _ => format!("{rounded:.2e}"),
    }
}

/// Several numbers in one cell.
pub(super) fn series(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(digits).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let shown = [0.0, 0.003_456, 0.25, -1.0, 99.96, 999.6, 45_678.0, 234_567.0, 3e20].map(digits);
        assert_eq!(shown, ["0", "0.00346", "0.250", "-1.00", "100", "1000", "45700", "2.35e5", "> 1e15"]);
        assert_eq!(digits(1e-15), "< 1e-9");
    }

    #[test]
    fn tables_are_markdown() {
        let mut table = Table::new("a | b");
        table.row(&["1".to_owned(), "2".to_owned()]);
        assert_eq!(table.text(), "| a | b |\n| --- | --- |\n| 1 | 2 |\n");
    }
}
