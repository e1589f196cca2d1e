//! Fewer vertices: removal of vertices of low Gaussian curvature (section 2.1 of the paper).
//!
//! [`simplify`] sorts the interior vertices by the absolute value of their curvature ([`removal_order`]) and removes
//! those below a threshold, as far as the [`RemovalRule`] lets them go. What is left is a polygon graph over vertices
//! of the full mesh: its edges are the springs of Eq. 5, its boundary is that of the mesh.
//!
//! ```
//! use qsimplify::qmesh::QuadMesh;
//! use qsimplify::{SimplifyOptions, simplify};
//!
//! // A grid of 6 by 6 quads with a bump.
//! let height = |x: f64, y: f64| (-(x - 3.0).powi(2) - (y - 3.0).powi(2)).exp();
//! let positions: Vec<[f64; 3]> =
//!     (0..49).map(|i| (f64::from(i % 7), f64::from(i / 7))).map(|(x, y)| [x, y, height(x, y)]).collect();
//! let quads = (0..36u32).map(|i| i + i / 6).map(|v| [v, v + 1, v + 8, v + 7]);
//! let mesh = QuadMesh::from_slices(&positions, quads)?;
//!
//! let simplified = simplify(&mesh, &SimplifyOptions::default(), &())?;
//! assert!(!simplified.removed.is_empty());
//! let graph = QuadMesh::build(simplified.polygons(&mesh))?; // a valid mesh again, of the same topology
//! assert_eq!(graph.topology(), mesh.topology());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Guaranteed: boundary vertices stay; with the rules `Guarded` and `Ring` the Euler characteristic and the boundary
//! loops stay, and no two faces come to share two vertices without sharing the edges between them, so a 3-connected
//! graph stays 3-connected and Tutte's theorem holds for Eq. 5 (each rule says what it means by that). Ties in
//! curvature, up to rounding, are broken by index; the result does not depend on the number of threads. Time is linear
//! but for the sorting: 190,000 quads take less than half a second.
//!
//! Not guaranteed: that all candidates go, nor that the largest possible number does: each is tried once, in order.
//! `Guarded` ends near a fifth of the interior vertices on real quad meshes, `Ring` near 95 %. `Naive` is deletion as the
//! paper prints it and leaves isolated vertices, chains and islands behind, for which Eq. 5 has no answer;
//! [`Simplified::connectivity`] counts them. Nothing shows that simplification lowers distortion.

mod error;
mod options;
mod order;
mod simplified;

mod graph;
mod guarded;
mod meetings;
mod naive;
mod ring;

pub use error::SimplifyError;
pub use options::{CurvatureMeasure, RemovalRule, RemovedSide, SimplifyOptions, Threshold};
pub use order::{RemovalOrder, removal_order};
pub use qcurv::{self, VertexArea, qmesh};
pub use simplified::{Connectivity, Simplified};

use graph::PolygonGraph;
use qmesh::{Observer, QuadMesh, VertexData, VertexId};

/// Candidates between two looks at the observer.
const OBSERVED_EVERY: usize = 4096;

/// Section 2.1: removes vertices of low curvature, in order.
///
/// Any mesh will do, with any number of components and boundary loops, or closed. Each candidate is tried once, when
/// its turn comes; one that is refused then is not tried again, although later removals may have made room for it.
///
/// # Errors
/// [`SimplifyError::BadThreshold`] when the threshold is out of range (whether or not the rule uses it), and
/// [`SimplifyError::Cancelled`] when the observer says so.
pub fn simplify(
    mesh: &QuadMesh,
    options: &SimplifyOptions,
    observer: &dyn Observer,
) -> Result<Simplified, SimplifyError> {
    options.check()?;
    report(observer, 0.0)?;
    let threshold = match options.rule {
        RemovalRule::All => Threshold::Fraction(1.0),
        RemovalRule::None => Threshold::Fraction(0.0),
        _ => options.threshold,
    };
    let candidates = removal_order(mesh, &SimplifyOptions { threshold, ..*options })?.candidates;
    let simplified = match options.rule {
        RemovalRule::Guarded => by_graph(mesh, &candidates, observer, guarded::Guarded::new)?,
        RemovalRule::Ring => by_graph(mesh, &candidates, observer, ring::Ring::new)?,
        RemovalRule::Carrier => {
            let mut full = Simplified::full(mesh);
            full.remove(&candidates);
            full
        }
        RemovalRule::Naive | RemovalRule::All => naive::delete(mesh, &candidates),
        RemovalRule::None => Simplified::full(mesh),
    };
    report(observer, 1.0)?;
    Ok(simplified)
}

/// A way to take single vertices out of a polygon graph.
trait Removal {
    /// Removes `vertex` from `graph` if that harms nothing, and says whether it did.
    fn try_remove(&mut self, graph: &mut PolygonGraph, vertex: u32) -> bool;
}

fn by_graph<R: Removal>(
    mesh: &QuadMesh,
    candidates: &[VertexId],
    observer: &dyn Observer,
    removal: impl FnOnce(&PolygonGraph) -> R,
) -> Result<Simplified, SimplifyError> {
    let mut graph = PolygonGraph::new(mesh);
    let mut removal = removal(&graph);
    let mut removed = Vec::new();
    for (done, &vertex) in candidates.iter().enumerate() {
        if done % OBSERVED_EVERY == 0 {
            report(observer, done as f64 / candidates.len() as f64)?;
        }
        if removal.try_remove(&mut graph, vertex.0) {
            removed.push(vertex);
        }
    }
    let mut kept = VertexData::filled(mesh.vertex_count(), true);
    for &vertex in &removed {
        kept[vertex] = false;
    }
    let (face_start, face_vertex) = graph.faces();
    Ok(Simplified {
        kept,
        removed,
        candidates: candidates.len(),
        springs: graph.edges(),
        face_start,
        face_vertex,
    })
}

fn report(observer: &dyn Observer, fraction: f64) -> Result<(), SimplifyError> {
    match observer.progress("simplify", fraction) {
        std::ops::ControlFlow::Continue(()) => Ok(()),
        std::ops::ControlFlow::Break(()) => Err(SimplifyError::Cancelled),
    }
}
