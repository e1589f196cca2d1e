//! The two ways to solve a Newton system.

use rayon::prelude::*;

use super::DescentError;
use super::hessian::{Accuracy, Solved};
use super::layout::{Block, Layout};
use crate::qmesh::Vec2;
use crate::qsolve::{
    BlockMatrix, ConjugateGradients, CsrMatrix, DMatrix, KeptFactors, LinearSolver, Multigrid,
    MultigridOptions, SolveError, Structure, Symbolic,
};

/// Added to the diagonal relative to its mean: a free map may move and turn at no cost.
const GAUGE: f64 = 1e-9;
/// A direction need not be exact, since the line search judges it.
const RESIDUAL_BOUND: f64 = 1e-2;
/// Added to the diagonal of the coarsest level, relative: a free map turns at little cost.
const SHIFT: f64 = 1e-5;
/// Conjugate gradients give what they have after so many iterations; it leads downhill whenever it is.
const MOST_ITERATIONS: usize = 300;
/// What a decisive decrement may miss.
const DECISIVE_MISSING: f64 = 0.1;
/// With a preconditioner of a former matrix the residual says little: at least so many iterations then.
const LEAST_LAGGED: usize = 3;

/// Scalar rows, and their factorization.
pub(super) struct Factored {
    matrix: CsrMatrix<f64>,
    symbolic: Symbolic,
    /// Those of the last matrix that was solved with.
    factors: Option<KeptFactors>,
}

impl Factored {
    pub(super) fn new(layout: &Layout) -> Result<Self, SolveError> {
        let matrix = scalar_zeros(layout);
        let symbolic = Symbolic::analyze(&matrix, Structure::SymmetricPositiveDefinite)?;
        Ok(Self { matrix, symbolic, factors: None })
    }

    /// `row(vertex, blocks)` gives the blocks of each vertex's row.
    pub(super) fn fill(&mut self, row: impl Fn(usize, &mut Vec<Block>) + Sync) {
        let (offsets, _, values) = self.matrix.csr_data_mut();
        let mut rest = values;
        let mut rows = Vec::with_capacity(offsets.len() / 2);
        for vertex in 0..offsets.len() / 2 {
            let (values, tail) = rest.split_at_mut(offsets[2 * vertex + 2] - offsets[2 * vertex]);
            rows.push(values);
            rest = tail;
        }
        let rows = rows.into_par_iter().with_min_len(512).enumerate();
        rows.for_each_init(Vec::new, |blocks, (vertex, values)| {
            row(vertex, blocks);
            let (upper, lower) = values.split_at_mut(2 * blocks.len());
            for (k, &[xx, xy, yx, yy]) in blocks.iter().enumerate() {
                (upper[2 * k], upper[2 * k + 1], lower[2 * k], lower[2 * k + 1]) = (xx, xy, yx, yy);
            }
        });
    }

    pub(super) fn fix(&mut self, fixed: &[bool]) {
        let (offsets, columns, values) = self.matrix.csr_data_mut();
        for row in 0..offsets.len() - 1 {
            for at in offsets[row]..offsets[row + 1] {
                if fixed[row / 2] || fixed[columns[at] / 2] {
                    values[at] = if columns[at] == row { 1.0 } else { 0.0 };
                }
            }
        }
    }

    pub(super) fn factor(&mut self) -> Result<(), SolveError> {
        self.shift(GAUGE);
        self.factors = None;
        self.factors = Some(self.symbolic.factor(&self.matrix)?.into_factors());
        Ok(())
    }

    pub(super) fn solve(&mut self, gradient: &[f64]) -> Result<Solved, DescentError> {
        self.shift(GAUGE);
        // Before there are others: both together would be the largest part of the memory.
        self.factors = None;
        let factor = self.symbolic.factor(&self.matrix)?;
        let rhs = DMatrix::from_iterator(gradient.len(), 1, gradient.iter().map(|g| -g));
        let (solution, _) = factor.solve(&rhs, RESIDUAL_BOUND)?;
        self.factors = Some(factor.into_factors());
        Ok(solved(solution.as_slice(), gradient, 0.0, 0))
    }

