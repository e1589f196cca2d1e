//! Which faces came out worst, and what forced them.

use std::collections::HashSet;

use qembed::qcurv::corner_angle;
use qembed::qmesh::{CornerData, FaceId, Id, QuadMesh, Vec2, Vec3, VertexId};

use crate::direct::rest::{concave_corners, corner_normals};
use crate::distortion::{FaceMeasure, FaceMeasures, MeasureError, measure_worst_faces};

/// How far around a face its causes are looked for, in edges.
const REACH: usize = 2;
/// Curvature within reach that is worth naming, in radians.
const CURVATURE: f64 = 0.1;
/// Quads bent along a diagonal by more than this many degrees are not planar.
const BEND: f64 = 10.0;
/// Faces with an edge shorter than this fraction of their longest, or as thin, are degenerate.
const THIN: f64 = 0.01;

/// A face with its errors, as [`measure_faces`](crate::measure_faces) defines them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct WorstFace {
    /// Which.
    pub face: FaceId,
    /// Its centre in space.
    pub place: Vec3,
    /// Its symmetric Dirichlet energy, 1 for an isometry; `None` when a corner is flipped.
    pub symmetric_dirichlet: Option<f64>,
    /// How far its angles are off, on average, in degrees.
    pub angle_degrees: f64,
    /// Its area in the plane over that in space, both totals made equal.
    pub area_ratio: f64,
    /// What forces it, the plainest first. Never empty.
    pub causes: Vec<Cause>,
}

/// What forces the errors of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Cause {
    /// No map can make it convex: it shares its opposite vertices with another face.
    Exempt,
    /// It has no area, an edge of nearly no length, or is a needle.
    Degenerate,
    /// A corner is concave in space.
    Concave,
    /// It is bent along a diagonal.
    NotPlanar {
        /// By how much, in degrees.
        degrees: f64,
    },
    /// A vertex nearby is pinned.
    Pin {
        /// The vertex.
        vertex: VertexId,
    },
    /// It touches a boundary that is held, or kept clear of itself.
    Boundary,
    /// The surface is curved here.
    Curvature {
        /// The sum of |K̄| (Eq. 1) over the inner vertices within two edges, in radians.
        radians: f64,
        /// Where most of it is.
        vertex: VertexId,
    },
    /// The descent ended before it had converged.
    NotConverged,
    /// Nothing of the above: the curvature that the region encloses or the shape around it.
    Surroundings,
}

/// What is known about how the map came about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Circumstances<'a> {
    /// Quads that no map can make convex.
    pub exempt: &'a [FaceId],
    /// Pinned vertices.
    pub pinned: &'a [VertexId],
    /// Whether the boundary was not wholly free.
    pub held_boundary: bool,
    /// Whether a descent ended early.
    pub not_converged: bool,
}

/// The `count` faces with the largest symmetric Dirichlet energy, flipped ones before all; ties (to seven digits) go to the
/// lower index.
///
/// # Errors
/// As [`measure`](crate::measure).
pub fn worst_faces(
    mesh: &QuadMesh,
    uv: &CornerData<Vec2>,
    circumstances: &Circumstances<'_>,
    count: usize,
) -> Result<Vec<WorstFace>, MeasureError> {
    let worst = measure_worst_faces(mesh.view(), uv, count)?;
    let explain = |(index, measure): (usize, FaceMeasure)| {
        WorstFace::new(mesh, FaceId::from_index(index), &measure, circumstances)
    };
    Ok(worst.into_iter().map(explain).collect())
}

impl WorstFace {
    /// A face of `mesh` with its errors and what forces them; for charts, whose faces are measured together.
    #[must_use]
    pub fn new(
        mesh: &QuadMesh,
        face: FaceId,
        measure: &FaceMeasure,
        circumstances: &Circumstances<'_>,
    ) -> Self {
        Self {
            face,
            place: center(mesh, face),
            symmetric_dirichlet: Some(measure.symmetric_dirichlet).filter(|energy| energy.is_finite()),
            angle_degrees: measure.angle_degrees,
            area_ratio: measure.area_ratio,
            causes: causes(mesh, face, circumstances),
        }
    }
}

