//! The three features of the paper's Table 1, looked for in any sweep.
//!
//! Angle error falls as q → 1, area error falls as q → 0, and their sum is smallest at neither end.

use serde::Serialize;

use super::{Errors, VANISHING, digits};

/// Relative changes below this count as none: what is left of rounding, and of overlap removal, is smaller.
const LEVEL: f64 = 1e-4;

/// Sums this near to the smallest are as small.
const TIE: f64 = 1e-6;

/// How an error changes towards the end of q at which it should be smallest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trend {
    /// It never rises, and falls as a whole.
    Falls,
    /// It never falls, and rises as a whole.
    Rises,
    /// It stays within 0.01 %.
    Level,
    /// It falls and rises.
    Mixed,
    /// Fewer than two maps.
    Unknown,
}

/// The trend of one error, and how much there is of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Towards q = 1 for the angle error, towards q = 0 for the area error.
    pub trend: Trend,
    /// The error at the far end.
    pub first: f64,
    /// The error at the end where it should be smallest.
    pub last: f64,
    /// The first step, as a pair of q, that goes the wrong way.
    pub against: Option<[f64; 2]>,
}

/// Where the sum of both errors is smallest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Smallest {
    /// There.
    pub q: f64,
    /// The sum.
    pub sum: f64,
    /// Whether `q` is neither the largest nor the smallest, and the sum there lies below both ends by more than 0.01 %.
    pub inside: bool,
}

/// Whether a sweep looks like Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Features {
    /// Of the angle error (Eq. 13), as q → 1.
    pub angle: Change,
    /// Of the area error (Eq. 14), as q → 0.
    pub area: Change,
    /// Of the sum; `None` without a map.
    pub smallest: Option<Smallest>,
}

impl Features {
    /// Of maps in any order.
    #[must_use]
    pub fn of(errors: &[Errors]) -> Self {
        let clean = |error: f64| if error < VANISHING { 0.0 } else { error };
        let cleaned = errors.iter().map(|e| Errors { q: e.q, angle: clean(e.angle), area: clean(e.area) });
        let mut sorted: Vec<Errors> = cleaned.collect();
        sorted.sort_by(|a, b| a.q.total_cmp(&b.q));
        let angle: Vec<_> = sorted.iter().map(|e| (e.q, e.angle)).collect();
        let area: Vec<_> = sorted.iter().rev().map(|e| (e.q, e.area)).collect();
        Self { angle: change(&angle), area: change(&area), smallest: smallest(&sorted) }
    }

    /// How many of the three hold.
    #[must_use]
    pub fn held(&self) -> usize {
        let trends = [self.angle.trend, self.area.trend].into_iter().filter(|&trend| trend == Trend::Falls);
        trends.count() + usize::from(self.smallest.is_some_and(|smallest| smallest.inside))
    }

    /// One for each feature.
    #[must_use]
    pub fn sentences(&self) -> [String; 3] {
        let sum = match self.smallest {
            None => "not known, there is no map".to_owned(),
            Some(Smallest { q, sum, inside: true }) => format!("yes, {} at q = {q}", digits(sum)),
            Some(Smallest { q, sum, inside: false }) => format!("no, {} at q = {q}", digits(sum)),
        };
        [
            format!("angle error falls as q → 1: {}", self.angle.words()),
            format!("area error falls as q → 0: {}", self.area.words()),
            format!("smallest sum inside: {sum}"),
        ]
    }
}

impl Change {
    /// `yes` or `no`, and by how much.
    #[must_use]
    pub fn words(&self) -> String {
        let Self { trend, first, last, against } = self;
        let way = format!("{} → {}", digits(*first), digits(*last));
        match (trend, against) {
            (Trend::Falls, _) => format!("yes, {way} ({})", amount(*first, *last)),
            (Trend::Rises, _) => format!("no, it rises, {way} ({})", amount(*last, *first)),
            (Trend::Level, _) => format!("no, it stays level, {way}"),
            (Trend::Mixed, Some([from, to])) => {
                format!("no, it rises from q = {from} to {to}; {way} as a whole")
            }
            _ => "not known from fewer than two maps".to_owned(),
        }
    }
}

/// A factor where it is worth one, else per cent.
fn amount(large: f64, small: f64) -> String {
    match large / small {
        factor if factor >= 1.1 => format!("a factor of {}", digits(factor)),
        factor if factor.is_finite() => format!("{:.2} %", 100.0 * (1.0 - 1.0 / factor)),
        _ => "to zero".to_owned(),
    }
}

