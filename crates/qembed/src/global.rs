//! The global step (section 2.2): the kept vertices come to rest as a net of springs.

use crate::qmesh::{QuadMesh, Vec2, VertexData, VertexId};
use crate::qsimplify::Simplified;
use qsolve::{SolveOptions, SolveRecord};

use crate::EmbedError;
use crate::dirichlet::{Unknowns, minimize_springs};

/// Spring constants lie between one over this and this, in units of that of a mean edge. A larger contrast than the
/// square of this drowns in the rounding of double precision, and the matrix is no longer positive definite.
const STIFFEST: f64 = 1e7;

/// What the global step leaves behind.
pub(crate) struct Global {
    /// Which vertices have their final position: the boundary, and what was kept and is tied to it.
    pub(crate) placed: VertexData<bool>,
    /// Kept vertices that no chain of springs ties to the boundary.
    pub(crate) cut_off: usize,
    /// How the system was solved, if there were unknowns.
    pub(crate) record: Option<SolveRecord>,
}

/// Eq. 5: minimises `½ Σ |vᵢ − vⱼ|⁻ʳ |uᵢ − uⱼ|²` over the springs of the simplified mesh, the boundary fixed in `uv`.
///
/// Lengths are measured in mean edge lengths `mean_edge`, which does not change the minimiser; spring constants are
/// kept between 1e-7 and 1e7 of that of a mean edge. What no spring ties to the boundary is determined by nothing (any place has the same energy);
/// it is left to the local step.
pub(crate) fn global(
    mesh: &QuadMesh,
    simplified: &Simplified,
    uv: &mut VertexData<Vec2>,
    exponent: f64,
    mean_edge: f64,
    options: &SolveOptions,
) -> Result<Global, EmbedError> {
    let tied = tied_to_boundary(mesh, &simplified.springs);
    let unknowns = Unknowns::new(mesh, |vertex| tied[vertex] && !mesh.is_boundary(vertex));
    let kept_inside = |vertex: &VertexId| simplified.kept[*vertex] && !mesh.is_boundary(*vertex);
    let cut_off = mesh.vertices().filter(kept_inside).filter(|&vertex| !tied[vertex]).count();
    let placed =
        mesh.vertex_data(|vertex| mesh.is_boundary(vertex) || (simplified.kept[vertex] && tied[vertex]));
    if unknowns.len() == 0 {
        return Ok(Global { placed, cut_off, record: None });
    }
    let stiffness = |[a, b]: [VertexId; 2]| {
        let length = (mesh.position(b) - mesh.position(a)).norm() / mean_edge;
        length.powf(-exponent).clamp(STIFFEST.recip(), STIFFEST)
    };
    // Springs along the boundary or in a cut-off part meet no unknown.
    let matters = |spring: &&[VertexId; 2]| spring.iter().any(|&end| unknowns.number(end).is_some());
    let springs: Vec<([VertexId; 2], f64)> =
        simplified.springs.iter().filter(matters).map(|&spring| (spring, stiffness(spring))).collect();
    let record = minimize_springs(&springs, &unknowns, uv, options)?;
    Ok(Global { placed, cut_off, record: Some(record) })
}

/// Which vertices a chain of springs ties to the boundary; the boundary itself included.
fn tied_to_boundary(mesh: &QuadMesh, springs: &[[VertexId; 2]]) -> VertexData<bool> {
    let mut starts = vec![0_u32; mesh.vertex_count() + 1];
    for end in springs.iter().flatten() {
        starts[end.index() + 1] += 1;
    }
    for vertex in 0..mesh.vertex_count() {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut neighbors = vec![VertexId(0); 2 * springs.len()];
    for &[a, b] in springs {
        for (here, there) in [(a, b), (b, a)] {
            neighbors[next[here.index()] as usize] = there;
            next[here.index()] += 1;
        }
    }
    let mut tied = mesh.vertex_data(|vertex| mesh.is_boundary(vertex));
    let mut stack: Vec<VertexId> = mesh.vertices().filter(|&vertex| tied[vertex]).collect();
    while let Some(vertex) = stack.pop() {
        let range = starts[vertex.index()] as usize..starts[vertex.index() + 1] as usize;
        for &neighbor in &neighbors[range] {
            if !std::mem::replace(&mut tied[neighbor], true) {
                stack.push(neighbor);
            }
        }
    }
    tied
}
