//! The Newton system: assembled from the corners, and solved as exactly as it is worth.
//!
//! Small systems are factorized. Large ones are solved by conjugate gradients with a multigrid preconditioner whose
//! near-kernel are the rigid motions: a tenth of the residual is reached in a few iterations at any size, and is enough of a
//! direction while the map is far from the minimum.

use std::ops::Range;

use rayon::prelude::*;

use super::DescentError;
use super::element::Edges;
use super::layout::{Layout, Triangle, windows};
use super::rest::{Corners, Rest};
use super::system::{Factored, Iterated};
use crate::qmesh::Vec2;
use crate::qsolve::SolveError;

/// Vertices above which systems are iterated on.
const FACTORED_VERTICES: usize = 6_000;
/// Vertices of the largest systems that are factorized for a better direction only.
const FACTORED_AT_MOST: usize = 400_000;
/// So many systems are factorized before iterations are tried again; after these have failed twice as many, and so on.
const FIRST_PATIENCE: usize = 2;
/// Corners that one task takes.
const CHUNK: usize = 2048;
/// Corners whose derivatives are held at a time: those of all would be the largest part of the memory.
const WINDOW: usize = 256 * CHUNK;

/// How exact a direction has to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accuracy {
    /// The residual, relative, that is enough for a direction.
    pub(super) residual: f64,
    /// A decrement below this is worth knowing to a tenth: it decides whether the descent ends.
    pub(super) decisive: f64,
}

impl Accuracy {
    /// As exact as a direction that nothing is decided by has to be.
    pub(super) const DIRECTION: Self = Self { residual: 0.1, decisive: 0.0 };
}

/// The answer of a Newton system.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub(super) direction: Vec<Vec2>,
    /// `−g·d`: with an inexact direction, less than the Newton decrement.
    pub(super) decrement: f64,
    /// About what is missing from the decrement.
    pub(super) missing: f64,
    /// Iterations of conjugate gradients; 0 when the system was factorized.
    pub(super) iterations: usize,
}

/// A symmetric matrix of 2 × 2 blocks, and what solves with it.
pub(super) struct Hessian {
    layout: Layout,
    /// For each window of corners the vertices that they have; none where all corners are one window.
    windows: Option<Vec<Vec<u32>>>,
    gradients: Vec<Edges>,
    triangles: Vec<Triangle>,
    system: System,
    /// The factorized system, while another one is in use.
    spare: Option<Box<Factored>>,
    is_large: bool,
    /// Factorized solutions until iterations are tried again, and how often these have failed.
    patience: [usize; 2],
}

