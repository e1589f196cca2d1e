//! The coarsest level: factorized.

use nalgebra_sparse::CsrMatrix;

use super::matrix::BlockMatrix;
use crate::factors::{Analysis, Factors};
use crate::{SolveError, Structure};

/// What is added to the diagonal, relative to it, when rounding took the definiteness of a singular matrix.
const SHIFTS: [f64; 4] = [1e-6, 1e-4, 1e-2, 1.0];

#[derive(Debug)]
pub(crate) struct Coarsest<const C: usize> {
    pub(crate) matrix: BlockMatrix<C>,
    analysis: Option<Analysis>,
    factors: Option<Factors>,
}

impl<const C: usize> Coarsest<C> {
    pub(crate) fn new(matrix: BlockMatrix<C>, shift: f64) -> Result<Self, SolveError> {
        let mut coarsest = Self { matrix, analysis: None, factors: None };
        if coarsest.matrix.rows() > 0 {
            let scalar = coarsest.scalar(shift);
            coarsest.analysis = Some(Analysis::new(&scalar, Structure::SymmetricPositiveDefinite)?);
            coarsest.refresh(shift)?;
        }
        Ok(coarsest)
    }

    /// Factorizes anew, with more on the diagonal where that is needed.
    pub(crate) fn refresh(&mut self, shift: f64) -> Result<(), SolveError> {
        let Some(analysis) = &self.analysis else { return Ok(()) };
        let mut failure = None;
        for shift in std::iter::once(shift).chain(SHIFTS.into_iter().filter(|&larger| larger > shift)) {
            match analysis.factor(&self.scalar(shift)) {
                Ok(factors) => {
                    self.factors = Some(factors);
                    return Ok(());
                }
                Err(error) => failure = Some(error),
            }
        }
        failure.map_or(Ok(()), |_| Err(SolveError::NotPositiveDefinite { row: None }))
    }

    fn scalar(&self, shift: f64) -> CsrMatrix<f64> {
        let rows = self.matrix.rows();
        let (mut offsets, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        for row in 0..rows {
            let (numbers, blocks) = self.matrix.row(row);
            for k in 0..C {
                for (&number, block) in numbers.iter().zip(blocks) {
                    for (l, &value) in block[k].iter().enumerate() {
                        let column = number as usize * C + l;
                        let factor = if column == row * C + k { 1.0 + shift } else { 1.0 };
                        columns.push(column);
                        values.push(factor * value);
                    }
                }
                offsets.push(columns.len());
            }
        }
        CsrMatrix::try_from_csr_data(rows * C, rows * C, offsets, columns, values)
            .expect("block columns ascend, and so do the columns within them")
    }

    pub(crate) fn solve(&self, b: &[[f64; C]], x: &mut [[f64; C]]) {
        let (Some(analysis), Some(factors)) = (&self.analysis, &self.factors) else { return };
        let mut exact: Vec<f64> = b.iter().flatten().copied().collect();
        // Without memory for a vector this stays the right-hand side, and the iterations around take longer.
        let _ = analysis.solve_in_place(factors, &mut exact);
        for (x, exact) in x.iter_mut().flatten().zip(exact) {
            *x = exact;
        }
    }
}
