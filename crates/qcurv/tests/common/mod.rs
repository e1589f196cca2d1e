//! Meshes from formulas for the tests of this crate.
#![allow(clippy::unwrap_used)] // helpers of tests are tests too

use std::f64::consts::{PI, TAU};

use qmesh::{Polygons, QuadMesh, Vec3};

/// A grid of `columns` by `rows` quads over the unit square, lifted by `surface`; wraps around where asked.
pub(crate) fn patch(
    columns: u32,
    rows: u32,
    wraps: [bool; 2],
    surface: impl Fn(f64, f64) -> [f64; 3],
) -> QuadMesh {
    let width = if wraps[0] { columns } else { columns + 1 };
    let height = if wraps[1] { rows } else { rows + 1 };
    let mut positions = Vec::new();
    for j in 0..height {
        for i in 0..width {
            positions.push(surface(f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows)));
        }
    }
    let at = |i: u32, j: u32| (j % height) * width + i % width;
    let faces = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    QuadMesh::build(Polygons::new(&positions, faces)).unwrap()
}

/// A torus whose tube is thick and thin in turn, so that hardly any quad is planar.
pub(crate) fn wavy_torus(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [true, true], |s, t| {
        let (u, v) = (TAU * s, TAU * t);
        let tube = 0.8 + 0.2 * (3.0 * u + v).sin();
        let ring = 2.0 + tube * v.cos();
        [ring * u.cos(), ring * u.sin(), tube * v.sin() + 0.3 * (2.0 * u).cos()]
    })
}

/// A lifted square with bumps.
pub(crate) fn bumpy(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [false, false], |s, t| [s, 1.3 * t, 0.2 * (5.0 * s).sin() * (4.0 * t + s).cos()])
}

/// An open tube: two boundary loops.
pub(crate) fn tube(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [true, false], |s, t| {
        let radius = 1.0 + 0.4 * (3.0 * t + TAU * s).sin();
        [radius * (TAU * s).cos(), radius * (TAU * s).sin(), 2.0 * t]
    })
}

/// A closed ball of radius `radius`: a cube of `n * n` quads a side, each point moved onto the sphere with equal angles.
pub(crate) fn ball(n: u32, radius: f64) -> QuadMesh {
    let mut index = std::collections::HashMap::new();
    let mut positions = Vec::new();
    let mut at = |p: [u32; 3]| {
        *index.entry(p).or_insert_with(|| {
            let q = p.map(|c| (PI / 4.0 * (2.0 * f64::from(c) / f64::from(n) - 1.0)).tan());
            positions.push((Vec3::from(q).normalize() * radius).into());
            positions.len() as u32 - 1
        })
    };
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [0, n] {
            for i in 0..n {
                for j in 0..n {
                    let mut corner = |di, dj| {
                        let mut p = [0; 3];
                        p[axis] = side;
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        at(p)
                    };
                    let mut quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    if side == 0 {
                        quad.reverse();
                    }
                    faces.push(quad);
                }
            }
        }
    }
    QuadMesh::build(Polygons::new(&positions, faces)).unwrap()
}
