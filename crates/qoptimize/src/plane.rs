//! What the exact tests of planar maps share: signs, points, islands, boundary edges that meet.

mod buckets;
mod crossings;
mod islands;
mod outlines;
mod predicates;
mod tree;

use qembed::qmesh::{PolygonView, Vec2};

pub use crossings::CROSSING_LIMIT;
pub(crate) use crossings::{Crossings, Scope, find_crossings};
pub(crate) use islands::{Islands, NONE, Outline};
pub(crate) use outlines::outline_flaws;
pub(crate) use predicates::orientation;
pub(crate) use tree::{Segment, Tree};

/// Every pair of boundary edges of the map that meet though they share no point of it, as the corners that they leave: edge `c`
/// runs from corner `c` to the next corner of its face. Sorted, the smaller corner first; beyond some ten thousand the list ends
/// while the count goes on. Touching counts; edges that share a point of the map are not compared.
#[allow(dead_code, reason = "the list of places to mend")]
pub(crate) fn boundary_crossings(polygons: PolygonView<'_>, corner_uv: &[Vec2]) -> Crossings {
    let islands = Islands::find(polygons, corner_uv);
    let at = |corner: u32| corner_uv[corner as usize];
    let segments = islands.boundary.iter().map(|&corner| islands.segment(corner, at)).collect();
    find_crossings(segments, Scope::Everything, usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qmesh::shapes;

    /// A strip bent into itself: the two ends of a 5 × 1 strip cross, and the edges that do are named by their corners.
    #[test]
    fn crossing_edges_are_named_by_their_corners() {
        let mesh = shapes::grid(5, 1);
        let flat: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
        assert_eq!(boundary_crossings(mesh.view(), &flat).pairs, Vec::<[u32; 2]>::new());
        let width = flat.iter().map(|p| p.x).fold(0.0, f64::max);
        let height = flat.iter().map(|p| p.y).fold(0.0, f64::max);
        let bent: Vec<Vec2> = flat
            .iter()
            .map(|p| {
                let (t, radius) = (-7.0 * p.x / width, 2.0 + p.y / height);
                Vec2::new(t.cos(), t.sin()) * radius
            })
            .collect();
        let found = boundary_crossings(mesh.view(), &bent);
        assert!(found.complete && found.count > 0 && found.count == found.pairs.len());
        let islands = Islands::find(mesh.view(), &bent);
        for &[a, b] in &found.pairs {
            assert!(a < b && islands.boundary.contains(&a) && islands.boundary.contains(&b));
            // Of one end and of the other.
            let face = |corner: u32| corner / 4;
            assert!(face(a).abs_diff(face(b)) >= 3, "{a} {b}");
        }
    }
}
