//! Our maps over the settings of `direct`: a grid of its dials, and a finer look near one of its points.

use std::path::Path;

use qparam_cli::qmesh::{QuadMesh, Vec2, VertexData};
use qparam_cli::qoptimize::direct::{DescentOptions, Objective, minimize};
use qparam_cli::qoptimize::{AngleTerm, Distortion, Exempt, Method, Options, certify, measure, parameterize};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

const Q: [f64; 8] = [0.99999, 0.9999, 0.99, 0.95, 0.8, 0.6, 0.2, 0.05];
const SHAPE: [f64; 9] = [10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.001, 0.0001];

/// What `direct` is told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Setting {
    q: f64,
    shape: f64,
    term: AngleTerm,
}

/// One of our maps: a setting and its errors.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Spot {
    /// What the maps are made with; the data name it by its options.
    #[serde(skip)]
    pub(super) setting: Setting,
    /// The setting, as options of `qparam unwrap`.
    pub(super) options: String,
    /// Angle error, area error, symmetric Dirichlet.
    pub(super) errors: [f64; 3],
}

/// Reads a mesh.
pub(super) fn load(path: &Path) -> Result<QuadMesh, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let document = crate::meshes::document(path).map_err(|error| failed(&error))?;
    QuadMesh::build(document.polygons()).map_err(|error| failed(&error))
}

/// The certified maps of the whole grid, each descended to from that of a neighbouring setting: fast, and near enough to choose by.
pub(super) fn grid(mesh: &QuadMesh) -> Result<Vec<Spot>, String> {
    let exempt = Exempt::find(mesh);
    let first = first(mesh)?;
    let options = DescentOptions { max_steps: 60, relative_decrease: 1e-5 };
    let descend = |uv: &mut VertexData<Vec2>, setting: Setting| {
        minimize(mesh, uv, &exempt, &setting.objective(), &options, &()).ok()
    };
    let terms = [AngleTerm::Log, AngleTerm::Paper].into_iter();
    let lines: Vec<(AngleTerm, f64)> = terms.clone().flat_map(|term| Q.map(|q| (term, q))).collect();
    let line = |(term, q): (AngleTerm, f64)| {
        let mut uv = first.clone();
        let mut spot = |shape: f64| {
            let setting = Setting::new(q, shape, term);
            descend(&mut uv, setting)?;
            let corners = mesh.to_corners(&uv);
            let holds = certify(mesh.view(), &corners, 0).ok()?.holds;
            setting.spot(&measure(mesh.view(), &corners).ok()?).filter(|_| holds)
        };
        SHAPE.into_iter().filter_map(&mut spot).collect::<Vec<_>>()
    };
    let spots: Vec<Spot> = lines.into_par_iter().flat_map_iter(line).collect();
    if spots.is_empty() {
        // Holes, say: there every map is made from its own start.
        let settings = terms.flat_map(|term| {
            Q.into_iter().flat_map(move |q| SHAPE.map(|shape| Setting::new(q, shape, term)))
        });
        let settings: Vec<Setting> = settings.collect();
        return Ok(settings.into_par_iter().filter_map(|setting| as_released(mesh, setting)).collect());
    }
    Ok(spots)
}

/// The map of least stretch, one place a vertex: where all lines of the grid start.
fn first(mesh: &QuadMesh) -> Result<VertexData<Vec2>, String> {
    let options = Setting::new(0.6, SHAPE[0], AngleTerm::Log).as_options();
    let map = parameterize(mesh, &options, &()).map_err(|error| error.to_string())?;
    let mut uv = mesh.vertex_data(|_| Vec2::zeros());
    mesh.corners().for_each(|corner| uv[mesh.vertex(corner)] = map.uv[corner]);
    Ok(uv)
}

/// The map as `qparam unwrap` makes it. Nothing where it is not certified: it would not be released either.
pub(super) fn as_released(mesh: &QuadMesh, setting: Setting) -> Option<Spot> {
    let map = parameterize(mesh, &setting.as_options(), &()).ok()?;
    setting.spot(&map.distortion).filter(|_| map.certificate.holds)
}

