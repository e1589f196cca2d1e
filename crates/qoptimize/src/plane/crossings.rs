//! Boundary edges that meet though they share no point of the map.
//!
//! Broad phase: trees of bounding boxes. Narrow phase: exact predicates; touching counts.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::predicates::orientation;
use super::tree::{Bounds, Segment, Tree};

/// Counting stops at this many crossings: a map with so many needs no better number.
pub const CROSSING_LIMIT: usize = 1_000_000;

/// Pairs of boxes and of edges looked at in one search, at most. Only boundaries made for the purpose, such as
/// 100,000 hair-thin slanted teeth, come near.
const WORK_LIMIT: u64 = 1 << 30;

/// Pairs that one task lists, at most.
const LISTED_PER_TASK: usize = 1 << 14;

/// Which pairs are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scope {
    /// Edges of the same island.
    WithinIslands,
    /// All edges.
    Everything,
}

/// The pairs that meet.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Crossings {
    /// How many, at most [`CROSSING_LIMIT`].
    pub(crate) count: usize,
    /// Whether all pairs were looked at; `count` is a lower bound otherwise.
    pub(crate) complete: bool,
    /// Ids of segments that meet, the smaller first, sorted; not more than were asked for, nor than `count`.
    pub(crate) pairs: Vec<[u32; 2]>,
}

/// Pairs of segments that meet and share no point; up to `listed` of them are listed. Below some ten thousand they all can
/// be; the list is the same for any number of threads.
pub(crate) fn find_crossings(mut segments: Vec<Segment>, scope: Scope, listed: usize) -> Crossings {
    let total = segments.len().max(1) as u64;
    let groups: Vec<Vec<Segment>> = match scope {
        Scope::Everything => vec![segments],
        Scope::WithinIslands => {
            segments.sort_by_key(|segment| segment.island);
            segments.chunk_by(|a, b| a.island == b.island).map(<[Segment]>::to_vec).collect()
        }
    };
    // All that were met so far, anywhere. Whether it reaches the limit does not depend on who counts first.
    let met = AtomicUsize::new(0);
    let found: Vec<Crossings> = groups
        .into_par_iter()
        .map(|group| {
            // Small islands are always finished: brute force on 2¹⁰ edges is no work.
            let share = u128::from(WORK_LIMIT) * group.len() as u128 / u128::from(total);
            let search = Search { tree: &Tree::new(group), met: &met, listed: listed.min(LISTED_PER_TASK) };
            search.run((share as u64).max(1 << 20))
        })
        .collect();
    let mut all = joined(found);
    all.pairs.sort_unstable();
    // Hundreds of tasks with full lists have more than are counted.
    all.pairs.truncate(listed.min(all.count));
    all
}

fn joined(parts: Vec<Crossings>) -> Crossings {
    let mut all = Crossings { complete: true, ..Crossings::default() };
    for mut part in parts {
        all.count += part.count;
        all.complete &= part.complete;
        all.pairs.append(&mut part.pairs);
    }
    all.complete &= all.count < CROSSING_LIMIT;
    all.count = all.count.min(CROSSING_LIMIT);
    all
}

/// Whether two closed segments have a point in common, exactly.
fn meet(a: &Segment, b: &Segment) -> bool {
    let side = |s: &Segment, end: usize, t: &Segment| orientation(s.ends[0], s.ends[1], t.ends[end]);
    // With overlapping boxes, "not strictly on one side" of each other is the whole test, collinear edges included.
    Bounds::of(a).overlaps(&Bounds::of(b))
        && side(a, 0, b) * side(a, 1, b) <= 0
        && side(b, 0, a) * side(b, 1, a) <= 0
}

struct Search<'a> {
    tree: &'a Tree,
    met: &'a AtomicUsize,
    listed: usize,
}

