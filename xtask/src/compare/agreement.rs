//! Two measurers, one truth: `qparam measure` against the independent script.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use super::league::{Figures, Measures, Outcome};
use super::ours::Qparam;
use super::race::{Finish, Race};
use super::shell;

/// Relative difference above which two figures disagree.
pub(super) const TOLERANCE: f64 = 1e-6;
/// Errors beyond this are those of triangles whose area is a rounding error: no digit of them means anything.
const MEANINGLESS: f64 = 1e15;

/// The independent script's report on one file.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Independent {
    #[serde(flatten)]
    pub(super) measures: Measures,
    torn_quads: usize,
    pub(super) rounding: Rounding,
}

/// How far each figure moves when computed in extended instead of double precision, relative.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Rounding {
    pub(super) angle_error: f64,
    pub(super) area_error: f64,
    pub(super) symmetric_dirichlet: f64,
}

/// What the two measurers make of a result.
pub(super) struct Judgement {
    pub(super) outcome: Outcome,
    pub(super) disagreements: Vec<String>,
}

/// Measures a result twice. One that both refuse, such as coordinates that are not finite, is a failure of the rival.
pub(super) fn judge(race: &Race<'_>, ours: &Qparam, mesh: &Path, finish: &Finish) -> Judgement {
    let measures = ours.measure(&finish.output);
    let independent = independent(race, mesh, &finish.output);
    match (measures, independent) {
        (Ok(measures), Ok(independent)) => Judgement {
            disagreements: disagreements(&measures, &independent),
            outcome: Outcome::Measured(Box::new(figures(measures, &independent, finish))),
        },
        (Err(_), Err(message)) => {
            Judgement { outcome: Outcome::Failed { message }, disagreements: Vec::new() }
        }
        (Ok(_), Err(message)) => refused_by_one("the script", message),
        (Err(message), Ok(_)) => refused_by_one("qparam measure", message),
    }
}

fn refused_by_one(measurer: &str, message: String) -> Judgement {
    let disagreements = vec![format!("only {measurer} refuses it: {message}")];
    Judgement { outcome: Outcome::Failed { message }, disagreements }
}

fn figures(measures: Measures, independent: &Independent, finish: &Finish) -> Figures {
    Figures {
        measures,
        torn_quads: independent.torn_quads,
        solve_seconds: finish.solve_seconds,
        process_seconds: finish.process_seconds,
        cpu_seconds: finish.cpu_seconds,
        peak_memory_bytes: finish.peak_memory_bytes,
        repeatable: finish.repeatable,
    }
}

fn independent(race: &Race<'_>, mesh: &Path, output: &Path) -> Result<Independent, String> {
    let mut command = Command::new(&race.interpreter.program);
    command.arg(race.places.scripts.join("measure.py")).arg("--original").arg(mesh).arg(output);
    command.envs(race.places.run_environment());
    let text = shell::output(&mut command)?;
    let value: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| format!("measure.py: {error}"))?;
    match value.get("error").and_then(|error| error.as_str()) {
        Some(error) => Err(error.to_owned()),
        None => serde_json::from_value(value).map_err(|error| format!("measure.py: {error}")),
    }
}

/// Where the two differ by more than the tolerance. A figure that double precision itself does not determine, such as
/// Eq. 14 of a map with areas near nothing, may differ by ten times its rounding.
pub(super) fn disagreements(ours: &Measures, script: &Independent) -> Vec<String> {
    let theirs = &script.measures;
    let rounding = &script.rounding;
    let figures = [
        ("angle_error", Some(ours.angle_error), Some(theirs.angle_error), rounding.angle_error),
        ("area_error", Some(ours.area_error), Some(theirs.area_error), rounding.area_error),
        (
            "symmetric_dirichlet",
            ours.symmetric_dirichlet,
            theirs.symmetric_dirichlet,
            rounding.symmetric_dirichlet,
        ),
    ];
    let counts = [
        ("faces", ours.faces, theirs.faces),
        ("islands", ours.islands, theirs.islands),
        ("mirrored_islands", ours.mirrored_islands, theirs.mirrored_islands),
        ("flipped_corners", ours.flipped_corners, theirs.flipped_corners),
        ("flipped_faces", ours.flipped_faces, theirs.flipped_faces),
        ("folded_faces", ours.folded_faces, theirs.folded_faces),
        ("boundary_crossings", ours.boundary_crossings, theirs.boundary_crossings),
    ];
    let mut found = Vec::new();
    for (name, a, b, rounding) in figures {
        let agree = match (a, b) {
            (Some(a), Some(b)) => {
                a.min(b) > MEANINGLESS
                    || (a - b).abs() <= TOLERANCE.max(10.0 * rounding) * a.abs().max(b.abs())
            }
            (a, b) => a.is_none() && b.is_none(),
        };
        if !agree {
            let text = |x: Option<f64>| x.map_or_else(|| "undefined".to_owned(), |x| x.to_string());
            found.push(format!("{name}: qparam {}, script {}", text(a), text(b)));
        }
    }
    for (name, a, b) in counts.into_iter().filter(|(_, a, b)| a != b) {
        found.push(format!("{name}: qparam {a}, script {b}"));
    }
    found
}
