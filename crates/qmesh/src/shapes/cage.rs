//! Coarse cages of quads: lattices with blocks replaced by rings of quads, refined smoothly to any resolution.

use super::lattice::built;
use crate::{CornerId, FaceId, Polygons, QuadMesh, Vec3};

/// Vertices and quads; vertices in no quad are left out of the mesh.
#[derive(Default)]
pub(crate) struct Cage {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) quads: Vec<[u32; 4]>,
}

impl Cage {
    /// Adds a vertex.
    pub(crate) fn vertex(&mut self, position: Vec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    /// Fills a rectangle of vertices (rows from the top, columns to the right, seen from outside) with quads.
    pub(crate) fn fill(&mut self, rows: &[Vec<u32>]) {
        for pair in rows.windows(2) {
            let [upper, lower] = [&pair[0], &pair[1]];
            for column in 1..upper.len() {
                self.quads.push([lower[column - 1], lower[column], upper[column], upper[column - 1]]);
            }
        }
    }

    /// Fills the rectangle between `rows` with one ring of quads around a smaller copy of it, whose vertex at
    /// column fraction `u` and row fraction `v`, both in `[−1, 1]` (`v` upwards), is put at `place([u, v])`.
    pub(crate) fn fill_with_inset(&mut self, rows: &[Vec<u32>], mut place: impl FnMut([f64; 2]) -> Vec3) {
        let [height, width] = [rows.len() - 1, rows[0].len() - 1];
        let fraction = |i: usize, count: usize| (2.0 * i as f64 - count as f64) / count as f64;
        let inner: Vec<Vec<u32>> = (0..=height)
            .map(|row| {
                (0..=width)
                    .map(|column| self.vertex(place([fraction(column, width), -fraction(row, height)])))
                    .collect()
            })
            .collect();
        let (outer_rim, inner_rim) = (rim(rows), rim(&inner));
        for here in 0..outer_rim.len() {
            let next = (here + 1) % outer_rim.len();
            self.quads.push([outer_rim[here], outer_rim[next], inner_rim[next], inner_rim[here]]);
        }
        self.fill(&inner);
    }

    /// The cage, smoothed and refined: every quad in `detail` × `detail`.
    ///
    /// Two steps of Catmull and Clark round the lines of the cage off; between their vertices the refinement is
    /// bilinear.
    pub(crate) fn refine(self, detail: usize) -> QuadMesh {
        let mut polygons = Polygons { positions: self.positions, ..Polygons::default() };
        self.quads.iter().for_each(|quad| polygons.push_face(quad));
        let cage = built(polygons);
        let twice = catmull_clark(&catmull_clark(&cage));
        Refinement { cage: &cage, twice: &twice, detail }.mesh()
    }
}

/// The vertices around a rectangle of them, counter-clockwise from the upper left.
fn rim(rows: &[Vec<u32>]) -> Vec<u32> {
    let (last_row, last_column) = (rows.len() - 1, rows[0].len() - 1);
    let down = (0..last_row).map(|row| rows[row][0]);
    let right = (0..last_column).map(|column| rows[last_row][column]);
    let up = (1..=last_row).rev().map(|row| rows[row][last_column]);
    let left = (1..=last_column).rev().map(|column| rows[0][column]);
    down.chain(right).chain(up).chain(left).collect()
}

/// One step of Catmull and Clark's subdivision (1978), with cubic B-splines as boundary and corners of one quad kept. Vertices: the old
/// ones, then one an edge, then one a face; face `c` is the quarter at corner `c`, and begins with its old vertex.
fn catmull_clark(mesh: &QuadMesh) -> QuadMesh {
    let middle = |face: FaceId| mesh.face_vertices(face).map(|v| mesh.position(v)).sum::<Vec3>() / 4.0;
    let ends = |edge| mesh.edge_vertices(edge).map(|v| mesh.position(v));
    let mut positions: Vec<Vec3> = mesh
        .vertices()
        .map(|vertex| {
            let here = mesh.position(vertex);
            let valence = mesh.valence(vertex) as f64;
            if mesh.is_boundary(vertex) {
                if valence < 3.0 {
                    return here;
                }
                let beside: Vec3 = mesh
                    .outgoing(vertex)
                    .filter(|&h| mesh.is_boundary_edge(mesh.edge(h)))
                    .map(|h| mesh.position(mesh.target(h)))
                    .sum();
                return here * 0.75 + beside * 0.125;
            }
            let faces: Vec3 = mesh.vertex_corners(vertex).map(|c| middle(mesh.face(c))).sum();
            let neighbors: Vec3 = mesh.neighbors(vertex).map(|v| mesh.position(v)).sum();
            (faces + neighbors) / (valence * valence) + here * ((valence - 2.0) / valence)
        })
        .collect();
    positions.extend(mesh.edges().map(|edge| {
        let [a, b] = ends(edge);
        if mesh.is_boundary_edge(edge) {
            return (a + b) / 2.0;
        }
        let halfedge = mesh.halfedge(edge);
        let sides = [halfedge, mesh.twin(halfedge)].map(|h| middle(mesh.face(CornerId(h.0))));
        (a + b + sides[0] + sides[1]) / 4.0
    }));
    positions.extend(mesh.faces().map(middle));
    let (edges, faces) = (mesh.vertex_count() as u32, (mesh.vertex_count() + mesh.edge_count()) as u32);
    let mut polygons = Polygons { positions, ..Polygons::default() };
    for corner in mesh.corners() {
        let after = mesh.edge(corner.halfedge()).0;
        let before = mesh.edge(mesh.previous_corner(corner).halfedge()).0;
        polygons.push_face(&[
            mesh.vertex(corner).0,
            edges + after,
            faces + mesh.face(corner).0,
            edges + before,
        ]);
    }
    built(polygons)
}

/// Splits every face of `cage` in `detail` × `detail`, its points taken from the same cage subdivided `twice`.
struct Refinement<'a> {
    cage: &'a QuadMesh,
    twice: &'a QuadMesh,
    detail: usize,
}

