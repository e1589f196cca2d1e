//! Mirror symmetries of a patch.
//!
//! A mirror maps the outer boundary to itself, backwards. So it is known as soon as one boundary edge is: from there it spreads over
//! the connectivity, in linear time. The places of the boundary are asked first, since most of the candidates fail there.

use qembed::qmesh::nalgebra::Matrix3;
use qembed::qmesh::{HalfedgeId, Id, QuadMesh, Vec3, VertexData, VertexId};

/// How far partners may lie from each other's mirror image, in root mean square, over the diameter of the surface.
pub const TOLERANCE: f64 = 0.01;
/// The same for single vertices: modelled heads with a mirrored connectivity are off by some percent where they were sculpted further.
pub const LARGEST: f64 = 0.1;
/// Mirrors that fit within this of each other count as equally good.
const TIE: f64 = 1e-6;
/// Candidates whose connectivity is looked at, at most: a disk around a pole has as many mirrors as boundary vertices.
const MOST_CANDIDATES: usize = 128;

/// A mirror symmetry: of the connectivity exactly, of the shape nearly.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mirror {
    /// The partner of each vertex; a vertex on the axis is its own.
    pub partner: VertexData<VertexId>,
    /// The normal of the mirror plane; of its two directions the one whose largest component is positive.
    pub normal: Vec3,
    /// A point of the plane.
    pub point: Vec3,
    /// How far a vertex lies from the mirror image of its partner, at most, over the diameter of the surface.
    pub deviation: f64,
    /// The same in root mean square.
    pub mean_deviation: f64,
}

/// Why there is no mirror symmetry.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SymmetryError {
    /// No mirror maps faces to faces.
    #[error("no mirror maps faces to faces: the one that fits the boundary best would have to swap {} and {}", vertices[0], vertices[1])]
    Connectivity {
        /// Two vertices that it would have to swap, though the faces around them differ.
        vertices: [VertexId; 2],
    },
    /// The mirror that fits best does not fit well enough.
    #[error(
        "the nearest mirror symmetry misses {vertex} by {deviation} of the size of the surface, all by {mean_deviation}; {LARGEST} and {TOLERANCE} are allowed"
    )]
    Shape {
        /// The vertex that is farthest from the mirror image of its partner.
        vertex: VertexId,
        /// How far, over the diameter of the surface.
        deviation: f64,
        /// Over all vertices, in root mean square.
        mean_deviation: f64,
    },
    /// The mesh has no boundary to begin with.
    #[error("the mesh has no boundary")]
    Closed,
}

impl Mirror {
    /// Finds the mirror symmetry that fits the shape best. Of equally good ones, that whose normal is nearest to the x axis, then to the
    /// y axis, then to the z axis.
    ///
    /// # Errors
    /// See [`SymmetryError`]. The mesh has to be connected.
    pub fn find(mesh: &QuadMesh) -> Result<Self, SymmetryError> {
        let mut loops = mesh.boundary_loops();
        mesh.outer_first(&mut loops);
        let rim = loops.first().ok_or(SymmetryError::Closed)?;
        let size = Size::of(mesh);
        let candidates = candidates(mesh, rim, &size)?;
        let mut best: Option<Self> = None;
        let mut nearest: Option<(VertexId, Self)> = None;
        let mut conflict = None;
        for &k in &candidates {
            let partner = match spread(mesh, rim[0], rim[k]) {
                Ok(partner) => partner,
                Err(vertices) => {
                    conflict = conflict.or(Some(vertices));
                    continue;
                }
            };
            let (mirror, worst) = Self::through(mesh, partner, &size);
            let fits = mirror.mean_deviation <= TOLERANCE && mirror.deviation <= LARGEST;
            if fits && best.as_ref().is_none_or(|best| mirror.is_better(best)) {
                best = Some(mirror);
            } else if nearest.as_ref().is_none_or(|near| mirror.mean_deviation < near.1.mean_deviation) {
                nearest = Some((worst, mirror));
            }
        }
        best.ok_or(match nearest {
            Some((vertex, Self { deviation, mean_deviation, .. })) => {
                SymmetryError::Shape { vertex, deviation, mean_deviation }
            }
            None => SymmetryError::Connectivity { vertices: conflict.unwrap_or([VertexId(0); 2]) },
        })
    }

    /// The plane that fits the partners best, and the vertex that it fits worst.
    fn through(mesh: &QuadMesh, partner: VertexData<VertexId>, size: &Size) -> (Self, VertexId) {
        let arm = |vertex: VertexId| (mesh.position(vertex) - size.center) / size.radius;
        let mut products = Matrix3::zeros();
        for (vertex, &other) in partner.entries() {
            products += arm(vertex) * arm(other).transpose();
        }
        // Σ |R p − p'|² with R = 1 − 2 n nᵀ is least where nᵀ (Σ p p'ᵀ) n is.
        let eigen = (0.5 * (products + products.transpose())).symmetric_eigen();
        let normal = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned();
        let normal = if normal[normal.iamax()] < 0.0 { -normal } else { normal };
        let off = |vertex: VertexId| {
            let p = arm(vertex);
            (p - 2.0 * normal * normal.dot(&p) - arm(partner[vertex])).norm() / 2.0
        };
        let (mut worst, mut squares) = ((VertexId(0), 0.0), 0.0);
        for vertex in mesh.vertices() {
            let here = off(vertex);
            squares += here * here;
            if here > worst.1 {
                worst = (vertex, here);
            }
        }
        let mean_deviation = (squares / mesh.vertex_count() as f64).sqrt();
        (Self { partner, normal, point: size.center, deviation: worst.1, mean_deviation }, worst.0)
    }

