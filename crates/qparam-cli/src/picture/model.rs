//! A surface made ready for pictures: near the unit of length, with normals, and cut into patches.
//!
//! A *patch* is a quad, shown as the bilinear surface through its corners, or a triangle. Quads are patches as they are;
//! only quads that are concave in space, whose bilinear surface would spill over their outline, and polygons with more
//! corners are cut into triangles. No patch is larger than the convex hull of its corners, and neighbours share straight
//! edges, so nothing gapes.

use qoptimize::qmesh::{PolygonView, Vec3};
use rayon::prelude::*;

use super::PictureError;

/// The fourth corner of a triangle.
pub(super) const NO_CORNER: u32 = u32::MAX;

/// Faces that meet at a sharper angle than this (cosine of 40°) have a crease between them.
const CREASE: f64 = 0.766;

/// A quad or a triangle in the order of its face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Patch {
    pub(super) face: u32,
    /// Corners of the file; the last is [`NO_CORNER`] for a triangle.
    pub(super) corners: [u32; 4],
}

impl Patch {
    pub(super) fn degree(&self) -> usize {
        if self.corners[3] == NO_CORNER { 3 } else { 4 }
    }

    /// What the corners have, mixed at `(s, t)`: bilinear for a quad, affine for a triangle.
    pub(super) fn shares(&self, s: f32, t: f32) -> [f32; 4] {
        if self.degree() == 3 {
            [1.0 - s - t, s, t, 0.0]
        } else {
            [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t]
        }
    }
}

/// A surface ready for pictures.
#[derive(Debug)]
pub struct Model<'a> {
    pub(super) polygons: PolygonView<'a>,
    /// Moved and scaled: the longest side of the bounding box is 1, its middle the origin.
    pub(super) positions: Vec<Vec3>,
    /// One a corner: smooth, but not across creases.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) patches: Vec<Patch>,
}

impl<'a> Model<'a> {
    /// Prepares any polygons; nothing is asked of their topology.
    ///
    /// # Errors
    /// [`PictureError::NoExtent`] when all vertices that faces use are in one place.
    pub fn new(polygons: PolygonView<'a>) -> Result<Self, PictureError> {
        Ok(Self::at(unit_positions(polygons)?, polygons))
    }

    /// Polygons of the plane, left in their place.
    pub(super) fn flat(polygons: PolygonView<'a>) -> Self {
        Self::at(polygons.positions.to_vec(), polygons)
    }

    fn at(positions: Vec<Vec3>, polygons: PolygonView<'a>) -> Self {
        let face_normals: Vec<Vec3> = (0..polygons.face_count())
            .into_par_iter()
            .map(|face| newell(polygons, &positions, face))
            .collect();
        let normals = corner_normals(polygons, &face_normals);
        let patches = (0..polygons.face_count())
            .flat_map(|face| cut(polygons, &positions, &face_normals[face], face))
            .collect();
        Self { polygons, positions, normals, patches }
    }

    pub(super) fn position(&self, corner: u32) -> Vec3 {
        self.positions[self.polygons.corner_vertex[corner as usize] as usize]
    }

    /// Positions of the vertices that faces use, for framing.
    pub(super) fn used_positions(&self) -> Vec<Vec3> {
        let mut used = vec![false; self.positions.len()];
        self.polygons.corner_vertex.iter().for_each(|&vertex| used[vertex as usize] = true);
        self.positions.iter().zip(used).filter(|(_, used)| *used).map(|(position, _)| *position).collect()
    }
}

fn unit_positions(polygons: PolygonView<'_>) -> Result<Vec<Vec3>, PictureError> {
    let used = polygons.corner_vertex.iter().map(|&vertex| polygons.positions[vertex as usize]);
    let low = used.clone().reduce(|a, b| a.inf(&b)).ok_or(PictureError::NoExtent)?;
    let high = used.reduce(|a, b| a.sup(&b)).ok_or(PictureError::NoExtent)?;
    let extent = (high - low).max();
    if !(extent > 0.0 && extent.is_finite()) {
        return Err(PictureError::NoExtent);
    }
    let middle = low + (high - low) / 2.0;
    // A quotient, not a product with the inverse: the extent may be subnormal.
    Ok(polygons.positions.iter().map(|p| (p - middle) / extent).collect())
}