/// The order in which [`worst_faces`] names faces, for polygons of any kind.
#[must_use]
pub fn rank_faces(measures: &FaceMeasures, count: usize) -> Vec<usize> {
    // Rounding must not decide between faces that are alike.
    let rank = |face: usize| measures.symmetric_dirichlet[face] as f32;
    let worse = |a: &usize, b: &usize| rank(*b).total_cmp(&rank(*a)).then(a.cmp(b));
    let mut order: Vec<usize> = (0..measures.symmetric_dirichlet.len()).collect();
    if count < order.len() {
        order.select_nth_unstable_by(count, worse);
        order.truncate(count);
    }
    order.sort_unstable_by(worse);
    order
}

/// The centre of a face in space.
fn center(mesh: &QuadMesh, face: FaceId) -> Vec3 {
    mesh.face_vertices(face).map(|vertex| mesh.position(vertex) / mesh.degree(face) as f64).sum()
}

/// What forces the errors of `face`, the plainest first. Never empty.
fn causes(mesh: &QuadMesh, face: FaceId, circumstances: &Circumstances<'_>) -> Vec<Cause> {
    let mut causes = Vec::new();
    if circumstances.exempt.contains(&face) {
        causes.push(Cause::Exempt);
    }
    let is_degenerate = is_degenerate(mesh, face);
    if is_degenerate {
        causes.push(Cause::Degenerate);
    } else if mesh.degree(face) == 4 {
        if concave_corners(mesh, face).contains(&true) {
            causes.push(Cause::Concave);
        }
        let degrees = bend(mesh, face);
        if degrees > BEND {
            causes.push(Cause::NotPlanar { degrees });
        }
    }
    let near = within_reach(mesh, face);
    causes
        .extend(near.iter().find(|v| circumstances.pinned.contains(v)).map(|&vertex| Cause::Pin { vertex }));
    if circumstances.held_boundary && mesh.face_vertices(face).any(|vertex| mesh.is_boundary(vertex)) {
        causes.push(Cause::Boundary);
    }
    let inner = near.iter().filter(|&&vertex| !mesh.is_boundary(vertex));
    let (mut radians, mut most) = (0.0, None);
    for &vertex in inner {
        let angles: f64 = mesh.vertex_corners(vertex).map(|corner| corner_angle(mesh, corner)).sum();
        let here = (std::f64::consts::TAU - angles).abs();
        radians += here;
        if most.is_none_or(|(largest, _)| here > largest) {
            most = Some((here, vertex));
        }
    }
    if let Some((_, vertex)) = most
        && radians > CURVATURE
    {
        causes.push(Cause::Curvature { radians, vertex });
    }
    if circumstances.not_converged {
        causes.push(Cause::NotConverged);
    }
    if causes.is_empty() {
        causes.push(Cause::Surroundings);
    }
    causes
}

fn is_degenerate(mesh: &QuadMesh, face: FaceId) -> bool {
    let lengths = mesh.face_corners(face).map(|corner| mesh.corner_vectors(corner)[0].norm());
    let longest = lengths.clone().fold(0.0, f64::max);
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    shortest <= THIN * longest || crate::qcurv::face_area(mesh, face) <= THIN * longest * longest
}

/// The larger of the angles by which a quad is bent along its diagonals, in degrees.
fn bend(mesh: &QuadMesh, face: FaceId) -> f64 {
    let normals = corner_normals(mesh, face);
    let between = |a: &Vec3, b: &Vec3| a.cross(b).norm().atan2(a.dot(b)).to_degrees();
    between(&normals[0], &normals[2]).max(between(&normals[1], &normals[3]))
}

/// The vertices of a face and those within [`REACH`] edges, near ones first.
fn within_reach(mesh: &QuadMesh, face: FaceId) -> Vec<VertexId> {
    let mut found: Vec<VertexId> = mesh.face_vertices(face).collect();
    let mut known: HashSet<VertexId> = found.iter().copied().collect();
    let mut from = 0;
    for _ in 0..REACH {
        let to = found.len();
        for k in from..to {
            for neighbor in mesh.neighbors(found[k]) {
                if known.insert(neighbor) {
                    found.push(neighbor);
                }
            }
        }
        from = to;
    }
    found
}
