//! Multigrid by smoothed aggregation, as a preconditioner of conjugate gradients.
//!
//! After [Vaněk, Mandel, Brezina 1996, "Algebraic multigrid by smoothed aggregation"]: neighbouring rows are joined to
//! aggregates, which carry a given near-kernel (what the smoother does not see: constants for a Laplacian; for a system with two
//! unknowns a row, both translations and the rotation) to the next level, through basis functions that one Jacobi step smooths.
//!
//! The matrices of all levels are in double precision: where rows differ by 1e8, as where a map is squeezed, sums over aggregates
//! cancel, and in single precision a coarse matrix of such a system was no longer positive definite. What carries from level to
//! level is in single precision.
//!
//! Where blocks stand is found once; new values of the same pattern cost a fraction of it ([`Multigrid::refresh`]). The same
//! input gives the same bits for any number of threads.
//!
//! Not guaranteed: few iterations for weights that jump from edge to edge by 1e6 without pattern; a factorization does not mind
//! those. Systems of one unknown a row have [a hierarchy of their own](crate::ScalarMultigrid).

mod aggregate;
mod block;
mod coarsest;
mod galerkin;
mod kernel;
mod level;
mod matrix;
mod pattern;
mod prolongation;
mod smoother;

#[cfg(test)]
mod tests;

use std::sync::Mutex;

use rayon::prelude::*;

pub use block::Block;
pub use matrix::BlockMatrix;

use crate::SolveError;
pub(crate) use aggregate::{NONE, aggregate};
pub(crate) use coarsest::Coarsest;
use level::Level;
pub(crate) use matrix::for_each_row;

/// A level of at most so many rows is factorized.
const COARSEST_ROWS: usize = 200;
/// A level that shrinks by less than this is factorized too: further ones would cost as much and bring nothing.
const LEAST_SHRINKING: f64 = 1.3;

/// How a hierarchy is made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, rename_all = "kebab-case"))]
pub struct MultigridOptions {
    /// A coupling is strong when its norm is above this fraction of the geometric mean of the two diagonal blocks; halved from
    /// level to level. Only strong couplings join aggregates. 0: whatever the pattern has, which is then the same for all
    /// values. Default 0.08.
    pub strength: f64,
    /// Added to the diagonal of the coarsest level, relative to it. Above 0 for a matrix that is singular but for rounding.
    /// Default 0.
    pub shift: f64,
    /// Whether the matrix maps constants (of each unknown) to zero, as for a body that nothing holds. They are then kept out of
    /// residual and answer, where rounding would make much of them. Default false.
    pub floating: bool,
}

impl Default for MultigridOptions {
    fn default() -> Self {
        Self { strength: 0.08, shift: 0.0, floating: false }
    }
}

/// The preconditioner of a symmetric positive definite matrix with `F` unknowns a row; `C` vectors span its near-kernel.
#[derive(Debug)]
pub struct Multigrid<const F: usize, const C: usize> {
    options: MultigridOptions,
    finest: Level<F, C>,
    coarser: Vec<Level<C, C>>,
    coarsest: Coarsest<C>,
    spare: Mutex<Vec<Work<F, C>>>,
}

impl<const F: usize, const C: usize> Multigrid<F, C> {
    /// The hierarchy of `matrix`. `kernel[row][unknown][k]` is the near-kernel's vector number `k`; zero at rows that are
    /// coupled to nothing.
    ///
    /// # Errors
    /// [`SolveError::NotPositiveDefinite`] where a diagonal block or the coarsest level is not;
    /// [`SolveError::WrongRightHandSide`] when `kernel` has another number of rows; [`SolveError::TooLarge`].
    pub fn new(
        matrix: BlockMatrix<F>,
        kernel: Vec<[[f64; C]; F]>,
        options: MultigridOptions,
    ) -> Result<Self, SolveError> {
        check_kernel(&matrix, &kernel)?;
        let mut finest = Level::new(matrix, options.strength);
        let mut matrix = finest.coarse_zeros()?;
        let mut kernel = finest.refresh(kernel, &mut matrix)?;
        let mut coarser: Vec<Level<C, C>> = Vec::new();
        let mut rows = finest.matrix.rows();
        let mut strength = options.strength;
        while matrix.rows() > COARSEST_ROWS && rows as f64 > LEAST_SHRINKING * matrix.rows() as f64 {
            strength *= 0.5;
            rows = matrix.rows();
            let mut level: Level<C, C> = Level::new(matrix, strength);
            matrix = level.coarse_zeros()?;
            kernel = level.refresh(kernel, &mut matrix)?;
            coarser.push(level);
        }
        let coarsest = Coarsest::new(matrix, options.shift)?;
        Ok(Self { options, finest, coarser, coarsest, spare: Mutex::default() })
    }

    /// The matrix.
    #[must_use]
    pub fn matrix(&self) -> &BlockMatrix<F> {
        &self.finest.matrix
    }

    /// The matrix, to be given new values before [`Multigrid::refresh`].
    pub fn matrix_mut(&mut self) -> &mut BlockMatrix<F> {
        &mut self.finest.matrix
    }

    /// Rows of each level, the finest first.
    #[must_use]
    pub fn level_rows(&self) -> Vec<usize> {
        let coarser = self.coarser.iter().map(|level| level.matrix.rows());
        std::iter::once(self.finest.matrix.rows())
            .chain(coarser)
            .chain([self.coarsest.matrix.rows()])
            .collect()
    }

