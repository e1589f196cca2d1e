//! The league as data: what the JSON holds and the Markdown is drawn from.

use serde::{Deserialize, Serialize};

use super::contestant::Absent;
use super::dominance::Dominance;
use super::machine::Machine;
use super::settings::Spot;

/// Changes when a field of the JSON is renamed, removed, or means something else.
pub(super) const SCHEMA_VERSION: u32 = 2;

/// Everything.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct League {
    pub(super) schema_version: u32,
    /// What the task was told, without folders.
    pub(super) arguments: String,
    pub(super) machine: Machine,
    pub(super) versions: Vec<String>,
    pub(super) runs: u32,
    pub(super) timeout_seconds: f64,
    /// The method that ratios are taken against.
    pub(super) baseline: String,
    pub(super) meshes: Vec<MeshTable>,
    /// Rivals that are not installed.
    pub(super) absent: Vec<Absent>,
    /// Whether our methods were run again after the rivals.
    #[serde(default)]
    pub(super) ours_again: bool,
}

/// One mesh.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct MeshTable {
    pub(super) name: String,
    pub(super) about: About,
    pub(super) rows: Vec<Row>,
    /// Where `qparam measure` and the independent script differ.
    pub(super) disagreements: Vec<String>,
    /// Our maps over the settings of `direct`, when they were asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) grid: Vec<Spot>,
    /// Our best setting against each rival in one island, when it was asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) dominance: Vec<Dominance>,
}

/// What a mesh is.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct About {
    pub(super) vertices: usize,
    pub(super) faces: usize,
    pub(super) quads: usize,
    /// Why it was refused.
    pub(super) not_a_disk: Option<String>,
}

/// One method on one mesh.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) ours: bool,
    /// How quads reach it.
    pub(super) input: String,
    /// What it does with the boundary.
    pub(super) boundary: String,
    pub(super) outcome: Outcome,
}

/// How it went.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Outcome {
    /// No result.
    Failed { message: String },
    /// A result, good or bad.
    Measured(Box<Figures>),
}

/// A result's figures; times and memory are medians.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Figures {
    #[serde(flatten)]
    pub(super) measures: Measures,
    /// Quads that are not one polygon in the plane.
    pub(super) torn_quads: usize,
    /// Wall time of the computation alone, inside the process.
    pub(super) solve_seconds: f64,
    /// Wall time of the process: starting, reading, computing, writing.
    pub(super) process_seconds: f64,
    /// Processor time of the process.
    pub(super) cpu_seconds: f64,
    pub(super) peak_memory_bytes: u64,
    /// Whether all runs wrote the same bytes.
    pub(super) repeatable: bool,
}

/// What both measurers compute, under the field names of `qparam measure --json`.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Measures {
    pub(super) faces: usize,
    pub(super) islands: usize,
    pub(super) mirrored_islands: usize,
    pub(super) angle_error: f64,
    pub(super) area_error: f64,
    /// Of the corner triangles that are not flipped; none when all are.
    pub(super) symmetric_dirichlet: Option<f64>,
    pub(super) flipped_corners: usize,
    pub(super) flipped_faces: usize,
    pub(super) folded_faces: usize,
    pub(super) boundary_crossings: usize,
}

impl MeshTable {
    /// Takes the rivals' rows from an earlier table of the same mesh, and where nothing newer is looked for, what was found then.
    pub(super) fn keep_rivals(&mut self, earlier: Self) {
        self.rows.extend(earlier.rows.into_iter().filter(|row| !row.ours));
        let of_rivals = |text: &String| !text.starts_with("qparam");
        self.disagreements.extend(earlier.disagreements.into_iter().filter(of_rivals));
        (self.grid, self.dominance) = (earlier.grid, earlier.dominance);
    }

    /// The file's name without its ending.
    pub(super) fn title(&self) -> String {
        self.name.trim_end_matches(".obj").to_owned()
    }
}

impl Measures {
    /// No flips and no overlaps within an island.
    pub(super) fn is_valid(&self) -> bool {
        self.flipped_corners == 0 && self.folded_faces == 0 && self.boundary_crossings == 0
    }
}

impl League {
    /// An error when the two measurers disagree anywhere, or when the method that ratios are taken against failed.
    pub(super) fn verdict(&self) -> Result<(), String> {
        let mut faults = Vec::new();
        for mesh in &self.meshes {
            let name = &mesh.name;
            faults.extend(
                mesh.disagreements.iter().map(|text| format!("{name}: the measurers disagree: {text}")),
            );
            for row in mesh.rows.iter().filter(|row| row.name == self.baseline) {
                if let Outcome::Failed { message } = &row.outcome {
                    faults.push(format!("{name}: {} failed: {message}", row.name));
                }
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
    }
}
