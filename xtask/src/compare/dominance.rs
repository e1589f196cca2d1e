//! For every valid rival: the setting of our dials that comes nearest to beating it in everything at once.

use qparam_cli::qmesh::QuadMesh;
use serde::{Deserialize, Serialize};

use super::league::{Measures, Outcome, Row};
use super::settings::{self, Setting, Spot};

/// The largest ratio that still counts as no worse.
pub(super) const TOLERANCE: f64 = 1.02;
/// The settings of the grid that are tried, the best by its own figures first.
const CANDIDATES: usize = 3;
/// Steps of the closer look where the grid has no point that is no worse, as factors.
const STEPS: [f64; 5] = [2.0, 1.5, 1.5, 1.2, 1.1];

/// Our point that is nearest to dominating a rival's.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Dominance {
    pub(super) rival: String,
    /// Whether the rival's map is valid.
    pub(super) valid: bool,
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

/// The best of our maps against each rival in one island, valid or not: at a setting of the grid, or near one where none is no
/// worse. The ratios are those of the map that `qparam unwrap` makes with that setting.
pub(super) fn against_all(mesh: &QuadMesh, rows: &[Row], grid: &[Spot]) -> Vec<Dominance> {
    let mut known: Vec<(String, Option<Spot>)> = Vec::new();
    let mut released = |setting: Setting| {
        let options = setting.options();
        if let Some((_, spot)) = known.iter().find(|(name, _)| *name == options) {
            return spot.clone();
        }
        let spot = settings::as_released(mesh, setting);
        known.push((options, spot.clone()));
        spot
    };
    let best = |row: &Row| {
        let (valid, errors) = rival(row)?;
        let (spot, ratios) = nearest(errors, grid, &mut released)?;
        Some(Dominance { rival: row.name.clone(), valid, setting: spot.options, ratios })
    };
    rows.iter().filter_map(best).collect()
}

/// Validity and errors of a rival's map in one piece; a cut map pays for small errors with its seams.
fn rival(row: &Row) -> Option<(bool, [f64; 3])> {
    let Outcome::Measured(figures) = &row.outcome else { return None };
    let counts = !row.ours && figures.torn_quads == 0 && figures.measures.islands == 1;
    counts.then_some((figures.measures.is_valid(), errors(&figures.measures)?))
}

/// Those that count here.
pub(super) fn errors(measures: &Measures) -> Option<[f64; 3]> {
    Some([measures.angle_error, measures.area_error, measures.symmetric_dirichlet?])
}

/// The map whose worst ratio to `theirs` is least, and its ratios.
fn nearest(
    theirs: [f64; 3],
    grid: &[Spot],
    released: &mut dyn FnMut(Setting) -> Option<Spot>,
) -> Option<(Spot, [f64; 3])> {
    let ratios = |spot: &Spot| -> [f64; 3] { std::array::from_fn(|k| spot.errors[k] / theirs[k]) };
    let worst = |spot: &Spot| ratios(spot).into_iter().fold(0.0, f64::max);
    let mut candidates: Vec<&Spot> = grid.iter().collect();
    candidates.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    let mut best: Option<Spot> = None;
    let mut take = |best: &mut Option<Spot>, setting: Setting| {
        let found = released(setting);
        if let Some(spot) = found.filter(|spot| best.as_ref().is_none_or(|best| worst(spot) < worst(best))) {
            *best = Some(spot);
        }
    };
    let is_enough = |best: &Option<Spot>| best.as_ref().is_some_and(|spot| worst(spot) <= TOLERANCE);
    for candidate in candidates.into_iter().take(CANDIDATES) {
        if is_enough(&best) {
            break;
        }
        take(&mut best, candidate.setting);
    }
    for step in STEPS {
        let Some(centre) = best.as_ref().filter(|spot| worst(spot) > TOLERANCE).map(|spot| spot.setting)
        else {
            break;
        };
        settings::around(centre, step).into_iter().for_each(|setting| take(&mut best, setting));
    }
    let best = best?;
    let ratios = ratios(&best);
    Some((best, ratios))
}

#[cfg(test)]
mod tests {
    use qparam_cli::qoptimize::AngleTerm;

    use super::*;

    fn spot(q: f64, errors: [f64; 3]) -> Spot {
        let setting = Setting::new(q, 1.0, AngleTerm::Log);
        Spot { setting, options: setting.options(), errors }
    }

    /// The point whose worst ratio is least wins, not the one that is best in one figure; and where one is no worse, no more maps
    /// are made.
    #[test]
    fn the_nearest_point_is_the_least_bad_in_its_worst_error() {
        let spots = [spot(0.9, [0.1, 3.0, 1.0]), spot(0.5, [0.9, 1.01, 1.0])];
        let mut asked = Vec::new();
        let mut released = |setting: Setting| {
            asked.push(setting.options());
            spots.iter().find(|spot| spot.setting == setting).cloned()
        };
        let (found, ratios) = nearest([1.0, 2.0, 1.0], &spots, &mut released).unwrap();
        assert_eq!((found.options.as_str(), ratios), ("--q 0.5 --shape 1", [0.9, 0.505, 1.0]));
        assert!(nearest([1.0, 1.0, 1.0], &[], &mut released).is_none());
        assert_eq!(asked, ["--q 0.5 --shape 1"]);
    }

    /// What counts is the map as it is released, whatever the grid says of it; and the closer look takes what is better, from there
    /// on, and nothing that is worse.
    #[test]
    fn a_closer_look_follows_the_better_point() {
        let q = |setting: Setting| -> f64 { setting.options().split(' ').nth(1).unwrap().parse().unwrap() };
        let mut released = |setting: Setting| Some(spot(q(setting), [0.7 / q(setting), 1.0, 1.0]));
        let (found, ratios) = nearest([1.0, 1.0, 1.0], &[spot(0.3, [0.1, 0.1, 0.1])], &mut released).unwrap();
        assert!(q(found.setting) > 0.68 && ratios[0] <= TOLERANCE, "{found:?}");
    }
}