    fn is_better(&self, other: &Self) -> bool {
        if (self.mean_deviation - other.mean_deviation).abs() > TIE {
            return self.mean_deviation < other.mean_deviation;
        }
        let [mine, yours] = [self, other].map(|mirror| mirror.normal.map(f64::abs));
        let axis = (0..3).find(|&axis| (mine[axis] - yours[axis]).abs() > TIE);
        axis.is_some_and(|axis| mine[axis] > yours[axis])
    }

    /// How many vertices lie on the axis.
    #[must_use]
    pub fn axis_vertices(&self) -> usize {
        self.partner.entries().filter(|&(vertex, &other)| vertex == other).count()
    }

    /// The surface made exactly as symmetric as its connectivity: every vertex in the middle between itself and the mirror image of
    /// its partner.
    #[must_use]
    pub fn symmetrized(&self, mesh: &QuadMesh) -> QuadMesh {
        let image = |p: Vec3| p - 2.0 * self.normal * self.normal.dot(&(p - self.point));
        let middle =
            |vertex: VertexId| 0.5 * (mesh.position(vertex) + image(mesh.position(self.partner[vertex])));
        mesh.clone().with_positions(mesh.vertex_data(middle))
    }
}

/// Middle and extent of a surface.
struct Size {
    center: Vec3,
    /// The largest distance from the centre.
    radius: f64,
}

impl Size {
    fn of(mesh: &QuadMesh) -> Self {
        let count = mesh.vertex_count() as f64;
        let center = mesh.positions().iter().map(|p| p / count).sum::<Vec3>();
        let radius = mesh.positions().iter().map(|p| (p - center).norm()).fold(0.0, f64::max);
        Self { center, radius: if radius > 0.0 { radius } else { 1.0 } }
    }
}

/// The boundary edges to which the first may be mapped, judged by what a mirror keeps: distances from the centre and valences.
fn candidates(mesh: &QuadMesh, rim: &[HalfedgeId], size: &Size) -> Result<Vec<usize>, SymmetryError> {
    let count = rim.len();
    let vertices: Vec<VertexId> = rim.iter().map(|&h| mesh.origin(h)).collect();
    let distance: Vec<f64> =
        vertices.iter().map(|&v| (mesh.position(v) - size.center).norm() / (2.0 * size.radius)).collect();
    let valence: Vec<usize> = vertices.iter().map(|&v| mesh.valence(v)).collect();
    let mut fitting: Vec<(f64, usize)> = Vec::new();
    let mut nearest = (f64::INFINITY, SymmetryError::Closed);
    for k in 0..count {
        let mut worst = (0.0, vertices[0]);
        let mut conflict = None;
        for j in 0..count {
            let other = (k + 1 + count - j) % count;
            if valence[j] != valence[other] {
                conflict = conflict.or(Some([vertices[j], vertices[other]]));
            }
            let off = (distance[j] - distance[other]).abs();
            if off > worst.0 {
                worst = (off, vertices[j]);
            }
            if worst.0 > LARGEST.max(nearest.0) {
                break;
            }
        }
        let (deviation, vertex) = worst;
        match conflict {
            None if deviation <= LARGEST => fitting.push((deviation, k)),
            None if deviation < nearest.0 => {
                let mean_deviation = deviation / (mesh.vertex_count() as f64).sqrt();
                nearest = (deviation, SymmetryError::Shape { vertex, deviation, mean_deviation });
            }
            Some(vertices) if deviation < nearest.0 => {
                nearest = (deviation, SymmetryError::Connectivity { vertices });
            }
            _ => {}
        }
    }
    if fitting.is_empty() {
        return Err(nearest.1);
    }
    // Rounding must not decide which come first.
    fitting.sort_by_key(|&(off, k)| ((off / TIE) as u64, k));
    fitting.truncate(MOST_CANDIDATES);
    Ok(fitting.into_iter().map(|(_, k)| k).collect())
}

/// The partners of all vertices, when the boundary edge `from` goes to `to`, backwards; or two vertices that cannot be partners.
fn spread(mesh: &QuadMesh, from: HalfedgeId, to: HalfedgeId) -> Result<VertexData<VertexId>, [VertexId; 2]> {
    let count = mesh.halfedge_count();
    let halfedge = HalfedgeId::from_index;
    let mut previous = vec![from; count];
    for h in (0..count).map(halfedge) {
        previous[mesh.next(h).index()] = h;
    }
    let mut image: Vec<Option<HalfedgeId>> = vec![None; count];
    let mut stack = vec![(from, to)];
    while let Some((h, g)) = stack.pop() {
        match image[h.index()] {
            Some(known) if known == g => continue,
            None if mesh.is_boundary_halfedge(h) == mesh.is_boundary_halfedge(g) => {
                image[h.index()] = Some(g);
            }
            _ => return Err([mesh.origin(h), mesh.target(g)]),
        }
        stack.push((mesh.next(h), previous[g.index()]));
        stack.push((mesh.twin(h), mesh.twin(g)));
    }
    let mut partner = mesh.vertex_data(|vertex| vertex);
    for h in (0..count).map(halfedge) {
        // What is not reached belongs to another component, of which there is none.
        let Some(g) = image[h.index()] else { return Err([mesh.origin(h); 2]) };
        partner[mesh.origin(h)] = mesh.target(g);
    }
    match mesh.vertices().find(|&vertex| partner[partner[vertex]] != vertex) {
        None => Ok(partner),
        Some(vertex) => Err([vertex, partner[vertex]]),
    }
}
