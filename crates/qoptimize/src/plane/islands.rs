//! Islands: faces that are connected in the plane.
//!
//! Two corners are the same point of the map when they have the same vertex and the same UV (`-0` is `0`). Faces
//! joined through an edge whose two ends are the same points form an island; an edge with one face only is boundary.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use qembed::qmesh::{Components, PolygonView, Vec2};
use rayon::prelude::*;

use super::buckets::Buckets;
use super::tree::Segment;

/// The least that a thread does at once.
const AT_ONCE: usize = 1 << 13;

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
        let (point, (next, face_of)) = rayon::join(|| weld(polygons, uv), || around_faces(polygons));
        let ends = |corner: u32| (point[corner as usize], point[next[corner as usize] as usize]);
        let corners = || (0..polygons.corner_count() as u32).into_par_iter().with_min_len(AT_ONCE);
        let low: Vec<u32> = corners().map(|corner| ends(corner).0.min(ends(corner).1)).collect();
        let edges = Buckets::new(&low, polygons.corner_count());
        drop(low);
        let twin: Vec<AtomicU32> = corners().map(|_| AtomicU32::new(NONE)).collect();
        let high = |corner: u32| ends(corner).0.max(ends(corner).1);
        let found = edges.runs(high, |found: &mut Found, edge| match *edge {
            [corner] => found.boundary.push(corner),
            [a, b] if ends(a) != ends(b) => {
                twin[a as usize].store(b, Relaxed);
                twin[b as usize].store(a, Relaxed);
            }
            _ => {
                found.nonmanifold.push((edge[0], edge.len() as u32));
                found.joined.extend(edge.windows(2).map(|pair| [pair[0], pair[1]]));
            }
        });
        let twin: Vec<u32> = twin.into_iter().map(AtomicU32::into_inner).collect();

        let mut sets = Components::new(polygons.face_count());
        let (mut boundary, mut nonmanifold) = (Vec::new(), Vec::new());
        let mut join = |a: u32, b: u32| {
            sets.join(face_of[a as usize], face_of[b as usize]);
        };
        for part in found {
            boundary.extend(part.boundary);
            nonmanifold.extend(part.nonmanifold);
            part.joined.into_iter().for_each(|[a, b]| join(a, b));
        }
        let of_pairs =
            twin.iter().enumerate().filter(|&(corner, &other)| other != NONE && (corner as u32) < other);
        of_pairs.for_each(|(corner, &other)| join(corner as u32, other));
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

        let mut sets = Components::new(points.len());
        let place = |point: u32| points.partition_point(|&p| p < point) as u32;
        for &corner in &self.boundary {
            let [a, b] = self.ends(corner);
            sets.join(place(a), place(b));
        }
        Outline { loops: sets.numbered().1, pinches }
    }
}

/// The next corner of the same face, and the face, for each corner.
fn around_faces(polygons: PolygonView<'_>) -> (Vec<u32>, Vec<u32>) {
    let corners = polygons.corner_count();
    let (mut next, mut face_of) = (Vec::with_capacity(corners), Vec::with_capacity(corners));
    for face in 0..polygons.face_count() {
        let range = polygons.corners(face);
        if let Some(last) = range.clone().last() {
            next.extend(range.start as u32 + 1..=last as u32);
            next.push(range.start as u32);
        }
        face_of.resize(range.end, face as u32);
    }
    (next, face_of)
}

/// The first corner at the same point of the map, for each corner.
fn weld(polygons: PolygonView<'_>, uv: &[Vec2]) -> Vec<u32> {
    let vertices = polygons.corner_vertex;
    // `+ 0.0` turns -0 into 0; bits are then equal exactly where the numbers are.
    let bits = |corner: u32| [uv[corner as usize].x, uv[corner as usize].y].map(|x| (x + 0.0).to_bits());
    // Most vertices have one UV: then their first corner says it all.
    let mut first = vec![NONE; polygons.positions.len()];
    for (corner, &vertex) in vertices.iter().enumerate() {
        let first = &mut first[vertex as usize];
        *first = (*first).min(corner as u32);
    }
    let mut point: Vec<u32> =
        vertices.par_iter().with_min_len(AT_ONCE).map(|&vertex| first[vertex as usize]).collect();
    let corners = || point.par_iter().enumerate().with_min_len(AT_ONCE);
    let is_apart = |&(corner, &first): &(usize, &u32)| bits(first) != bits(corner as u32);
    let at_seams: Vec<u32> = corners().filter(is_apart).map(|(corner, _)| vertices[corner]).collect();
    if at_seams.is_empty() {
        return point;
    }
    let mut is_split = vec![false; polygons.positions.len()];
    at_seams.into_iter().for_each(|vertex| is_split[vertex as usize] = true);
    let split: Vec<u32> = corners()
        .map(|(corner, _)| corner as u32)
        .filter(|&corner| is_split[vertices[corner as usize] as usize])
        .collect();
    let keys: Vec<u32> = split.iter().map(|&corner| vertices[corner as usize]).collect();
    let corner = |item: u32| split[item as usize];
    let welded = Buckets::new(&keys, polygons.positions.len()).runs(
        |item| bits(corner(item)),
        |found: &mut Vec<[u32; 2]>, same| {
            found.extend(same.iter().map(|&item| [corner(item), corner(same[0])]));
        },
    );
    welded.into_iter().flatten().for_each(|[corner, first]| point[corner as usize] = first);
    point
}

/// What was found at some edges.
#[derive(Default)]
struct Found {
    boundary: Vec<u32>,
    nonmanifold: Vec<(u32, u32)>,
    /// Corners at edges that are no pair's, whose faces are joined all the same.
    joined: Vec<[u32; 2]>,
}
