//! Quasi-Newton directions [Nocedal 1980, L-BFGS]: what steps have told of the second derivatives corrects a system that was solved
//! before.

use std::collections::VecDeque;

use rayon::prelude::*;

use crate::qmesh::Vec2;

use super::conjugate::dot;
use super::hessian::Hessian;

/// Steps that are remembered, 32 bytes a vertex each.
const MEMORY: usize = 5;
/// Vertices that one task takes.
const CHUNK: usize = 8192;

/// Steps `s` and the changes of the gradient `y` along them.
#[derive(Debug, Default)]
pub(super) struct Learnt {
    pairs: VecDeque<Pair>,
}

#[derive(Debug)]
struct Pair {
    step: Vec<Vec2>,
    change: Vec<f64>,
    /// Their scalar product.
    curvature: f64,
}

impl Learnt {
    pub(super) fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// After a step, and the change of the gradient along it.
    pub(super) fn learn(&mut self, step: Vec<Vec2>, change: Vec<f64>) {
        let curvature = dot(&change, &step);
        if curvature > 0.0 {
            if self.pairs.len() == MEMORY {
                self.pairs.pop_front();
            }
            self.pairs.push_back(Pair { step, change, curvature });
        }
    }

    /// `−H⁻¹ g`, where `hessian` keeps the first idea of H.
    pub(super) fn direction(&self, hessian: &Hessian, gradient: &[f64]) -> Option<Vec<Vec2>> {
        let mut right = gradient.to_vec();
        let mut shares = Vec::with_capacity(self.pairs.len());
        for pair in self.pairs.iter().rev() {
            let share = dot(&right, &pair.step) / pair.curvature;
            let entries = right.par_iter_mut().with_min_len(CHUNK).zip(&pair.change);
            entries.for_each(|(r, y)| *r -= share * y);
            shares.push(share);
        }
        let mut direction = hessian.kept_direction(&right)?;
        for (pair, share) in self.pairs.iter().zip(shares.into_iter().rev()) {
            // The direction is downhill, so its share is negative.
            let factor = -share - dot(&pair.change, &direction) / pair.curvature;
            let entries = direction.par_iter_mut().with_min_len(CHUNK).zip(&pair.step);
            entries.for_each(|(d, s)| *d += s * factor);
        }
        Some(direction)
    }
}
