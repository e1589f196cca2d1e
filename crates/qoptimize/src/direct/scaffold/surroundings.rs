//! What is not covered by a map, as triangles: the outside up to a frame, and the inside of the holes.

use robust::{Coord, orient2d};
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation as _};

use crate::qmesh::Vec2;

/// The side of the frame over the longer side of what it encloses.
const FRAME: f64 = 3.0;
/// Points on a side of the frame.
const FRAME_POINTS: usize = 6;
/// No angle is smaller where the boundary leaves room, in degrees. Refinement surely ends below 30°; 20° take few points.
const LEAST_ANGLE: f64 = 20.0;
/// Points added at most, as a multiple of those on the boundary; and as a number besides.
const MOST_POINTS: (usize, usize) = (4, 200);
/// Triangles smaller than this fraction of the frame are not refined: their circumcentres are not known well enough.
const LEAST_AREA: f64 = 1e-12;

/// A triangulation of what a map leaves free. Vertices of the map keep their numbers, new ones follow.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    /// The new vertices, those of the frame first.
    pub(super) points: Vec<Vec2>,
    /// How many vertices the frame has.
    pub(super) frame: usize,
    /// Counter-clockwise, and positive by exact predicates.
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Surroundings {
    /// Triangulates around `uv`, whose boundary runs along `edges`, each with the free side on its left. The boundary must
    /// not meet itself. The frame encloses `reach` too.
    ///
    /// `None` when the boundary is too close to itself for the arithmetic of the triangulation.
    pub(super) fn triangulate(edges: &[[u32; 2]], uv: &[Vec2], reach: &[Vec2]) -> Option<Self> {
        let mut rim: Vec<u32> = edges.iter().map(|edge| edge[0]).collect();
        rim.sort_unstable();
        rim.dedup();
        let points = rim.iter().map(|&v| uv[v as usize]).chain(reach.iter().copied());
        let low = points.clone().reduce(|a, b| a.inf(&b))?;
        let high = points.reduce(|a, b| a.sup(&b))?;
        let window = Window::around(low, high)?;
        let frame = window.frame();
        let mut vertices: Vec<Point2<f64>> = frame.iter().map(|&p| window.enter(p)).collect();
        vertices.extend(rim.iter().map(|&v| window.enter(uv[v as usize])));
        let number = |v: u32| frame.len() + rim.partition_point(|&other| other < v);
        let mut fences: Vec<[usize; 2]> = edges.iter().map(|edge| edge.map(number)).collect();
        fences.extend((0..frame.len()).map(|k| [k, (k + 1) % frame.len()]));
        let (known, fence_count) = (vertices.len(), fences.len());
        let mut clashes = 0;
        let mut cdt: Cdt = Cdt::try_bulk_load_cdt(vertices, fences.clone(), |_| clashes += 1).ok()?;
        // Constraints that meet, vertices that coincide or lie on an edge: closer than this arithmetic can tell.
        if clashes > 0 || cdt.num_vertices() != known || cdt.num_constraints() != fence_count {
            return None;
        }
        cdt.refine(
            RefinementParameters::new()
                .keep_constraint_edges()
                .exclude_outer_faces(true)
                .with_angle_limit(AngleLimit::from_deg(LEAST_ANGLE))
                .with_min_required_area(LEAST_AREA)
                .with_max_additional_vertices(MOST_POINTS.0 * rim.len() + MOST_POINTS.1),
        );
        let free = free_faces(&cdt, &fences[..edges.len()])?;
        let added = cdt.vertices().skip(known).map(|vertex| window.leave(vertex.position()));
        let points: Vec<Vec2> = frame.iter().copied().chain(added).collect();
        let numbers = Numbers { map: uv.len(), frame: frame.len(), rim: &rim };
        let triangles =
            free.iter().map(|&face| cdt.face(face).vertices().map(|vertex| numbers.of(vertex.index())));
        let surroundings = Self { points, frame: frame.len(), triangles: triangles.collect() };
        surroundings.is_positive(uv).then_some(surroundings)
    }

    /// Whether every triangle turns left, exactly and in floating point.
    fn is_positive(&self, uv: &[Vec2]) -> bool {
        let at = |v: u32| uv.get(v as usize).copied().unwrap_or_else(|| self.points[v as usize - uv.len()]);
        let coord = |p: Vec2| Coord { x: p.x, y: p.y };
        self.triangles.iter().all(|triangle| {
            let [a, b, c] = triangle.map(at);
            orient2d(coord(a), coord(b), coord(c)) > 0.0 && (b - a).perp(&(c - a)) > 0.0
        })
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// From the triangulation's numbers to those of map and surroundings.
struct Numbers<'a> {
    map: usize,
    frame: usize,
    rim: &'a [u32],
}

impl Numbers<'_> {
    fn of(&self, vertex: usize) -> u32 {
        match vertex.checked_sub(self.frame) {
            None => (self.map + vertex) as u32,
            Some(k) if k < self.rim.len() => self.rim[k],
            Some(k) => (self.map + self.frame + k - self.rim.len()) as u32,
        }
    }
}