impl Refinement<'_> {
    fn mesh(&self) -> QuadMesh {
        let (cage, n) = (self.cage, self.detail);
        let mut polygons = Polygons::default();
        // Vertices of the cage, then of its edges, then of its faces, so that neighbours share them.
        polygons.positions.extend(cage.vertices().map(|v| self.twice.position(v)));
        for edge in cage.edges() {
            let corner = CornerId(cage.halfedge(edge).0);
            let face = cage.face(corner);
            let side = cage.face_corners(face).position(|c| c == corner).unwrap_or(0);
            polygons.positions.extend((1..n).map(|step| self.point(face, on_side(side, step, n))));
        }
        for face in cage.faces() {
            let inside = (1..n).flat_map(|j| (1..n).map(move |i| [i, j]));
            polygons.positions.extend(inside.map(|place| self.point(face, place)));
        }
        for face in cage.faces() {
            for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
                let quad = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
                polygons.push_face(&quad.map(|place| self.vertex(face, place)));
            }
        }
        built(polygons)
    }

    /// The vertex at column `i`, row `j` of a refined face.
    fn vertex(&self, face: FaceId, [i, j]: [usize; 2]) -> u32 {
        let (cage, n) = (self.cage, self.detail);
        let edges = cage.vertex_count();
        let faces = edges + cage.edge_count() * (n - 1);
        if (1..n).contains(&i) && (1..n).contains(&j) {
            return (faces + (face.index() * (n - 1) + j - 1) * (n - 1) + i - 1) as u32;
        }
        let (side, step) = match [i, j] {
            [step, 0] if step < n => (0, step),
            [_, step] if i == n && step < n => (1, step),
            [step, _] if j == n && step > 0 => (2, n - step),
            [_, step] => (3, n - step),
        };
        let corner = CornerId(4 * face.0 + side);
        if step == 0 {
            return cage.vertex(corner).0;
        }
        let edge = cage.edge(corner.halfedge());
        let step = if cage.halfedge(edge) == corner.halfedge() { step } else { n - step };
        (edges + edge.index() * (n - 1) + step - 1) as u32
    }

    /// Bilinear between the 5 × 5 points that the two subdivisions put on `face`.
    fn point(&self, face: FaceId, place: [usize; 2]) -> Vec3 {
        let n = self.detail;
        let cell = place.map(|i| (4 * i / n).min(3));
        let [s, t] = [0, 1].map(|k| (4 * place[k] - cell[k] * n) as f64 / n as f64);
        let at = |di: usize, dj: usize| self.subdivided(face, [cell[0] + di, cell[1] + dj]);
        at(0, 0).lerp(&at(1, 0), s).lerp(&at(0, 1).lerp(&at(1, 1), s), t)
    }

    /// The point at column `i`, row `j` of 4 on a face subdivided twice.
    fn subdivided(&self, face: FaceId, [i, j]: [usize; 2]) -> Vec3 {
        // The quarter of the face whose corner 0 is nearest, turned so that this corner is at [0, 0]; there [2, 2] is
        // the middle of the face. The same again inside the quarter.
        let (quarter, [i, j]) = nearest_corner([i, j], 4);
        let (sixteenth, [i, j]) = nearest_corner([i, j], 2);
        let small = FaceId(4 * (4 * face.0 + quarter) + sixteenth);
        let corner = match [i, j] {
            [0, 0] => 0,
            [1, 0] => 1,
            [1, 1] => 2,
            _ => 3,
        };
        self.twice.position(self.twice.vertex(CornerId(4 * small.0 + corner)))
    }
}

/// Column and row of the point `step` steps along a side of a face.
fn on_side(side: usize, step: usize, n: usize) -> [usize; 2] {
    match side {
        0 => [step, 0],
        1 => [n, step],
        2 => [n - step, n],
        _ => [0, n - step],
    }
}

/// The corner of an `n` × `n` square that is nearest to a point, and the point as seen from there.
fn nearest_corner([i, j]: [usize; 2], n: usize) -> (u32, [usize; 2]) {
    match (2 * i <= n, 2 * j <= n) {
        (true, true) => (0, [i, j]),
        (false, true) => (1, [j, n - i]),
        (false, false) => (2, [n - i, n - j]),
        (true, false) => (3, [n - j, i]),
    }
}
