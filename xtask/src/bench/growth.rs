//! How time grows with size.

use super::estimates::Estimate;

/// One stage at all its sizes.
pub(super) struct Row {
    pub(super) stage: String,
    pub(super) times: Vec<Estimate>,
    /// The exponent; `None` for a single size.
    pub(super) growth: Option<f64>,
    /// The exponent over the sizes from [`LARGE`] on, where what is done once no longer counts.
    pub(super) growth_of_large: Option<f64>,
}

/// Quads from which a mesh is large.
pub(super) const LARGE: usize = 10_000;

/// One row a stage; the estimates are sorted by stage.
pub(super) fn rows(estimates: &[Estimate]) -> Vec<Row> {
    let stages = estimates.chunk_by(|a, b| a.stage == b.stage);
    let row = |times: &[Estimate]| {
        let large: Vec<Estimate> = times.iter().filter(|time| time.quads >= LARGE).cloned().collect();
        let stage = times[0].stage.clone();
        Row { stage, times: times.to_vec(), growth: exponent(times), growth_of_large: exponent(&large) }
    };
    stages.map(row).collect()
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
        assert_eq!(exponent(&[]), None);
    }

    /// What small meshes cost beside their quads does not show in the growth of large ones.
    #[test]
    fn large_meshes_have_a_growth_of_their_own() {
        let times = [(1024, 5e6), (10_000, 1e6), (1_000_000, 1e8)].map(|(quads, nanoseconds)| Estimate {
            stage: "x".into(),
            quads,
            nanoseconds,
        });
        let row = &rows(&times)[0];
        assert!((row.growth_of_large.unwrap() - 1.0).abs() < 1e-12);
        assert!(row.growth.unwrap() < 0.6);
    }
}
