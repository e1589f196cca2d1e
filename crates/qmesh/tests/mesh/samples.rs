//! Small meshes made by hand, and random ones.

use proptest::collection::vec;
use proptest::prelude::*;
use qmesh::{Polygons, Vec3};

/// Faces over vertices whose positions do not matter.
pub(crate) fn faces<F: AsRef<[u32]>>(faces: impl IntoIterator<Item = F>) -> Polygons {
    let mut polygons = Polygons::default();
    for face in faces {
        polygons.push_face(face.as_ref());
    }
    let count = polygons.corner_vertex.iter().max().map_or(0, |&last| last + 1);
    polygons.positions = (0..count).map(|v| Vec3::new(f64::from(v), f64::from(v).powi(2), 1.0)).collect();
    polygons
}

/// `columns × rows` quads in the plane, counter-clockwise.
pub(crate) fn grid(columns: u32, rows: u32) -> Polygons {
    let at = |i: u32, j: u32| j * (columns + 1) + i;
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let mut polygons = faces(cells.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    polygons.positions = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| Vec3::new(f64::from(i), f64::from(j), 0.0)))
        .collect();
    polygons
}

/// A grid closed in one direction: a ring with two boundary loops.
pub(crate) fn ring(columns: u32, rows: u32) -> Polygons {
    let at = move |i: u32, j: u32| j * columns + i % columns;
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    faces(cells.map(move |(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
}

/// A grid closed in both directions.
pub(crate) fn torus(columns: u32, rows: u32) -> Polygons {
    let at = move |i: u32, j: u32| (j % rows) * columns + i % columns;
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    faces(cells.map(move |(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
}

pub(crate) fn cube() -> Polygons {
    faces([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
}

/// A strip of `length` quads whose end is glued to its start after half a turn.
pub(crate) fn moebius(length: u32) -> Polygons {
    let at = move |i: u32, side: u32| {
        let (i, side) = if i == length { (0, 1 - side) } else { (i, side) };
        2 * i + side
    };
    faces((0..length).map(move |i| [at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)]))
}

/// Two meshes beside each other.
pub(crate) fn both(mut first: Polygons, second: &Polygons) -> Polygons {
    let shift = first.positions.len() as u32;
    first.positions.extend(&second.positions);
    for face in 0..second.view().face_count() {
        let face: Vec<u32> = second.view().face(face).iter().map(|v| v + shift).collect();
        first.push_face(&face);
    }
    first
}

/// The faces of `polygons` as lists.
pub(crate) fn lists(polygons: &Polygons) -> Vec<Vec<u32>> {
    (0..polygons.view().face_count()).map(|face| polygons.view().face(face).to_vec()).collect()
}

/// Pieces of grids, rings and tori in which some quads are missing, some are halved into triangles and some merged
/// with their neighbour into hexagons. Most of them are meshes; some touch themselves in a vertex.
pub(crate) fn patchwork() -> impl Strategy<Value = Polygons> {
    (0..3u8, 3u32..7, 3u32..7, vec(0..8u8, 36)).prop_map(|(kind, columns, rows, fates)| {
        let whole = match kind {
            0 => grid(columns, rows),
            1 => ring(columns, rows),
            _ => torus(columns, rows),
        };
        let mut patched = Vec::new();
        let quads = lists(&whole);
        let mut index = 0;
        while index < quads.len() {
            let quad = &quads[index];
            let is_last_of_row = (index + 1).is_multiple_of(columns as usize);
            match fates[index % fates.len()] {
                0 => {}
                1 => {
                    patched.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]].map(Vec::from));
                }
                2 if !is_last_of_row => {
                    let after = &quads[index + 1];
                    patched.push(vec![quad[0], quad[1], after[1], after[2], quad[2], quad[3]]);
                    index += 1;
                }
                _ => patched.push(quad.clone()),
            }
            index += 1;
        }
        Polygons { positions: whole.positions, ..faces(patched) }
    })
}
