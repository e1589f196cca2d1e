//! Proof that a UV map is injective: no two faces share a point that they do not share in the mesh.
//!
//! [`certify`] decides with exact predicates, on the coordinates as they are. It reads any polygons with one UV per corner:
//! several islands, holes, seams, faces of any degree, whoever made them.
//!
//! # What is verified
//! Corners with the same vertex and the same UV are one *point* of the map; faces joined through an edge between the same two
//! points form an *island*; an edge with one face is *boundary* and runs as its face does.
//!
//! 1. *Faces.* Every triangle has positive area, every quad only corners that turn left, and every face of five corners or more is
//!    a simple polygon that runs counter-clockwise. A quad that no map can make convex because it shares its two opposite points u, v
//!    with another face (*exempt*: doublets, bubbles) is held to its corners at u and v.
//! 2. *Edges.* An edge that is not boundary has exactly two faces, which run opposite ways.
//! 3. *Boundary.* No point has more than one boundary edge that leaves it; two boundary edges that share no point of the map have
//!    no point of the plane in common, and two that share one have no other. So the boundary consists of simple polygons, *loops*,
//!    that neither cross nor touch each other or themselves.
//! 4. *Nesting.* In each island exactly one loop, the outer one, runs counter-clockwise; the others, its holes, run clockwise and
//!    lie directly inside it; and each outer loop lies outside all others or directly inside a hole. (Loop A lies *directly inside* B
//!    when B is the innermost loop around it.)
//!
//! # Why that is a proof
//! *Each face is a union of positive triangles* without common interior points, on its own corners: a triangle itself; a quad whose
//! corners turn left is convex, since four turns between 0 and π sum to a multiple of 2π below 4π; an exempt quad is split at the
//! diagonal that does not join u and v; a simple polygon has a triangulation without new vertices, and without triangles of no area
//! even where corners are straight ([Meisters 1975]: from a strictly convex corner, either the diagonal that cuts it off or the one to
//! the vertex farthest inside it divides the polygon into two simple ones). The corners' own turns would not do: a pentagram
//! turns left at each.
//!
//! *Coverage is winding.* Let c(p) be the number of triangles around p, for p on no edge. It is the sum of the winding numbers
//! of all triangles around p, because they are positive. Edges inside faces and between faces are run both ways (1 and 2) and cancel, so
//! c(p) is the sum of the winding numbers of the boundary loops around p.
//!
//! *Coverage is at most one.* By 3 the loops are Jordan curves, each with winding number ±1 inside and 0 outside, and any two are
//! disjoint, so they are nested like a forest. By 4, loops on the path from the root to p alternate between outer and hole, beginning
//! with an outer one: an outer loop lies directly inside nothing or a hole, a hole directly inside an outer loop. Hence the sum is 0
//! or 1.
//!
//! *So the map is injective.* The triangles' interiors are disjoint, as c ≤ 1. A point q of the map on an edge or vertex that is not on the
//! boundary is surrounded by triangles that cover a neighbourhood, and once around only, as c ≤ 1: a branch point, around which the angles sum
//! to 4π though every corner turns left, has c ≥ 2, and so have two islands' vertices in one place. No triangle elsewhere can
//! reach q, since it would have area there. Two points on the boundary are apart by 3.
//!
//! Nothing was assumed about the surface in space: it may be a disk, a cut sphere, or a soup. The four conditions are also necessary,
//! but for three strictnesses: quads and triangles must be convex where a split would do, boundaries must not even touch, and a map
//! whose islands are *mirrored* as a whole is not certified though it may cover nothing twice. Each has a kind of its own among
//! the [violations](ViolationKind).
//!
//! Time grows as n log n.

mod faces;
mod loops;
mod nesting;
mod violation;

pub(crate) use faces::outline_sign;

use std::collections::BTreeMap;
use std::fmt;

use qembed::qmesh::{PolygonView, Vec2};

pub use self::violation::{Place, Violation, ViolationKind};
use crate::distortion::{Distortion, MeasureError, check, measure_islands};
use crate::plane::{Islands, orientation};