    /// Computes the hierarchy anew from the values that the matrix has now, on the aggregates of before.
    ///
    /// # Errors
    /// As [`Multigrid::new`]. The hierarchy is of no use then.
    pub fn refresh(&mut self, kernel: Vec<[[f64; C]; F]>) -> Result<(), SolveError> {
        check_kernel(&self.finest.matrix, &kernel)?;
        let Self { finest, coarser, coarsest, .. } = self;
        let next = coarser.first_mut().map_or(&mut coarsest.matrix, |level| &mut level.matrix);
        let mut kernel = finest.refresh(kernel, next)?;
        let mut rest = coarser.as_mut_slice();
        while let Some((level, further)) = rest.split_first_mut() {
            let next = further.first_mut().map_or(&mut coarsest.matrix, |level| &mut level.matrix);
            kernel = level.refresh(kernel, next)?;
            rest = further;
        }
        coarsest.refresh(self.options.shift)
    }

    /// Computes only the finest level's smoother anew, for values that have changed little: a preconditioner that is a little
    /// worse, for a fraction of the work.
    ///
    /// # Errors
    /// [`SolveError::NotPositiveDefinite`] where a diagonal block is not.
    pub fn refresh_finest(&mut self) -> Result<(), SolveError> {
        self.finest.smoother.invert(&self.finest.matrix)
    }

    /// `z ≈ A⁻¹ r` by one V-cycle, a symmetric positive definite operation; `F` entries a row.
    pub fn apply(&self, r: &[f64], z: &mut [f64]) {
        let spare = self.spare.lock().ok().and_then(|mut spare| spare.pop());
        let mut work = spare.unwrap_or_else(|| Work::new(self));
        let r = r.as_chunks::<F>().0;
        let middle = if self.options.floating { mean(r) } else { [0.0; F] };
        let b = work.fine.b.par_iter_mut().with_min_len(1 << 12).zip(r);
        b.for_each(|(b, r)| *b = std::array::from_fn(|k| r[k] - middle[k]));
        cycle(&self.finest, &self.coarser, &self.coarsest, &mut work.fine, &mut work.coarse);
        let z = z.as_chunks_mut::<F>().0;
        let middle = if self.options.floating { mean(&work.fine.x) } else { [0.0; F] };
        let z = z.par_iter_mut().with_min_len(1 << 12).zip(&work.fine.x);
        z.for_each(|(z, x)| *z = std::array::from_fn(|k| x[k] - middle[k]));
        if let Ok(mut spare) = self.spare.lock() {
            spare.push(work);
        }
    }
}

fn check_kernel<const F: usize, const C: usize>(
    matrix: &BlockMatrix<F>,
    kernel: &[[[f64; C]; F]],
) -> Result<(), SolveError> {
    let (expected, found) = (matrix.rows(), kernel.len());
    if expected == found { Ok(()) } else { Err(SolveError::WrongRightHandSide { expected, found }) }
}

/// In chunks of fixed size, so that the sum does not depend on the number of threads.
fn mean<const F: usize>(x: &[[f64; F]]) -> [f64; F] {
    let add = |sum: [f64; F], x: &[f64; F]| std::array::from_fn(|k| sum[k] + x[k]);
    let sums: Vec<[f64; F]> = x.par_chunks(8192).map(|chunk| chunk.iter().fold([0.0; F], add)).collect();
    sums.iter().fold([0.0; F], add).map(|sum| sum / x.len() as f64)
}

/// The vectors of one level.
#[derive(Debug)]
struct Vectors<const N: usize> {
    b: Vec<[f64; N]>,
    x: Vec<[f64; N]>,
    r: Vec<[f64; N]>,
}

impl<const N: usize> Vectors<N> {
    fn new(rows: usize) -> Self {
        let zeros = || vec![[0.0; N]; rows];
        Self { b: zeros(), x: zeros(), r: zeros() }
    }
}

/// The vectors of all levels.
#[derive(Debug)]
struct Work<const F: usize, const C: usize> {
    fine: Vectors<F>,
    coarse: Vec<Vectors<C>>,
}

impl<const F: usize, const C: usize> Work<F, C> {
    fn new(multigrid: &Multigrid<F, C>) -> Self {
        let rows = multigrid.level_rows();
        Self {
            fine: Vectors::new(rows[0]),
            coarse: rows[1..].iter().map(|&rows| Vectors::new(rows)).collect(),
        }
    }
}

/// One V-cycle from `at.b` to `at.x`.
fn cycle<const F: usize, const C: usize>(
    level: &Level<F, C>,
    coarser: &[Level<C, C>],
    coarsest: &Coarsest<C>,
    at: &mut Vectors<F>,
    below: &mut [Vectors<C>],
) {
    let Some((next, further)) = below.split_first_mut() else { return };
    level.smoother.forward(&level.matrix, &at.b, &mut at.x);
    level.smoother.residual(&level.matrix, &at.x, &mut at.r);
    level.prolongation.restrict(&at.r, &mut next.b);
    match coarser.split_first() {
        Some((coarse, coarser)) => cycle(coarse, coarser, coarsest, next, further),
        None => coarsest.solve(&next.b, &mut next.x),
    }
    level.prolongation.prolong(&next.x, &mut at.x);
    at.r.copy_from_slice(&at.x);
    level.smoother.backward(&level.matrix, &at.b, &at.r, &mut at.x);
}
