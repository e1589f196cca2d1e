//! A first map that is injective: Tutte's embedding, made to survive long limbs.
//!
//! With positive weights on a strictly convex boundary Tutte's embedding has no flipped corner, exempt quads aside
//! ([`Exempt`]), but floating point loses it where limbs shrink: around a tube of m edges the radius falls per ring by a
//! factor of up to 3.7. So three ways are tried, each judged by exact predicates:
//!
//! 1. weights from the star's angles, `cot(α/4)`;
//! 2. *torsion weights*: ρ solves `L ρ = 1` with ρ = 0 on the boundary, so it is about constant around a limb and falls along it;
//!    edges around are weakened against edges along until the radius falls by less than four over the whole limb, however long;
//! 3. the untangler of [Garanzha et al. 2021, "Foldover-free maps in 50 lines of code"], from the collapsed map.
//!
//! A map that crowds much surface into little room is spread then ([`super::even`]).

use qmesh::observe::Observer;
use qmesh::{EdgeData, QuadMesh, Vec2, Vec3, VertexData};
use rayon::prelude::*;
use robust::{Coord, orient2d};

use super::StartError;
use super::even::{MAX_ROUNDS, evened};
use super::rest::{Rest, RestCorner};
use super::untangle::untangle;
use crate::convexity::Exempt;
use crate::qmesh;
use crate::qsolve::{DMatrix, SolveOptions, Structure, Triplets, solve};

/// A start whose smallest corner is below this fraction of the mean corner is tried to be bettered.
const THIN: f64 = 1e-8;
/// Corners that one task takes.
const CHUNK: usize = 4096;
/// Exponents of the torsion weights: 2 is best on shallow shapes, 4 on nested ones.
const EXPONENTS: [i32; 2] = [2, 4];

/// How the start was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum StartMethod {
    /// Tutte's embedding with the star's weights.
    Tutte,
    /// Tutte's embedding with torsion weights.
    Torsion,
    /// The untangler had to help.
    Untangled,
    /// A map of a coarser mesh was carried up.
    CoarseToFine,
}

/// A valid first map on the unit circle.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Start {
    /// Where each vertex goes.
    pub uv: VertexData<Vec2>,
    /// How it was found.
    pub method: StartMethod,
    /// The smallest corner area over the mean corner area.
    pub smallest_corner: f64,
}

/// Where a first map comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    pub(super) method: StartMethod,
    pub(super) smallest_corner: f64,
}

impl Start {
    pub(super) fn origin(&self) -> Origin {
        Origin { method: self.method, smallest_corner: self.smallest_corner }
    }

    /// The map of the first vertices alone.
    pub(super) fn truncated(self, vertex_count: usize) -> Self {
        let mut uv = self.uv.into_vec();
        uv.truncate(vertex_count);
        Self { uv: VertexData::from_vec(uv), ..self }
    }
}

/// Finds a map of the disk `mesh` to the unit circle in which every corner (but for exempt ones) turns left.
///
/// The observer hears of `"start"` before each further system that is to be solved, and of `"untangle"`; when it asks to stop, the best
/// map so far is the result.
///
/// # Errors
/// [`StartError::Tangled`] with the place, when none of the three ways leads to one; [`StartError::Cancelled`] by the observer before
/// there was one.
pub fn find_start(mesh: &QuadMesh, exempt: &Exempt, observer: &dyn Observer) -> Result<Start, StartError> {
    find_start_on(mesh, exempt, &circle(mesh)?, observer)
}

/// The same where `mesh` may have holes, which are filled for this time only.
pub(super) fn find_start_with_holes(
    mesh: &QuadMesh,
    exempt: &Exempt,
    observer: &dyn Observer,
) -> Result<Start, StartError> {
    let Some(filled) = mesh.filled() else {
        return find_start(mesh, exempt, observer);
    };
    let start = find_start(&filled, &Exempt::find(&filled), observer);
    let start = start.map_err(|error| error.outside_of_fillings(mesh, &filled))?;
    Ok(start.truncated(mesh.vertex_count()))
}