    pub(super) fn kept_direction(&self, gradient: &[f64]) -> Option<Vec<Vec2>> {
        let mut direction: Vec<f64> = gradient.iter().map(|g| -g).collect();
        self.symbolic.solve_in_place(self.factors.as_ref()?, &mut direction).ok()?;
        Some(pairs(&direction))
    }

    /// Adds `share` of the diagonal's mean to the diagonal.
    fn shift(&mut self, share: f64) {
        let size = self.matrix.nrows();
        let places: Vec<usize> = (0..size).map(|row| self.diagonal_place(row)).collect();
        let values = self.matrix.values_mut();
        let mean = places.iter().map(|&at| values[at]).sum::<f64>() / size as f64;
        for at in places {
            values[at] += share * mean;
        }
    }

    fn diagonal_place(&self, row: usize) -> usize {
        let pattern = self.matrix.pattern();
        let start = pattern.major_offsets()[row];
        start + pattern.lane(row).partition_point(|&column| column < row)
    }
}

fn scalar_zeros(layout: &Layout) -> CsrMatrix<f64> {
    let size = 2 * layout.vertex_count();
    let mut starts = vec![0];
    let mut columns = Vec::with_capacity(4 * layout.columns.len());
    for vertex in 0..layout.vertex_count() {
        for _ in 0..2 {
            columns.extend(layout.row(vertex).iter().flat_map(|&c| [2 * c as usize, 2 * c as usize + 1]));
            starts.push(columns.len());
        }
    }
    let values = vec![0.0; columns.len()];
    CsrMatrix::try_from_csr_data(size, size, starts, columns, values)
        .expect("rows are in order and their columns ascend")
}

fn pairs(solution: &[f64]) -> Vec<Vec2> {
    solution.chunks_exact(2).map(|d| Vec2::new(d[0], d[1])).collect()
}

fn solved(solution: &[f64], gradient: &[f64], missing: f64, iterations: usize) -> Solved {
    let direction = pairs(solution);
    let decrement = solution.iter().zip(gradient).map(|(d, g)| -d * g).sum();
    Solved { direction, decrement, missing, iterations }
}

/// Block rows, and a hierarchy of them.
pub(super) struct Iterated {
    state: State,
    fixed: Vec<bool>,
}

enum State {
    /// No hierarchy yet.
    Bare(BlockMatrix<2>),
    Ready(Box<Multigrid<2, 3>>),
}

impl Iterated {
    pub(super) fn new(layout: &Layout) -> Result<Self, SolveError> {
        let matrix = BlockMatrix::zeros(layout.starts.clone(), layout.columns.clone())?;
        Ok(Self { state: State::Bare(matrix), fixed: Vec::new() })
    }

    fn matrix_mut(&mut self) -> &mut BlockMatrix<2> {
        match &mut self.state {
            State::Bare(matrix) => matrix,
            State::Ready(multigrid) => multigrid.matrix_mut(),
        }
    }

    /// `row(vertex, blocks)` gives the blocks of each vertex's row.
    pub(super) fn fill(&mut self, row: impl Fn(usize, &mut Vec<Block>) + Sync) {
        self.matrix_mut().fill_rows_with(Vec::new, |blocks, vertex, _, values| {
            row(vertex, blocks);
            for (value, block) in values.iter_mut().zip(blocks) {
                let [xx, xy, yx, yy] = *block;
                *value = [[xx, xy], [yx, yy]];
            }
        });
    }

    /// Sets all blocks to zero, to be added to.
    pub(super) fn clear(&mut self) {
        self.matrix_mut().clear();
    }

