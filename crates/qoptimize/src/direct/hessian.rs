//! The sparse Hessian: its pattern, and where each corner's share goes.
//!
//! Two unknowns a vertex, so 2 × 2 blocks. The pattern depends on the connectivity alone and is analysed once for all steps.

use super::DescentError;
use super::rest::Rest;
use crate::qmesh::Vec2;
use crate::qsolve::{CsrMatrix, DMatrix, LinearSolver, SolveError, Structure, Symbolic};

/// Added to the diagonal relative to its mean: a free map may move and turn at no cost.
const GAUGE: f64 = 1e-9;
/// A direction need not be exact, since the line search judges it.
const RESIDUAL_BOUND: f64 = 1e-2;

/// A symmetric matrix of 2 × 2 blocks, as scalar rows.
pub(super) struct Hessian {
    /// Where the blocks of each vertex's block row start.
    block_start: Vec<u32>,
    /// Per corner, where in their block rows the blocks stand: row by row over (here, next, previous).
    slots: Vec<[u32; 9]>,
    matrix: CsrMatrix<f64>,
    symbolic: Symbolic,
}

impl Hessian {
    /// The zero matrix, analysed for factorization.
    pub(super) fn new(rest: &Rest) -> Result<Self, SolveError> {
        let blocks = Blocks::new(rest);
        let slots = rest.corners.iter().map(|corner| blocks.slots(corner.vertices)).collect();
        let matrix = blocks.matrix();
        let symbolic = Symbolic::analyze(&matrix, Structure::SymmetricPositiveDefinite)?;
        Ok(Self { block_start: blocks.start, slots, matrix, symbolic })
    }

    pub(super) fn clear(&mut self) {
        self.matrix.values_mut().fill(0.0);
    }

    /// Takes the vertices marked in `fixed` out of the system; returns the gradient without them.
    pub(super) fn fix(&mut self, fixed: &[bool], mut gradient: Vec<f64>) -> Vec<f64> {
        let (offsets, columns, values) = self.matrix.csr_data_mut();
        for row in 0..gradient.len() {
            let row_fixed = fixed[row / 2];
            if row_fixed {
                gradient[row] = 0.0;
            }
            for at in offsets[row]..offsets[row + 1] {
                if row_fixed || fixed[columns[at] / 2] {
                    values[at] = if columns[at] == row { 1.0 } else { 0.0 };
                }
            }
        }
        gradient
    }

    /// Solves the Newton system: the direction, and the Newton decrement `−g·d`.
    pub(super) fn newton_direction(&mut self, gradient: &[f64]) -> Result<(Vec<Vec2>, f64), DescentError> {
        self.shift(GAUGE);
        let factor = self.symbolic.factor(&self.matrix)?;
        let rhs = DMatrix::from_iterator(gradient.len(), 1, gradient.iter().map(|g| -g));
        let (solution, _) = factor.solve(&rhs, RESIDUAL_BOUND)?;
        let direction = solution.as_slice().chunks_exact(2).map(|d| Vec2::new(d[0], d[1])).collect();
        let decrement = solution.iter().zip(gradient).map(|(d, g)| -d * g).sum();
        Ok((direction, decrement))
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

    /// Where the values of a block row start, and how many blocks it has.
    fn block_row(&self, vertex: usize) -> (usize, usize) {
        let (start, end) = (self.block_start[vertex] as usize, self.block_start[vertex + 1] as usize);
        (4 * start, end - start)
    }

    /// Adds the Hessian of corner number `corner`, given by its edge vectors (upper triangle, row by row).
    pub(super) fn add(&mut self, corner: usize, vertices: [u32; 3], edges: &[f64; 10]) {
        let [a, b, c, d, e, f, g, h, i, j] = *edges;
        // By (f1, f0), that is by the vertices next and previous; what is left belongs to the corner's own vertex.
        let (nn, np, pp) = ([a, b, b, e], [c, d, f, g], [h, i, i, j]);
        let pn = transposed(np);
        let hn = minus_sum(nn, pn);
        let hp = minus_sum(np, pp);
        let hh = minus_sum(hn, hp);
        let blocks = [hh, hn, hp, transposed(hn), nn, np, transposed(hp), pn, pp];
        let slots = self.slots[corner];
        let values_at = vertices.map(|v| self.block_row(v as usize));
        let values = self.matrix.values_mut();
        for (k, (block, slot)) in blocks.into_iter().zip(slots).enumerate() {
            let (first, row_blocks) = values_at[k / 3];
            let upper = first + 2 * slot as usize;
            let lower = upper + 2 * row_blocks;
            values[upper] += block[0];
            values[upper + 1] += block[1];
            values[lower] += block[2];
            values[lower + 1] += block[3];
        }
    }
}

fn transposed([xx, xy, yx, yy]: [f64; 4]) -> [f64; 4] {
    [xx, yx, xy, yy]
}

fn minus_sum(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|k| -a[k] - b[k])
}

/// Which blocks there are: per vertex itself and all vertices that share a corner triangle with it, ascending.
struct Blocks {
    start: Vec<u32>,
    column: Vec<u32>,
}

impl Blocks {
    fn new(rest: &Rest) -> Self {
        let mut pairs: Vec<(u32, u32)> = (0..rest.vertex_count as u32).map(|v| (v, v)).collect();
        for corner in &rest.corners {
            let [h, n, p] = corner.vertices;
            pairs.extend([(h, n), (n, h), (h, p), (p, h), (n, p), (p, n)]);
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut start = vec![0u32; rest.vertex_count + 1];
        for &(row, _) in &pairs {
            start[row as usize + 1] += 1;
        }
        for row in 0..rest.vertex_count {
            start[row + 1] += start[row];
        }
        Self { start, column: pairs.into_iter().map(|(_, column)| column).collect() }
    }

    fn row(&self, vertex: usize) -> &[u32] {
        &self.column[self.start[vertex] as usize..self.start[vertex + 1] as usize]
    }

    fn slots(&self, vertices: [u32; 3]) -> [u32; 9] {
        std::array::from_fn(|k| {
            self.row(vertices[k / 3] as usize).partition_point(|&c| c < vertices[k % 3]) as u32
        })
    }

    fn matrix(&self) -> CsrMatrix<f64> {
        let size = 2 * (self.start.len() - 1);
        let mut starts = vec![0];
        let mut columns = Vec::with_capacity(4 * self.column.len());
        for vertex in 0..self.start.len() - 1 {
            for _ in 0..2 {
                columns.extend(self.row(vertex).iter().flat_map(|&c| [2 * c as usize, 2 * c as usize + 1]));
                starts.push(columns.len());
            }
        }
        let values = vec![0.0; columns.len()];
        CsrMatrix::try_from_csr_data(size, size, starts, columns, values)
            .expect("rows are in order and their columns ascend")
    }
}