/// Twice the vector area of a face.
fn newell(polygons: PolygonView<'_>, positions: &[Vec3], face: usize) -> Vec3 {
    let corners = polygons.face(face);
    let Some(&first) = corners.first() else { return Vec3::zeros() };
    let origin = positions[first as usize];
    let at = |vertex: &u32| positions[*vertex as usize] - origin;
    corners.windows(2).map(|pair| at(&pair[0]).cross(&at(&pair[1]))).sum()
}

/// The sum over the faces around the vertex that turn less than a crease away from the corner's own face.
fn corner_normals(polygons: PolygonView<'_>, face_normals: &[Vec3]) -> Vec<[f32; 3]> {
    let count = polygons.positions.len();
    let mut start = vec![0_u32; count + 1];
    for &vertex in polygons.corner_vertex {
        start[vertex as usize + 1] += 1;
    }
    for i in 0..count {
        start[i + 1] += start[i];
    }
    let mut fill = start.clone();
    let mut faces = vec![0_u32; polygons.corner_count()];
    for face in 0..polygons.face_count() {
        for &vertex in polygons.face(face) {
            let place = &mut fill[vertex as usize];
            faces[*place as usize] = face as u32;
            *place += 1;
        }
    }
    let of_face = |face: usize| {
        let own = face_normals[face];
        let direction = own.try_normalize(0.0).unwrap_or_default();
        polygons.face(face).iter().map(move |&vertex| (direction, vertex as usize))
    };
    (0..polygons.face_count())
        .into_par_iter()
        .flat_map_iter(of_face)
        .map(|(direction, vertex)| {
            let around = &faces[start[vertex] as usize..start[vertex + 1] as usize];
            let sum: Vec3 = around
                .iter()
                .map(|&face| face_normals[face as usize])
                .filter(|normal| normal.dot(&direction) >= CREASE * normal.norm())
                .sum();
            let normal = sum.try_normalize(0.0).unwrap_or(direction);
            [normal.x as f32, normal.y as f32, normal.z as f32]
        })
        .collect()
}

/// The patches of a face.
fn cut(polygons: PolygonView<'_>, positions: &[Vec3], normal: &Vec3, face: usize) -> Vec<Patch> {
    let corners: Vec<u32> = polygons.corners(face).map(|corner| corner as u32).collect();
    let triangle = |[a, b, c]: [u32; 3]| Patch { face: face as u32, corners: [a, b, c, NO_CORNER] };
    match *corners.as_slice() {
        [a, b, c] => vec![triangle([a, b, c])],
        [a, b, c, d] => {
            let at = |corner: u32| positions[polygons.corner_vertex[corner as usize] as usize];
            let is_reflex = |before: u32, here: u32, after: u32| {
                (at(after) - at(here)).cross(&(at(before) - at(here))).dot(normal) < 0.0
            };
            match [is_reflex(d, a, b), is_reflex(a, b, c), is_reflex(b, c, d), is_reflex(c, d, a)] {
                [true, false, _, false] | [false, false, true, false] => {
                    vec![triangle([a, b, c]), triangle([a, c, d])]
                }
                [false, true, false, _] | [false, false, false, true] => {
                    vec![triangle([b, c, d]), triangle([b, d, a])]
                }
                _ => vec![Patch { face: face as u32, corners: [a, b, c, d] }],
            }
        }
        _ => ears(polygons, positions, normal, corners).into_iter().map(triangle).collect(),
    }
}