    /// Adds to the rows of `vertices`, which ascend, what `row(vertex, blocks)` gives.
    pub(super) fn add(&mut self, vertices: &[u32], row: impl Fn(usize, &mut Vec<Block>) + Sync + Send) {
        self.matrix_mut().change_rows_with(vertices, Vec::new, |blocks, vertex, values| {
            row(vertex, blocks);
            for (value, [xx, xy, yx, yy]) in values.iter_mut().zip(blocks) {
                let sums = [[&mut *xx, xy], [yx, yy]];
                for (value, sums) in value.iter_mut().zip(sums) {
                    value.iter_mut().zip(sums).for_each(|(value, sum)| *value += *sum);
                }
            }
        });
    }

    pub(super) fn fix(&mut self, fixed: &[bool]) {
        if self.fixed != fixed {
            self.fixed = fixed.to_vec();
            // The kernel is another one.
            self.state = State::Bare(self.matrix_mut().clone());
        }
        self.matrix_mut().fill_rows(|row, columns, blocks| {
            for (&column, block) in columns.iter().zip(blocks) {
                if fixed[row] || fixed[column as usize] {
                    let one = if column as usize == row { 1.0 } else { 0.0 };
                    *block = [[one, 0.0], [0.0, one]];
                }
            }
        });
    }

    /// The rigid motions of the map `uv`.
    fn near_kernel(&self, uv: &[Vec2]) -> Vec<[[f64; 3]; 2]> {
        let motions = |vertex: usize, p: &Vec2| {
            if self.fixed.get(vertex).copied().unwrap_or(false) {
                [[0.0; 3]; 2]
            } else {
                [[1.0, 0.0, -p.y], [0.0, 1.0, p.x]]
            }
        };
        uv.par_iter().with_min_len(4096).enumerate().map(|(vertex, p)| motions(vertex, p)).collect()
    }

    pub(super) fn solve(
        &mut self,
        uv: &[Vec2],
        gradient: &[f64],
        accuracy: Accuracy,
        lagged: bool,
    ) -> Result<Solved, DescentError> {
        match &mut self.state {
            State::Ready(multigrid) if lagged => multigrid.refresh_finest()?,
            _ => self.refresh(uv)?,
        }
        let State::Ready(multigrid) = &self.state else { return Err(SolveError::OtherPattern.into()) };
        let mut cg = ConjugateGradients::new(multigrid, gradient.iter().map(|g| -g).collect());
        let least = if lagged { LEAST_LAGGED } else { 1 };
        let is_rough = |cg: &ConjugateGradients<2, 3>| {
            cg.iterations() < least || cg.relative_residual() > accuracy.residual
        };
        let is_open = |cg: &ConjugateGradients<2, 3>| {
            cg.energy() <= accuracy.decisive && cg.energy_left() > DECISIVE_MISSING * cg.energy()
        };
        while cg.iterations() < MOST_ITERATIONS && (is_rough(&cg) || is_open(&cg)) {
            if !cg.advance() {
                break;
            }
        }
        if cg.iterations() == 0 && gradient.iter().any(|&g| g != 0.0) {
            return Err(SolveError::NotPositiveDefinite { row: None }.into());
        }
        Ok(solved(cg.solution(), gradient, cg.energy_left(), cg.iterations()))
    }

    pub(super) fn kept_direction(&self, gradient: &[f64]) -> Option<Vec<Vec2>> {
        let State::Ready(multigrid) = &self.state else { return None };
        let right: Vec<f64> = gradient.iter().map(|g| -g).collect();
        let mut direction = vec![0.0; right.len()];
        multigrid.apply(&right, &mut direction);
        Some(pairs(&direction))
    }

    pub(super) fn refresh(&mut self, uv: &[Vec2]) -> Result<(), SolveError> {
        let kernel = self.near_kernel(uv);
        match &mut self.state {
            State::Ready(multigrid) => multigrid.refresh(kernel),
            State::Bare(matrix) => {
                let free = !self.fixed.contains(&true);
                let options = MultigridOptions { strength: 0.0, shift: SHIFT, floating: free };
                let matrix = std::mem::replace(matrix, BlockMatrix::zeros(vec![0], Vec::new())?);
                self.state = State::Ready(Box::new(Multigrid::new(matrix, kernel, options)?));
                Ok(())
            }
        }
    }
}
