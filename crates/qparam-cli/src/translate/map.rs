//! Why a mesh has no map.

use std::collections::BTreeSet;

use qoptimize::direct::StartError;
use qoptimize::qembed::EmbedError;
use qoptimize::qmesh::{FaceId, Id};
use qoptimize::{Certificate, ParameterizeError, SymmetryError};

use super::names::Names;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::table::{counted, short};

/// Why there is no map of a mesh.
pub(crate) fn no_map(error: &ParameterizeError, names: &Names<'_>) -> Failure {
    let failure = none(names.input);
    match error {
        ParameterizeError::Embed(error) => embedding(error, names, failure),
        ParameterizeError::Start(error) => start(error, names, failure),
        ParameterizeError::Symmetry(error) => symmetry(error, names, failure),
        ParameterizeError::Rounding(certificate) => {
            let source = |face: usize| names.source_face(FaceId::from_index(face));
            rounding(certificate, source, names.input)
        }
        ParameterizeError::BoundaryMeets { .. } | ParameterizeError::FlatCorner { .. } => {
            held_boundary(error, names, failure)
        }
        _ => pins(error, names, failure),
    }
}

fn none(input: &Input) -> Failure {
    Failure::new(Exit::Computation, format!("{}: no map was found", input.name))
}

fn held_boundary(error: &ParameterizeError, names: &Names<'_>, failure: Failure) -> Failure {
    match error {
        ParameterizeError::BoundaryMeets { edges: [first, second] } => failure.note(format!(
            "the boundary meets itself at the edges between the vertices {} and {}",
            names.edge(*first),
            names.edge(*second)
        )),
        ParameterizeError::FlatCorner { corner } => failure
            .note(format!(
                "{} lies with three vertices on the boundary, which does not turn left at {}: it cannot be convex there",
                names.face(*corner),
                names.at(*corner)
            ))
            .help("use --boundary free or circle"),
        other => failure.cause(other),
    }
}

fn start(error: &StartError, names: &Names<'_>, failure: Failure) -> Failure {
    match error {
        StartError::Tangled { corner, count } => failure
            .note(format!(
                "no start without flips was found: {} left, the worst in {} at {}",
                counted(*count, "corner"),
                names.face(*corner),
                names.at(*corner)
            ))
            .help("a free or convex boundary leaves more room; cut limbs that are longer than floating point reaches"),
        other => failure.cause(other),
    }
}

fn symmetry(error: &SymmetryError, names: &Names<'_>, failure: Failure) -> Failure {
    const HELP: &str = "leave --symmetric out, or repair the symmetry of the model";
    match error {
        SymmetryError::Shape { vertex, deviation, .. } => failure
            .note(format!(
                "the mesh has no mirror symmetry: the nearest one misses {} by {} of the size of the mesh",
                names.vertex(*vertex),
                short(*deviation)
            ))
            .help(HELP),
        SymmetryError::Connectivity { vertices: [a, b] } => failure
            .note(format!(
                "the mesh has no mirror symmetry: the nearest one would have to swap {} and {}, where the faces differ",
                names.vertex(*a),
                names.vertex(*b)
            ))
            .help(HELP),
        other => failure.cause(other),
    }
}

fn pins(error: &ParameterizeError, names: &Names<'_>, failure: Failure) -> Failure {
    match error {
        ParameterizeError::PinOnHeldBoundary { vertex } => failure
            .note(format!("{} is pinned, but the boundary is held already", names.vertex(*vertex)))
            .help("use --boundary free, or move the vertex in the file of --boundary-uv"),
        ParameterizeError::PinTwice { vertex } => {
            failure.note(format!("{} is pinned twice", names.vertex(*vertex)))
        }
        ParameterizeError::PinsMeet { vertices: [a, b] } => {
            failure.note(format!("{} and {} are pinned to the same place", names.vertex(*a), names.vertex(*b)))
        }
        ParameterizeError::PinOutOfReach { vertex, distance } => failure
            .note(format!(
                "the pin of {} stays {} short of its place: on the way a corner would flip, or the boundary pass itself",
                names.vertex(*vertex),
                short(*distance)
            ))
            .help("move the pin, or leave others out"),
        other => failure.cause(other),
    }
}

