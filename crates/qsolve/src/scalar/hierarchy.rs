//! The V-cycle.

use super::conjugate::Preconditioner;
use super::level::Level;
use super::sparse::{Sparse, Value};
use crate::SolveError;
use crate::multigrid::{BlockMatrix, Coarsest};

/// A level of at most so many rows is factorized.
const COARSEST_ROWS: usize = 500;
/// A level that shrinks by less than this is factorized too: further ones would cost as much and bring nothing.
const LEAST_SHRINKING: f64 = 1.3;
/// A coupling of the finest level is strong above this; halved from level to level.
const STRENGTH: f64 = 0.08;

/// All levels.
#[derive(Debug)]
pub(super) struct Hierarchy {
    pub(super) finest: Level<f64>,
    coarser: Vec<Level<f32>>,
    coarsest: Coarsest<1>,
    pub(super) rows: Vec<usize>,
}

impl Hierarchy {
    pub(super) fn new(matrix: Sparse<f64>) -> Result<Self, SolveError> {
        let mut rows = vec![matrix.rows()];
        let mut strength = STRENGTH;
        let (finest, mut matrix) = Level::new(matrix, strength)?;
        let mut coarser = Vec::new();
        let shrinks = |rows: &[usize], next: usize| {
            rows.last().is_some_and(|&rows| rows as f64 > LEAST_SHRINKING * next as f64)
        };
        while matrix.rows() > COARSEST_ROWS && shrinks(&rows, matrix.rows()) {
            rows.push(matrix.rows());
            strength *= 0.5;
            let (level, next) = Level::new(matrix, strength)?;
            coarser.push(level);
            matrix = next;
        }
        rows.push(matrix.rows());
        let values = matrix.values.into_iter().map(|value| [[f64::from(value)]]).collect();
        let matrix = BlockMatrix { starts: matrix.starts, columns: matrix.columns, values };
        let coarsest = Coarsest::new(matrix, 0.0)?;
        Ok(Self { finest, coarser, coarsest, rows })
    }
}

/// V-cycles with the vectors that they work in.
#[derive(Debug)]
pub(super) struct Cycles<'a, const K: usize> {
    hierarchy: &'a Hierarchy,
    work: Work<K>,
}

impl<'a, const K: usize> Cycles<'a, K> {
    pub(super) fn new(hierarchy: &'a Hierarchy) -> Self {
        Self { hierarchy, work: Work::new(hierarchy) }
    }

    /// With vectors from before.
    pub(super) fn with(hierarchy: &'a Hierarchy, work: Work<K>) -> Self {
        Self { hierarchy, work }
    }

    pub(super) fn into_work(self) -> Work<K> {
        self.work
    }
}

/// Symmetric positive definite but for the rounding of single precision.
impl<const K: usize> Preconditioner<K> for Cycles<'_, K> {
    fn apply(&mut self, r: &[[f64; K]]) {
        let Hierarchy { finest, coarser, coarsest, .. } = self.hierarchy;
        let Work { fine, coarse } = &mut self.work;
        cycle(finest, coarser, coarsest, r, fine, coarse);
    }

    fn z(&self) -> &[[f32; K]] {
        &self.work.fine.x
    }
}

/// Iterate and residual of a level.
#[derive(Debug)]
struct Vectors<const K: usize> {
    x: Vec<[f32; K]>,
    r: Vec<[f32; K]>,
}

/// The vectors of all levels.
#[derive(Debug)]
pub(super) struct Work<const K: usize> {
    fine: Vectors<K>,
    /// With the right-hand side of each.
    coarse: Vec<(Vec<[f32; K]>, Vectors<K>)>,
}

impl<const K: usize> Work<K> {
    fn new(hierarchy: &Hierarchy) -> Self {
        let zeros = |rows: usize| vec![[0.0; K]; rows];
        let vectors = |rows: usize| Vectors { x: zeros(rows), r: zeros(rows) };
        let coarse = hierarchy.rows[1..].iter().map(|&rows| (zeros(rows), vectors(rows)));
        Self { fine: vectors(hierarchy.rows[0]), coarse: coarse.collect() }
    }
}

/// One V-cycle from `b` to `at.x`.
fn cycle<T: Value, V: Value, const K: usize>(
    level: &Level<T>,
    coarser: &[Level<f32>],
    coarsest: &Coarsest<1>,
    b: &[[V; K]],
    at: &mut Vectors<K>,
    below: &mut [(Vec<[f32; K]>, Vectors<K>)],
) {
    let Some(((coarse_b, next), further)) = below.split_first_mut() else { return };
    level.forward(b, &mut at.x);
    level.residual(&at.x, &mut at.r);
    level.restrict(&at.r, coarse_b);
    match coarser.split_first() {
        Some((coarse, coarser)) => cycle(coarse, coarser, coarsest, coarse_b, next, further),
        None => solve_coarsest(coarsest, coarse_b, &mut next.x),
    }
    level.prolong(&next.x, &mut at.x);
    level.backward(b, &at.x, &mut at.r);
    std::mem::swap(&mut at.x, &mut at.r);
}

fn solve_coarsest<const K: usize>(coarsest: &Coarsest<1>, b: &[[f32; K]], x: &mut [[f32; K]]) {
    let mut exact = vec![[0.0]; b.len()];
    for k in 0..K {
        let column: Vec<[f64; 1]> = b.iter().map(|b| [f64::from(b[k])]).collect();
        coarsest.solve(&column, &mut exact);
        x.iter_mut().zip(&exact).for_each(|(x, exact)| x[k] = exact[0] as f32);
    }
}
