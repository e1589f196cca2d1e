//! Which loop lies inside which: from the outermost point of each, a ray straight down meets the edge that tells.

use std::cmp::Ordering;

use qembed::qmesh::Vec2;
use rayon::prelude::*;

use super::faces::lexical;
use super::loops::Loops;
use super::violation::ViolationKind;
use super::{Findings, Map};
use crate::plane::{Segment, Tree, orientation};

/// A loop that is simple and apart from all others.
#[derive(Clone, Copy)]
struct Clean {
    index: usize,
    island: u32,
    /// Its leftmost point, the lowest of several.
    outermost: Vec2,
    /// 1 counter-clockwise, −1 clockwise.
    runs: i32,
    /// 1 when it goes round the material as an outer loop does, −1 for a hole; the same unless the island is mirrored.
    side: i32,
}

/// Condition 4, for the islands all of whose loops are simple.
pub(super) fn judge(
    map: &Map<'_>,
    loops: &Loops,
    is_simple: &[bool],
    mirrored: &[bool],
    found: &mut Findings,
) {
    let mut is_clean = vec![true; map.islands.count];
    let island_of = |index: usize| map.islands.island(loops.corners(index)[0]);
    for index in (0..loops.count()).filter(|&index| !is_simple[index]) {
        is_clean[island_of(index) as usize] = false;
    }
    let mut clean: Vec<Clean> = (0..loops.count())
        .into_par_iter()
        .filter(|&index| is_clean[island_of(index) as usize])
        .map(|index| {
            let (outermost, runs) = loops.outermost(map, index);
            let island = island_of(index);
            let side = if mirrored[island as usize] { -runs } else { runs };
            Clean { index, island, outermost, runs, side }
        })
        .collect();
    clean.sort_unstable_by(|a, b| lexical(a.outermost, b.outermost).then(a.index.cmp(&b.index)));
    let parents = parents(map, loops, &clean);
    report(map, loops, &clean, &parents, found);
}

/// For each loop, the place in `clean` of the innermost loop around it.
fn parents(map: &Map<'_>, loops: &Loops, clean: &[Clean]) -> Vec<Option<usize>> {
    let mut place = vec![usize::MAX; loops.count()];
    for (i, known) in clean.iter().enumerate() {
        place[known.index] = i;
    }
    let place_of = |edge: usize| place[loops.of_edge[edge] as usize];
    let tree = Tree::new(loops.segments(map, |edge| place_of(edge) != usize::MAX));
    let below: Vec<Option<Segment>> = (0..clean.len())
        .into_par_iter()
        .map(|i| edge_below(&tree, clean[i].outermost, |edge| place_of(edge as usize) == i))
        .collect();
    let mut parents: Vec<Option<usize>> = Vec::with_capacity(clean.len());
    for edge in below {
        parents.push(edge.and_then(|edge| {
            // Its outermost point lies left of the edge's loop's own ones, or straight below: that loop came first.
            let other = place_of(edge.id as usize);
            let runs_right = edge.ends[0].x < edge.ends[1].x;
            let is_inside = runs_right == (clean[other].runs > 0);
            if is_inside { Some(other) } else { parents[other] }
        }));
    }
    parents
}

/// The first edge straight below `p` (and ever so little to the right), those left out that `is_own` names. No edge touches `p` but
/// its own.
fn edge_below(tree: &Tree, p: Vec2, is_own: impl Fn(u32) -> bool) -> Option<Segment> {
    let mut best: Option<(Segment, f64)> = None;
    let mut stack: Vec<usize> = if tree.nodes.is_empty() { Vec::new() } else { vec![0] };
    while let Some(index) = stack.pop() {
        let node = &tree.nodes[index];
        let (low, high) = (node.bounds.low, node.bounds.high);
        let is_lower = best.as_ref().is_some_and(|(_, bottom)| high.y < *bottom);
        if low.x > p.x || high.x <= p.x || low.y > p.y || is_lower {
            continue;
        }
        if node.is_leaf() {
            for &segment in tree.segments(node) {
                let [l, r] = from_left(&segment);
                if l.x <= p.x && p.x < r.x && !is_own(segment.id) && orientation(l, r, p) > 0 {
                    let is_higher = best.as_ref().is_none_or(|(best, _)| is_above(&segment, best));
                    if is_higher {
                        best = Some((segment, l.y.min(r.y)));
                    }
                }
            }
        } else {
            // The higher one is looked at first.
            let [a, b] = tree.children(index);
            let is_first = tree.nodes[a].bounds.high.y > tree.nodes[b].bounds.high.y;
            stack.extend(if is_first { [b, a] } else { [a, b] });
        }
    }
    best.map(|(segment, _)| segment)
}

fn from_left(segment: &Segment) -> [Vec2; 2] {
    let [a, b] = segment.ends;
    if a.x <= b.x { [a, b] } else { [b, a] }
}

/// Which of two edges, of which one stands above or below the other and which do not cross, is the higher one.
fn is_above(a: &Segment, b: &Segment) -> bool {
    let ([p, q], [r, s]) = (from_left(a), from_left(b));
    let sign = if p.x >= r.x {
        orientation(r, s, p).cmp(&0).then(orientation(r, s, q).cmp(&0))
    } else {
        0.cmp(&orientation(p, q, r)).then(0.cmp(&orientation(p, q, s)))
    };
    sign == Ordering::Greater
}

fn report(map: &Map<'_>, loops: &Loops, clean: &[Clean], parents: &[Option<usize>], found: &mut Findings) {
    // The first loop of each island has its outermost point.
    let mut outer = vec![usize::MAX; map.islands.count];
    let edge = |i: usize| map.edge_place(loops.corners(clean[i].index)[0] as usize);
    for (i, known) in clean.iter().enumerate() {
        let island = known.island;
        let own = &mut outer[island as usize];
        if *own == usize::MAX {
            *own = i;
            match parents[i] {
                _ if known.side < 0 => {
                    found.add(ViolationKind::OuterClockwise, 1, &[island], || vec![edge(i)]);
                }
                Some(parent) if clean[parent].side > 0 => {
                    let islands = [island, clean[parent].island];
                    found.add(ViolationKind::IslandOnIsland, 1, &islands, || vec![edge(i), edge(parent)]);
                }
                _ => {}
            }
        } else if known.side > 0 {
            found.add(ViolationKind::HoleCounterClockwise, 1, &[island], || vec![edge(i), edge(*own)]);
        } else if parents[i] != Some(*own) {
            found.add(ViolationKind::HoleOutside, 1, &[island], || vec![edge(i), edge(*own)]);
        }
    }
}
