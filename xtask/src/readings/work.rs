//! What the stages have to solve and to move, counted instead of timed.

use qparam_cli::qoptimize::{Options, Parameterization};
use qparam_cli::qsimplify::RemovalRule;

use super::inputs::{models, paper, run};
use super::table::{MEANINGLESS, Table, digits};

/// The ways whose work and times are compared. The first is the single system that the others are to be faster than.
pub(super) fn ways() -> Vec<(&'static str, Options)> {
    let with = |rule, fraction| Options { overlaps: Some(Default::default()), ..paper(rule, fraction) };
    vec![
        ("all: one system for every interior vertex", paper(RemovalRule::All, 1.0)),
        ("guarded, half asked", with(RemovalRule::Guarded, 0.5)),
        ("ring, 0.3 asked", with(RemovalRule::Ring, 0.3)),
        ("ring, 0.7 asked", with(RemovalRule::Ring, 0.7)),
        ("naive, 0.1 asked", with(RemovalRule::Naive, 0.1)),
        ("naive, 0.3 asked", with(RemovalRule::Naive, 0.3)),
    ]
}

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(
        "mesh | way | unknowns, global | unknowns, local | matrix entries | of those of `all` | moves of 2.4",
    );
    for (name, mesh) in models() {
        let mut all = None;
        for (way, options) in ways() {
            let Parameterization { record, distortion, .. } = run(&mesh, &options)?;
            let of = |stage: &str| {
                record
                    .solves
                    .iter()
                    .filter(|solve| solve.stage == stage)
                    .map(|s| s.record.unknowns)
                    .sum::<usize>()
            };
            let entries: usize = record.solves.iter().map(|solve| solve.record.nonzeros).sum();
            let base = *all.get_or_insert(entries);
            table.row(&[
                name.to_owned(),
                way.to_owned(),
                of("global").to_string(),
                of("local").to_string(),
                entries.to_string(),
                digits(entries as f64 / base as f64),
                match record.overlaps {
                    None => "–".to_owned(),
                    Some(_) if distortion.area_error > MEANINGLESS => "rounding".to_owned(),
                    Some(report) => report.moves.to_string(),
                },
            ]);
        }
    }
    Ok(format!(
        "Both coordinates share one matrix. Times are not written here; `cargo xtask readings --times` prints their \
         ratios.\n\n{}",
        table.text()
    ))
}
