//! Islands: faces that are connected in the plane.
//!
//! Two corners are the same point of the map when they have the same vertex and the same UV (`-0` is `0`). Faces
//! joined through an edge whose two ends are the same points form an island; an edge with one face only is boundary.

use qembed::qmesh::{PolygonView, Vec2};

use super::buckets::Buckets;
use super::tree::Segment;

/// No corner.
pub(crate) const NONE: u32 = u32::MAX;

pub(crate) struct Islands {
    /// The island of each face, numbered by first face.
    pub(crate) of_face: Vec<u32>,
    /// How many there are.
    pub(crate) count: usize,
    /// The first corner that is the same point of the map, for each corner.
    pub(crate) point: Vec<u32>,
    /// The next corner of the same face, for each corner.
    pub(crate) next: Vec<u32>,
    /// The face of each corner.
    pub(crate) face_of: Vec<u32>,
    /// For each corner, the corner whose edge runs the other way along the same edge; [`NONE`] where not exactly one does.
    pub(crate) twin: Vec<u32>,
    /// The corners whose edge to the next corner is boundary.
    pub(crate) boundary: Vec<u32>,
    /// A corner at each edge with more than two faces, or with two that run the same way, and how many they are.
    pub(crate) nonmanifold: Vec<(u32, u32)>,
}

/// How the boundary runs, as a graph.
pub(crate) struct Outline {
    /// Connected pieces of the boundary.
    pub(crate) loops: usize,
    /// Points that the boundary does not enter and leave exactly once.
    pub(crate) pinches: usize,
}

impl Islands {
    pub(crate) fn find(polygons: PolygonView<'_>, uv: &[Vec2]) -> Self {
        let point = weld(polygons, uv);
        let corners = polygons.corner_count();
        let mut next = vec![0_u32; corners];
        let mut face_of = vec![0_u32; corners];
        for face in 0..polygons.face_count() {
            let range = polygons.corners(face);
            for corner in range.clone() {
                next[corner] = if corner + 1 == range.end { range.start } else { corner + 1 } as u32;
                face_of[corner] = face as u32;
            }
        }
        let ends = |corner: u32| (point[corner as usize], point[next[corner as usize] as usize]);
        let low: Vec<u32> = (0..corners as u32).map(|corner| ends(corner).0.min(ends(corner).1)).collect();
        let mut edges = Buckets::new(&low, corners);
        drop(low);
        edges.sort_each(|corner| ends(corner).0.max(ends(corner).1));

        let mut sets = DisjointSets::new(polygons.face_count());
        let (mut boundary, mut nonmanifold) = (Vec::new(), Vec::new());
        let mut twin = vec![NONE; corners];
        for bucket in edges.iter() {
            let high = |&corner: &u32| ends(corner).0.max(ends(corner).1);
            for edge in bucket.chunk_by(|a, b| high(a) == high(b)) {
                match *edge {
                    [corner] => boundary.push(corner),
                    [a, b] if ends(a) != ends(b) => {
                        twin[a as usize] = b;
                        twin[b as usize] = a;
                    }
                    _ => nonmanifold.push((edge[0], edge.len() as u32)),
                }
                for pair in edge.windows(2) {
                    sets.join(face_of[pair[0] as usize], face_of[pair[1] as usize]);
                }
            }
        }
        boundary.sort_unstable();
        nonmanifold.sort_unstable();
        let (of_face, count) = sets.numbered();
        Self { of_face, count, point, next, face_of, twin, boundary, nonmanifold }
    }

    /// The points of the map at both ends of the edge that leaves `corner`.
    pub(crate) fn ends(&self, corner: u32) -> [u32; 2] {
        [corner, self.next[corner as usize]].map(|corner| self.point[corner as usize])
    }

    /// The island of a corner.
    pub(crate) fn island(&self, corner: u32) -> u32 {
        self.of_face[self.face_of[corner as usize] as usize]
    }

    /// The edge that leaves `corner`, with the corner as its id.
    pub(crate) fn segment(&self, corner: u32, at: impl Fn(u32) -> Vec2) -> Segment {
        Segment {
            ends: [at(corner), at(self.next[corner as usize])],
            points: self.ends(corner),
            island: self.island(corner),
            id: corner,
        }
    }

    pub(crate) fn outline(&self) -> Outline {
        let mut starts: Vec<u32> = self.boundary.iter().map(|&corner| self.ends(corner)[0]).collect();
        let mut stops: Vec<u32> = self.boundary.iter().map(|&corner| self.ends(corner)[1]).collect();
        starts.sort_unstable();
        stops.sort_unstable();
        let mut points = [starts.as_slice(), stops.as_slice()].concat();
        points.sort_unstable();
        points.dedup();
        let times = |sorted: &[u32], point: u32| {
            sorted.partition_point(|&p| p <= point) - sorted.partition_point(|&p| p < point)
        };
        let pinches = points.iter().filter(|&&p| times(&starts, p) != 1 || times(&stops, p) != 1).count();

        let mut sets = DisjointSets::new(points.len());
        let place = |point: u32| points.partition_point(|&p| p < point) as u32;
        for &corner in &self.boundary {
            let [a, b] = self.ends(corner);
            sets.join(place(a), place(b));
        }
        Outline { loops: sets.numbered().1, pinches }
    }
}

/// The first corner at the same point of the map, for each corner.
fn weld(polygons: PolygonView<'_>, uv: &[Vec2]) -> Vec<u32> {
    // `+ 0.0` turns -0 into 0; bits are then equal exactly where the numbers are.
    let bits = |corner: u32| [uv[corner as usize].x, uv[corner as usize].y].map(|x| (x + 0.0).to_bits());
    let mut vertices = Buckets::new(polygons.corner_vertex, polygons.positions.len());
    vertices.sort_each(bits);
    let mut point = vec![0; polygons.corner_count()];
    for bucket in vertices.iter() {
        for same in bucket.chunk_by(|&a, &b| bits(a) == bits(b)) {
            for &corner in same {
                point[corner as usize] = same[0];
            }
        }
    }
    point
}

/// Union-find with path halving; the smaller number is the root.
struct DisjointSets(Vec<u32>);

impl DisjointSets {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn root(&mut self, mut item: u32) -> u32 {
        while self.0[item as usize] != item {
            self.0[item as usize] = self.0[self.0[item as usize] as usize];
            item = self.0[item as usize];
        }
        item
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// The number of each item's set, in order of first items, and how many sets there are.
    fn numbered(mut self) -> (Vec<u32>, usize) {
        let mut count = 0;
        let mut number = vec![0; self.0.len()];
        for item in 0..number.len() as u32 {
            let root = self.root(item);
            number[item as usize] = if root == item { count } else { number[root as usize] };
            count += u32::from(root == item);
        }
        (number, count as usize)
    }
}