/// The verdict on a map.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Certificate {
    /// Whether the map is proven injective.
    pub holds: bool,
    /// Whether everything was looked at. Otherwise `holds` is false, and the counts are lower bounds: there are corners that are
    /// not finite, or boundaries so entangled that looking at all pairs of edges would take minutes.
    pub complete: bool,
    /// Faces.
    pub faces: usize,
    /// Pieces that are connected in the plane.
    pub islands: usize,
    /// Closed curves that bound them.
    pub boundary_loops: usize,
    /// Quads that are not convex, but held to two corners only because no map can make them convex. Indices from 0.
    pub exempt_faces: Vec<u32>,
    /// How many violations there are of each kind; kinds without any are left out.
    pub counts: BTreeMap<ViolationKind, usize>,
    /// The violations by kind, then place; of each kind as many as were asked for.
    pub violations: Vec<Violation>,
}

impl Certificate {
    /// How many violations there are, of all kinds.
    #[must_use]
    pub fn violation_count(&self) -> usize {
        self.counts.values().sum()
    }
}

/// `holds`, or how many violations of which kind there are.
impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.holds {
            return f.write_str("holds");
        }
        if self.counts.is_empty() {
            return f.write_str("not decided: the boundary is too entangled");
        }
        let counts: Vec<String> =
            self.counts.iter().map(|(&kind, &count)| violation::counted(kind, count)).collect();
        write!(f, "fails: {}", counts.join(", "))?;
        if self.complete { Ok(()) } else { f.write_str(" (not everything was looked at)") }
    }
}

/// Decides whether a map is injective; see the [module](self) for what is verified. At most `limit` violations of each kind are
/// listed; all are counted. The answer is the same for any number of threads.
///
/// Positions in space are not read. UVs that are not finite are violations.
///
/// ```
/// use qoptimize::{certify, qmesh::{Vec2, shapes}};
///
/// let mesh = shapes::grid(4, 3);
/// let mut uv: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
/// assert!(certify(mesh.view(), &uv, 10)?.holds);
/// uv[0] = Vec2::new(100.0, 100.0); // the first face turns over
/// assert!(!certify(mesh.view(), &uv, 10)?.holds);
/// # Ok::<(), qoptimize::MeasureError>(())
/// ```
///
/// # Errors
/// Arrays that contradict each other, or no faces: see [`MeasureError`].
pub fn certify(
    polygons: PolygonView<'_>,
    corner_uv: &[Vec2],
    limit: usize,
) -> Result<Certificate, MeasureError> {
    crate::distortion::check_arrays(polygons, corner_uv)?;
    Ok(certify_islands(polygons, corner_uv, &Islands::find(polygons, corner_uv), limit))
}

/// Both [`measure`](crate::measure) and [`certify`], which together cost less than one after the other.
///
/// # Errors
/// As [`measure`](crate::measure).
pub fn judge(
    polygons: PolygonView<'_>,
    corner_uv: &[Vec2],
    limit: usize,
) -> Result<(Distortion, Certificate), MeasureError> {
    check(polygons, corner_uv)?;
    let islands = Islands::find(polygons, corner_uv);
    // One after the other: each works in parallel by itself, and together they would need the memory of both.
    let distortion = measure_islands(polygons, corner_uv, &islands)?;
    Ok((distortion, certify_islands(polygons, corner_uv, &islands, limit)))
}

fn certify_islands(
    polygons: PolygonView<'_>,
    corner_uv: &[Vec2],
    islands: &Islands,
    limit: usize,
) -> Certificate {
    let is_finite = crate::distortion::first(corner_uv, |p| !p.iter().all(|x| x.is_finite())).is_none();
    let map = Map { polygons, uv: corner_uv, islands, all_finite: is_finite };
    let mut found = Findings { limit, ..Findings::default() };
    let verdicts = faces::judge(&map);
    let mirrored = mirrored_islands(&map, &verdicts);
    judge_faces(&map, &verdicts, &mirrored, &mut found);
    judge_edges(&map, &mut found);
    let (mut complete, mut boundary_loops) = (is_finite, 0);
    if is_finite {
        let loops = loops::Loops::find(&map);
        boundary_loops = loops.count();
        complete = loops::judge(&map, &loops, &mirrored, &mut found);
    }
    found.violations.sort_by_cached_key(|violation| (violation.kind, place_key(violation)));
    let exempt = verdicts.iter().enumerate().filter(|(_, verdict)| verdict.exempt);
    Certificate {
        holds: complete && found.counts.is_empty(),
        complete,
        faces: polygons.face_count(),
        islands: map.islands.count,
        boundary_loops,
        exempt_faces: exempt.map(|(face, _)| face as u32).collect(),
        counts: found.counts,
        violations: found.violations,
    }
}

