//! Every reading of the paper's method on the face and the head, ranked by how much of Table 1 they show.

use std::fmt::Write as _;

use qparam_cli::qembed::{Mixing, Weights};
use qparam_cli::qsimplify::RemovalRule;
use qparam_cli::sweep::{Change, Column, Sweep, TABLE_1_Q, Trend, digits, sweep};
use rayon::prelude::*;

use super::Mesh;
use super::reading::{Boundary, Reading};

/// How many readings the table shows.
const SHOWN: usize = 30;

/// A reading on all meshes.
struct Entry {
    reading: Reading,
    sweeps: Vec<Sweep>,
}

/// The ranking as Markdown.
pub(super) fn table(meshes: &[Mesh]) -> Result<String, String> {
    let readings = readings();
    let count = readings.len();
    let mut entries: Vec<Entry> =
        readings.into_par_iter().filter_map(|reading| Entry::new(reading, meshes)).collect();
    let valid = entries.len();
    entries.sort_by(|a, b| b.features().cmp(&a.features()).then(b.weakest().total_cmp(&a.weakest())));
    let mut text = format!(
        "# Readings of the paper's method\n\nWritten by `cargo xtask sweep --search`: {count} readings on {} at q = 1, 0.8, 0.5, 0.2, 0. {valid} of them give valid maps \
         (no flips, no\noverlaps) everywhere; the first {SHOWN} are shown. They are ranked by how many of the three features of Table 1 hold on both meshes together (at most 6), then by the\nsmallest of \
         the factors by which the angle error falls as q → 1 and the area error as q → 0 (below 1: it rises). Table 1 itself has all 6, and 1.58.\n\n",
        meshes.iter().map(|mesh| mesh.name.as_str()).collect::<Vec<_>>().join(" and ")
    );
    text += "| reading | features | smallest factor |";
    for mesh in meshes {
        let _ = write!(text, " {0}: features | angle error | area error | smallest sum |", mesh.name);
    }
    text += &format!("\n| --- | ---: | ---: |{}\n", " --- | --- | --- | --- |".repeat(meshes.len()));
    for entry in entries.iter().take(SHOWN) {
        let _ = write!(
            text,
            "| {} | {} | {} |",
            entry.reading.words(),
            entry.features(),
            digits(entry.weakest())
        );
        for sweep in &entry.sweeps {
            let found = &sweep.features;
            let way = |change: &Change| {
                let mark = if change.trend == Trend::Falls { "" } else { " (no)" };
                format!("{} → {}{mark}", digits(change.first), digits(change.last))
            };
            let smallest =
                found.smallest.map_or_else(String::new, |s| format!("{} at {}", digits(s.sum), s.q));
            let _ = write!(
                text,
                " {} | {} | {} | {smallest} |",
                found.held(),
                way(&found.angle),
                way(&found.area)
            );
        }
        text += "\n";
    }
    Ok(text)
}

impl Entry {
    /// `None` when a map is missing or not valid.
    fn new(reading: Reading, meshes: &[Mesh]) -> Option<Self> {
        let run = |mesh: &Mesh| {
            let options = reading.options(&mesh.mesh).ok()?;
            let sweep = sweep(&mesh.mesh, &options, &TABLE_1_Q, &()).ok()?;
            sweep.columns.iter().all(Column::is_valid).then_some(sweep)
        };
        let sweeps = meshes.iter().map(run).collect::<Option<Vec<_>>>()?;
        Some(Self { reading, sweeps })
    }

    fn features(&self) -> usize {
        self.sweeps.iter().map(|sweep| sweep.features.held()).sum()
    }

    /// The smallest factor of a fall.
    fn weakest(&self) -> f64 {
        let factors = self.sweeps.iter().flat_map(|sweep| [sweep.features.angle, sweep.features.area]);
        factors.map(|change| change.first / change.last).fold(f64::INFINITY, f64::min)
    }
}

/// Rule × weights × boundary × mixing × exponent, without the repetitions.
fn readings() -> Vec<Reading> {
    let mut readings = Vec::new();
    for rule in [RemovalRule::Guarded, RemovalRule::Ring, RemovalRule::Carrier, RemovalRule::All] {
        // With all interior vertices gone, no edge is left for the exponent of Eq. 5.
        let exponents: &[f64] = if rule == RemovalRule::All { &[1.0] } else { &[0.0, 1.0, 2.0] };
        for weights in [Weights::Star4, Weights::Star1, Weights::Printed] {
            for boundary in [Boundary::Circle, Boundary::Square, Boundary::Projection, Boundary::Lscm] {
                for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                    for &exponent in exponents {
                        readings.push(Reading { rule, weights, mixing, boundary, exponent });
                    }
                }
            }
        }
    }
    readings
}