/// Ear clipping in the plane of the face; a fan of what is left when no ear can be found.
fn ears(polygons: PolygonView<'_>, positions: &[Vec3], normal: &Vec3, mut left: Vec<u32>) -> Vec<[u32; 3]> {
    let at = |corner: u32| positions[polygons.corner_vertex[corner as usize] as usize];
    let turn = |a: u32, b: u32, c: u32| (at(b) - at(a)).cross(&(at(c) - at(a))).dot(normal);
    let mut triangles = Vec::with_capacity(left.len().saturating_sub(2));
    while left.len() > 3 {
        let count = left.len();
        let ear = (0..count).find(|&i| {
            let [a, b, c] = [left[(i + count - 1) % count], left[i], left[(i + 1) % count]];
            turn(a, b, c) > 0.0
                && left
                    .iter()
                    .filter(|&&p| p != a && p != b && p != c)
                    .all(|&p| turn(a, b, p) < 0.0 || turn(b, c, p) < 0.0 || turn(c, a, p) < 0.0)
        });
        let i = ear.unwrap_or(1);
        triangles.push([left[(i + count - 1) % count], left[i], left[(i + 1) % count]]);
        left.remove(i);
    }
    if let [a, b, c] = *left.as_slice() {
        triangles.push([a, b, c]);
    }
    triangles
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::{Polygons, shapes};

    use super::*;

    fn doubled_area(model: &Model<'_>) -> f64 {
        let at = |corner: u32| model.position(corner);
        let area = |patch: &Patch| match patch.corners {
            [a, b, c, NO_CORNER] => (at(b) - at(a)).cross(&(at(c) - at(a))).z,
            [a, b, c, d] => (at(c) - at(a)).cross(&(at(d) - at(b))).z,
        };
        model.patches.iter().map(area).sum()
    }

    /// Patches have the area of their faces with the same sign, whatever the faces look like.
    #[test]
    fn patches_cover_their_faces_once() {
        let arrow = [[0.0, 0.0, 0.0], [0.4, 0.4, 0.0], [1.0, 0.0, 0.0], [0.5, 1.0, 0.0]];
        for turn in 0..4_u32 {
            let face: Vec<u32> = (0..4).map(|i| (i + turn) % 4).collect();
            let polygons = Polygons::new(&arrow, [face]);
            let model = Model::new(polygons.view()).unwrap();
            assert_eq!(model.patches.len(), 2);
            assert!(model.patches.iter().all(|patch| {
                let [a, b, c, _] = patch.corners;
                let at = |corner: u32| model.position(corner);
                (at(b) - at(a)).cross(&(at(c) - at(a))).z > 0.0
            }));
            assert!((doubled_area(&model) - 0.6).abs() < 1e-12);
        }
        let comb: Vec<[f64; 3]> = [[0, 0], [4, 0], [4, 2], [3, 1], [2, 2], [1, 1], [0, 2]]
            .map(|[x, y]| [f64::from(x), f64::from(y), 7.0])
            .into();
        let polygons = Polygons::new(&comb, [[0_u32, 1, 2, 3, 4, 5, 6]]);
        let model = Model::new(polygons.view()).unwrap();
        assert_eq!(model.patches.len(), 5);
        assert!((doubled_area(&model) * 16.0 - 12.0).abs() < 1e-9);
    }

    /// A sphere is smooth, a cube is not.
    #[test]
    fn normals_stop_at_creases() {
        let sphere = shapes::sphere(12);
        let model = Model::new(sphere.view()).unwrap();
        for (corner, normal) in model.normals.iter().enumerate() {
            let out = model.position(corner as u32).normalize();
            let [x, y, z] = normal.map(f64::from);
            assert!(Vec3::new(x, y, z).dot(&out) > 0.99);
        }
        let cube = shapes::sphere(1);
        let model = Model::new(cube.view()).unwrap();
        assert!(
            model.normals.iter().all(|n| (n.iter().map(|x| x.abs()).fold(0.0, f32::max) - 1.0).abs() < 1e-6)
        );
    }

    #[test]
    fn a_point_has_no_picture() {
        let point = Polygons::new(&[[1.0, 2.0, 3.0]; 4], [[0, 1, 2, 3]]);
        assert!(matches!(Model::new(point.view()), Err(PictureError::NoExtent)));
    }
}
