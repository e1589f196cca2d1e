//! The boundary as closed curves: how it runs, and where it meets itself.

use qembed::qmesh::Vec2;

use super::faces::{folds_back, lexical, points_up};
use super::violation::ViolationKind;
use super::{Findings, Map, nesting};
use crate::plane::{Crossings, NONE, Scope, Segment, find_crossings, orientation};

/// Closed walks along the boundary, one after the other. A walk keeps to the faces around each point that it passes, so that loops
/// pinched in one point stay apart.
pub(super) struct Loops {
    /// Where the edges of each loop start, and one entry more for the end.
    start: Vec<u32>,
    /// The edges, each as the corner that it leaves.
    pub(super) edges: Vec<u32>,
    /// The loop of each entry of `edges`.
    pub(super) of_edge: Vec<u32>,
}

impl Loops {
    /// Every edge without a twin lies on one loop, edges of more than two faces included.
    pub(super) fn find(map: &Map<'_>) -> Self {
        let twin = &map.islands.twin;
        let next = &map.islands.next;
        let mut loops = Self { start: vec![0], edges: Vec::new(), of_edge: Vec::new() };
        let mut seen = vec![false; twin.len()];
        for first in 0..twin.len() as u32 {
            let mut corner = first;
            while twin[corner as usize] == NONE && !std::mem::replace(&mut seen[corner as usize], true) {
                loops.of_edge.push(loops.count() as u32);
                loops.edges.push(corner);
                // Around the point at the end, from face to face, to the next edge without a twin. A walk back along the same way would
                // lead here, so it cannot run in circles.
                corner = next[corner as usize];
                while twin[corner as usize] != NONE {
                    corner = next[twin[corner as usize] as usize];
                }
            }
            if loops.edges.len() > loops.start[loops.count()] as usize {
                loops.start.push(loops.edges.len() as u32);
            }
        }
        loops
    }

    pub(super) fn count(&self) -> usize {
        self.start.len() - 1
    }

    /// The corners of one loop.
    pub(super) fn corners(&self, index: usize) -> &[u32] {
        &self.edges[self.start[index] as usize..self.start[index + 1] as usize]
    }

    /// The place in the loop whose point is outermost, and which way a simple loop runs: it is strictly convex there.
    pub(super) fn outermost(&self, map: &Map<'_>, index: usize) -> (Vec2, i32) {
        let corners = self.corners(index);
        let n = corners.len();
        let at = |i: usize| map.uv[corners[i % n] as usize];
        let place = (0..n).min_by(|&i, &j| lexical(at(i), at(j))).unwrap_or(0);
        (at(place), orientation(at(place + n - 1), at(place), at(place + 1)))
    }

    /// The edges as segments; their ids are their places in `edges`.
    pub(super) fn segments(&self, map: &Map<'_>, keep: impl Fn(usize) -> bool) -> Vec<Segment> {
        let at = |corner: u32| map.uv[corner as usize];
        let kept = (0..self.edges.len()).filter(|&edge| keep(edge));
        kept.map(|edge| Segment { id: edge as u32, ..map.islands.segment(self.edges[edge], at) }).collect()
    }
}

/// Conditions 3 and 4. Returns whether everything was looked at.
pub(super) fn judge(map: &Map<'_>, loops: &Loops, mirrored: &[bool], found: &mut Findings) -> bool {
    judge_pinches(map, found);
    let mut is_simple = vec![true; loops.count()];
    judge_neighbors(map, loops, &mut is_simple, found);
    let crossings = find_crossings(loops.segments(map, |_| true), Scope::Everything, usize::MAX);
    judge_crossings(map, loops, &crossings, &mut is_simple, found);
    let all_listed = crossings.complete && crossings.pairs.len() == crossings.count;
    if all_listed {
        nesting::judge(map, loops, &is_simple, mirrored, found);
    }
    judge_islands(map, loops, found);
    if !found.counts.is_empty() {
        judge_branch_points(map, mirrored, found);
    }
    crossings.complete
}

/// Points that more than one boundary edge leaves.
fn judge_pinches(map: &Map<'_>, found: &mut Findings) {
    let mut edges: Vec<(u32, u32)> =
        map.islands.boundary.iter().map(|&corner| (map.point(corner as usize), corner)).collect();
    edges.sort_unstable();
    for group in edges.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let mut islands: Vec<u32> = group.iter().map(|&(_, corner)| map.islands.island(corner)).collect();
        islands.sort_unstable();
        islands.dedup();
        found
            .add(ViolationKind::Pinch, group.len(), &islands, || vec![map.corner_place(group[0].1 as usize)]);
    }
}

