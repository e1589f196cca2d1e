//! A tree of bounding boxes over segments, split at the median, so unequal edge lengths (the rule on free boundaries) cost nothing.

use qembed::qmesh::Vec2;

/// Segments per leaf.
const LEAF: usize = 4;

/// A boundary edge in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    /// Where it starts and ends.
    pub(crate) ends: [Vec2; 2],
    /// The points of the map at its ends: edges that share one are neighbours.
    pub(crate) points: [u32; 2],
    /// What it bounds.
    pub(crate) island: u32,
    /// The caller's number for it.
    pub(crate) id: u32,
}

#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) low: Vec2,
    pub(crate) high: Vec2,
}

impl Bounds {
    pub(crate) fn of(segment: &Segment) -> Self {
        let [a, b] = segment.ends;
        Self { low: a.inf(&b), high: a.sup(&b) }
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

pub(crate) struct Node {
    pub(crate) bounds: Bounds,
    start: usize,
    end: usize,
    /// The second child; the first follows its parent. 0 in a leaf.
    second: usize,
}

impl Node {
    pub(crate) fn is_leaf(&self) -> bool {
        self.second == 0
    }

    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }
}

/// The tree; node 0 is its root.
pub(crate) struct Tree {
    segments: Vec<Segment>,
    pub(crate) nodes: Vec<Node>,
}

impl Tree {
    pub(crate) fn new(segments: Vec<Segment>) -> Self {
        let nodes = Vec::with_capacity(segments.len());
        let count = segments.len();
        let mut tree = Self { segments, nodes };
        tree.split(0, count);
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
        let size = bounds.high - bounds.low;
        let axis = usize::from(size.y > size.x);
        let center = |s: &Segment| s.ends[0][axis] / 2.0 + s.ends[1][axis] / 2.0;
        let middle = (end - start) / 2;
        own.select_nth_unstable_by(middle, |a, b| {
            center(a).total_cmp(&center(b)).then_with(|| a.points.cmp(&b.points)).then(a.id.cmp(&b.id))
        });
        self.split(start, start + middle);
        self.nodes[node].second = self.nodes.len();
        self.split(start + middle, end);
    }

    pub(crate) fn children(&self, node: usize) -> [usize; 2] {
        [node + 1, self.nodes[node].second]
    }

    pub(crate) fn segments(&self, node: &Node) -> &[Segment] {
        &self.segments[node.start..node.end]
    }

    pub(crate) fn len(&self) -> usize {
        self.segments.len()
    }
}
