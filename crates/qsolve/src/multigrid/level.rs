//! One level: its matrix, its smoother, and the way to the next level and back.

use super::aggregate::{Strong, aggregate};
use super::block::Block;
use super::galerkin::Patches;
use super::kernel::{Members, Tentative};
use super::matrix::BlockMatrix;
use super::prolongation::{Parts, Prolongation};
use super::smoother::Smoother;
use crate::SolveError;

/// A level whose rows have `F` unknowns, and `C` in the next coarser one.
#[derive(Clone, Debug)]
pub(super) struct Level<const F: usize, const C: usize> {
    pub(super) matrix: BlockMatrix<F>,
    pub(super) smoother: Smoother<F>,
    pub(super) prolongation: Prolongation<F, C>,
    strong: Strong,
    aggregate: Vec<u32>,
    members: Members,
    patches: Patches,
}

impl<const F: usize, const C: usize> Level<F, C> {
    /// Chooses aggregates by pattern and strength; nothing is computed from the values yet.
    pub(super) fn new(matrix: BlockMatrix<F>, theta: f64) -> Self {
        let strong = Strong::new(&matrix, theta);
        let (aggregate, count) = aggregate(matrix.rows(), |row| strong.neighbors(&matrix, row));
        let members = Members::new(&aggregate, count);
        let prolongation = Prolongation::new(&matrix, &strong, &aggregate, count);
        let patches = Patches::new(prolongation.transposed());
        let smoother = Smoother::new(&matrix);
        Self { matrix, smoother, prolongation, strong, aggregate, members, patches }
    }

    /// The next level's matrix, still zero.
    pub(super) fn coarse_zeros(&self) -> Result<BlockMatrix<C>, SolveError> {
        let product = self.prolongation.pattern().product(&self.matrix);
        let pattern = product.galerkin(self.prolongation.transposed());
        BlockMatrix::zeros(pattern.starts, pattern.columns)
    }

    /// Everything that depends on values: smoother, prolongation, the next level's matrix and its near-kernel.
    pub(super) fn refresh(
        &mut self,
        kernel: Vec<Block<F, C>>,
        coarse: &mut BlockMatrix<C>,
    ) -> Result<Vec<Block<C, C>>, SolveError> {
        let Self { matrix, smoother, prolongation, strong, aggregate, members, patches } = self;
        smoother.refresh(matrix)?;
        let tentative = Tentative::new(kernel, aggregate, members);
        prolongation.refresh(&Parts {
            matrix,
            strong,
            aggregate,
            tentative: &tentative.blocks,
            largest_eigenvalue: smoother.largest_eigenvalue(),
        });
        patches.galerkin(matrix, prolongation, &tentative.coarse, coarse);
        Ok(tentative.coarse)
    }
}