fn place_key(violation: &Violation) -> Vec<usize> {
    violation.places.iter().map(|place| place.corner).collect()
}

/// The map and how it hangs together.
struct Map<'a> {
    polygons: PolygonView<'a>,
    uv: &'a [Vec2],
    islands: &'a Islands,
    all_finite: bool,
}

impl Map<'_> {
    fn previous(&self, corner: usize) -> usize {
        let range = self.polygons.corners(self.islands.face_of[corner] as usize);
        if corner == range.start { range.end - 1 } else { corner - 1 }
    }

    fn next(&self, corner: usize) -> usize {
        self.islands.next[corner] as usize
    }

    /// Which way the face turns at a corner.
    fn turn(&self, corner: usize) -> i32 {
        orientation(self.uv[corner], self.uv[self.next(corner)], self.uv[self.previous(corner)])
    }

    fn point(&self, corner: usize) -> u32 {
        self.islands.point[corner]
    }

    fn is_finite(&self, corner: usize) -> bool {
        self.all_finite || self.uv[corner].iter().all(|x| x.is_finite())
    }

    /// The first corner of a face; of one without corners, its number is all there is.
    fn face_place(&self, face: usize) -> Place {
        let corner = self.polygons.corners(face).start;
        if !self.polygons.corners(face).is_empty() {
            return self.corner_place(corner);
        }
        Place { face, corner, vertex: u32::MAX, uv: [0.0; 2], to_vertex: None, to_uv: None }
    }

    fn corner_place(&self, corner: usize) -> Place {
        Place {
            face: self.islands.face_of[corner] as usize,
            corner,
            vertex: self.polygons.corner_vertex[corner],
            uv: self.uv[corner].into(),
            to_vertex: None,
            to_uv: None,
        }
    }

    fn edge_place(&self, corner: usize) -> Place {
        let next = self.next(corner);
        Place {
            to_vertex: Some(self.polygons.corner_vertex[next]),
            to_uv: Some(self.uv[next].into()),
            ..self.corner_place(corner)
        }
    }
}

/// What was found so far.
#[derive(Default)]
struct Findings {
    limit: usize,
    counts: BTreeMap<ViolationKind, usize>,
    violations: Vec<Violation>,
}

impl Findings {
    /// Counts one more of a kind; it is listed while there is room.
    fn add(
        &mut self,
        kind: ViolationKind,
        times: usize,
        islands: &[u32],
        places: impl FnOnce() -> Vec<Place>,
    ) {
        let count = self.counts.entry(kind).or_default();
        *count += 1;
        if *count <= self.limit {
            self.violations.push(Violation { kind, places: places(), islands: islands.to_vec(), times });
        }
    }
}

/// Whether every face of an island would be a positive cell in the mirror.
fn mirrored_islands(map: &Map<'_>, verdicts: &[faces::Verdict]) -> Vec<bool> {
    let mut mirrored = vec![true; map.islands.count];
    for (&island, verdict) in map.islands.of_face.iter().zip(verdicts) {
        mirrored[island as usize] &= verdict.mirrored;
    }
    mirrored
}

/// Condition 1.
fn judge_faces(map: &Map<'_>, verdicts: &[faces::Verdict], mirrored: &[bool], found: &mut Findings) {
    let mut first_face = vec![usize::MAX; map.islands.count];
    let mut faces = vec![0_usize; map.islands.count];
    for (face, verdict) in verdicts.iter().enumerate() {
        let island = map.islands.of_face[face] as usize;
        faces[island] += 1;
        first_face[island] = first_face[island].min(face);
        if verdict.plain || mirrored[island] {
            continue;
        }
        for (kind, corner) in faces::faults(map, face) {
            found.add(kind, 1, &[island as u32], || match kind {
                ViolationKind::TooFewCorners => vec![map.face_place(face)],
                _ => vec![map.corner_place(corner)],
            });
        }
    }
    for island in (0..map.islands.count).filter(|&island| mirrored[island]) {
        found.add(ViolationKind::MirroredIsland, faces[island], &[island as u32], || {
            vec![map.face_place(first_face[island])]
        });
    }
}

/// Condition 2.
fn judge_edges(map: &Map<'_>, found: &mut Findings) {
    for &(corner, times) in &map.islands.nonmanifold {
        let island = map.islands.island(corner);
        found.add(ViolationKind::NonmanifoldEdge, times as usize, &[island], || {
            vec![map.edge_place(corner as usize)]
        });
    }
}
