//! Meshes from formulas for the tests of this crate.
#![allow(clippy::unwrap_used, dead_code)] // helpers of tests are tests too; not every test uses all

use std::f64::consts::TAU;

use qcurv::qmesh::{Polygons, QuadMesh};

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
    let quads = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    QuadMesh::build(Polygons::new(&positions, quads)).unwrap()
}

/// A square with bumps: all curvatures differ.
pub(crate) fn bumpy(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [false, false], |s, t| {
        [s, 1.3 * t, 0.2 * (5.0 * s + 0.1).sin() * (4.0 * t + s).cos()]
    })
}

/// A flat square: all curvatures are zero.
pub(crate) fn flat(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [false, false], |s, t| [s, t, 0.0])
}

/// An open tube: two boundary loops.
pub(crate) fn tube(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [true, false], |s, t| {
        let radius = 1.0 + 0.4 * (3.0 * t + TAU * s).sin();
        [radius * (TAU * s).cos(), radius * (TAU * s).sin(), 2.0 * t]
    })
}

/// A closed mesh of genus 1.
pub(crate) fn torus(columns: u32, rows: u32) -> QuadMesh {
    patch(columns, rows, [true, true], |s, t| {
        let (u, v) = (TAU * s, TAU * t);
        let ring = 2.0 + (0.8 + 0.2 * (3.0 * u + v).sin()) * v.cos();
        [ring * u.cos(), ring * u.sin(), 0.8 * v.sin() + 0.3 * (2.0 * u).cos()]
    })
}

/// The same connectivity with vertex `v` lifted to `heights[v]`.
pub(crate) fn lifted(mesh: &QuadMesh, heights: &[f64]) -> QuadMesh {
    mesh.clone().with_positions(mesh.vertex_data(|v| {
        let mut p = mesh.position(v);
        p.z += 0.3 * heights[v.index() % heights.len()];
        p
    }))
}