fn embedding(error: &EmbedError, names: &Names<'_>, failure: Failure) -> Failure {
    match error {
        EmbedError::FixedNotFinite { vertex } => failure
            .note(format!("the position given for {} is not finite, or beyond 1e60", names.vertex(*vertex))),
        EmbedError::Solve(_) => failure
            .cause(error)
            .help("try another --method or --backend; --residual-bound accepts less accurate solutions"),
        other => match unfit_boundary(error, names) {
            Some(why) => failure.note(why).help("use --boundary circle"),
            None => failure.cause(other),
        },
    }
}

/// Why the boundary does not fit the shape that was asked for.
fn unfit_boundary(error: &EmbedError, names: &Names<'_>) -> Option<String> {
    Some(match error {
        EmbedError::TooManyCorners { vertex, count } => format!(
            "the square has four corners, but {count} boundary vertices, among them {}, have a single face, \
             which would collapse on a side",
            names.vertex(*vertex)
        ),
        EmbedError::ChordOnSide { edge } => format!(
            "the edge between the vertices {} would lie along a side of the square, with faces between",
            names.edge(*edge)
        ),
        EmbedError::BoundaryFolds { edges: [first, second] } if first == second => format!(
            "projected to its best-fit plane, the boundary has no length at the edge between the vertices {}",
            names.edge(*first)
        ),
        EmbedError::BoundaryFolds { edges: [first, second] } => format!(
            "projected to its best-fit plane, the boundary meets itself at the edges between the vertices {} \
             and {}",
            names.edge(*first),
            names.edge(*second)
        ),
        EmbedError::NoPlane => "the boundary has no best-fit plane, since it encloses no area".to_owned(),
        _ => return None,
    })
}

/// Which faces single precision cannot hold; `source` leads to those of the file.
pub(super) fn rounding(certificate: &Certificate, source: impl Fn(usize) -> usize, input: &Input) -> Failure {
    const SHOWN: usize = 8;
    let places = certificate.violations.iter().flat_map(|violation| &violation.places);
    let faces: BTreeSet<usize> = places.map(|place| source(place.face)).collect();
    let name = |&face: &usize| format!("{} (line {})", face + 1, input.document.face_line(face));
    let mut list: Vec<String> = faces.iter().take(SHOWN).map(name).collect();
    if faces.len() > SHOWN {
        list.push("…".to_owned());
    }
    none(input)
        .note(format!("in single precision the map would overlap itself: the certificate {certificate}"))
        .note(format!("at the faces {}", list.join(", ")))
        .help("use --uv-precision f64; or another method, which may give these faces more room")
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::charts::cut;
    use qoptimize::qmesh::obj::ObjDocument;
    use qoptimize::qmesh::{CornerId, Seams};
    use qoptimize::{AtlasError, ParameterizeError};

    use crate::input::Input;
    use crate::translate::no_atlas;

    /// Faces of the second island have the numbers of the file, not those of the island.
    #[test]
    fn faces_have_the_numbers_of_the_file() {
        let square =
            |x: u32| format!("v {x} 0 0\nv {x} 1 0\nv {} 1 0\nv {} 0 0\nf -1 -2 -3 -4\n", x + 1, x + 1);
        let text = square(0) + &square(4);
        let input =
            Input { name: "in.obj".to_owned(), document: ObjDocument::parse(text.into_bytes()).unwrap() };
        let charts = cut(input.document.view(), &Seams::default()).unwrap().charts;
        let error = ParameterizeError::FlatCorner { corner: CornerId(0) };
        let failure = no_atlas(&AtlasError::Island { chart: Box::new(charts[1].clone()), error }, 2, &input);
        let message = failure.render(false);
        assert!(message.contains("face 2 (line 10) lies with three vertices on the boundary"), "{message}");
        assert!(message.contains("at vertex 8 (line 9)"), "{message}");
    }
}