/// The same with the boundary elsewhere. On a boundary that is not strictly convex, there need not be such a map.
pub(super) fn find_start_on(
    mesh: &QuadMesh,
    exempt: &Exempt,
    boundary: &[(qmesh::VertexId, Vec2)],
    observer: &dyn Observer,
) -> Result<Start, StartError> {
    let rest = Rest::new(mesh, exempt);
    let mut search = Search { mesh, boundary, rest: &rest, observer, solved: 0, is_stopped: false };
    let mut best = search.by_weights()?;
    if let Some(found) = best.take_if(|best| best.start.smallest_corner > least_of_its_own(exempt)) {
        return Ok(search.evened(found));
    }
    match (search.untangled(), best.map(|best| best.start)) {
        (Ok(start), Some(best)) if start.smallest_corner < best.smallest_corner => Ok(best),
        (Err(_), Some(best)) => Ok(best),
        (start, _) => start,
    }
}

/// A start, and the weights that it solves Tutte's system with.
struct Weighted {
    start: Start,
    weights: EdgeData<f64>,
}

/// Systems at most: Tutte's, that of the torsion, one for each exponent, those that even out.
const MOST_SOLVED: usize = 2 + EXPONENTS.len() + MAX_ROUNDS;

/// The way to a start. The observer is asked before each system but the first, without which there is nothing at all.
struct Search<'a> {
    mesh: &'a QuadMesh,
    boundary: &'a [(qmesh::VertexId, Vec2)],
    rest: &'a Rest,
    observer: &'a dyn Observer,
    /// Systems so far.
    solved: usize,
    is_stopped: bool,
}

impl Search<'_> {
    /// Whether there may be one more system.
    fn may_go_on(&mut self) -> bool {
        self.solved += 1;
        let fraction = self.solved as f64 / MOST_SOLVED as f64;
        self.is_stopped = self.is_stopped || self.observer.progress("start", fraction.min(1.0)).is_break();
        !self.is_stopped
    }

    /// The best valid map of Tutte's system with the star's weights and, where that is thin, with torsion weights.
    fn by_weights(&mut self) -> Result<Option<Weighted>, StartError> {
        let star = star_weights(self.mesh);
        let mut best = self.valid(tutte(self.mesh, self.boundary, &star)?, StartMethod::Tutte, &star);
        let is_thin =
            |best: &Option<Weighted>| best.as_ref().is_none_or(|best| best.start.smallest_corner <= THIN);
        if !is_thin(&best) || !self.may_go_on() {
            return Ok(best);
        }
        let torsion = Torsion::new(self.mesh)?;
        for exponent in EXPONENTS {
            if !is_thin(&best) || !self.may_go_on() {
                break;
            }
            let weights = torsion.weights(self.mesh, &star, exponent);
            let Ok(uv) = tutte(self.mesh, self.boundary, &weights) else { continue };
            let found = self.valid(uv, StartMethod::Torsion, &weights);
            let is_better = |found: &Weighted| {
                best.as_ref().is_none_or(|best| best.start.smallest_corner < found.start.smallest_corner)
            };
            if found.as_ref().is_some_and(is_better) {
                best = found;
            }
        }
        Ok(best)
    }

    fn valid(&self, uv: VertexData<Vec2>, method: StartMethod, weights: &EdgeData<f64>) -> Option<Weighted> {
        let smallest_corner = judge(self.rest, &uv).valid()?;
        Some(Weighted { start: Start { uv, method, smallest_corner }, weights: weights.clone() })
    }

    /// `found`, spread as far as there is time for.
    fn evened(&mut self, found: Weighted) -> Start {
        let (mesh, boundary, rest) = (self.mesh, self.boundary, self.rest);
        let Weighted { mut start, mut weights } = found;
        let valid = |weights: &EdgeData<f64>| {
            if !self.may_go_on() {
                return None;
            }
            let uv = tutte(mesh, boundary, weights).ok()?;
            judge(rest, &uv).valid().map(|_| uv.into_vec())
        };
        if let Some(uv) = evened(mesh, rest, &mut weights, &start.uv, valid) {
            start.uv = VertexData::from_vec(uv);
            start.smallest_corner = judge(rest, &start.uv).valid().unwrap_or(start.smallest_corner);
        }
        start
    }

    /// The untangler's map, from the collapsed one.
    fn untangled(&mut self) -> Result<Start, StartError> {
        if !self.may_go_on() {
            return Err(StartError::Cancelled);
        }
        let ones = self.mesh.edge_data(|_| 1.0);
        let mut uv = tutte(self.mesh, self.boundary, &ones)?;
        untangle(self.rest, self.mesh, &mut uv, self.observer)?;
        let verdict = judge(self.rest, &uv);
        match verdict.valid() {
            Some(smallest_corner) => Ok(Start { uv, method: StartMethod::Untangled, smallest_corner }),
            None => Err(StartError::Tangled { corner: verdict.worst, count: verdict.bad }),
        }
    }
}