impl Search<'_> {
    /// Work is divided into a fixed list of tasks, so that where a limit strikes does not depend on threads.
    fn run(&self, work: u64) -> Crossings {
        const TASKS: usize = 128;
        if self.tree.nodes.is_empty() {
            return Crossings { complete: true, ..Crossings::default() };
        }
        let mut tasks = vec![(0, 0)];
        for _ in 0..self.tree.len().ilog2() {
            if tasks.len() >= TASKS {
                break;
            }
            let mut finer = Vec::with_capacity(3 * tasks.len());
            for &pair in &tasks {
                self.refine(pair, &mut finer);
            }
            tasks = finer;
        }
        let share = work / tasks.len().max(1) as u64;
        joined(tasks.par_iter().map(|&pair| self.run_below(pair, share)).collect())
    }

    /// Appends the pairs of boxes that a pair of boxes stands for; the pair itself when both are leaves.
    fn refine(&self, (a, b): (usize, usize), pairs: &mut Vec<(usize, usize)>) {
        let nodes = &self.tree.nodes;
        let is_leaf = |node: usize| nodes[node].is_leaf();
        let mut push = |a: usize, b: usize| {
            if nodes[a].bounds.overlaps(&nodes[b].bounds) {
                pairs.push((a, b));
            }
        };
        if is_leaf(a) && is_leaf(b) {
            push(a, b);
        } else if a == b {
            let [c, d] = self.tree.children(a);
            push(c, c);
            push(c, d);
            push(d, d);
        } else if is_leaf(b) || (!is_leaf(a) && nodes[a].len() >= nodes[b].len()) {
            self.tree.children(a).into_iter().for_each(|child| push(child, b));
        } else {
            self.tree.children(b).into_iter().for_each(|child| push(a, child));
        }
    }

    fn run_below(&self, pair: (usize, usize), mut work: u64) -> Crossings {
        let mut stack = vec![pair];
        let mut found = Crossings::default();
        while let Some((a, b)) = stack.pop() {
            // A task fills its list even when others have met enough: the list is the same whoever came first.
            let is_enough =
                self.met.load(Ordering::Relaxed) >= CROSSING_LIMIT && found.pairs.len() >= self.listed;
            if work == 0 || is_enough {
                return found;
            }
            work -= 1;
            if self.tree.nodes[a].is_leaf() && self.tree.nodes[b].is_leaf() {
                let before = found.count;
                self.search_leaves(a, b, &mut found);
                if found.count > before {
                    self.met.fetch_add(found.count - before, Ordering::Relaxed);
                }
            } else {
                self.refine((a, b), &mut stack);
            }
        }
        found.complete = true;
        found
    }

    fn search_leaves(&self, a: usize, b: usize, found: &mut Crossings) {
        let [first, second] = [a, b].map(|node| self.tree.segments(&self.tree.nodes[node]));
        for (i, s) in first.iter().enumerate() {
            for t in &second[if a == b { i + 1 } else { 0 }..] {
                let neighbors = s.points.iter().any(|point| t.points.contains(point));
                if !neighbors && meet(s, t) {
                    found.count += 1;
                    if found.pairs.len() < self.listed {
                        found.pairs.push([s.id.min(t.id), s.id.max(t.id)]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use qembed::qmesh::Vec2;

    use super::*;

    fn closed(points: &[[f64; 2]]) -> Vec<Segment> {
        let n = points.len();
        (0..n)
            .map(|i| Segment {
                ends: [points[i].into(), points[(i + 1) % n].into()],
                points: [i as u32, ((i + 1) % n) as u32],
                island: 0,
                id: i as u32,
            })
            .collect()
    }

    fn brute(segments: &[Segment], scope: Scope) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        for (i, a) in segments.iter().enumerate() {
            for b in &segments[i + 1..] {
                let apart = a.points.iter().all(|p| !b.points.contains(p));
                let counts = scope == Scope::Everything || a.island == b.island;
                if apart && counts && meet(a, b) {
                    pairs.push([a.id, b.id]);
                }
            }
        }
        pairs
    }

    fn count_crossings(segments: Vec<Segment>) -> usize {
        find_crossings(segments, Scope::WithinIslands, 0).count
    }

    /// The tree finds what comparing all pairs finds.
    #[test]
    fn tree_agrees_with_all_pairs() {
        let mut seed = 7_u64;
        let mut random = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / (1 << 24) as f64
        };
        for n in [3, 4, 5, 9, 40, 300] {
            // Few distinct coordinates: touching, collinear and repeated edges are common.
            let points: Vec<[f64; 2]> =
                (0..n).map(|_| [(random() * 12.0).floor(), (random() * 12.0).floor()]).collect();
            let mut segments = closed(&points);
            for (i, segment) in segments.iter_mut().enumerate() {
                segment.island = u32::from(i * 3 > n);
            }
            for scope in [Scope::WithinIslands, Scope::Everything] {
                let pairs = brute(&segments, scope);
                let expected = Crossings { count: pairs.len(), complete: true, pairs };
                assert_eq!(find_crossings(segments.clone(), scope, usize::MAX), expected);
            }
        }
    }

    /// A convex polygon does not cross itself; a pentagram does so five times; a spike that touches an edge counts.
    #[test]
    fn known_counts() {
        let circle = |n: usize, step: usize| -> Vec<[f64; 2]> {
            (0..n)
                .map(|i| {
                    let t = std::f64::consts::TAU * (i * step) as f64 / n as f64;
                    [t.cos(), t.sin()]
                })
                .collect()
        };
        assert_eq!(count_crossings(closed(&circle(100_000, 1))), 0);
        assert_eq!(count_crossings(closed(&circle(5, 2))), 5);
        let spike = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert_eq!(count_crossings(closed(&spike)), 2);
        assert_eq!(count_crossings(Vec::new()), 0);
    }

    /// Everything on one line: counting stops at the limit, and says so.
    #[test]
    fn collinear_boundary_is_bounded() {
        let points: Vec<[f64; 2]> = (0..20_000).map(|i| [f64::from(i * 7919 % 20_000), 0.0]).collect();
        let found = find_crossings(closed(&points), Scope::Everything, 7);
        assert_eq!((found.count, found.complete, found.pairs.len()), (CROSSING_LIMIT, false, 7));
    }

    /// Edges that cross and edges that only touch, more than are counted: all that are listed are among those counted.
    #[test]
    fn no_more_are_listed_than_counted() {
        const LINES: u32 = 1300;
        let segment = |number: u32, ends: [[f64; 2]; 2]| Segment {
            ends: ends.map(Vec2::from),
            points: [2 * number, 2 * number + 1],
            island: 0,
            id: number,
        };
        // Every second line of one family ends on the outermost line of the other.
        let length = |i: u32| f64::from(if i.is_multiple_of(2) { LINES - 1 } else { LINES });
        let across = (0..LINES).map(|i| segment(i, [[-1.0, f64::from(i)], [length(i), f64::from(i)]]));
        let up = (0..LINES).map(|i| segment(LINES + i, [[f64::from(i), -1.0], [f64::from(i), length(i)]]));
        let found = find_crossings(across.chain(up).collect(), Scope::Everything, usize::MAX);
        assert_eq!((found.count, found.complete), (CROSSING_LIMIT, false));
        assert!(found.pairs.len() <= found.count && found.pairs.is_sorted(), "{}", found.pairs.len());
    }
}
