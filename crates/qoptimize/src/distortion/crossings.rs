//! Boundary edges that meet though they share no point of the map.
//!
//! Broad phase: one tree of bounding boxes per island, split at the median, so unequal edge lengths (the rule on free
//! boundaries) cost nothing. Narrow phase: exact predicates; touching counts.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use robust::{Coord, orient2d};

/// Counting stops at this many crossings: a map with so many needs no better number.
pub const CROSSING_LIMIT: usize = 1_000_000;

/// Pairs of boxes and of edges looked at in one measurement, at most. Only boundaries made for the purpose, such as
/// 100,000 hair-thin slanted teeth, come near.
const WORK_LIMIT: u64 = 1 << 30;

const LEAF: usize = 4;

/// An edge of the boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) ends: [[f64; 2]; 2],
    /// The points of the map at its ends: edges that share one are neighbours.
    pub(super) points: [u32; 2],
    pub(super) island: u32,
}

/// How many pairs meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crossings {
    pub(super) count: usize,
    /// Whether all pairs were looked at; `count` is a lower bound otherwise.
    pub(super) complete: bool,
}

/// Pairs of segments of one island that meet and share no point.
pub(super) fn count_crossings(mut segments: Vec<Segment>) -> Crossings {
    segments.sort_by_key(|segment| segment.island);
    let total = segments.len().max(1) as u64;
    let islands: Vec<&[Segment]> = segments.chunk_by(|a, b| a.island == b.island).collect();
    // All that were met so far, anywhere. Whether it reaches the limit does not depend on who counts first.
    let met = AtomicUsize::new(0);
    let found: Vec<Crossings> = islands
        .par_iter()
        .map(|&island| {
            // Small islands are always finished: brute force on 2¹⁰ edges is no work.
            let share = u128::from(WORK_LIMIT) * island.len() as u128 / u128::from(total);
            Tree::new(island).count((share as u64).max(1 << 20), &met)
        })
        .collect();
    sum(&found)
}

fn sum(parts: &[Crossings]) -> Crossings {
    let count = parts.iter().map(|part| part.count).sum::<usize>();
    Crossings {
        count: count.min(CROSSING_LIMIT),
        complete: count < CROSSING_LIMIT && parts.iter().all(|part| part.complete),
    }
}

/// Whether two closed segments have a point in common, exactly.
fn meet(a: &Segment, b: &Segment) -> bool {
    let side = |s: &Segment, p: [f64; 2]| {
        let at = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
        let turn = orient2d(at(s.ends[0]), at(s.ends[1]), at(p));
        i32::from(turn > 0.0) - i32::from(turn < 0.0)
    };
    // With overlapping boxes, "not strictly on one side" of each other is the whole test, collinear edges included.
    Bounds::of(a).overlaps(&Bounds::of(b))
        && side(a, b.ends[0]) * side(a, b.ends[1]) <= 0
        && side(b, a.ends[0]) * side(b, a.ends[1]) <= 0
}

#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    fn of(segment: &Segment) -> Self {
        let [a, b] = segment.ends;
        Self { low: [a[0].min(b[0]), a[1].min(b[1])], high: [a[0].max(b[0]), a[1].max(b[1])] }
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: [self.low[0].min(other.low[0]), self.low[1].min(other.low[1])],
            high: [self.high[0].max(other.high[0]), self.high[1].max(other.high[1])],
        }
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

struct Node {
    bounds: Bounds,
    start: usize,
    end: usize,
    /// The second child; the first follows its parent. 0 in a leaf.
    second: usize,
}

struct Tree {
    segments: Vec<Segment>,
    nodes: Vec<Node>,
}

impl Tree {
    fn new(segments: &[Segment]) -> Self {
        let mut tree = Self { segments: segments.to_vec(), nodes: Vec::with_capacity(segments.len()) };
        tree.split(0, segments.len());
        tree
    }

