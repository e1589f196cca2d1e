//! Which corners' edges are one edge of the surface.

use super::Repairs;
use crate::Seams;
use crate::build::NONE;
use crate::polygons::PolygonView;

/// For the edge from each corner to the next of its face: the corner behind which the same edge lies in the other face;
/// `NONE` at boundaries and edges that are no two faces' own. First without those at seams, then with them.
pub(super) fn pair(
    polygons: PolygonView<'_>,
    layer: &[u32],
    alone: &[u32],
    seams: &Seams,
    repairs: &mut Repairs,
) -> [Vec<u32>; 2] {
    let mut joined = vec![NONE; polygons.corner_count()];
    let mut at_seams = Vec::new();
    let edges = Edges::new(polygons, layer, alone);
    let mut nonmanifold = Vec::new();
    let mut bucket: Vec<Edge> = Vec::new();
    for low in 0..polygons.positions.len() {
        bucket.clear();
        bucket.extend(edges.above(low as u32));
        bucket.sort_unstable();
        for group in bucket.chunk_by(|a, b| (a.high, a.layer) == (b.high, b.layer)) {
            let ends = [low as u32, group[0].high];
            match group {
                [_] => {}
                [a, b] => {
                    joined[a.corner as usize] = b.corner;
                    joined[b.corner as usize] = a.corner;
                    if !seams.is_empty() && seams.contains(ends[0], ends[1]) {
                        at_seams.extend([a.corner, b.corner]);
                    }
                }
                _ if !seams.is_empty() && seams.contains(ends[0], ends[1]) => {}
                _ => nonmanifold.push(ends),
            }
        }
    }
    nonmanifold.dedup();
    nonmanifold.into_iter().for_each(|edge| repairs.nonmanifold_edges.push(edge));
    let mut mates = joined.clone();
    at_seams.into_iter().for_each(|corner| mates[corner as usize] = NONE);
    [mates, joined]
}

/// One face's side of an edge, in the order in which sides are grouped.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    high: u32,
    layer: u32,
    corner: u32,
}

/// The sides of all edges, by their lower vertex.
struct Edges<'a> {
    polygons: PolygonView<'a>,
    layer: &'a [u32],
    start: Vec<u32>,
    /// The corner at which the edge starts, and its face.
    sides: Vec<[u32; 2]>,
}

impl<'a> Edges<'a> {
    fn new(polygons: PolygonView<'a>, layer: &'a [u32], alone: &[u32]) -> Self {
        let mut is_alone = vec![false; polygons.face_count()];
        alone.iter().for_each(|&face| is_alone[face as usize] = true);
        let mut start = vec![0u32; polygons.positions.len() + 1];
        let joined = |face: &usize| !is_alone[*face];
        let lows = |face: usize| {
            let vertices = polygons.face(face);
            (0..vertices.len()).map(move |i| vertices[i].min(vertices[(i + 1) % vertices.len()]))
        };
        for face in (0..polygons.face_count()).filter(joined) {
            lows(face).for_each(|low| start[low as usize + 1] += 1);
        }
        for vertex in 0..polygons.positions.len() {
            start[vertex + 1] += start[vertex];
        }
        let mut cursor = start.clone();
        let mut sides = vec![[0; 2]; start[polygons.positions.len()] as usize];
        for face in (0..polygons.face_count()).filter(joined) {
            for (low, corner) in lows(face).zip(polygons.corners(face)) {
                let place = &mut cursor[low as usize];
                sides[*place as usize] = [corner as u32, face as u32];
                *place += 1;
            }
        }
        Self { polygons, layer, start, sides }
    }

    /// The sides of the edges from `low` to higher vertices.
    fn above(&self, low: u32) -> impl Iterator<Item = Edge> + '_ {
        let range = self.start[low as usize] as usize..self.start[low as usize + 1] as usize;
        self.sides[range].iter().map(move |&[corner, face]| {
            let here = self.polygons.corner_vertex[corner as usize];
            let next = self.polygons.corner_vertex[after(self.polygons, corner, face) as usize];
            Edge { high: here.max(next), layer: self.layer[face as usize], corner }
        })
    }
}

/// The corner after `corner` in its face.
pub(super) fn after(polygons: PolygonView<'_>, corner: u32, face: u32) -> u32 {
    let end = polygons.face_start[face as usize + 1];
    if corner + 1 == end { polygons.face_start[face as usize] } else { corner + 1 }
}