/// Successive edges that run back along each other.
fn judge_neighbors(map: &Map<'_>, loops: &Loops, is_simple: &mut [bool], found: &mut Findings) {
    for (index, is_simple) in is_simple.iter_mut().enumerate() {
        let corners = loops.corners(index);
        for (i, &corner) in corners.iter().enumerate() {
            let before = corners[(i + corners.len() - 1) % corners.len()] as usize;
            let corner = corner as usize;
            let [a, b, c] = [before, corner, map.next(corner)].map(|corner| map.uv[corner]);
            if folds_back(a, b, c) {
                *is_simple = false;
                // An edge without length has corners without area: they are named already.
                if a != b && b != c {
                    found.add(ViolationKind::Touching, 1, &[map.islands.island(corner as u32)], || {
                        vec![map.edge_place(before), map.edge_place(corner)]
                    });
                }
            }
        }
    }
}

fn judge_crossings(
    map: &Map<'_>,
    loops: &Loops,
    crossings: &Crossings,
    is_simple: &mut [bool],
    found: &mut Findings,
) {
    for pair in &crossings.pairs {
        pair.iter().for_each(|&edge| is_simple[loops.of_edge[edge as usize] as usize] = false);
        let [a, b] = pair.map(|edge| loops.edges[edge as usize]);
        let (a, b) = (a.min(b), a.max(b));
        let ends = |corner: u32| [corner as usize, map.next(corner as usize)].map(|corner| map.uv[corner]);
        let sides = |[p, q]: [Vec2; 2], r: [Vec2; 2]| orientation(p, q, r[0]) * orientation(p, q, r[1]);
        let is_proper = sides(ends(a), ends(b)) < 0 && sides(ends(b), ends(a)) < 0;
        let kind = if is_proper { ViolationKind::Crossing } else { ViolationKind::Touching };
        let mut islands = vec![map.islands.island(a), map.islands.island(b)];
        islands.dedup();
        found.add(kind, 1, &islands, || vec![map.edge_place(a as usize), map.edge_place(b as usize)]);
    }
    let unlisted = crossings.count - crossings.pairs.len();
    if unlisted > 0 {
        *found.counts.entry(ViolationKind::Crossing).or_default() += unlisted;
    }
}

/// Islands without a boundary.
fn judge_islands(map: &Map<'_>, loops: &Loops, found: &mut Findings) {
    let mut has_boundary = vec![false; map.islands.count];
    for &corner in &loops.edges {
        has_boundary[map.islands.island(corner) as usize] = true;
    }
    for (face, &island) in map.islands.of_face.iter().enumerate() {
        let corners = map.polygons.corners(face);
        if !std::mem::replace(&mut has_boundary[island as usize], true) && !corners.is_empty() {
            found.add(ViolationKind::NoBoundary, 1, &[island], || vec![map.corner_place(corners.start)]);
        }
    }
}

/// Points inside an island around which the angles sum to two full turns or more. Where all corners turn left, condition 3 or 4 is
/// violated too; this names the cause.
fn judge_branch_points(map: &Map<'_>, mirrored: &[bool], found: &mut Findings) {
    const NOT_INSIDE: u32 = u32::MAX;
    let mut turns = vec![0_u32; map.uv.len()];
    for &corner in &map.islands.boundary {
        turns[map.point(corner as usize) as usize] = NOT_INSIDE;
    }
    for corner in 0..map.uv.len() {
        let point = map.point(corner) as usize;
        let is_mirrored = mirrored[map.islands.island(corner as u32) as usize];
        if map.turn(corner) != if is_mirrored { -1 } else { 1 } {
            turns[point] = NOT_INSIDE;
        }
        if turns[point] != NOT_INSIDE {
            let [to, from] = [map.next(corner), map.previous(corner)];
            let [to, from] = if is_mirrored { [from, to] } else { [to, from] };
            let up = |end: usize| points_up(map.uv[corner], map.uv[end]);
            // The corner holds the direction to the right, seen from its point: counter-clockwise by less than half a turn.
            turns[point] += u32::from(!up(to) && up(from));
        }
    }
    for (point, &turns) in turns.iter().enumerate() {
        if turns > 1 && turns != NOT_INSIDE {
            let island = map.islands.island(point as u32);
            found
                .add(ViolationKind::BranchPoint, turns as usize, &[island], || vec![map.corner_place(point)]);
        }
    }
}
