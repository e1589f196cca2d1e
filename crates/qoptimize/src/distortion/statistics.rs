//! Sums and quantiles that do not depend on the number of threads.

use std::ops::Range;

use rayon::prelude::*;

/// What `part` says of each run of faces, in order. The runs are the same for any number of threads, so sums over them
/// have the same bits.
pub(super) fn by_runs<T: Send>(faces: usize, part: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    const RUN: usize = 4096;
    (0..faces.div_ceil(RUN))
        .into_par_iter()
        .map(|run| part(run * RUN..((run + 1) * RUN).min(faces)))
        .collect()
}

/// All lists one after the other, copied by all threads: on large meshes most of the time goes into fresh memory.
pub(super) fn concatenated(parts: Vec<Vec<f64>>) -> Vec<f64> {
    let mut all = vec![0.0; parts.iter().map(Vec::len).sum()];
    let mut rest = all.as_mut_slice();
    let mut places = Vec::with_capacity(parts.len());
    for part in parts {
        let (here, after) = rest.split_at_mut(part.len());
        rest = after;
        places.push((here, part));
    }
    places.into_par_iter().for_each(|(here, part)| here.copy_from_slice(&part));
    all
}

/// The `fraction`-quantile, linear between neighbours (definition 7 of Hyndman and Fan 1996, NumPy's default).
/// Reorders the values. `None` without values.
pub(super) fn quantile(values: &mut [f64], fraction: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = fraction * last as f64;
    let index = (place.floor() as usize).min(last);
    let (_, &mut low, above) = values.select_nth_unstable_by(index, f64::total_cmp);
    let high = above.iter().copied().min_by(f64::total_cmp).unwrap_or(low);
    Some(low + (high - low) * (place - index as f64))
}

#[cfg(test)]
mod tests {
    use super::{concatenated, quantile};

    #[test]
    fn lists_keep_their_order() {
        assert_eq!(concatenated(vec![vec![3.0, 1.0], vec![], vec![2.0]]), [3.0, 1.0, 2.0]);
        assert_eq!(concatenated(Vec::new()), []);
    }

    /// `numpy.quantile([3, 1, 2, 10], [0, .5, .99, 1])`.
    #[test]
    fn quantiles_are_linear() {
        for (fraction, expected) in [(0.0, 1.0), (0.5, 2.5), (0.99, 9.79), (1.0, 10.0)] {
            let found = quantile(&mut [3.0, 1.0, 2.0, 10.0], fraction).unwrap();
            assert!((found - expected).abs() < 1e-12, "{fraction}: {found}");
        }
        assert_eq!(quantile(&mut [], 0.5), None);
        assert_eq!(quantile(&mut [7.0], 0.99), Some(7.0));
    }
}
