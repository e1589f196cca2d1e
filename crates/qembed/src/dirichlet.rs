//! Systems with given values at some vertices: numbering, assembly, and the way to the solver and back.

use crate::qmesh::{QuadMesh, Vec2, VertexData, VertexId};
use qsolve::{CsrMatrix, DMatrix, SolveOptions, SolveRecord, Structure, Triplets};

use crate::EmbedError;
use crate::weights::Row;

/// The vertices whose positions are sought, numbered in order.
pub(crate) struct Unknowns {
    pub(crate) vertices: Vec<VertexId>,
    number: VertexData<u32>,
}

impl Unknowns {
    pub(crate) fn new(mesh: &QuadMesh, sought: impl Fn(VertexId) -> bool) -> Self {
        let mut number = VertexData::filled(mesh.vertex_count(), u32::MAX);
        let vertices: Vec<VertexId> = mesh.vertices().filter(|&vertex| sought(vertex)).collect();
        for (k, &vertex) in vertices.iter().enumerate() {
            number[vertex] = k as u32;
        }
        Self { vertices, number }
    }

    pub(crate) fn len(&self) -> usize {
        self.vertices.len()
    }

    pub(crate) fn number(&self, vertex: VertexId) -> Option<usize> {
        let number = self.number[vertex];
        (number != u32::MAX).then_some(number as usize)
    }
}

/// Minimises `½ Σ w |uᵢ − uⱼ|²` over the unknowns and writes them into `uv`; what is there at the other vertices is given.
/// Each edge comes once, with a positive weight, or with weights whose quadratic form is positive.
pub(crate) fn minimize_springs(
    edges: &[([VertexId; 2], f64)],
    unknowns: &Unknowns,
    uv: &mut VertexData<Vec2>,
    options: &SolveOptions,
) -> Result<SolveRecord, EmbedError> {
    let mut diagonal = vec![0.0_f64; unknowns.len()];
    for ([a, b], weight) in edges {
        for k in [unknowns.number(*a), unknowns.number(*b)].into_iter().flatten() {
            diagonal[k] += weight;
        }
    }
    // Unknowns in units of their stiffness: the diagonal becomes one, and the residual is measured in positions.
    let unit: Vec<f64> =
        diagonal.iter().map(|&sum| if sum > 0.0 { sum.sqrt().recip() } else { 1.0 }).collect();
    let mut triplets = Triplets::with_capacity(unknowns.len(), unknowns.len(), 4 * edges.len());
    let mut rhs = DMatrix::zeros(unknowns.len(), 2);
    for &([a, b], weight) in edges {
        let numbers = [unknowns.number(a), unknowns.number(b)];
        for (here, there, value) in [(numbers[0], numbers[1], uv[b]), (numbers[1], numbers[0], uv[a])] {
            let Some(i) = here else { continue };
            triplets.add(i, i, unit[i] * unit[i] * weight);
            match there {
                Some(j) => triplets.add(i, j, -unit[i] * unit[j] * weight),
                None => add_row(&mut rhs, i, unit[i] * weight * value),
            }
        }
    }
    let structure = Structure::SymmetricPositiveDefinite;
    let (solution, record) = qsolve::solve(&triplets.build()?, structure, &rhs, options)?;
    for (k, &vertex) in unknowns.vertices.iter().enumerate() {
        uv[vertex] = unit[k] * row_of(&solution, k);
    }
    Ok(record)
}

/// Solves `d uᵢ = Σⱼ λᵢⱼ uⱼ`, one row for each unknown, and writes them into `uv`; what is there elsewhere is given.
pub(crate) fn balance_rows(
    rows: &[Row],
    unknowns: &Unknowns,
    uv: &mut VertexData<Vec2>,
    options: &SolveOptions,
) -> Result<SolveRecord, EmbedError> {
    let (matrix, rhs) = assemble_rows(rows, unknowns, uv)?;
    let (solution, record) = qsolve::solve(&matrix, Structure::General, &rhs, options)?;
    for (k, &vertex) in unknowns.vertices.iter().enumerate() {
        uv[vertex] = row_of(&solution, k);
    }
    Ok(record)
}

fn assemble_rows(
    rows: &[Row],
    unknowns: &Unknowns,
    uv: &VertexData<Vec2>,
) -> Result<(CsrMatrix<f64>, DMatrix<f64>), EmbedError> {
    let entries = rows.iter().map(|row| row.neighbors.len() + 1).sum();
    let mut triplets = Triplets::with_capacity(rows.len(), rows.len(), entries);
    let mut rhs = DMatrix::zeros(rows.len(), 2);
    for (i, row) in rows.iter().enumerate() {
        triplets.add(i, i, row.diagonal);
        for &(neighbor, weight) in &row.neighbors {
            match unknowns.number(neighbor) {
                Some(j) => triplets.add(i, j, -weight),
                None => add_row(&mut rhs, i, weight * uv[neighbor]),
            }
        }
    }
    Ok((triplets.build()?, rhs))
}

fn add_row(rhs: &mut DMatrix<f64>, row: usize, value: Vec2) {
    rhs[(row, 0)] += value.x;
    rhs[(row, 1)] += value.y;
}

fn row_of(solution: &DMatrix<f64>, row: usize) -> Vec2 {
    Vec2::new(solution[(row, 0)], solution[(row, 1)])
}
