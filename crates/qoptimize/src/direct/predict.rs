//! Where the next map of a series will lie, seen from the others.
//!
//! The map of least energy depends on q as smoothly as the energy does, so a polynomial through the maps at other q passes near it:
//! with three or more around it, often nearer than the tolerance of the descent. It is a polynomial in a stretched q: near 1, where
//! the area term fades out, maps change fastest.

use rayon::prelude::*;

use crate::qmesh::Vec2;

use super::Objective;

/// Maps that are kept. With more, polynomials would not be better, and each takes 16 bytes a vertex.
const MOST: usize = 5;
/// Maps that a polynomial goes through where the next one is not between them: there it would magnify what they are off by.
const MOST_BEYOND: usize = 3;
/// How much holds areas at q = 1, relative to what holds them at 0: what the symmetric Dirichlet term does. Of 0.1 to 1, the value with
/// which predictions were best on faces, heads and hills; without a stretch up to twice as many steps were left at 1.
const AREAS_AT_ONE: f64 = 0.2;
/// Vertices that one task takes.
const CHUNK: usize = 8192;
/// Maps whose dials are nearer than this count as one.
const APART: f64 = 1e-3;

/// Maps of one surface, each turned and moved to lie on the first as well as it can.
#[derive(Debug, Default)]
pub(super) struct Series {
    maps: Vec<(Objective, Vec<Vec2>)>,
}

impl Objective {
    pub(super) fn q(&self) -> f64 {
        match *self {
            Self::Direct { q, .. } | Self::Conformal { q } => q,
        }
    }

    fn with_q(self, q: f64) -> Self {
        match self {
            Self::Direct { shape, angle_term, .. } => Self::Direct { q, shape, angle_term },
            Self::Conformal { .. } => Self::Conformal { q },
        }
    }
}

impl Series {
    pub(super) fn is_empty(&self) -> bool {
        self.maps.is_empty()
    }

    /// Takes in the map of least energy, and turns and moves it to where it fits the others.
    pub(super) fn remember(&mut self, objective: &Objective, uv: &mut [Vec2]) {
        if let Some((_, first)) = self.maps.first() {
            lay_onto(first, uv);
        }
        self.maps.retain(|(other, _)| distance(other, objective) > APART);
        if self.maps.len() >= MOST {
            let far = |number: &usize| distance(&self.maps[*number].0, objective);
            let farthest = (0..self.maps.len()).max_by(|a, b| far(a).total_cmp(&far(b)));
            farthest.map(|number| self.maps.remove(number));
        }
        self.maps.push((*objective, uv.to_vec()));
    }

    /// The map whose objective is nearest; the later among equals.
    pub(super) fn nearest(&self, objective: &Objective) -> Option<&[Vec2]> {
        let far = |(other, _): &(Objective, Vec<Vec2>)| distance(other, objective);
        let nearest = self.maps.iter().rev().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map(|(_, uv)| uv.as_slice())
    }

    /// The map on the polynomial in the stretched q through the nearest others of the same kind; `None` where there are not two.
    pub(super) fn predicted(&self, objective: &Objective) -> Option<Vec<Vec2>> {
        let mut maps: Vec<_> = self.maps.iter().filter(|(other, _)| is_alike(other, objective)).collect();
        if maps.len() < 2 {
            return None;
        }
        maps.sort_by(|a, b| distance(&a.0, objective).total_cmp(&distance(&b.0, objective)));
        let q = objective.q();
        let is_between = maps.iter().any(|map| map.0.q() < q) && maps.iter().any(|map| map.0.q() > q);
        maps.truncate(if is_between { MOST } else { MOST_BEYOND });
        let nodes: Vec<f64> = maps.iter().map(|(other, _)| stretched(other.q())).collect();
        let weights = lagrange(&nodes, stretched(objective.q()));
        let at = |vertex: usize| {
            let terms = maps.iter().zip(&weights).map(|((_, uv), weight)| uv[vertex] * *weight);
            terms.fold(Vec2::zeros(), |sum, term| sum + term)
        };
        Some((0..maps[0].1.len()).into_par_iter().with_min_len(CHUNK).map(at).collect())
    }
}

/// Whether two objectives differ in q at most.
fn is_alike(a: &Objective, b: &Objective) -> bool {
    a.with_q(0.5) == b.with_q(0.5)
}

/// How far apart two objectives are in q; those of different kinds further than any of one kind.
fn distance(a: &Objective, b: &Objective) -> f64 {
    let apart = (a.q() - b.q()).abs();
    if is_alike(a, b) { apart } else { 2.0 + apart }
}

/// The variable in which maps are polynomials.
fn stretched(q: f64) -> f64 {
    -(1.0 - q + AREAS_AT_ONE).ln()
}

