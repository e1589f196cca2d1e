//! What Krylov iterations are preconditioned with.

use nalgebra_sparse::{CsrMatrix, SparseEntry};
use rayon::prelude::*;

use crate::factors::{Analysis, Factors};
use crate::incomplete::IncompleteLu;
use crate::multigrid::BlockMatrix;
use crate::scalar::ScalarMultigrid;
use crate::symmetrized::symmetrized;
use crate::{SolveError, Structure};

/// `M ≈ A` of which `M⁻¹ r` is cheap.
#[derive(Debug)]
pub(crate) enum Preconditioner {
    /// The Cholesky factor of a symmetric neighbour.
    Symmetrized(Box<(Analysis, Factors)>),
    /// A multigrid cycle of a symmetric neighbour.
    Multigrid(Box<ScalarMultigrid>),
    /// ILU(0).
    Incomplete(IncompleteLu),
    /// The inverse of the diagonal.
    Jacobi(Vec<f64>),
}

impl Preconditioner {
    /// The best that exists: for a general matrix the Cholesky factor of its symmetric neighbour, for a symmetric one
    /// (and where that fails) ILU(0), and Jacobi where that lacks pivots.
    pub(crate) fn new(matrix: &CsrMatrix<f64>, structure: Structure) -> Self {
        let neighbour = match structure {
            Structure::General => factor_neighbour(matrix),
            Structure::SymmetricPositiveDefinite => None,
        };
        let positive = structure == Structure::SymmetricPositiveDefinite;
        neighbour
            .map(|factors| Self::Symmetrized(Box::new(factors)))
            .or_else(|| IncompleteLu::new(matrix, positive).map(Self::Incomplete))
            .unwrap_or_else(|| Self::Jacobi(inverse_diagonal(matrix)))
    }

    /// A multigrid cycle of the symmetric neighbour.
    pub(crate) fn multigrid(matrix: &CsrMatrix<f64>) -> Result<Self, SolveError> {
        let neighbour = BlockMatrix::from_csr(&symmetrized(matrix)?)?;
        Ok(Self::Multigrid(Box::new(ScalarMultigrid::new(neighbour, 0)?)))
    }

    /// `z = M⁻¹ r`.
    pub(crate) fn apply(&self, r: &[f64], z: &mut [f64]) {
        match self {
            Self::Symmetrized(neighbour) => {
                z.copy_from_slice(r);
                // Without memory for a vector `z` stays `r`, and the iterations go on unpreconditioned.
                let _ = neighbour.0.solve_in_place(&neighbour.1, z);
            }
            Self::Multigrid(multigrid) => multigrid.apply(r, z),
            Self::Incomplete(factors) => factors.apply(r, z),
            Self::Jacobi(inverse) => {
                z.par_iter_mut().with_min_len(8192).zip(r).zip(inverse).for_each(|((z, r), d)| *z = r * d);
            }
        }
    }
}

fn factor_neighbour(matrix: &CsrMatrix<f64>) -> Option<(Analysis, Factors)> {
    let neighbour = symmetrized(matrix).ok()?;
    let analysis = Analysis::new(&neighbour, Structure::SymmetricPositiveDefinite).ok()?;
    let factors = analysis.factor(&neighbour).ok()?;
    Some((analysis, factors))
}

fn inverse_diagonal(matrix: &CsrMatrix<f64>) -> Vec<f64> {
    let inverse = |row: usize| {
        let inverse = matrix.get_entry(row, row).map_or(0.0, SparseEntry::into_value).recip();
        if inverse.is_finite() { inverse } else { 1.0 }
    };
    (0..matrix.nrows()).into_par_iter().map(inverse).collect()
}