/// Corners below this fraction of the mean one may be positive by luck: quads that share their opposite vertices collapse onto the
/// segment between those in Tutte's embedding, and rounding puts what lies between on either side.
fn least_of_its_own(exempt: &Exempt) -> f64 {
    const HAIR: f64 = 1e-15;
    const HAIR_OF_BUBBLES: f64 = 1e-12;
    if exempt.is_empty() { HAIR } else { HAIR_OF_BUBBLES }
}

/// How many corners do not turn left, by exact predicates.
pub(super) struct Verdict {
    pub(super) bad: usize,
    pub(super) worst: qmesh::CornerId,
    smallest: f64,
    mean: f64,
}

impl Verdict {
    /// The smallest corner over the mean one, when all turn left.
    pub(super) fn valid(&self) -> Option<f64> {
        (self.bad == 0).then(|| self.smallest / self.mean)
    }
}

pub(super) fn judge(rest: &Rest, uv: &[Vec2]) -> Verdict {
    // In chunks of fixed size, so that the mean does not depend on the number of threads.
    let chunks: Vec<Verdict> = rest
        .corners
        .par_chunks(CHUNK)
        .zip(rest.ids.par_chunks(CHUNK))
        .map(|(corners, ids)| judge_some(corners, ids, uv))
        .collect();
    let none = Verdict { bad: 0, worst: qmesh::CornerId(0), smallest: f64::INFINITY, mean: 0.0 };
    let all = chunks.into_iter().fold(none, |all, chunk| {
        let worst = if chunk.smallest.is_nan() || chunk.smallest < all.smallest { &chunk } else { &all };
        let (worst, smallest) = (worst.worst, worst.smallest);
        Verdict { bad: all.bad + chunk.bad, worst, smallest, mean: all.mean + chunk.mean }
    });
    Verdict { mean: all.mean / rest.corners.len() as f64, ..all }
}

/// The same for some of the corners, with the sum in place of the mean.
fn judge_some(corners: &[RestCorner], ids: &[qmesh::CornerId], uv: &[Vec2]) -> Verdict {
    let mut verdict = Verdict { bad: 0, worst: qmesh::CornerId(0), smallest: f64::INFINITY, mean: 0.0 };
    for (corner, &id) in corners.iter().zip(ids) {
        let [here, next, previous] = corner.vertices.map(|v| uv[v as usize]);
        let turn = orient2d(coord(here), coord(next), coord(previous));
        // The descent computes in floating point: what only exact arithmetic can tell from a flip is of no use to it.
        let [f1x, f1y, f0x, f0y] = super::energy::edges(corner, uv);
        if !(turn > 0.0 && f1x * f0y - f1y * f0x > 0.0) {
            verdict.bad += 1;
        }
        if turn.is_nan() || turn < verdict.smallest {
            (verdict.smallest, verdict.worst) = (turn, id);
        }
        verdict.mean += turn.abs();
    }
    verdict
}

