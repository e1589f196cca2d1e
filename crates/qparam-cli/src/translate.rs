//! Refusals of the libraries in the numbers of the file: counted from 1, with lines.

mod map;
mod names;
mod polygons;

use qoptimize::qembed::EmbedError;
use qoptimize::qmesh::Chart;
use qoptimize::{AtlasError, ParameterizeError};

use crate::disk::describe;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;

pub(crate) use map::no_map;
pub(crate) use names::Names;
pub(crate) use polygons::refused;

/// Why there are no UVs.
pub(crate) fn no_atlas(error: &AtlasError, islands: usize, input: &Input) -> Failure {
    match error {
        AtlasError::Cancelled => Failure::interrupted(),
        AtlasError::OutOfTime => Failure::new(
            Exit::OutOfTime,
            format!("{}: the time limit was over before there was a map: nothing was written", input.name),
        )
        .help("give it more seconds with --time-limit, or a coarser mesh"),
        AtlasError::Build(error) => refused(error, input),
        AtlasError::KeptFaceFlipped { face } => Failure::new(
            Exit::Computation,
            format!(
                "{}: {} cannot keep its UVs: it is turned over in the plane, or has no area there",
                input.name,
                names::face(*face as usize, input)
            ),
        )
        .help("`qparam check` names all such faces; leave them out of the group"),
        AtlasError::Rounding(certificate) => map::rounding(certificate, |face| face, input),
        AtlasError::Island { chart, error } => no_island(chart, error, islands, input),
        other => Failure::new(Exit::Computation, format!("{}: no map was found", input.name)).cause(other),
    }
}

/// Why an island has no map.
fn no_island(chart: &Chart, error: &ParameterizeError, islands: usize, input: &Input) -> Failure {
    let first = chart.faces.first().map_or(0, |&face| face as usize);
    let place = format!("the island of {}", names::face(first, input));
    if let ParameterizeError::Embed(EmbedError::Closed { .. } | EmbedError::Handles { .. }) = error {
        let why = describe(&chart.mesh.topology());
        return Failure::new(Exit::Mesh, format!("{}: {place} cannot be flattened: {why}", input.name))
            .help("leave --seams none out: it is cut open automatically then");
    }
    let failure = no_map(error, &Names::of_part(&chart.mesh, &chart.faces, input));
    if islands == 1 { failure } else { failure.note(format!("in {place}")) }
}
