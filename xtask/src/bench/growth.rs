//! How time grows with size.

use super::estimates::Estimate;

/// One stage at all its sizes.
pub(super) struct Row {
    pub(super) stage: String,
    pub(super) times: Vec<Estimate>,
    /// The exponent; `None` for a single size.
    pub(super) growth: Option<f64>,
}

/// One row a stage; the estimates are sorted by stage.
pub(super) fn rows(estimates: &[Estimate]) -> Vec<Row> {
    let stages = estimates.chunk_by(|a, b| a.stage == b.stage);
    stages
        .map(|times| Row { stage: times[0].stage.clone(), times: times.to_vec(), growth: exponent(times) })
        .collect()
}

/// The slope of log time over log quads, by least squares.
fn exponent(times: &[Estimate]) -> Option<f64> {
    let points: Vec<(f64, f64)> = times.iter().map(|t| ((t.quads as f64).ln(), t.nanoseconds.ln())).collect();
    let count = points.len() as f64;
    let mean = |value: fn(&(f64, f64)) -> f64| points.iter().map(value).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let joint: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    (spread > 0.0).then(|| joint / spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// time = c · quads^k gives k, whatever c is.
    #[test]
    fn a_power_law_has_its_exponent() {
        for k in [0.5, 1.0, 1.5, 2.0] {
            let times: Vec<_> = [1024, 10_000, 99_856]
                .map(|quads| Estimate { stage: "x".into(), quads, nanoseconds: 7.0 * (quads as f64).powf(k) })
                .into();
            assert!((exponent(&times).unwrap() - k).abs() < 1e-12);
        }
        assert_eq!(exponent(&[Estimate { stage: "x".into(), quads: 5, nanoseconds: 1.0 }]), None);
    }
}