fn coord(p: Vec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// The boundary on the unit circle, counter-clockwise: half by arc length, half evenly, so that no two vertices meet.
fn circle(mesh: &QuadMesh) -> Result<Vec<(qmesh::VertexId, Vec2)>, StartError> {
    let loops = mesh.boundary_loops();
    let [outline] = &loops[..] else {
        return Err(StartError::NotADisk(mesh.topology()));
    };
    let vertices = mesh.loop_vertices(outline);
    let lengths: Vec<f64> = (0..vertices.len())
        .map(|i| (mesh.position(vertices[(i + 1) % vertices.len()]) - mesh.position(vertices[i])).norm())
        .collect();
    let total: f64 = lengths.iter().sum();
    let mut at = 0.0;
    Ok(vertices
        .iter()
        .zip(&lengths)
        .map(|(&vertex, length)| {
            let (sin, cos) = (std::f64::consts::TAU * at).sin_cos();
            let arc = if total > 0.0 { length / total } else { 0.0 };
            at += 0.5 * arc + 0.5 / vertices.len() as f64;
            (vertex, Vec2::new(cos, sin))
        })
        .collect())
}

/// Per edge: `Σ cot(α/4)` over the angles α that see it in the corner triangles of its two ends.
fn star_weights(mesh: &QuadMesh) -> EdgeData<f64> {
    const LEAST_ANGLE: f64 = 1e-2;
    let mut weights = mesh.edge_data(|_| 0.0);
    let quarter = |at: Vec3, a: Vec3, b: Vec3| {
        let (u, v) = (a - at, b - at);
        1.0 / (u.cross(&v).norm().atan2(u.dot(&v)).max(LEAST_ANGLE) / 4.0).tan()
    };
    for corner in mesh.corners() {
        let [here, next, previous] = [corner, mesh.next_corner(corner), mesh.previous_corner(corner)]
            .map(|c| mesh.position(mesh.vertex(c)));
        weights[mesh.edge(corner.halfedge())] += quarter(previous, here, next);
        weights[mesh.edge(mesh.previous_corner(corner).halfedge())] += quarter(next, here, previous);
    }
    weights
}

/// Tutte's embedding: every interior vertex is the weighted mean of its neighbours.
fn tutte(
    mesh: &QuadMesh,
    boundary: &[(qmesh::VertexId, Vec2)],
    weights: &EdgeData<f64>,
) -> Result<VertexData<Vec2>, StartError> {
    let mut uv = mesh.vertex_data(|_| Vec2::zeros());
    for &(vertex, position) in boundary {
        uv[vertex] = position;
    }
    let interior = Interior::new(mesh);
    if interior.count == 0 {
        return Ok(uv);
    }
    let mut rhs = DMatrix::zeros(interior.count, 2);
    let matrix = interior.laplacian(mesh, weights, |row, weight, fixed| {
        rhs[(row, 0)] += weight * uv[fixed].x;
        rhs[(row, 1)] += weight * uv[fixed].y;
    })?;
    let (x, _) = solve(&matrix, Structure::SymmetricPositiveDefinite, &rhs, &SolveOptions::default())?;
    for vertex in mesh.vertices() {
        if let Some(row) = interior.row(vertex) {
            uv[vertex] = Vec2::new(x[(row, 0)], x[(row, 1)]);
        }
    }
    Ok(uv)
}

/// The interior vertices, numbered.
struct Interior {
    rows: Vec<u32>,
    count: usize,
}

impl Interior {
    fn new(mesh: &QuadMesh) -> Self {
        let mut count = 0;
        let rows = mesh
            .vertices()
            .map(|vertex| {
                if mesh.is_boundary(vertex) {
                    return u32::MAX;
                }
                count += 1;
                count - 1
            })
            .collect();
        Self { rows, count: count as usize }
    }

    fn row(&self, vertex: qmesh::VertexId) -> Option<usize> {
        let row = self.rows[vertex.index()];
        (row != u32::MAX).then_some(row as usize)
    }

    /// The weighted Laplacian of the interior; `to_boundary(row, weight, vertex)` hears of edges that leave it.
    fn laplacian(
        &self,
        mesh: &QuadMesh,
        weights: &EdgeData<f64>,
        mut to_boundary: impl FnMut(usize, f64, qmesh::VertexId),
    ) -> Result<crate::qsolve::CsrMatrix<f64>, StartError> {
        let mut triplets = Triplets::with_capacity(self.count, self.count, 4 * mesh.edge_count());
        for (edge, &weight) in weights.entries() {
            let [a, b] = mesh.edge_vertices(edge);
            for (from, to) in [(a, b), (b, a)] {
                let Some(row) = self.row(from) else { continue };
                triplets.add(row, row, weight);
                match self.row(to) {
                    Some(column) => triplets.add(row, column, -weight),
                    None => to_boundary(row, weight, to),
                }
            }
        }
        Ok(triplets.build()?)
    }
}

/// What the torsion weights are made of.
struct Torsion {
    /// Per edge, `|ρi − ρj|` over the largest such difference at either end.
    slope: EdgeData<f64>,
    /// The largest graph distance from the boundary.
    depth: f64,
}

impl Torsion {
    fn new(mesh: &QuadMesh) -> Result<Self, StartError> {
        let interior = Interior::new(mesh);
        let ones = mesh.edge_data(|_| 1.0);
        let matrix = interior.laplacian(mesh, &ones, |_, _, _| {})?;
        let rhs = DMatrix::from_element(interior.count, 1, 1.0);
        let (x, _) = solve(&matrix, Structure::SymmetricPositiveDefinite, &rhs, &SolveOptions::default())?;
        let rho = mesh.vertex_data(|vertex| interior.row(vertex).map_or(0.0, |row| x[(row, 0)]));
        let difference = mesh.edge_data(|edge| {
            let [a, b] = mesh.edge_vertices(edge);
            (rho[a] - rho[b]).abs()
        });
        let mut steepest = mesh.vertex_data(|_| 0.0f64);
        for (edge, &value) in difference.entries() {
            for vertex in mesh.edge_vertices(edge) {
                steepest[vertex] = steepest[vertex].max(value);
            }
        }
        let slope = mesh.edge_data(|edge| {
            let [a, b] = mesh.edge_vertices(edge);
            let largest = steepest[a].max(steepest[b]);
            if largest > 0.0 { difference[edge] / largest } else { 1.0 }
        });
        Ok(Self { slope, depth: depth(mesh) })
    }

    fn weights(&self, mesh: &QuadMesh, star: &EdgeData<f64>, exponent: i32) -> EdgeData<f64> {
        let least = (self.depth * self.depth).recip();
        mesh.edge_data(|edge| (self.slope[edge].powi(exponent) + least) * star[edge])
    }
}

/// The largest number of edges between a vertex and the boundary; at least 1.
fn depth(mesh: &QuadMesh) -> f64 {
    let mut seen = mesh.vertex_data(|vertex| mesh.is_boundary(vertex));
    let mut front: Vec<_> = mesh.vertices().filter(|&vertex| seen[vertex]).collect();
    let mut depth = 0;
    while !front.is_empty() {
        let mut next = Vec::new();
        for vertex in front {
            for neighbor in mesh.neighbors(vertex) {
                if !std::mem::replace(&mut seen[neighbor], true) {
                    next.push(neighbor);
                }
            }
        }
        front = next;
        depth += 1;
    }
    f64::from(depth.max(1))
}
