//! For every valid rival: the setting of our dials that comes nearest to beating it in everything at once.

use std::path::Path;

use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qmesh::obj::ObjDocument;
use qparam_cli::qoptimize::{AngleTerm, Method, Options, parameterize};
use rayon::prelude::*;
use serde::Serialize;

use super::league::{Measures, Outcome, Row};

const Q: [f64; 7] = [0.9999, 0.99, 0.95, 0.8, 0.5, 0.2, 0.05];
const SHAPE: [f64; 8] = [10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.001];
/// The largest ratio that still counts as no worse.
pub(super) const TOLERANCE: f64 = 1.02;

/// Our point that is nearest to dominating a rival's.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Dominance {
    pub(super) rival: String,
    /// The setting, as options of `qparam unwrap`.
    pub(super) setting: String,
    /// Ours over the rival's: angle error, area error, symmetric Dirichlet.
    pub(super) ratios: [f64; 3],
}

impl Dominance {
    /// The worst of the three: at most 1 where our map is no worse in anything.
    pub(super) fn worst(&self) -> f64 {
        self.ratios.into_iter().fold(0.0, f64::max)
    }
}

/// One of our maps.
struct Point {
    setting: String,
    errors: [f64; 3],
}

/// Maps `mesh` with every setting of the grid and finds the best against each valid rival in one island.
pub(super) fn against_all(mesh: &Path, rows: &[Row]) -> Result<Vec<Dominance>, String> {
    let rivals: Vec<(&str, [f64; 3])> = rows.iter().filter_map(rival).collect();
    if rivals.is_empty() {
        return Ok(Vec::new());
    }
    let points = points(mesh)?;
    Ok(rivals.into_iter().filter_map(|(name, errors)| nearest(name, errors, &points)).collect())
}

/// The errors of a rival's valid map in one piece; a cut map pays for small errors with its seams.
fn rival(row: &Row) -> Option<(&str, [f64; 3])> {
    let Outcome::Measured(figures) = &row.outcome else { return None };
    let counts = !row.ours && figures.measures.is_valid() && figures.measures.islands == 1;
    (counts && figures.torn_quads == 0).then_some((row.name.as_str(), errors(&figures.measures)?))
}

fn errors(measures: &Measures) -> Option<[f64; 3]> {
    Some([measures.angle_error, measures.area_error, measures.symmetric_dirichlet?])
}

fn nearest(rival: &str, theirs: [f64; 3], points: &[Point]) -> Option<Dominance> {
    let versus = |point: &Point| Dominance {
        rival: rival.to_owned(),
        setting: point.setting.clone(),
        ratios: std::array::from_fn(|k| point.errors[k] / theirs[k]),
    };
    points.iter().map(versus).min_by(|a, b| a.worst().total_cmp(&b.worst()))
}

fn points(mesh: &Path) -> Result<Vec<Point>, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", mesh.display());
    let document = ObjDocument::from_path(mesh).map_err(|error| failed(&error))?;
    let mesh = QuadMesh::build(document.polygons()).map_err(|error| failed(&error))?;
    let settings: Vec<(f64, f64, AngleTerm)> = [AngleTerm::Log, AngleTerm::Paper]
        .into_iter()
        .flat_map(|term| Q.into_iter().flat_map(move |q| SHAPE.map(|shape| (q, shape, term))))
        .collect();
    Ok(settings.into_par_iter().filter_map(|setting| point(&mesh, setting)).collect())
}

/// Nothing where the map is not valid: it would not be released either.
fn point(mesh: &QuadMesh, (q, shape, angle_term): (f64, f64, AngleTerm)) -> Option<Point> {
    let mut options = Options { method: Method::Direct, q, ..Options::default() };
    options.direct.shape = shape;
    options.direct.angle_term = angle_term;
    let distortion = parameterize(mesh, &options, &()).ok()?.distortion;
    let is_valid = distortion.flipped_corners == 0 && distortion.boundary_crossings == 0;
    let term = if angle_term == AngleTerm::Paper { " --angle-term paper" } else { "" };
    is_valid.then_some(Point {
        setting: format!("--q {q} --shape {shape}{term}"),
        errors: [distortion.angle_error, distortion.area_error, distortion.symmetric_dirichlet?],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The point whose worst ratio is least wins, not the one that is best in one figure.
    #[test]
    fn the_nearest_point_is_the_least_bad_in_its_worst_error() {
        let point = |setting: &str, errors| Point { setting: setting.to_owned(), errors };
        let points = [point("best angles", [0.1, 3.0, 1.0]), point("even", [0.9, 1.01, 1.0])];
        let found = nearest("rival", [1.0, 1.0, 1.0], &points).unwrap();
        assert_eq!((found.setting.as_str(), found.worst()), ("even", 1.01));
        assert!(nearest("rival", [1.0, 1.0, 1.0], &[]).is_none());
    }
}
