//! Tables for people: labels on the left, one column of values a file.

use anstyle::Style;

const HEAD: Style = Style::new().bold();

/// Rows under a head; an empty label starts a section.
#[derive(Debug, Default)]
pub(crate) struct Table {
    head: Vec<String>,
    rows: Vec<(String, Vec<String>)>,
}

impl Table {
    pub(crate) fn new(head: Vec<String>) -> Self {
        Self { head, rows: Vec::new() }
    }

    pub(crate) fn row(&mut self, label: &str, values: Vec<String>) {
        self.rows.push((label.to_owned(), values));
    }

    pub(crate) fn section(&mut self, title: &str) {
        self.rows.push((title.to_owned(), Vec::new()));
    }

    /// The table as lines; section titles and the head are bold with `color`.
    pub(crate) fn render(&self, color: bool) -> String {
        let left = self.rows.iter().map(|(label, _)| width(label) + 2).max().unwrap_or(0);
        let columns: Vec<usize> = (0..self.head.len())
            .map(|column| {
                let values = self.rows.iter().filter_map(|(_, values)| values.get(column));
                values.chain([&self.head[column]]).map(|text| width(text)).max().unwrap_or(0)
            })
            .collect();
        let line = |label: &str, values: &[String]| {
            let mut text = format!("{label}{}", " ".repeat(left - width(label).min(left)));
            for (value, &column) in values.iter().zip(&columns) {
                text += &format!("  {}{value}", " ".repeat(column - width(value)));
            }
            text.trim_end().to_owned()
        };
        let bold = |text: String| if color { format!("{HEAD}{text}{HEAD:#}\n") } else { text + "\n" };
        let mut text = String::new();
        if self.head.iter().any(|head| !head.is_empty()) {
            text += &bold(line("", &self.head));
        }
        for (label, values) in &self.rows {
            text += &match values.is_empty() {
                true => bold(label.clone()),
                false => line(&format!("  {label}"), values) + "\n",
            };
        }
        text
    }
}

fn width(text: &str) -> usize {
    text.chars().count()
}

/// Four significant digits; scientific where that is shorter; a dash where there is no value.
pub(crate) fn short(value: impl Into<Option<f64>>) -> String {
    let Some(value) = value.into() else { return "–".to_owned() };
    if !value.is_finite() {
        return value.to_string();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // The exponent after rounding: 0.99999 is shown as 1.000.
    let scientific = format!("{value:.3e}");
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        Some(exponent @ -4..6) => format!("{value:.decimals$}", decimals = (3 - exponent).max(0) as usize),
        _ => scientific,
    }
}

/// Digits in groups of three, as people read them.
pub(crate) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// `1 face`, `2 faces`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    match (count, noun) {
        (1, _) => format!("1 {noun}"),
        (_, "vertex") => format!("{} vertices", grouped(count)),
        _ => format!("{} {noun}s", grouped(count)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Table, counted, grouped, short};

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 1.0, 0.99999, 0.123456, 1234.56, 1.5e-9, 7.25e8, f64::INFINITY].map(short);
        assert_eq!(shown, ["0", "1.000", "1.000", "0.1235", "1235", "1.500e-9", "7.250e8", "inf"]);
        assert_eq!(short(None), "–");
        assert_eq!([7, 1234, 1_234_567].map(grouped), ["7", "1 234", "1 234 567"]);
        assert_eq!(counted(1, "vertex") + ", " + &counted(2, "vertex"), "1 vertex, 2 vertices");
    }

    #[test]
    fn columns_are_aligned_on_the_right() {
        let mut table = Table::new(vec!["a.obj".into(), "longer.obj".into()]);
        table.section("area");
        table.row("error", vec!["1".into(), "22".into()]);
        insta::assert_snapshot!(table.render(false), @r"
                 a.obj  longer.obj
        area
          error      1          22
        ");
    }
}
