//! The methods that the paper compares itself with, on the full mesh.

mod dirichlet_energy;
mod lscm;
mod mean_value;

use crate::qmesh::{Observer, QuadMesh, VertexId};
use qsolve::SolveOptions;

use crate::boundary::place;
use crate::dirichlet::{Unknowns, balance_rows, minimize_springs};
use crate::disk::{check_patch, filled, rim};
use crate::embed::{single, tell, without_filling};
use crate::frame::Frame;
use crate::{BoundaryShape, EmbedError, Embedding};
use rayon::prelude::*;

/// The methods that the paper compares itself with, on the full mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Classic {
    /// Tutte 1963: every edge weighs one.
    Uniform,
    /// Floater 2003: `(tan δ/2 + tan γ/2) / |vᵢ − vⱼ|` with the corner angles of the faces left and right of the edge at
    /// `vᵢ`, that is, mean value coordinates in the immediate star. Always positive.
    MeanValue,
    /// Eck et al. 1995: the harmonic map, whose Dirichlet energy is the mean over both ways to cut each quad into two
    /// triangles. Symmetric, with weights along the diagonals too; weights may be negative.
    Harmonic,
    /// Lévy et al. 2002: least squares conformal, free boundary, two pinned vertices. The energy is again the mean over
    /// both ways to cut each quad, so that no diagonal is preferred.
    Lscm,
}

/// A classic baseline. `boundary` is not used by LSCM, whose boundary is free. Holes are filled for the time of the
/// embedding, but by LSCM, which needs no filling.
///
/// # Errors
/// See [`EmbedError`].
pub fn embed_classic(
    mesh: &QuadMesh,
    method: Classic,
    boundary: &BoundaryShape,
    solve: &SolveOptions,
    observer: &dyn Observer,
) -> Result<Embedding, EmbedError> {
    tell(observer, 0.0)?;
    let embedding = match method {
        Classic::Lscm => {
            check_patch(mesh)?;
            lscm::lscm(mesh, &rim(mesh), solve)?
        }
        _ => {
            let patch = filled(mesh)?;
            let mut embedding = with_boundary(&patch, &rim(&patch), method, boundary, solve)?;
            embedding.uv = without_filling(embedding.uv, mesh);
            embedding
        }
    };
    tell(observer, 1.0)?;
    Ok(embedding)
}

fn with_boundary(
    mesh: &QuadMesh,
    rim: &[VertexId],
    method: Classic,
    boundary: &BoundaryShape,
    solve: &SolveOptions,
) -> Result<Embedding, EmbedError> {
    let positions = place(mesh, rim, boundary)?;
    let frame = Frame::new(&positions);
    let mut uv = frame.enter(mesh, rim, &positions);
    let unknowns = Unknowns::new(mesh, |vertex| !mesh.is_boundary(vertex));
    let (mut negative, mut record) = (0, None);
    if unknowns.len() > 0 {
        record = Some(match method {
            Classic::MeanValue => {
                let row = |&vertex: &VertexId| mean_value::row(mesh, vertex);
                let rows: Vec<_> = unknowns.vertices.par_iter().with_min_len(512).map(row).collect();
                balance_rows(&rows, &unknowns, &mut uv, solve)?
            }
            Classic::Harmonic => {
                let edges = dirichlet_energy::springs(mesh)?;
                negative = edges.iter().filter(|(_, weight)| *weight < 0.0).count();
                minimize_springs(&edges, &unknowns, &mut uv, solve)?
            }
            Classic::Uniform | Classic::Lscm => {
                let edges: Vec<_> = mesh.edges().map(|edge| (mesh.edge_vertices(edge), 1.0)).collect();
                minimize_springs(&edges, &unknowns, &mut uv, solve)?
            }
        });
    }
    frame.leave(&mut uv, rim, &positions);
    Ok(single(uv, method.name(), record, negative))
}

impl Classic {
    /// The name of the stage in [`Embedding::solves`](crate::Embedding::solves).
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::MeanValue => "mean-value",
            Self::Harmonic => "harmonic",
            Self::Lscm => "lscm",
        }
    }
}
