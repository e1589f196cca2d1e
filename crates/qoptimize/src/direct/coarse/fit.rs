//! Places that fit given derivatives best: one sparse least squares problem.

use crate::qmesh::nalgebra::Matrix2x3;
use rayon::prelude::*;

use crate::qmesh::{Id, QuadMesh, Vec2, VertexId};

use super::super::layout::split;
use super::super::rest::mean_edge;

/// Iterations of conjugate gradients: what is wrong at the start is wrong within a cluster, so few are enough.
const ITERATIONS: usize = 10;
/// Less is left of the residual: nothing is gained by further ones.
const ENOUGH: f64 = 1e-4;
const CHUNK: usize = 4096;
/// Edges count as at least this long, relative to the mean.
const SHORTEST: f64 = 1e-3;

/// `min Σ w |uj − ui − (Gi + Gj)/2 · (pj − pi)|²` over the edges, w the inverse of the squared length.
pub(super) struct Fit {
    starts: Vec<u32>,
    neighbors: Vec<u32>,
    weights: Vec<f64>,
    diagonal: Vec<f64>,
    rhs: Vec<Vec2>,
}

impl Fit {
    pub(super) fn new(mesh: &QuadMesh, gradients: &[Matrix2x3<f64>], unit: f64) -> Self {
        let count = mesh.vertex_count();
        let mean = mean_edge(mesh);
        let mut starts = vec![0];
        let mut neighbors = Vec::with_capacity(2 * mesh.edge_count());
        for vertex in mesh.vertices() {
            neighbors.extend(mesh.neighbors(vertex).map(|v| v.0));
            starts.push(neighbors.len() as u32);
        }
        let mut fit = Self {
            weights: vec![0.0; neighbors.len()],
            starts,
            neighbors,
            diagonal: vec![0.0; count],
            rhs: vec![Vec2::zeros(); count],
        };
        let point = |v: usize| mesh.position(VertexId::from_index(v));
        let shortest = SHORTEST * mean;
        let Self { starts, neighbors, weights, diagonal, rhs } = &mut fit;
        let weight = |a: usize, b: u32| (mean / (point(b as usize) - point(a)).norm().max(shortest)).powi(2);
        split(starts, weights).into_par_iter().with_min_len(CHUNK).enumerate().for_each(|(a, row)| {
            let neighbors = &neighbors[starts[a] as usize..starts[a + 1] as usize];
            row.iter_mut().zip(neighbors).for_each(|(of_edge, &b)| *of_edge = weight(a, b));
        });
        rhs.par_iter_mut().zip(diagonal).with_min_len(CHUNK).enumerate().for_each(|(a, (rhs, diagonal))| {
            for at in starts[a] as usize..starts[a + 1] as usize {
                let b = neighbors[at] as usize;
                let step = (point(b) - point(a)) / unit;
                *rhs -= (gradients[a] + gradients[b]) * step * (0.5 * weights[at]);
                *diagonal += weights[at];
            }
        });
        fit
    }

    fn times(&self, x: &[Vec2], y: &mut [Vec2]) {
        y.par_iter_mut().with_min_len(CHUNK).enumerate().for_each(|(a, y)| {
            *y = x[a] * self.diagonal[a];
            for at in self.starts[a] as usize..self.starts[a + 1] as usize {
                *y -= x[self.neighbors[at] as usize] * self.weights[at];
            }
        });
    }

    /// By conjugate gradients from `x`, preconditioned by the diagonal.
    pub(super) fn solve(&self, mut x: Vec<Vec2>) -> Vec<Vec2> {
        let mut r = vec![Vec2::zeros(); x.len()];
        self.times(&x, &mut r);
        r.par_iter_mut().zip(&self.rhs).with_min_len(CHUNK).for_each(|(r, b)| *r = b - *r);
        let mut p: Vec<Vec2> = r.iter().zip(&self.diagonal).map(|(r, d)| r / *d).collect();
        let mut ap = r.clone();
        let mut rz = self.dot(&r, &r);
        let first = rz;
        for _ in 0..ITERATIONS {
            self.times(&p, &mut ap);
            let alpha = rz / dot(&p, &ap);
            if !alpha.is_finite() {
                break;
            }
            x.par_iter_mut().zip(&p).with_min_len(CHUNK).for_each(|(x, p)| *x += p * alpha);
            r.par_iter_mut().zip(&ap).with_min_len(CHUNK).for_each(|(r, ap)| *r -= ap * alpha);
            let next = self.dot(&r, &r);
            if next <= ENOUGH * ENOUGH * first {
                break;
            }
            let beta = next / rz;
            rz = next;
            p.par_iter_mut()
                .zip(&r)
                .zip(&self.diagonal)
                .with_min_len(CHUNK)
                .for_each(|((p, r), d)| *p = r / *d + *p * beta);
        }
        x
    }

    /// The scalar product after the preconditioner.
    fn dot(&self, a: &[Vec2], b: &[Vec2]) -> f64 {
        let chunks = a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).zip(self.diagonal.par_chunks(CHUNK));
        let sums: Vec<f64> = chunks
            .map(|((a, b), d)| a.iter().zip(b).zip(d).map(|((a, b), d)| a.dot(b) / d).sum::<f64>())
            .collect();
        sums.iter().sum()
    }
}

/// In chunks of fixed size, so that the sum does not depend on the number of threads.
fn dot(a: &[Vec2], b: &[Vec2]) -> f64 {
    let chunks = a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK));
    let sums: Vec<f64> = chunks.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.dot(b)).sum::<f64>()).collect();
    sums.iter().sum()
}