/// The settings a step away from `centre`; a step is a factor of `shape` and of the odds of `q`.
pub(super) fn around(centre: Setting, step: f64) -> [Setting; 4] {
    [(step, 1.0), (1.0 / step, 1.0), (1.0, step), (1.0, 1.0 / step)]
        .map(|(odds, factor)| centre.moved(odds, factor))
}

impl Setting {
    pub(super) fn new(q: f64, shape: f64, term: AngleTerm) -> Self {
        Self { q, shape, term }
    }

    /// Rounded to four digits, so that the table says exactly what was run.
    fn moved(self, odds: f64, factor: f64) -> Self {
        let rounded = |value: f64| format!("{value:.3e}").parse().unwrap_or(value);
        let ratio = odds * self.q / (1.0 - self.q);
        let q = 1.0 - rounded(1.0 / (1.0 + ratio));
        Self { q: (q * 1e8).round() / 1e8, shape: rounded(self.shape * factor).max(0.001), ..self }
    }

    fn as_options(self) -> Options {
        let mut options = Options { method: Method::Direct, q: self.q, ..Options::default() };
        options.direct.shape = self.shape;
        options.direct.angle_term = self.term;
        options
    }

    fn objective(self) -> Objective {
        Objective::Direct { q: self.q, shape: self.shape, angle_term: self.term }
    }

    fn spot(self, distortion: &Distortion) -> Option<Spot> {
        let errors = [distortion.angle_error, distortion.area_error, distortion.symmetric_dirichlet?];
        Some(Spot { setting: self, options: self.options(), errors })
    }

    /// As options of `qparam unwrap`.
    pub(super) fn options(self) -> String {
        let term = if self.term == AngleTerm::Paper { " --angle-term paper" } else { "" };
        format!("--q {} --shape {}{term}", self.q, self.shape)
    }
}

#[cfg(test)]
mod tests {
    use qparam_cli::qmesh::shapes;

    use super::*;

    /// A step of the odds there and back is no step, and q stays inside (0, 1) however near it is to an end.
    #[test]
    fn dials_move_by_odds_and_factors() {
        let start = Setting::new(0.8, 0.3, AngleTerm::Log);
        let there = start.moved(2.0, 2.0);
        assert_eq!((there.q, there.shape), (0.8889, 0.6));
        let back = there.moved(0.5, 0.5);
        assert!((back.q - 0.8).abs() < 1e-4 && (back.shape - 0.3).abs() < 1e-12, "{back:?}");
        let mut end = Setting::new(0.9999, 0.001, AngleTerm::Paper);
        for _ in 0..3 {
            end = end.moved(4.0, 0.25);
        }
        assert!(end.q < 1.0 && end.q > 0.9999 && end.shape == 0.001, "{end:?}");
        assert_eq!(start.options(), "--q 0.8 --shape 0.3");
    }

    /// More weight of a term lowers it: what the grid relies on.
    #[test]
    fn spots_follow_their_dials() {
        let mesh = shapes::bump(6, 0.5);
        let at = |q, shape| as_released(&mesh, Setting::new(q, shape, AngleTerm::Log)).unwrap().errors;
        let (angles, areas, stretch) = (at(0.95, 0.1), at(0.05, 0.1), at(0.5, 10.0));
        assert!(angles[0] < areas[0] && areas[1] < angles[1], "{angles:?} {areas:?}");
        assert!(stretch[2] <= angles[2].min(areas[2]), "{stretch:?}");
        // The grid, which goes from setting to setting, finds the same maps.
        let grid = grid(&mesh).unwrap();
        let found = grid.iter().find(|spot| spot.options == "--q 0.95 --shape 0.1").unwrap();
        for (warm, cold) in found.errors.iter().zip(angles) {
            assert!((warm / cold - 1.0).abs() < 0.02, "{found:?} {angles:?}");
        }
    }
}
