//! Axes: which part of the numbers a plot shows, and its ticks.

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// Evenly, from the first bound to the second, which may be the smaller one.
    Linear,
    /// By their logarithms; bounds are positive.
    Logarithmic,
}

/// One axis.
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) scale: Scale,
    /// At the start and at the end of the axis.
    pub(crate) bounds: [f64; 2],
    /// The numbers that are written; none for powers of ten (or of a thousand, where there are many).
    pub(crate) marked: Vec<f64>,
}

impl Axis {
    /// A logarithmic axis that holds all `values` that have a logarithm, with some room.
    pub(crate) fn holding(label: &str, values: impl Iterator<Item = f64>) -> Self {
        let positive = values.filter(|&value| value > 0.0 && value.is_finite());
        let [low, high] = positive.fold([f64::INFINITY, 0.0_f64], |[low, high], v| [low.min(v), high.max(v)]);
        let bounds = if low <= high { [low / 1.6, high * 1.6] } else { [0.1, 10.0] };
        Self { label: label.to_owned(), scale: Scale::Logarithmic, bounds, marked: Vec::new() }
    }

    /// Where a value lies, 0 at the start and 1 at the end; nothing beyond.
    pub(super) fn fraction(&self, value: f64) -> Option<f64> {
        let along = |value: f64| if self.scale == Scale::Logarithmic { value.log10() } else { value };
        let [start, end] = self.bounds.map(along);
        let fraction = (along(value) - start) / (end - start);
        (-1e-9..=1.0 + 1e-9).contains(&fraction).then_some(fraction)
    }

    /// The numbers to write, with their texts.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        if !self.marked.is_empty() || self.scale == Scale::Linear {
            return self.marked.iter().map(|&value| (value, value.to_string())).collect();
        }
        let [low, high] = self.bounds.map(f64::log10);
        let (first, last) = (low.ceil() as i32, high.floor() as i32);
        let step = (last - first) / 7 + 1;
        let factors: &[f64] = if last - first < 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let exponents = (first - 1..=last).filter(|e| e.rem_euclid(step.max(1)) == 0);
        let values = exponents.flat_map(|e| factors.iter().map(move |factor| (factor * 10_f64.powi(e), e)));
        values
            .filter(|(value, _)| self.fraction(*value).is_some())
            .map(|(value, e)| (value, name(value, e)))
            .collect()
    }
}

/// Plain where that is short.
fn name(value: f64, exponent: i32) -> String {
    match exponent {
        -3..=4 => {
            let decimals = usize::try_from(-exponent).unwrap_or(0);
            format!("{value:.decimals$}")
        }
        _ => format!("1e{exponent}"),
    }
}
