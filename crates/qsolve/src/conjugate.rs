//! Conjugate gradients that can be asked, after each iteration, how far they are.

use rayon::prelude::*;

use crate::multigrid::Multigrid;
use crate::product::dot;

const GRAIN: usize = 8192;

/// `A x ≈ b` from zero, by conjugate gradients [Hestenes, Stiefel 1952] with a multigrid preconditioner M.
///
/// Errors are measured by the energy norm `‖x‖² = xᵀ A x`, in which the iterates approach the answer monotonically:
/// `‖x_k‖² + ‖x − x_k‖² = ‖x‖²`. With A as the Hessian and `b` as the negative gradient this is the Newton decrement.
#[derive(Debug)]
pub struct ConjugateGradients<'a, const F: usize, const C: usize> {
    multigrid: &'a Multigrid<F, C>,
    x: Vec<f64>,
    r: Vec<f64>,
    z: Vec<f64>,
    p: Vec<f64>,
    ap: Vec<f64>,
    rz: f64,
    first_rz: f64,
    energy: f64,
    alphas: Vec<f64>,
    betas: Vec<f64>,
}

impl<'a, const F: usize, const C: usize> ConjugateGradients<'a, F, C> {
    /// Before the first iteration.
    #[must_use]
    pub fn new(multigrid: &'a Multigrid<F, C>, b: Vec<f64>) -> Self {
        let n = b.len();
        let mut z = vec![0.0; n];
        multigrid.apply(&b, &mut z);
        let rz = dot(&b, &z);
        let p = z.clone();
        let (x, ap) = (vec![0.0; n], vec![0.0; n]);
        let (alphas, betas) = (Vec::new(), Vec::new());
        Self { multigrid, x, r: b, z, p, ap, rz, first_rz: rz, energy: 0.0, alphas, betas }
    }

    /// One iteration. False, with nothing done, when there is nothing left to do, or when A or M turn out not to be positive
    /// definite.
    pub fn advance(&mut self) -> bool {
        self.multigrid.matrix().multiply(&self.p, &mut self.ap);
        let curvature = dot(&self.p, &self.ap);
        let alpha = self.rz / curvature;
        if !(self.rz > 0.0 && curvature > 0.0 && alpha.is_finite()) {
            return false;
        }
        let steps = self.x.par_iter_mut().with_min_len(GRAIN).zip(&mut self.r).zip(&self.p).zip(&self.ap);
        steps.for_each(|(((x, r), p), ap)| {
            *x += alpha * p;
            *r -= alpha * ap;
        });
        self.energy += alpha * self.rz;
        self.multigrid.apply(&self.r, &mut self.z);
        let rz = dot(&self.r, &self.z);
        let beta = rz / self.rz;
        self.rz = rz;
        self.alphas.push(alpha);
        self.betas.push(beta);
        self.p.par_iter_mut().with_min_len(GRAIN).zip(&self.z).for_each(|(p, z)| *p = z + beta * *p);
        true
    }

    /// Iterations made.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.alphas.len()
    }

    /// `‖r‖ / ‖b‖` in the norm of M⁻¹.
    #[must_use]
    pub fn relative_residual(&self) -> f64 {
        if self.first_rz > 0.0 { (self.rz.max(0.0) / self.first_rz).sqrt() } else { 0.0 }
    }

    /// `‖x_k‖²`, never more than that of the answer.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// About `‖x − x_k‖²`: the residual in the norm of M⁻¹, over the smallest eigenvalue of M⁻¹A that the iterations have met.
    #[must_use]
    pub fn energy_left(&self) -> f64 {
        self.rz.max(0.0) / self.smallest_eigenvalue()
    }

    /// The answer so far.
    #[must_use]
    pub fn solution(&self) -> &[f64] {
        &self.x
    }

    /// The smallest eigenvalue of the Lanczos matrix that the iterations amount to, by bisection; 1 before there are any.
    fn smallest_eigenvalue(&self) -> f64 {
        let diagonal: Vec<f64> = (0..self.alphas.len())
            .map(|k| 1.0 / self.alphas[k] + if k > 0 { self.betas[k - 1] / self.alphas[k - 1] } else { 0.0 })
            .collect();
        let square = |k: usize| self.betas[k - 1] / (self.alphas[k - 1] * self.alphas[k - 1]);
        // By Sturm's sequence: whether all eigenvalues are above `bound`.
        let all_above = |bound: f64| {
            let mut pivot = 1.0;
            diagonal.iter().enumerate().all(|(k, d)| {
                pivot = d - bound - if k > 0 { square(k) / pivot } else { 0.0 };
                pivot > 0.0
            })
        };
        let (mut low, mut high) = (0.0, diagonal.iter().copied().fold(1.0, f64::min));
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if all_above(middle) { low = middle } else { high = middle }
        }
        high.max(f64::MIN_POSITIVE)
    }
}