/// All faces that can be reached from the left of the boundary without crossing it, in order.
fn free_faces(cdt: &Cdt, boundary: &[[usize; 2]]) -> Option<Vec<FixedFaceHandle<InnerTag>>> {
    let mut seen = vec![false; cdt.num_all_faces()];
    let mut stack = Vec::new();
    for edge in boundary {
        let [a, b] = edge.map(FixedVertexHandle::from_index);
        stack.push(cdt.get_edge_from_neighbors(a, b)?.face().as_inner()?.fix());
    }
    let mut free = Vec::new();
    while let Some(face) = stack.pop() {
        if std::mem::replace(&mut seen[face.index()], true) {
            continue;
        }
        free.push(face);
        for edge in cdt.face(face).adjacent_edges() {
            if let Some(neighbor) = edge.rev().face().as_inner()
                && !edge.is_constraint_edge()
            {
                stack.push(neighbor.fix());
            }
        }
    }
    free.sort_unstable();
    Some(free)
}

/// The frame, and coordinates in which it reaches from 1 to 2: free of underflow.
struct Window {
    center: Vec2,
    side: f64,
}

impl Window {
    fn around(low: Vec2, high: Vec2) -> Option<Self> {
        let side = FRAME * (high - low).max();
        (side.is_normal() && side > 0.0).then(|| Self { center: low + 0.5 * (high - low), side })
    }

    fn enter(&self, p: Vec2) -> Point2<f64> {
        let q = (p - self.center) / self.side;
        Point2::new(1.5 + q.x, 1.5 + q.y)
    }

    fn leave(&self, p: Point2<f64>) -> Vec2 {
        self.center + self.side * Vec2::new(p.x - 1.5, p.y - 1.5)
    }

    /// The points of the frame, counter-clockwise.
    fn frame(&self) -> Vec<Vec2> {
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| Vec2::new(x, y));
        (0..4)
            .flat_map(|k| (0..FRAME_POINTS).map(move |i| (k, i as f64 / FRAME_POINTS as f64)))
            .map(|(k, t)| self.center + self.side * corners[k].lerp(&corners[(k + 1) % 4], t))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn polygon(points: &[Vec2]) -> Vec<[u32; 2]> {
        // The free side on the left: against the polygon's own sense.
        (0..points.len() as u32).map(|i| [(i + 1) % points.len() as u32, i]).collect()
    }

    fn area(surroundings: &Surroundings, uv: &[Vec2]) -> f64 {
        let at = |v: u32| {
            uv.get(v as usize).copied().unwrap_or_else(|| surroundings.points[v as usize - uv.len()])
        };
        surroundings.triangles.iter().map(|t| 0.5 * (at(t[1]) - at(t[0])).perp(&(at(t[2]) - at(t[0])))).sum()
    }

    /// Triangles and map together fill the frame; holes are filled too.
    #[test]
    fn everything_free_is_covered_once() {
        let circle = |n: u32, r: f64| -> Vec<Vec2> {
            (0..n)
                .map(|i| (TAU * f64::from(i) / f64::from(n)).sin_cos())
                .map(|(s, c)| Vec2::new(r * c, r * s))
                .collect()
        };
        let outer = circle(40, 1.0);
        let mut edges = polygon(&outer);
        let alone = Surroundings::triangulate(&edges, &outer, &[]).expect("a circle is simple");
        let covered = 20.0 * (TAU / 40.0).sin();
        assert!((area(&alone, &outer) - (36.0 - covered)).abs() < 1e-9, "{}", area(&alone, &outer));
        let hole = circle(12, 0.4);
        edges.extend((0..12).map(|i| [40 + i, 40 + (i + 1) % 12]));
        let both = [outer, hole].concat();
        let holed = Surroundings::triangulate(&edges, &both, &[]).expect("a ring is simple");
        let filled = 6.0 * 0.16 * (TAU / 12.0).sin();
        assert!((area(&holed, &both) - (36.0 - covered + filled)).abs() < 1e-9);
    }

    /// Away from narrow gaps no triangle is a sliver, and the number of points stays in proportion.
    #[test]
    fn triangles_are_well_shaped() {
        let comb: Vec<Vec2> = (0..60)
            .map(|i| PI * f64::from(i) / 30.0)
            .map(|t| Vec2::new(t.cos(), t.sin()) * (1.0 + 0.3 * (7.0 * t).sin()))
            .collect();
        let around = Surroundings::triangulate(&polygon(&comb), &comb, &[]).expect("a star is simple");
        assert!(around.points.len() < 400, "{}", around.points.len());
        let at =
            |v: u32| comb.get(v as usize).copied().unwrap_or_else(|| around.points[v as usize - comb.len()]);
        let thin = around.triangles.iter().filter(|t| {
            let [a, b, c] = t.map(at);
            let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
            (b - a).perp(&(c - a)) < 0.15 * longest
        });
        assert!(thin.count() * 50 < around.triangles.len());
    }

    /// What touches itself is refused, and a map as small or large as doubles allow is not.
    #[test]
    fn degenerate_boundaries_are_refused() {
        let touching = [[0., 0.], [4., 0.], [4., 1.], [2., 0.], [0., 1.]].map(|[x, y]| Vec2::new(x, y));
        assert!(Surroundings::triangulate(&polygon(&touching), &touching, &[]).is_none());
        let point = [Vec2::zeros(); 3];
        assert!(Surroundings::triangulate(&polygon(&point), &point, &[]).is_none());
        for scale in [1e-100, 1e100] {
            let triangle = [[0., 0.], [1., 0.], [0., 1.]].map(|[x, y]| scale * Vec2::new(x, y));
            assert!(Surroundings::triangulate(&polygon(&triangle), &triangle, &[]).is_some());
        }
    }
}
