//! Least squares conformal maps (Lévy et al. 2002).
//!
//! The conformal energy of a map is its Dirichlet energy minus its signed area. The area depends on the boundary
//! alone, so the system is two copies of the harmonic one, tied together along the boundary. It is symmetric, and
//! positive definite once two vertices are pinned. Mirrored maps have negative area, so the minimiser is none.

use crate::qmesh::{QuadMesh, Vec2, VertexData, VertexId};
use qsolve::{
    Backend, CsrMatrix, DMatrix, LinearSolver, SolveError, SolveOptions, SolveRecord, Structure, Symbolic,
    Triplets,
};

use super::dirichlet_energy::springs;
use crate::dirichlet::Unknowns;
use crate::disk::{farthest, pairs};
use crate::embed::single;
use crate::{EmbedError, Embedding};

/// Entries of the largest factor that is made without being asked for: 2.4 GB.
const MOST_ENTRIES: usize = 300_000_000;

/// The answer, from factors up to a size that most machines have room for: every conformal map has little energy, and no coarser level
/// stands for all of them. Two million unknowns take 17 s so, and four minutes by multigrid.
fn solved(
    matrix: &CsrMatrix<f64>,
    rhs: &DMatrix<f64>,
    options: &SolveOptions,
) -> Result<(DMatrix<f64>, SolveRecord), SolveError> {
    let structure = Structure::SymmetricPositiveDefinite;
    if options.backend != Backend::Auto {
        return qsolve::solve(matrix, structure, rhs, options);
    }
    if let Ok(symbolic) = Symbolic::analyze(matrix, structure)
        && symbolic.factor_entries() <= Some(MOST_ENTRIES)
    {
        match symbolic.factor(matrix).and_then(|factor| factor.solve(rhs, options.residual_bound)) {
            Err(SolveError::TooLarge { .. }) => {}
            decided => return decided,
        }
    }
    qsolve::solve(matrix, structure, rhs, &SolveOptions { backend: Backend::Multigrid, ..*options })
}

/// Pins the boundary vertices that are farthest apart (found by walking twice to the farthest vertex) on the `x` axis,
/// as far apart as in space.
pub(super) fn lscm(
    mesh: &QuadMesh,
    rim: &[VertexId],
    options: &SolveOptions,
) -> Result<Embedding, EmbedError> {
    let first = farthest(mesh, rim, mesh.position(rim[0]));
    let second = farthest(mesh, rim, mesh.position(first));
    let span = (mesh.position(second) - mesh.position(first)).norm();
    if span <= 0.0 {
        return Err(EmbedError::NothingToPin);
    }
    // Solved in units of the span.
    let mut uv = VertexData::filled(mesh.vertex_count(), Vec2::zeros());
    uv[second] = Vec2::new(1.0, 0.0);
    let unknowns = Unknowns::new(mesh, |vertex| vertex != first && vertex != second);
    let springs = springs(mesh)?;
    let negative = springs.iter().filter(|(_, weight)| *weight < 0.0).count();
    let mut system = System {
        unknowns: &unknowns,
        uv: &uv,
        triplets: triplets(&unknowns, &springs),
        rhs: DMatrix::zeros(2 * unknowns.len(), 1),
    };
    for &([a, b], weight) in &springs {
        for axis in 0..2 {
            system.couple((a, axis), (a, axis), weight);
            system.couple((b, axis), (b, axis), weight);
            system.couple((a, axis), (b, axis), -weight);
            system.couple((b, axis), (a, axis), -weight);
        }
    }
    // Minus the area ½ Σ (xₐ y_b − x_b yₐ) over the boundary edges, holes included: the rim first.
    let mut loops = mesh.boundary_loops();
    mesh.outer_first(&mut loops);
    let holes: Vec<_> = loops.iter().skip(1).map(|hole| mesh.loop_vertices(hole)).collect();
    for [a, b] in pairs(rim).chain(holes.iter().flat_map(|hole| pairs(hole))) {
        for (x, y, value) in [(a, b, -0.5), (b, a, 0.5)] {
            system.couple((x, 0), (y, 1), value);
            system.couple((y, 1), (x, 0), value);
        }
    }
    let matrix = system.triplets.build()?;
    let rhs = system.rhs;
    let (solution, record) = match solved(&matrix, &rhs, options) {
        // So close to singular that rounding decides the sign of a pivot: LU looks for a better one.
        Err(SolveError::NotPositiveDefinite { .. }) => {
            qsolve::solve(&matrix, Structure::General, &rhs, options)?
        }
        solved => solved?,
    };
    for (k, &vertex) in unknowns.vertices.iter().enumerate() {
        uv[vertex] = Vec2::new(solution[2 * k], solution[2 * k + 1]);
    }
    for position in uv.iter_mut() {
        *position *= span;
    }
    Ok(single(uv, "lscm", Some(record), negative))
}

/// The gradient of the energy, zero at the minimiser; pinned coordinates go to the right.
struct System<'a> {
    unknowns: &'a Unknowns,
    uv: &'a VertexData<Vec2>,
    triplets: Triplets,
    rhs: DMatrix<f64>,
}

fn triplets(unknowns: &Unknowns, springs: &[([VertexId; 2], f64)]) -> Triplets {
    Triplets::with_capacity(2 * unknowns.len(), 2 * unknowns.len(), 9 * springs.len())
}

impl System<'_> {
    /// Adds `value` to the derivative by `here` of the derivative by `there`, each a vertex and an axis.
    fn couple(&mut self, here: (VertexId, usize), there: (VertexId, usize), value: f64) {
        let Some(row) = self.unknowns.number(here.0) else { return };
        match self.unknowns.number(there.0) {
            Some(column) => self.triplets.add(2 * row + here.1, 2 * column + there.1, value),
            None => self.rhs[(2 * row + here.1, 0)] -= value * self.uv[there.0][there.1],
        }
    }
}