/// Fills in what the corners in `window` have, and returns the sums of their values, chunk by chunk.
fn element_sums(
    rest: &Rest,
    window: &Range<usize>,
    gradients: &mut [Edges],
    triangles: &mut [Triangle],
    shares: &(impl Fn(Corners<'_>, &mut [Edges], &mut [Triangle]) -> Result<f64, usize> + Sync),
) -> Vec<Result<f64, usize>> {
    rest.par_chunks_of(window.clone(), CHUNK)
        .zip(gradients.par_chunks_mut(CHUNK))
        .zip(triangles.par_chunks_mut(CHUNK))
        .enumerate()
        .map(|(chunk, ((corners, gradients), triangles))| {
            shares(corners, gradients, triangles).map_err(|place| window.start + chunk * CHUNK + place)
        })
        .collect()
}

enum System {
    Factored(Box<Factored>),
    Iterated(Box<Iterated>),
}

impl Hessian {
    /// The zero matrix of the corners of `rest`, analysed.
    pub(super) fn new(rest: &Rest) -> Result<Self, SolveError> {
        let layout = Layout::new(&rest.corners, rest.vertex_count);
        let is_large = rest.vertex_count > FACTORED_VERTICES;
        let system = if is_large {
            System::Iterated(Box::new(Iterated::new(&layout)?))
        } else {
            System::Factored(Box::new(Factored::new(&layout)?))
        };
        let windows = (is_large && rest.corners.len() > WINDOW).then(|| windows(&rest.corners, WINDOW));
        let length = rest.corners.len().min(WINDOW);
        let (gradients, triangles) = (vec![[0.0; 4]; length], vec![[0.0; 10]; length]);
        Ok(Self { layout, windows, gradients, triangles, system, spare: None, is_large, patience: [0, 0] })
    }

    /// Factorizes from here on, for a while where the system is a large one; the matrix has to be assembled again.
    pub(super) fn factorize(&mut self) -> Result<(), SolveError> {
        if !self.is_factored() {
            let factored = match self.spare.take() {
                Some(factored) => factored,
                None => Box::new(Factored::new(&self.layout)?),
            };
            self.system = System::Factored(factored);
            self.patience[0] = FIRST_PATIENCE;
        }
        Ok(())
    }

    /// [`Hessian::factorize`] because iterations failed: the more often they do, the longer.
    pub(super) fn give_up_iterations(&mut self) -> Result<(), SolveError> {
        self.factorize()?;
        let [left, failures] = &mut self.patience;
        *failures += 1;
        *left = FIRST_PATIENCE << (*failures).min(6);
        Ok(())
    }

    /// [`Hessian::factorize`] where that takes seconds and not minutes.
    pub(super) fn factorize_unless_huge(&mut self) -> Result<(), SolveError> {
        if self.layout.vertex_count() <= FACTORED_AT_MOST { self.factorize() } else { Ok(()) }
    }

    /// Goes back to iterations when a large system has been factorized for long enough; to be called before it is assembled.
    pub(super) fn reconsider(&mut self) -> Result<(), SolveError> {
        if self.is_large && self.is_factored() && self.patience[0] == 0 {
            let iterated = System::Iterated(Box::new(Iterated::new(&self.layout)?));
            if let System::Factored(factored) = std::mem::replace(&mut self.system, iterated) {
                self.spare = Some(factored);
            }
        }
        Ok(())
    }

    pub(super) fn is_factored(&self) -> bool {
        matches!(self.system, System::Factored(_))
    }

    /// Fills the matrix. `shares(corners, gradients, triangles)` gives the gradient of each corner by its edge vectors and the
    /// upper triangle of its Hessian, row by row, and returns the sum of their values or the place of one that has none.
    ///
    /// Returns the sum of all values and the gradient (2 entries a vertex), or the number of the first corner without a value.
    pub(super) fn assemble(
        &mut self,
        rest: &Rest,
        shares: impl Fn(Corners<'_>, &mut [Edges], &mut [Triangle]) -> Result<f64, usize> + Sync,
    ) -> Result<(f64, Vec<f64>), usize> {
        let Self { layout, gradients, triangles, system, windows, .. } = self;
        let all = 0..rest.corners.len();
        let mut gradient = vec![0.0; 2 * layout.vertex_count()];
        if let (Some(windows), System::Iterated(system)) = (windows, &mut *system) {
            system.clear();
            let mut sums = Vec::new();
            for (number, vertices) in windows.iter().enumerate() {
                let window = number * WINDOW..((number + 1) * WINDOW).min(all.end);
                let (gradients, triangles) = (&mut gradients[..window.len()], &mut triangles[..window.len()]);
                sums.extend(element_sums(rest, &window, gradients, triangles, &shares));
                system.add(vertices, |row, blocks| {
                    layout.gather_row(row, &window, triangles, &rest.corners, blocks);
                });
                layout.add_gradient(&mut gradient, &window, Some(vertices), gradients);
            }
            return Ok((sums.into_iter().sum::<Result<f64, usize>>()?, gradient));
        }
        gradients.resize(all.end, [0.0; 4]);
        triangles.resize(all.end, [0.0; 10]);
        let sums = element_sums(rest, &all, gradients, triangles, &shares);
        let value = sums.into_iter().sum::<Result<f64, usize>>()?;
        let row = |row, blocks: &mut _| layout.gather_row(row, &all, triangles, &rest.corners, blocks);
        match system {
            System::Factored(system) => system.fill(row),
            System::Iterated(system) => system.fill(row),
        }
        layout.add_gradient(&mut gradient, &all, None, gradients);
        Ok((value, gradient))
    }

    /// The sum of all values and the gradient as [`Hessian::assemble`] gives them; the matrix stays as it is.
    pub(super) fn gradient(
        &mut self,
        rest: &Rest,
        shares: impl Fn(Corners<'_>, &mut [Edges]) -> Result<f64, usize> + Sync,
    ) -> Result<(f64, Vec<f64>), usize> {
        let Self { layout, gradients, windows, .. } = self;
        let count = rest.corners.len();
        let mut gradient = vec![0.0; 2 * layout.vertex_count()];
        let mut sums = Vec::new();
        let length = if windows.is_some() { WINDOW } else { count };
        for number in 0..count.div_ceil(length.max(1)) {
            let window = number * length..((number + 1) * length).min(count);
            gradients.resize(gradients.len().max(window.len()), [0.0; 4]);
            let gradients = &mut gradients[..window.len()];
            let chunks = rest.par_chunks_of(window.clone(), CHUNK).zip(gradients.par_chunks_mut(CHUNK));
            let values = chunks.enumerate().map(|(chunk, (corners, gradients))| {
                shares(corners, gradients).map_err(|place| window.start + chunk * CHUNK + place)
            });
            sums.par_extend(values);
            let vertices = windows.as_ref().map(|windows| windows[number].as_slice());
            layout.add_gradient(&mut gradient, &window, vertices, gradients);
        }
        Ok((sums.into_iter().sum::<Result<f64, usize>>()?, gradient))
    }

    /// Makes ready for [`Hessian::kept_direction`] what has been assembled at `uv`.
    pub(super) fn renew(&mut self, uv: &[Vec2]) -> Result<(), SolveError> {
        match &mut self.system {
            System::Factored(system) => system.factor(),
            System::Iterated(system) => system.refresh(uv),
        }
    }

    /// What the last system that was solved makes of another right-hand side, about: `−H⁻¹ g`, from its factorization or one cycle
    /// of its hierarchy. `None` where none was solved yet.
    pub(super) fn kept_direction(&self, gradient: &[f64]) -> Option<Vec<Vec2>> {
        match &self.system {
            System::Factored(system) => system.kept_direction(gradient),
            System::Iterated(system) => system.kept_direction(gradient),
        }
    }

    /// Takes the vertices marked in `fixed` out of the system; returns the gradient without them.
    pub(super) fn fix(&mut self, fixed: &[bool], mut gradient: Vec<f64>) -> Vec<f64> {
        for (pair, _) in gradient.chunks_exact_mut(2).zip(fixed).filter(|(_, fixed)| **fixed) {
            pair.fill(0.0);
        }
        match &mut self.system {
            System::Factored(system) => system.fix(fixed),
            System::Iterated(system) => system.fix(fixed),
        }
        gradient
    }

    /// Solves the Newton system. `uv` is where it was assembled; `lagged` allows to precondition with what the last matrix left.
    ///
    /// # Errors
    /// When the matrix is not positive definite in the precision at hand; [`Hessian::factorize`] is the way out.
    pub(super) fn newton_direction(
        &mut self,
        uv: &[Vec2],
        gradient: &[f64],
        accuracy: Accuracy,
        lagged: bool,
    ) -> Result<Solved, DescentError> {
        match &mut self.system {
            System::Factored(system) => {
                self.patience[0] = self.patience[0].saturating_sub(1);
                system.solve(gradient)
            }
            System::Iterated(system) => system.solve(uv, gradient, accuracy, lagged),
        }
    }
}
