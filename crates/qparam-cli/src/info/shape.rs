//! Lengths, areas, and quads that are bent or concave.

use qoptimize::qmesh::{PolygonView, Vec3};
use serde::Serialize;

/// The diagonals of a quad far from planar pass each other at more than this part of their mean length.
const WARP_LIMIT: f64 = 0.1;

/// Smallest, median and largest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Spread {
    pub(crate) smallest: f64,
    pub(crate) median: f64,
    pub(crate) largest: f64,
}

/// What the positions say.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Shape {
    /// Extent along the axes.
    pub(crate) bounding_box: [f64; 3],
    pub(crate) edge_length: Spread,
    pub(crate) face_area: Spread,
    /// Vertices at exactly the position of an earlier vertex.
    pub(crate) repeated_positions: usize,
    pub(crate) zero_area_faces: usize,
    /// Quads with a corner that turns against the quad's normal.
    pub(crate) concave_quads: usize,
    /// Quads whose diagonals pass each other at over 10 % of their mean length.
    pub(crate) nonplanar_quads: usize,
}

impl Shape {
    pub(crate) fn new(view: PolygonView<'_>) -> Self {
        let faces = || (0..view.face_count()).map(|face| view.face(face));
        let points = |face: &[u32]| face.iter().map(|&v| view.positions[v as usize]).collect::<Vec<_>>();
        let mut lengths = Vec::with_capacity(view.corner_count());
        let mut areas = Vec::with_capacity(view.face_count());
        let mut shape = Self { bounding_box: bounding_box(view.positions), ..Self::default() };
        for face in faces() {
            let points = points(face);
            lengths.extend((0..points.len()).map(|i| (points[(i + 1) % points.len()] - points[i]).norm()));
            areas.push(area(&points));
            if let [a, b, c, d] = points[..] {
                shape.concave_quads += usize::from(is_concave([a, b, c, d]));
                shape.nonplanar_quads += usize::from(warp([a, b, c, d]) > WARP_LIMIT);
            }
        }
        shape.zero_area_faces = areas.iter().filter(|&&area| area <= 0.0).count();
        shape.edge_length = Spread::of(lengths);
        shape.face_area = Spread::of(areas);
        shape.repeated_positions = repeated(view.positions);
        shape
    }
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        match (values.first(), values.last()) {
            (Some(&smallest), Some(&largest)) => Self { smallest, median: values[values.len() / 2], largest },
            _ => Self::default(),
        }
    }
}

fn bounding_box(positions: &[Vec3]) -> [f64; 3] {
    let Some(&first) = positions.first() else { return [0.0; 3] };
    let (low, high) =
        positions.iter().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point)));
    (high - low).into()
}

/// A quad counts the mean of its two diagonal splits, a larger polygon its fan around the first corner.
fn area(points: &[Vec3]) -> f64 {
    let triangle = |a: &Vec3, b: &Vec3, c: &Vec3| (b - a).cross(&(c - a)).norm() / 2.0;
    match points {
        [a, b, c, d] => (triangle(a, b, c) + triangle(a, c, d) + triangle(a, b, d) + triangle(b, c, d)) / 2.0,
        [first, rest @ ..] => rest.windows(2).map(|pair| triangle(first, &pair[0], &pair[1])).sum(),
        [] => 0.0,
    }
}

fn is_concave(points: [Vec3; 4]) -> bool {
    let normal = (points[2] - points[0]).cross(&(points[3] - points[1]));
    (0..4).any(|i| {
        let (next, previous) = (points[(i + 1) % 4] - points[i], points[(i + 3) % 4] - points[i]);
        next.cross(&previous).dot(&normal) < 0.0
    })
}

/// The distance between the lines of the diagonals, as a part of their mean length; 0 when they are parallel.
fn warp([a, b, c, d]: [Vec3; 4]) -> f64 {
    let (first, second) = (c - a, d - b);
    let normal = first.cross(&second);
    let distance = (b - a).dot(&normal).abs() / normal.norm();
    let warp = distance / ((first.norm() + second.norm()) / 2.0);
    if warp.is_finite() { warp } else { 0.0 }
}

fn repeated(positions: &[Vec3]) -> usize {
    // Adding zero makes −0 and 0 the same position.
    let mut keys: Vec<[u64; 3]> =
        positions.iter().map(|p| [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).collect();
    keys.sort_unstable();
    keys.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::Polygons;

    use super::Shape;

    fn quad(points: &[[f64; 3]; 4]) -> Shape {
        Shape::new(Polygons::new(points, [[0, 1, 2, 3]]).view())
    }

    #[test]
    fn a_square_is_flat_and_convex() {
        let shape = quad(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]]);
        assert_eq!((shape.concave_quads, shape.nonplanar_quads, shape.repeated_positions), (0, 0, 0));
        assert_eq!((shape.face_area.median, shape.edge_length.largest), (4.0, 2.0));
        assert_eq!(shape.bounding_box, [2.0, 2.0, 0.0]);
    }

    #[test]
    fn bent_concave_and_empty_quads_are_counted() {
        let bent = quad(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 0.0], [0.0, 1.0, 0.2]]);
        assert_eq!((bent.nonplanar_quads, bent.concave_quads), (1, 0));
        let arrow = quad(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.2, 0.2, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!((arrow.nonplanar_quads, arrow.concave_quads), (0, 1));
        let point = quad(&[[0.0; 3], [0.0; 3], [-0.0; 3], [0.0; 3]]);
        assert_eq!((point.zero_area_faces, point.repeated_positions, point.nonplanar_quads), (1, 3, 0));
    }
}
