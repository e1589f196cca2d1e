//! Small maps made by hand: vertices are told apart by where they are in space.

use std::collections::HashMap;
use std::ops::Range;

use qoptimize::qmesh::{Polygons, Vec2, Vec3};

/// Polygons with their UVs.
#[derive(Clone)]
pub(crate) struct Soup {
    pub(crate) polygons: Polygons,
    pub(crate) uv: Vec<Vec2>,
}

pub(crate) fn at(x: i32, y: i32) -> Vec2 {
    Vec2::new(f64::from(x), f64::from(y))
}

impl Soup {
    /// Faces given by their UVs; corners at the same place are the same vertex.
    pub(crate) fn new(faces: &[&[[i32; 2]]]) -> Self {
        let mut soup =
            Self { polygons: Polygons { face_start: vec![0], ..Polygons::default() }, uv: Vec::new() };
        let mut vertices = HashMap::new();
        for face in faces {
            let numbers: Vec<u32> = face
                .iter()
                .map(|&[x, y]| {
                    *vertices.entry([x, y]).or_insert_with(|| soup.push_vertex(f64::from(x), f64::from(y)))
                })
                .collect();
            soup.polygons.push_face(&numbers);
            soup.uv.extend(face.iter().map(|&[x, y]| at(x, y)));
        }
        soup
    }

    fn push_vertex(&mut self, x: f64, y: f64) -> u32 {
        self.polygons.positions.push(Vec3::new(x, y, 0.0));
        self.polygons.positions.len() as u32 - 1
    }

    /// Every corner at `from` goes to `to`.
    pub(crate) fn move_vertex(&mut self, from: [f64; 2], to: [f64; 2]) {
        let from = Vec2::from(from);
        assert!(self.uv.contains(&from));
        self.uv.iter_mut().filter(|p| **p == from).for_each(|p| *p = to.into());
    }

    /// The corner of a face at `from`, and those of the same vertex there, go to `to`.
    pub(crate) fn move_corner(&mut self, face: usize, from: [f64; 2], to: [f64; 2]) {
        let from = Vec2::from(from);
        let mut corners = self.polygons.view().corners(face);
        let corner = corners.find(|&corner| self.uv[corner] == from).expect("a corner there");
        let vertex = self.polygons.corner_vertex[corner];
        for (p, &v) in self.uv.iter_mut().zip(&self.polygons.corner_vertex) {
            if v == vertex && *p == from {
                *p = to.into();
            }
        }
    }

    /// Scaled, then moved.
    pub(crate) fn placed(&self, by: [f64; 2], scale: f64) -> Self {
        let mut soup = self.clone();
        soup.uv.iter_mut().for_each(|p| *p = *p * scale + Vec2::from(by));
        soup
    }

    /// Both, with vertices of their own.
    pub(crate) fn with(&self, other: &Self) -> Self {
        let mut soup = self.clone();
        let first = soup.polygons.positions.len() as u32;
        soup.polygons.positions.extend_from_slice(&other.polygons.positions);
        for face in 0..other.polygons.view().face_count() {
            let vertices: Vec<u32> = other.polygons.view().face(face).iter().map(|v| v + first).collect();
            soup.polygons.push_face(&vertices);
        }
        soup.uv.extend_from_slice(&other.uv);
        soup
    }
}

fn cell([x, y]: [i32; 2]) -> [[i32; 2]; 4] {
    [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]]
}

/// A grid of unit cells over itself, row by row.
pub(crate) fn grid_uv(columns: i32, rows: i32) -> Soup {
    let cells: Vec<[[i32; 2]; 4]> = (0..rows).flat_map(|y| (0..columns).map(move |x| cell([x, y]))).collect();
    Soup::new(&cells.iter().map(<[[i32; 2]; 4]>::as_slice).collect::<Vec<_>>())
}

/// A square of `n` × `n` cells without those whose column and row are both in `hole`.
pub(crate) fn disk_with_hole(n: i32, hole: Range<i32>) -> Soup {
    let is_kept = |x: i32, y: i32| !(hole.contains(&x) && hole.contains(&y));
    let cells: Vec<[[i32; 2]; 4]> =
        (0..n).flat_map(|y| (0..n).map(move |x| [x, y])).filter(|&[x, y]| is_kept(x, y)).map(cell).collect();
    Soup::new(&cells.iter().map(<[[i32; 2]; 4]>::as_slice).collect::<Vec<_>>())
}

/// A strip of unit cells, each joined to the next along the edge that they share; where the strip meets itself otherwise, it does so
/// with vertices of its own.
pub(crate) fn chain(cells: &[[i32; 2]]) -> Soup {
    let mut soup = Soup { polygons: Polygons { face_start: vec![0], ..Polygons::default() }, uv: Vec::new() };
    let mut last: HashMap<[i32; 2], u32> = HashMap::new();
    for &place in cells {
        let mut here = HashMap::new();
        for corner in cell(place) {
            let vertex = match last.get(&corner) {
                Some(&vertex) => vertex,
                None => soup.push_vertex(f64::from(corner[0]), f64::from(corner[1])),
            };
            here.insert(corner, vertex);
            soup.uv.push(at(corner[0], corner[1]));
        }
        soup.polygons.push_face(&cell(place).map(|corner| here[&corner]));
        last = here;
    }
    soup
}

/// A sheet of 8 × 8 cells and one of 4 × 4 on its middle, glued crosswise along the slit from (3, 4) to (5, 4): what comes from below on one
/// sheet goes on above on the other.
pub(crate) fn two_sheets() -> Soup {
    let mut soup = Soup { polygons: Polygons { face_start: vec![0], ..Polygons::default() }, uv: Vec::new() };
    let mut vertices: HashMap<([i32; 2], i32), u32> = HashMap::new();
    for (sheet, range) in [(0, 0..8), (1, 2..6)] {
        for y in range.clone() {
            for x in range.clone() {
                let corners = cell([x, y]);
                let numbers = corners.map(|[u, v]| {
                    // On the slit, the sheet above it counts; its ends are on both sheets at once.
                    let name = match (u, v) {
                        (3 | 5, 4) => 0,
                        (4, 4) if y == 3 => 1 - sheet,
                        _ => sheet,
                    };
                    *vertices.entry(([u, v], name)).or_insert_with(|| {
                        soup.polygons.positions.push(Vec3::new(f64::from(u), f64::from(v), f64::from(name)));
                        soup.polygons.positions.len() as u32 - 1
                    })
                });
                soup.polygons.push_face(&numbers);
                soup.uv.extend(corners.map(|[u, v]| at(u, v)));
            }
        }
    }
    soup
}
