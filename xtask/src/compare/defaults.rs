//! At our defaults, without turning a dial: ours against the methods that minimise stretch, and against the conformal ones.

use super::dominance::errors;
use super::league::{Figures, MeshTable, Outcome};
use super::ours::LEAST_STRETCH;

/// The rivals that minimise symmetric Dirichlet: both errors are to be no worse than theirs.
const STRETCH: [&str; 2] = ["libigl-slim", "blender-minimum-stretch-50"];
/// Words in the names of the conformal rivals: the sum of both errors is to be less than theirs.
const CONFORMAL: [&str; 2] = ["abf", "lscm"];
/// How much more symmetric Dirichlet may be than theirs: at the defaults, and with the preset for least stretch.
pub(super) const MORE_STRETCH: [f64; 2] = [1.05, 1.02];

/// Ours over a rival's.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Versus {
    pub(super) rival: String,
    /// Whether the rival's map is valid.
    pub(super) valid: bool,
    pub(super) islands: usize,
    pub(super) figures: Ratios,
}

/// The figures that count against a rival.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Ratios {
    /// Angle error, area error, symmetric Dirichlet; symmetric Dirichlet with the preset for least stretch.
    Stretch { errors: [f64; 3], least_stretch: Option<f64> },
    /// The sum of angle and area error.
    Conformal { sum: f64 },
}

impl Versus {
    /// Whether we hold what is claimed.
    pub(super) fn holds(&self) -> bool {
        match &self.figures {
            Ratios::Stretch { errors: [angle, area, stretch], least_stretch } => {
                let least = least_stretch.is_some_and(|ratio| ratio <= MORE_STRETCH[1]);
                *angle <= 1.0 && *area <= 1.0 && *stretch <= MORE_STRETCH[0] && least
            }
            Ratios::Conformal { sum } => *sum < 1.0,
        }
    }
}

/// One line a rival that is there and has errors, valid or not.
pub(super) fn versus(mesh: &MeshTable, baseline: &str) -> Vec<Versus> {
    let Some(ours) = figures(mesh, baseline).and_then(|figures| errors(&figures.measures)) else {
        return Vec::new();
    };
    let least = figures(mesh, LEAST_STRETCH).and_then(|figures| errors(&figures.measures));
    let rows = mesh.rows.iter().filter(|row| !row.ours);
    rows.filter_map(|row| {
        let theirs = figures(mesh, &row.name)?;
        let errors = errors(&theirs.measures)?;
        let figures = if STRETCH.contains(&row.name.as_str()) {
            Ratios::Stretch {
                errors: std::array::from_fn(|k| ours[k] / errors[k]),
                least_stretch: least.map(|least| least[2] / errors[2]),
            }
        } else if CONFORMAL.iter().any(|word| row.name.contains(word)) {
            Ratios::Conformal { sum: (ours[0] + ours[1]) / (errors[0] + errors[1]) }
        } else {
            return None;
        };
        let (valid, islands) = (theirs.measures.is_valid(), theirs.measures.islands);
        Some(Versus { rival: row.name.clone(), valid, islands, figures })
    })
    .collect()
}

fn figures<'a>(mesh: &'a MeshTable, name: &str) -> Option<&'a Figures> {
    mesh.rows.iter().find(|row| row.name == name).and_then(|row| match &row.outcome {
        Outcome::Measured(figures) => Some(figures.as_ref()),
        Outcome::Failed { .. } => None,
    })
}
