//! Ratios of times. They depend on the machine and its load, so they are printed and not kept.

use std::time::Instant;

use qparam_cli::qmesh::{QuadMesh, shapes};
use qparam_cli::qoptimize::Options;

use super::inputs::run;
use super::table::digits;
use super::work::ways;

/// Each way runs this often; the least time counts, since load only adds.
const RUNS: usize = 7;

/// Prints how long each way takes, in times of the single system of rule `all`; measuring is part of all of them.
pub(super) fn print() -> Result<(), String> {
    for (name, mesh) in [("face(10)", shapes::face(10)), ("head(5)", shapes::head(5))] {
        let mut all = None;
        for (way, options) in ways() {
            let time = least_time(&mesh, &options)?;
            println!("{name}, {way}: {}", digits(time / *all.get_or_insert(time)));
        }
    }
    Ok(())
}

fn least_time(mesh: &QuadMesh, options: &Options) -> Result<f64, String> {
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        run(mesh, options)?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}