/// How much each of `nodes` counts at `q` [Lagrange].
fn lagrange(nodes: &[f64], q: f64) -> Vec<f64> {
    let weight = |i: usize| {
        let others = nodes.iter().enumerate().filter(|&(j, _)| j != i);
        others.map(|(_, other)| (q - other) / (nodes[i] - other)).product()
    };
    (0..nodes.len()).map(weight).collect()
}

/// Turns and moves `uv` to where it fits `target` best in the mean square.
fn lay_onto(target: &[Vec2], uv: &mut [Vec2]) {
    let [to, from] = [target, &*uv].map(middle);
    // In chunks of fixed size, so that the sums do not depend on the number of threads.
    let chunks = target.par_chunks(CHUNK).zip(uv.par_chunks(CHUNK));
    let sums: Vec<Vec2> = chunks
        .map(|(target, uv)| {
            let turned = |(t, p): (&Vec2, &Vec2)| {
                let (t, p) = (t - to, p - from);
                Vec2::new(p.dot(&t), p.perp(&t))
            };
            target.iter().zip(uv).map(turned).sum()
        })
        .collect();
    let Some(turn) = sums.iter().sum::<Vec2>().try_normalize(0.0) else { return };
    uv.par_iter_mut().with_min_len(CHUNK).for_each(|p| {
        let d = *p - from;
        *p = to + Vec2::new(turn.x * d.x - turn.y * d.y, turn.y * d.x + turn.x * d.y);
    });
}

fn middle(uv: &[Vec2]) -> Vec2 {
    let sums: Vec<Vec2> = uv.par_chunks(CHUNK).map(|chunk| chunk.iter().sum()).collect();
    sums.iter().sum::<Vec2>() / uv.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direct::AngleTerm;

    fn direct(q: f64) -> Objective {
        Objective::Direct { q, shape: 1.0, angle_term: AngleTerm::Log }
    }

    /// A map whose places are polynomials of the stretched q, turned and moved by what has nothing to do with q.
    fn map(q: f64, degree: i32, angle: f64) -> Vec<Vec2> {
        let q = stretched(q);
        let places = (0..40).map(|i| {
            let (x, y) = (f64::from(i % 8), f64::from(i / 8));
            Vec2::new(x + 0.1 * q.powi(degree) * y, y - 0.2 * q * x)
        });
        let (sin, cos) = angle.sin_cos();
        places.map(|p| Vec2::new(cos * p.x - sin * p.y + angle, sin * p.x + cos * p.y)).collect()
    }

    fn largest_difference(a: &[Vec2], b: &[Vec2]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    /// Maps on a polynomial are continued exactly: of degree 2 beyond them, of degree 4 between them.
    #[test]
    fn polynomials_are_continued() {
        for (nodes, degree, q) in [(&[0.0, 0.1, 0.2][..], 2, 0.3), (&[0.0, 1.0, 0.2, 0.4, 0.8], 4, 0.6)] {
            let series =
                Series { maps: nodes.iter().map(|&node| (direct(node), map(node, degree, 0.0))).collect() };
            let predicted = series.predicted(&direct(q)).unwrap();
            assert!(largest_difference(&predicted, &map(q, degree, 0.0)) < 1e-12);
        }
    }

    /// No more maps are kept than are of use, and those nearest to the last.
    #[test]
    fn the_farthest_are_forgotten() {
        let mut series = Series::default();
        for k in 0..20 {
            let q = f64::from(k) / 20.0;
            series.remember(&direct(q), &mut map(q, 2, 0.0));
        }
        let kept: Vec<f64> = series.maps.iter().map(|(objective, _)| objective.q()).collect();
        assert_eq!(kept, [0.75, 0.8, 0.85, 0.9, 0.95]);
    }

    /// What is remembered lies on the first map, however it was turned and moved.
    #[test]
    fn maps_are_laid_onto_the_first() {
        let mut series = Series::default();
        let first = map(0.5, 2, 0.0);
        series.remember(&direct(0.5), &mut first.clone());
        for angle in [0.3, 3.0, -1.5] {
            let mut turned = map(0.5, 2, angle);
            series.remember(&direct(0.5), &mut turned);
            assert!(largest_difference(&turned, &first) < 1e-12);
        }
    }

    /// Nothing is predicted from one map, nor from maps of other kinds; the nearest in q is found among those of the same kind first.
    #[test]
    fn only_maps_of_the_same_kind_count() {
        let mut series = Series::default();
        assert!(series.is_empty() && series.nearest(&direct(0.5)).is_none());
        series.remember(&direct(0.1), &mut map(0.1, 2, 0.0));
        series.remember(&Objective::Conformal { q: 0.5 }, &mut map(0.5, 2, 0.0));
        assert!(series.predicted(&direct(0.5)).is_none());
        assert_eq!(series.nearest(&direct(0.5)), Some(map(0.1, 2, 0.0).as_slice()));
    }
}