/// Values in the order in which they should fall.
fn change(values: &[(f64, f64)]) -> Change {
    let (first, last) = match values {
        [(_, first), .., (_, last)] => (*first, *last),
        _ => return Change { trend: Trend::Unknown, first: 0.0, last: 0.0, against: None },
    };
    let rises = |a: f64, b: f64| b > a * (1.0 + LEVEL);
    let against =
        values.windows(2).find(|pair| rises(pair[0].1, pair[1].1)).map(|pair| [pair[0].0, pair[1].0]);
    let down = values.windows(2).any(|pair| rises(pair[1].1, pair[0].1));
    let trend = match (down, against) {
        (true, Some(_)) => Trend::Mixed,
        (false, Some(_)) => Trend::Rises,
        (true, None) => Trend::Falls,
        // Steps too small to count, which may add up.
        (false, None) if rises(last, first) => Trend::Falls,
        (false, None) => Trend::Level,
    };
    Change { trend, first, last, against }
}

fn smallest(sorted: &[Errors]) -> Option<Smallest> {
    let least = sorted.iter().map(Errors::sum).min_by(f64::total_cmp)?;
    // Of equal sums the one of the smallest q: rounding shall not choose.
    let best = sorted.iter().find(|errors| errors.sum() <= least * (1.0 + TIE))?;
    let ends = [sorted.first()?.sum(), sorted.last()?.sum()];
    let inside = ends.iter().all(|end| *end > best.sum() * (1.0 + LEVEL));
    Some(Smallest { q: best.q, sum: best.sum(), inside })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(angle: [f64; 5], area: [f64; 5]) -> Vec<Errors> {
        let q = crate::sweep::TABLE_1_Q;
        (0..5).map(|i| Errors { q: q[i], angle: angle[i], area: area[i] }).collect()
    }

    /// The paper's own rows have all three features, in any order of the columns.
    #[test]
    fn table_1_has_its_features() {
        let mut face = errors([8.74, 10.98, 14.20, 17.41, 20.01], [30.93, 26.44, 22.58, 20.27, 19.63]);
        let head = errors([12.56, 15.42, 18.95, 25.83, 29.57], [44.81, 39.87, 31.25, 28.21, 25.42]);
        assert_eq!(Features::of(&face).held(), 3);
        assert_eq!(Features::of(&head).held(), 3);
        face.swap(0, 3);
        assert_eq!(Features::of(&face).smallest.map(|smallest| smallest.q), Some(0.5));
        insta::assert_snapshot!(Features::of(&face).sentences().join("\n"), @r"
        angle error falls as q → 1: yes, 20.01 → 8.740 (a factor of 2.289)
        area error falls as q → 0: yes, 30.93 → 19.63 (a factor of 1.576)
        smallest sum inside: yes, 36.78 at q = 0.5
        ");
    }

    /// A wrong step, a level row and a smallest sum at an end are called what they are.
    #[test]
    fn what_does_not_hold_is_said() {
        let found = Features::of(&errors([1.0, 2.0, 1.5, 3.0, 4.0], [7.0; 5]));
        assert_eq!((found.angle.trend, found.area.trend, found.held()), (Trend::Mixed, Trend::Level, 0));
        insta::assert_snapshot!(found.sentences().join("\n"), @r"
        angle error falls as q → 1: no, it rises from q = 0.5 to 0.8; 4.000 → 1.000 as a whole
        area error falls as q → 0: no, it stays level, 7.000 → 7.000
        smallest sum inside: no, 8.000 at q = 1
        ");
        let reversed = Features::of(&errors([5.0, 4.0, 3.0, 2.0, 1.0], [100.0, 99.9, 99.8, 99.7, 99.6]));
        assert_eq!(reversed.angle.trend, Trend::Rises);
        assert_eq!(reversed.area.words(), "yes, 100.0 → 99.60 (0.40 %)");
        assert_eq!(Features::of(&[]).held(), 0);
    }

    /// A flat mesh is mapped without error: rounding is no trend.
    #[test]
    fn rounding_is_no_trend() {
        let found = Features::of(&errors([1e-13, 3e-12, 2e-30, 0.0, 1e-29], [0.0; 5]));
        assert_eq!((found.angle.trend, found.area.trend), (Trend::Level, Trend::Level));
    }
}
