//! The knee of the trade-off: the q beyond which one error costs much more of the other.
//!
//! Errors span decades, so both axes are logarithmic and scaled to [0, 1] between the ends of the Pareto front
//! (the maps that no other map beats in both errors). The knee is the map of the front that lies farthest below
//! the chord from one end to the other, towards the origin. This is the rule of [Satopää2011] ("Kneedle"), with
//! the perpendicular distance.
//!
//! [Satopää2011]: V. Satopää et al., Finding a "Kneedle" in a Haystack, ICDCS Workshops 2011.

use std::fmt;

use serde::Serialize;

use super::{Errors, VANISHING};

/// A front that spans less than this factor in one of the errors has no knee worth a name.
const LEAST_FACTOR: f64 = 1.01;
/// A front nearer to its chord than this has no bend; the farthest that any can come is √½. Table 1 has 0.075 and 0.11.
const LEAST_DISTANCE: f64 = 0.05;

/// Where the trade-off bends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Knee {
    /// There.
    pub q: f64,
    /// Distance from the chord, where the front spans the unit square; between 0.05 and √½.
    pub distance: f64,
}

/// Why there is no knee.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoKnee {
    /// A knee needs two ends and something between.
    TooFewMaps,
    /// On the front, one error hardly changes.
    NoTradeOff,
    /// One of the errors vanishes.
    NoError,
    /// The front is straight, or bends away from the origin.
    Straight,
}

impl fmt::Display for NoKnee {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooFewMaps => "fewer than three valid maps trade one error for the other",
            Self::NoTradeOff => "q trades less than 1 % of one error for the other",
            Self::NoError => "a map without error leaves nothing to trade",
            Self::Straight => "the trade-off is straight or bends outwards on logarithmic scales",
        })
    }
}

/// The knee of maps in any order.
///
/// # Errors
/// [`NoKnee`] when the front is degenerate.
pub fn knee(errors: &[Errors]) -> Result<Knee, NoKnee> {
    if errors.iter().any(|e| e.angle.min(e.area) < VANISHING) {
        return Err(NoKnee::NoError);
    }
    let front = front(errors);
    let [first, _, .., last] = front[..] else {
        return Err(NoKnee::TooFewMaps);
    };
    if last.angle < first.angle * LEAST_FACTOR || first.area < last.area * LEAST_FACTOR {
        return Err(NoKnee::NoTradeOff);
    }
    let share = |low: f64, high: f64, value: f64| (value / low).ln() / (high / low).ln();
    let distance = |e: &Errors| {
        // The chord runs from (0, 1) to (1, 0).
        let sum = share(first.angle, last.angle, e.angle) + share(last.area, first.area, e.area);
        (1.0 - sum) * std::f64::consts::FRAC_1_SQRT_2
    };
    let farthest = front.iter().map(|e| Knee { q: e.q, distance: distance(e) });
    let farthest = farthest.max_by(|a, b| a.distance.total_cmp(&b.distance));
    farthest.filter(|knee| knee.distance >= LEAST_DISTANCE).ok_or(NoKnee::Straight)
}

/// The maps that no other beats in both errors, by rising angle error and so by falling area error.
fn front(errors: &[Errors]) -> Vec<Errors> {
    let mut sorted = errors.to_vec();
    sorted.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.area.total_cmp(&b.area)));
    let mut front: Vec<Errors> = Vec::new();
    for e in sorted {
        if front.last().is_none_or(|last| e.area < last.area) {
            front.push(e);
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(pairs: &[(f64, f64)]) -> Vec<Errors> {
        let last = (pairs.len().max(2) - 1) as f64;
        let q = |i: usize| 1.0 - i as f64 / last;
        pairs.iter().enumerate().map(|(i, &(angle, area))| Errors { q: q(i), angle, area }).collect()
    }

    /// An L in log-log has its knee in the corner, whatever the units of the errors.
    #[test]
    fn a_corner_is_the_knee_in_any_unit() {
        for unit in [1e-8, 1.0, 1e9] {
            let knee = knee(&errors(&[(unit, 1e4), (2.0 * unit, 2.0), (100.0 * unit, 1.0)])).unwrap();
            assert_eq!(knee.q, 0.5);
            assert!(knee.distance > 0.5 && knee.distance < std::f64::consts::FRAC_1_SQRT_2);
        }
    }

    /// The paper calls "about 0.5" the best q of its Table 1: there its trade-off bends, for both models.
    #[test]
    fn the_knee_of_table_1() {
        let angle = [[8.74, 10.98, 14.20, 17.41, 20.01], [12.56, 15.42, 18.95, 25.83, 29.57]];
        let area = [[30.93, 26.44, 22.58, 20.27, 19.63], [44.81, 39.87, 31.25, 28.21, 25.42]];
        for (angle, area) in angle.into_iter().zip(area) {
            let rows = angle.into_iter().zip(area).zip(crate::sweep::TABLE_1_Q);
            let errors: Vec<_> = rows.map(|((angle, area), q)| Errors { q, angle, area }).collect();
            assert_eq!(knee(&errors).unwrap().q, 0.5);
        }
    }

    /// Maps beaten in both errors change nothing.
    #[test]
    fn beaten_maps_do_not_count() {
        let front = [(1.0, 100.0), (2.0, 3.0), (50.0, 1.0)];
        let expected = knee(&errors(&front)).unwrap();
        let mut more = errors(&front);
        more.push(Errors { q: 0.33, angle: 60.0, area: 5.0 });
        more.reverse();
        assert_eq!(knee(&more).unwrap(), expected);
    }

    #[test]
    fn degenerate_fronts_have_none() {
        let none = |pairs: &[(f64, f64)]| knee(&errors(pairs)).unwrap_err();
        assert_eq!(none(&[]), NoKnee::TooFewMaps);
        assert_eq!(none(&[(1.0, 2.0), (2.0, 1.0)]), NoKnee::TooFewMaps);
        assert_eq!(none(&[(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]), NoKnee::TooFewMaps, "one beats all");
        assert_eq!(none(&[(1.0, 1.001), (2.0, 1.0005), (3.0, 1.0)]), NoKnee::NoTradeOff);
        assert_eq!(none(&[(0.0, 1.0), (2.0, 0.5), (3.0, 0.0)]), NoKnee::NoError);
        assert_eq!(none(&[(1.0, 100.0), (10.0, 10.0), (100.0, 1.0)]), NoKnee::Straight);
        assert_eq!(none(&[(1.0, 100.0), (50.0, 50.0), (100.0, 1.0)]), NoKnee::Straight);
    }
}