    fn split(&mut self, start: usize, end: usize) {
        let own = &mut self.segments[start..end];
        let Some(bounds) = own.iter().map(Bounds::of).reduce(Bounds::union) else { return };
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, start, end, second: 0 });
        if end - start <= LEAF {
            return;
        }
        let size = [0, 1].map(|k| bounds.high[k] - bounds.low[k]);
        let axis = usize::from(size[1] > size[0]);
        let center = |s: &Segment| s.ends[0][axis] / 2.0 + s.ends[1][axis] / 2.0;
        let middle = (end - start) / 2;
        own.select_nth_unstable_by(middle, |a, b| {
            center(a).total_cmp(&center(b)).then_with(|| a.points.cmp(&b.points))
        });
        self.split(start, start + middle);
        self.nodes[node].second = self.nodes.len();
        self.split(start + middle, end);
    }

    /// Work is divided into a fixed list of tasks, so that where a limit strikes does not depend on threads.
    fn count(&self, work: u64, met: &AtomicUsize) -> Crossings {
        const TASKS: usize = 128;
        if self.nodes.is_empty() {
            return Crossings { count: 0, complete: true };
        }
        let mut tasks = vec![(0, 0)];
        for _ in 0..self.segments.len().ilog2() {
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
        let found: Vec<Crossings> =
            tasks.par_iter().map(|&pair| self.count_below(pair, share, met)).collect();
        sum(&found)
    }

    /// Appends the pairs of boxes that a pair of boxes stands for; the pair itself when both are leaves.
    fn refine(&self, (a, b): (usize, usize), pairs: &mut Vec<(usize, usize)>) {
        let children = |node: usize| [node + 1, self.nodes[node].second];
        let is_leaf = |node: usize| self.nodes[node].second == 0;
        let mut push = |a: usize, b: usize| {
            if self.nodes[a].bounds.overlaps(&self.nodes[b].bounds) {
                pairs.push((a, b));
            }
        };
        if is_leaf(a) && is_leaf(b) {
            push(a, b);
        } else if a == b {
            let [c, d] = children(a);
            push(c, c);
            push(c, d);
            push(d, d);
        } else if is_leaf(b) || (!is_leaf(a) && self.len(a) >= self.len(b)) {
            children(a).into_iter().for_each(|child| push(child, b));
        } else {
            children(b).into_iter().for_each(|child| push(a, child));
        }
    }

    fn len(&self, node: usize) -> usize {
        self.nodes[node].end - self.nodes[node].start
    }

    fn count_below(&self, pair: (usize, usize), mut work: u64, met: &AtomicUsize) -> Crossings {
        let mut stack = vec![pair];
        let mut count = 0;
        while let Some((a, b)) = stack.pop() {
            if work == 0 || met.load(Ordering::Relaxed) >= CROSSING_LIMIT {
                return Crossings { count, complete: false };
            }
            work -= 1;
            if self.nodes[a].second == 0 && self.nodes[b].second == 0 {
                let here = self.count_leaves(a, b);
                if here > 0 {
                    met.fetch_add(here, Ordering::Relaxed);
                    count += here;
                }
            } else {
                self.refine((a, b), &mut stack);
            }
        }
        Crossings { count, complete: true }
    }

    fn count_leaves(&self, a: usize, b: usize) -> usize {
        let (first, second) = (&self.nodes[a], &self.nodes[b]);
        let mut count = 0;
        for i in first.start..first.end {
            let from = if a == b { i + 1 } else { second.start };
            for j in from..second.end {
                let (s, t) = (&self.segments[i], &self.segments[j]);
                let neighbors = s.points.iter().any(|point| t.points.contains(point));
                count += usize::from(!neighbors && meet(s, t));
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(points: &[[f64; 2]]) -> Vec<Segment> {
        let n = points.len();
        (0..n)
            .map(|i| Segment {
                ends: [points[i], points[(i + 1) % n]],
                points: [i as u32, ((i + 1) % n) as u32],
                island: 0,
            })
            .collect()
    }

    fn brute(segments: &[Segment]) -> usize {
        let mut count = 0;
        for (i, a) in segments.iter().enumerate() {
            for b in &segments[i + 1..] {
                let apart = a.points.iter().all(|p| !b.points.contains(p));
                count += usize::from(apart && a.island == b.island && meet(a, b));
            }
        }
        count
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
            assert_eq!(
                count_crossings(segments.clone()),
                Crossings { count: brute(&segments), complete: true }
            );
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
        assert_eq!(count_crossings(closed(&circle(100_000, 1))).count, 0);
        assert_eq!(count_crossings(closed(&circle(5, 2))).count, 5);
        let spike = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert_eq!(count_crossings(closed(&spike)).count, 2);
        assert_eq!(count_crossings(Vec::new()), Crossings { count: 0, complete: true });
    }

    /// Everything on one line: counting stops at the limit, and says so.
    #[test]
    fn collinear_boundary_is_bounded() {
        let points: Vec<[f64; 2]> = (0..20_000).map(|i| [f64::from(i * 7919 % 20_000), 0.0]).collect();
        let found = count_crossings(closed(&points));
        assert_eq!(found, Crossings { count: CROSSING_LIMIT, complete: false });
    }
}
