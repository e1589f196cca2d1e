//! Numbers as the table shows them.

/// The middle value; the mean of the two middle ones of an even number.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[half],
        _ => f64::midpoint(values[half - 1], values[half]),
    }
}

/// Three significant digits: plain between 0.001 and 100,000, else with an exponent.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    // Rounding can carry into the next power of ten: ask the rounded number for its exponent.
    let scientific = format!("{value:.2e}");
    let (_, exponent) = scientific.split_once('e').unwrap_or(("", "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..5).contains(&exponent) {
        let decimals = usize::try_from(2 - exponent).unwrap_or(0);
        let rounded: f64 = scientific.parse().unwrap_or(value);
        format!("{rounded:.decimals$}")
    } else {
        scientific
    }
}

/// A figure and how many times ours it is: `57.8 (×2.31)`.
pub(super) fn against(value: f64, ours: Option<f64>) -> String {
    match ours {
        Some(ours) if ours > 0.0 && value.is_finite() => {
            format!("{} (×{})", short(value), short(value / ours))
        }
        _ => short(value),
    }
}

/// A count against ours: a ratio, or what is added to none.
pub(super) fn count_against(value: usize, ours: Option<usize>) -> String {
    match ours {
        Some(0) if value > 0 => format!("{value} (+{value})"),
        Some(ours) if ours > 0 && value != ours => {
            format!("{value} (×{})", short(value as f64 / ours as f64))
        }
        _ => value.to_string(),
    }
}

/// A ratio of times or memory, which are noisy: two digits.
pub(super) fn ratio(value: f64) -> String {
    match value {
        large if large >= 9.95 => format!("{large:.0}"),
        middle if middle >= 0.0995 => format!("{middle:.1}"),
        small => format!("{small:.2}"),
    }
}
