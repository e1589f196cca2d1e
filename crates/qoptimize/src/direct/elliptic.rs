//! How much stretch the energy bears before it stops being elliptic.
//!
//! MIPS, the area term and symmetric Dirichlet are polyconvex, hence elliptic at any stretch. The angle term is to blame for
//! what is lost: it sees no stretch along a quad's own edges, so a fine zigzag of such stretches imitates a shear at less
//! cost. Enough symmetric Dirichlet against it mends that.

use super::{AngleTerm, Objective};

/// Per angle term: the weight of symmetric Dirichlet over that of the angles that keeps square cells elliptic up to a
/// stretch s1/s2; found by scanning the acoustic tensor, and held by a test.
const LOG: [(f64, f64); 7] =
    [(1.3, 20.0), (0.8, 10.0), (0.6, 5.0), (0.58, 3.0), (0.47, 2.0), (0.22, 1.3), (0.09, 1.1)];
const PAPER: [(f64, f64); 7] =
    [(23.0, 20.0), (11.0, 10.0), (4.6, 5.0), (2.1, 3.0), (0.9, 2.0), (0.24, 1.3), (0.09, 1.1)];

impl Objective {
    /// The stretch s1/s2 up to which the energy of a square cell is rank-one convex; `None` when it is at any stretch.
    ///
    /// Beyond it a fine oscillation may lower the energy, so a fine mesh may grow shear bands. 20 stands for "20 and more".
    #[must_use]
    pub fn elliptic_limit(&self) -> Option<f64> {
        let Self::Direct { q, shape, angle_term } = self.clamped() else { return None };
        let table = match angle_term {
            AngleTerm::Log => LOG,
            AngleTerm::Paper => PAPER,
        };
        let ratio = shape / q;
        Some(table.iter().find(|(least, _)| ratio >= *least).map_or(1.0, |&(_, limit)| limit))
    }
}
