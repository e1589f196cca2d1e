//! One mesh, several `q`: the trade-off between angles and areas, in the form of the paper's Table 1.
//!
//! ```
//! use qparam_cli::qmesh::shapes;
//! use qparam_cli::qoptimize::{Method, Options};
//! use qparam_cli::qsimplify::{RemovalRule, SimplifyOptions};
//! use qparam_cli::sweep::{Trend, sweep};
//!
//! let simplify = SimplifyOptions { rule: RemovalRule::All, ..SimplifyOptions::default() };
//! let options = Options { method: Method::Paper, simplify, ..Options::default() };
//! let result = sweep(&shapes::bump(8, 0.5), &options, &[1.0, 0.5, 0.0], &())?;
//! assert_eq!(result.columns.len(), 3);
//! assert_eq!(result.features.angle.trend, Trend::Falls);
//! # Ok::<(), qparam_cli::qoptimize::ParameterizeError>(())
//! ```

mod features;
mod knee;

pub use features::{Change, Features, Smallest, Trend};
pub use knee::{Knee, NoKnee, knee};

use qoptimize::qmesh::{Observer, QuadMesh};
use qoptimize::{
    Certificate, Continuation, Distortion, Options, Parameterization, ParameterizeError, parameterize_from,
};
use serde::Serialize;

use crate::table::short;

/// The `q` of the paper's Table 1.
pub const TABLE_1_Q: [f64; 5] = [1.0, 0.8, 0.5, 0.2, 0.0];

/// Errors below this are none: what rounding, and the last step of an iteration, leave on a mesh that can be flattened.
pub const VANISHING: f64 = 1e-9;

/// An error as tables show it: four significant digits, so that every machine shows the same; two from 1e10 on, where
/// some corner has all but vanished and its size is rounding.
#[must_use]
pub fn digits(error: f64) -> String {
    match error.abs() {
        size if size < VANISHING => "0".to_owned(),
        size if size >= 1e10 => format!("{error:.1e}"),
        _ => short(error),
    }
}

/// What Table 1 shows of a map, at one `q`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// 1 angle-true, 0 area-true.
    pub q: f64,
    /// Eq. 13.
    pub angle: f64,
    /// Eq. 14.
    pub area: f64,
}

impl Errors {
    /// Of both errors.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.angle + self.area
    }
}

/// The map at one `q`, or why there is none.
#[derive(Clone, Debug)]
pub struct Column {
    /// 1 angle-true, 0 area-true.
    pub q: f64,
    /// Its measures.
    pub outcome: Result<Distortion, ParameterizeError>,
    /// The proof that it is valid, or what is wrong with it; nothing where there is no map.
    pub certificate: Option<Certificate>,
}

impl Column {
    /// The errors of the map, if there is one.
    #[must_use]
    pub fn errors(&self) -> Option<Errors> {
        let distortion = self.outcome.as_ref().ok()?;
        Some(Errors { q: self.q, angle: distortion.angle_error, area: distortion.area_error })
    }

    /// Whether there is a map that is certified to have neither flips nor overlaps.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.certificate.as_ref().is_some_and(|certificate| certificate.holds)
    }
}

/// A whole sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// One a `q`, in the order asked for.
    pub columns: Vec<Column>,
    /// Whether the three features of Table 1 hold, over all maps there are.
    pub features: Features,
    /// Where the trade-off bends, over the valid maps.
    pub knee: Result<Knee, NoKnee>,
}

/// Maps `mesh` once for each `q`; the `q` of `options` is not read.
///
/// A `q` without a map leaves a gap: its column says why. The observer hears of the maps one after the other; which comes first does not
/// depend on the order of `q`.
///
/// # Errors
/// [`ParameterizeError::Cancelled`] when the observer stops; the first error when no `q` has a map.
pub fn sweep(
    mesh: &QuadMesh,
    options: &Options,
    q: &[f64],
    observer: &dyn Observer,
) -> Result<Sweep, ParameterizeError> {
    let mut columns: Vec<Option<Column>> = vec![None; q.len()];
    let mut continuation = Continuation::default();
    for place in middle_first(q) {
        let q = q[place];
        let map = parameterize_from(&mut continuation, mesh, &Options { q, ..options.clone() }, observer);
        columns[place] = Some(match map {
            Ok(Parameterization { distortion, certificate, .. }) => {
                Column { q, outcome: Ok(distortion), certificate: Some(certificate) }
            }
            Err(ParameterizeError::Cancelled) => return Err(ParameterizeError::Cancelled),
            Err(error) => Column { q, outcome: Err(error), certificate: None },
        });
    }
    let columns: Vec<Column> = columns.into_iter().flatten().collect();
    if columns.iter().all(|column| column.outcome.is_err())
        && let Some(Column { outcome: Err(error), .. }) = columns.first()
    {
        return Err(error.clone());
    }
    Ok(Sweep::of(columns))
}

/// The places of the values of `q` in the order in which their maps are found fastest: the one in the middle, where a first descent is
/// short, from there up to the largest, each predicted from those before, and then down to the smallest.
pub(crate) fn middle_first(q: &[f64]) -> Vec<usize> {
    const MIDDLE: f64 = 0.6;
    let mut rising: Vec<usize> = (0..q.len()).collect();
    rising.sort_by(|&a, &b| q[a].total_cmp(&q[b]));
    let far = |place: usize| (q[place] - MIDDLE).abs();
    let middle = (0..q.len()).min_by(|&a, &b| far(rising[a]).total_cmp(&far(rising[b]))).unwrap_or(0);
    let below = rising[..middle].iter().rev();
    rising[middle..].iter().chain(below).copied().collect()
}

impl Sweep {
    /// Reads features and knee off columns.
    #[must_use]
    pub fn of(columns: Vec<Column>) -> Self {
        let errors: Vec<Errors> = columns.iter().filter_map(Column::errors).collect();
        let valid: Vec<Errors> =
            columns.iter().filter(|column| column.is_valid()).filter_map(Column::errors).collect();
        Self { features: Features::of(&errors), knee: knee(&valid), columns }
    }

    /// The three features of Table 1 and the knee, a sentence each.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = self.features.sentences().to_vec();
        sentences.push(match &self.knee {
            Ok(knee) => format!("knee of the trade-off: q = {}", knee.q),
            Err(reason) => format!("knee of the trade-off: none, {reason}"),
        });
        sentences
    }
}

#[cfg(test)]
mod tests {
    use super::middle_first;

    #[test]
    fn sweeps_begin_in_the_middle() {
        for (q, expected) in [
            (&[][..], &[][..]),
            (&[0.3], &[0.3]),
            (&[1.0, 0.8, 0.5, 0.2, 0.0], &[0.5, 0.8, 1.0, 0.2, 0.0]),
            (&[0.0, 0.1, 0.2], &[0.2, 0.1, 0.0]),
            (&[0.9, 0.7, 1.0], &[0.7, 0.9, 1.0]),
        ] {
            let found: Vec<f64> = middle_first(q).into_iter().map(|place| q[place]).collect();
            assert_eq!(found, expected);
        }
    }
}
