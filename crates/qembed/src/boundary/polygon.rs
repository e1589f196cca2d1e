//! Whether a polygon is simple: no two of its edges meet but neighbours in their common vertex.
//!
//! A binary tree of boxes over the edges in order; two subtrees are looked into only where their boxes overlap. For
//! polygons that do not wind densely around themselves that takes `O(n log n)`.

use crate::qmesh::Vec2;
use robust::{Coord, orient2d};

/// Two edges that meet where they should not, as the numbers of their first vertices; nothing when the polygon is
/// simple. Decided exactly on the given coordinates.
pub(super) fn meeting_edges(polygon: &[Vec2]) -> Option<[usize; 2]> {
    let tree = Tree::new(polygon);
    tree.meeting(tree.levels.len() - 1, 0, 0)
}

struct Tree<'a> {
    polygon: &'a [Vec2],
    /// The boxes of the edges, of pairs of edges, of fours, up to all.
    levels: Vec<Vec<Bounds>>,
}

impl<'a> Tree<'a> {
    fn new(polygon: &'a [Vec2]) -> Self {
        let count = polygon.len();
        let edge = |k: usize| Bounds::of(polygon[k], polygon[(k + 1) % count]);
        let mut levels = vec![(0..count).map(edge).collect::<Vec<_>>()];
        while let Some(finest) = levels.last().filter(|level| level.len() > 1) {
            let coarser = finest.chunks(2).map(|pair| pair[0].join(pair[pair.len() - 1])).collect();
            levels.push(coarser);
        }
        Self { polygon, levels }
    }

    /// Looks below two nodes of one level, `a ≤ b`.
    fn meeting(&self, level: usize, a: usize, b: usize) -> Option<[usize; 2]> {
        let nodes = &self.levels[level];
        if b >= nodes.len() || !nodes[a].overlaps(&nodes[b]) {
            return None;
        }
        if level == 0 {
            return self.meet(a, b).then_some([a, b]);
        }
        let below: &[[usize; 2]] = if a == b {
            &[[2 * a, 2 * a], [2 * a, 2 * a + 1], [2 * a + 1, 2 * a + 1]]
        } else {
            &[[2 * a, 2 * b], [2 * a, 2 * b + 1], [2 * a + 1, 2 * b], [2 * a + 1, 2 * b + 1]]
        };
        below.iter().find_map(|&[a, b]| self.meeting(level - 1, a, b))
    }

    /// Whether edges `a ≤ b` meet beyond what neighbours share; an edge without length meets itself.
    fn meet(&self, a: usize, b: usize) -> bool {
        let count = self.polygon.len();
        let [a0, a1] = [self.polygon[a], self.polygon[(a + 1) % count]];
        let [b0, b1] = [self.polygon[b], self.polygon[(b + 1) % count]];
        if a == b {
            return a0 == a1;
        }
        if (a + 1) % count == b {
            return folds_back(a0, a1, b1);
        }
        if (b + 1) % count == a {
            return folds_back(b0, b1, a1);
        }
        let [sa, sb] = [side(a0, a1, b0), side(a0, a1, b1)];
        let [sc, sd] = [side(b0, b1, a0), side(b0, b1, a1)];
        if sa == 0 && sb == 0 {
            return true; // on one line, and the boxes overlap
        }
        sa * sb <= 0 && sc * sd <= 0
    }
}

/// Whether the path `a b c` runs back over itself.
fn folds_back(a: Vec2, b: Vec2, c: Vec2) -> bool {
    side(a, b, c) == 0 && (a - b).dot(&(c - b)) > 0.0
}

/// 1 when `c` lies left of the line from `a` to `b`, −1 when right, 0 when on it.
fn side(a: Vec2, b: Vec2, c: Vec2) -> i8 {
    let coord = |p: Vec2| Coord { x: p.x, y: p.y };
    let turn = orient2d(coord(a), coord(b), coord(c));
    i8::from(turn > 0.0) - i8::from(turn < 0.0)
}

#[derive(Clone, Copy)]
struct Bounds {
    low: Vec2,
    high: Vec2,
}

impl Bounds {
    fn of(a: Vec2, b: Vec2) -> Self {
        Self { low: a.inf(&b), high: a.sup(&b) }
    }

    fn join(self, other: Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Vec<Vec2> {
        points.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
    }

    #[test]
    fn simple_polygons_have_no_meeting_edges() {
        assert_eq!(meeting_edges(&polygon(&[[0., 0.], [1., 0.], [0., 1.]])), None);
        // A comb with 500 teeth: concave, but simple.
        let teeth = (0..500).flat_map(|k| [[k as f64, 0.0], [k as f64 + 0.5, 1.0]]);
        let comb: Vec<_> = teeth.chain([[500.0, 2.0], [-1.0, 2.0]]).collect();
        assert_eq!(meeting_edges(&polygon(&comb)), None);
    }

    #[test]
    fn every_kind_of_meeting_is_found() {
        let bow_tie = [[0., 0.], [1., 1.], [1., 0.], [0., 1.]];
        assert_eq!(meeting_edges(&polygon(&bow_tie)), Some([0, 2]));
        let touching = [[0., 0.], [4., 0.], [4., 1.], [2., 0.], [0., 1.]];
        assert_eq!(meeting_edges(&polygon(&touching)), Some([0, 2]));
        let spike = [[0., 0.], [2., 0.], [1., 0.], [1., 1.]];
        assert_eq!(meeting_edges(&polygon(&spike)), Some([0, 1]));
        let repeated = [[0., 0.], [1., 0.], [1., 0.], [0., 1.]];
        assert!(meeting_edges(&polygon(&repeated)).is_some());
    }

    /// Against all pairs of edges, on star-shaped polygons with one vertex moved anywhere.
    #[test]
    fn the_tree_agrees_with_all_pairs() {
        let mut seed = 1_u64;
        let mut random = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (mut simple, mut meeting) = (0, 0);
        for count in 4..60 {
            let step = std::f64::consts::TAU / count as f64;
            let mut points: Vec<Vec2> = (0..count)
                .map(|k| (0.3 + random()) * Vec2::new((step * k as f64).cos(), (step * k as f64).sin()))
                .collect();
            points[count / 2] = Vec2::new(random() - 0.5, random() - 0.5);
            let tree = Tree::new(&points);
            let all = (0..count).any(|a| {
                (a..count).any(|b| tree.levels[0][a].overlaps(&tree.levels[0][b]) && tree.meet(a, b))
            });
            assert_eq!(meeting_edges(&points).is_some(), all, "{points:?}");
            if all { meeting += 1 } else { simple += 1 }
        }
        assert!(simple > 5 && meeting > 5, "both cases occur: {simple} {meeting}");
    }
}
