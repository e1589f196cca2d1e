//! What a step learns from the one before: conjugate directions, with the Newton system as their preconditioner.
//!
//! Gauss–Newton leaves out part of the second derivatives, so near a minimum its steps converge only linearly. Conjugate
//! gradients preconditioned by it [Polak, Ribière 1969; Powell 1984 for the restart at β < 0] cost two scalar products a step more
//! and take about half as many steps where that is slow.

use rayon::prelude::*;

use crate::qmesh::Vec2;

/// The last direction counts at most so much.
const MOST_BETA: f64 = 2.0;
/// The joint direction has to promise at least this fraction of what Newton's does.
const LEAST_PROMISE: f64 = 0.1;
/// Vertices that one task takes.
const CHUNK: usize = 8192;

/// The last step.
#[derive(Debug, Default)]
pub(super) struct Memory(Option<Last>);

#[derive(Debug)]
struct Last {
    gradient: Vec<f64>,
    direction: Vec<Vec2>,
    /// The decrement `gᵀ H⁻¹ g` of Newton's direction there.
    decrement: f64,
}

impl Memory {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    pub(super) fn forget(&mut self) {
        self.0 = None;
    }

    /// Adds what the last direction has to add to Newton's; returns the decrement `−g·d` of the sum.
    pub(super) fn conjugate(&self, direction: &mut [Vec2], gradient: &[f64], decrement: f64) -> f64 {
        let Some(last) = &self.0 else { return decrement };
        let beta = (decrement + dot(&last.gradient, direction)) / last.decrement;
        let beta = beta.min(MOST_BETA);
        let joint = decrement - beta * dot(gradient, &last.direction);
        if !(beta > 0.0 && joint > LEAST_PROMISE * decrement) {
            return decrement;
        }
        direction.par_iter_mut().with_min_len(CHUNK).zip(&last.direction).for_each(|(d, l)| *d += l * beta);
        joint
    }

    /// Remembers a step along `direction`, made at `gradient` where Newton's decrement was `decrement`.
    pub(super) fn remember(&mut self, gradient: Vec<f64>, direction: Vec<Vec2>, decrement: f64) {
        self.0 = Some(Last { gradient, direction, decrement });
    }
}

/// In chunks of fixed size, so that the sum does not depend on the number of threads.
pub(super) fn dot(gradient: &[f64], direction: &[Vec2]) -> f64 {
    let of_chunk = |(g, d): (&[f64], &[Vec2])| -> f64 {
        g.chunks_exact(2).zip(d).map(|(g, d)| g[0] * d.x + g[1] * d.y).sum()
    };
    let sums: Vec<f64> =
        gradient.par_chunks(2 * CHUNK).zip(direction.par_chunks(CHUNK)).map(of_chunk).collect();
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a quadratic function, with a system that knows only the diagonal, steps of exact length along these directions end
    /// after as many steps as there are unknowns, as conjugate gradients do; without the memory they do not.
    #[test]
    fn exact_steps_end_on_a_quadratic() {
        let matrix = [[4.0, 1.0, 0.5, 0.0], [1.0, 3.0, 0.2, 0.4], [0.5, 0.2, 2.0, 0.9], [0.0, 0.4, 0.9, 1.0]];
        let times = |x: &[f64]| -> Vec<f64> {
            matrix.iter().map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
        };
        let gradient_left = |remembers: bool| {
            let mut x = vec![1.0, -2.0, 0.5, 3.0];
            let mut memory = Memory::default();
            for _ in 0..4 {
                let g = times(&x);
                let along: Vec<f64> = g.iter().enumerate().map(|(i, g)| -g / matrix[i][i]).collect();
                let decrement: f64 = along.iter().zip(&g).map(|(d, g)| -d * g).sum();
                let mut d: Vec<Vec2> = along.chunks(2).map(|d| Vec2::new(d[0], d[1])).collect();
                let joint = memory.conjugate(&mut d, &g, decrement);
                let flat: Vec<f64> = d.iter().flat_map(|d| [d.x, d.y]).collect();
                let curvature: f64 = times(&flat).iter().zip(&flat).map(|(a, b)| a * b).sum();
                x.iter_mut().zip(&flat).for_each(|(x, d)| *x += joint / curvature * d);
                if remembers {
                    memory.remember(g, d, decrement);
                }
            }
            times(&x).iter().map(|g| g.abs()).fold(0.0, f64::max)
        };
        assert!(gradient_left(true) < 1e-12);
        assert!(gradient_left(false) > 1e-2);
    }

    /// What leads uphill is not added, and nothing is remembered of what was forgotten.
    #[test]
    fn the_direction_always_leads_down() {
        let mut memory = Memory::default();
        memory.remember(vec![1.0, 0.0], vec![Vec2::new(100.0, 0.0)], 1.0);
        let mut direction = vec![Vec2::new(-1.0, 1.0)];
        assert_eq!(memory.conjugate(&mut direction, &[1.0, 0.0], 1.0), 1.0);
        assert_eq!(direction, [Vec2::new(-1.0, 1.0)]);
        memory.forget();
        assert!(memory.is_empty());
    }
}
