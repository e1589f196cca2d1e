//! Where the boundary of a map that is known vertex by vertex meets itself.

use qembed::qmesh::{HalfedgeId, QuadMesh, Vec2, VertexId};

use super::crossings::{Scope, find_crossings};
use super::predicates::orientation;
use super::tree::Segment;

/// How often the boundary of the map meets itself: pairs of edges that cross or touch, vertices at which it runs back over
/// itself, and loops that run the wrong way round. Zero together with corners that all turn left proves the map injective:
/// how often a point is covered is the sum of the loops' winding numbers, never negative, and at most that of the one outer loop.
pub(crate) fn outline_flaws(mesh: &QuadMesh, uv: &[Vec2]) -> usize {
    let at = |vertex: VertexId| uv[vertex.index()];
    let segment = |h: HalfedgeId| {
        let [a, b] = [mesh.origin(h), mesh.target(h)];
        Segment { ends: [a, b].map(at), points: [a.0, b.0], island: 0, id: h.0 }
    };
    let folds = mesh
        .boundary_halfedges()
        .filter(|&h| folds_back(at(mesh.origin(h)), at(mesh.target(h)), at(mesh.target(mesh.next(h)))))
        .count();
    let segments = mesh.boundary_halfedges().map(segment).collect();
    find_crossings(segments, Scope::Everything, 0).count + folds + misoriented(mesh, uv)
}

/// Whether the path `a b c` runs back over itself.
fn folds_back(a: Vec2, b: Vec2, c: Vec2) -> bool {
    (a - b).dot(&(c - b)) > 0.0 && orientation(a, b, c) == 0
}

/// One loop runs counter-clockwise, with the map to its left; all others, around holes, clockwise.
fn misoriented(mesh: &QuadMesh, uv: &[Vec2]) -> usize {
    let outer = mesh.boundary_loops().iter().filter(|walk| doubled_area(mesh, uv, walk) > 0.0).count();
    outer.abs_diff(1)
}

/// Twice the area that a loop encloses, with the surface to its left.
fn doubled_area(mesh: &QuadMesh, uv: &[Vec2], walk: &[HalfedgeId]) -> f64 {
    let Some(&first) = walk.first() else { return 0.0 };
    let origin = uv[mesh.origin(first).index()];
    let at = |vertex: VertexId| uv[vertex.index()] - origin;
    walk.iter().map(|&h| at(mesh.target(h)).perp(&at(mesh.origin(h)))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use qembed::qmesh::shapes;

    fn flaws(mesh: &QuadMesh, place: impl Fn(VertexId, Vec2) -> Vec2) -> usize {
        let uv: Vec<Vec2> = mesh.vertices().map(|v| place(v, mesh.position(v).xy())).collect();
        outline_flaws(mesh, &uv)
    }

    /// A flat map with holes has none; turned inside out, folded or pushed together it has.
    #[test]
    fn every_kind_of_flaw_is_seen() {
        let strip = shapes::grid(3, 1);
        assert_eq!(flaws(&strip, |_, p| p), 0);
        assert_eq!(flaws(&strip, |_, p| Vec2::new(-p.x, p.y)), 1, "mirrored");
        let far = |p: Vec2| if p.x == 3.0 { Vec2::new(0.5, p.y) } else { p };
        assert!(flaws(&strip, |_, p| far(p)) > 1, "folded over");
        assert_eq!(
            flaws(&strip, |v, p| if v.0 == 3 { Vec2::new(1.5, 0.0) } else { p }),
            2,
            "back over itself"
        );
        let tube = shapes::cylinder(8, 2);
        let radius = |z: f64| 3.0 - z;
        let flat: Vec<Vec2> =
            tube.vertices().map(|v| tube.position(v).xy() * radius(tube.position(v).z)).collect();
        assert_eq!(outline_flaws(&tube, &flat), 0, "a ring is injective");
        let inverted: Vec<Vec2> = flat.iter().map(|p| p / p.norm_squared()).collect();
        assert_eq!(
            outline_flaws(&tube, &inverted),
            0,
            "so is the ring turned inside out: one loop is the outer"
        );
    }
}
