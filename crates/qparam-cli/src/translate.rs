//! Refusals of the libraries in the numbers of the file: counted from 1, with lines.

use std::collections::BTreeSet;

use qoptimize::direct::StartError;
use qoptimize::qembed::EmbedError;
use qoptimize::qmesh::{BuildError, QuadMesh, VertexId};
use qoptimize::{AtlasError, Certificate, ParameterizeError, SymmetryError};

use crate::disk::describe;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::table::{counted, short};

/// Why the polygons of `input` are no mesh.
pub(crate) fn refused(error: &BuildError, input: &Input) -> Failure {
    let document = &input.document;
    let face = |face: u32| format!("face {} (line {})", face + 1, document.face_line(face as usize));
    let vertex =
        |vertex: u32| format!("vertex {} (line {})", vertex + 1, document.vertex_line(vertex as usize));
    let fail = |class, text: String, help: &str| {
        Failure::new(class, format!("{}: {text}", input.name)).help(help.to_owned())
    };
    match error {
        BuildError::NoFaces => fail(
            Exit::Input,
            "there are no faces".into(),
            "a mesh needs lines `f a b c d`; points and lines alone have no surface",
        ),
        BuildError::TooFewCorners { face: f, corners } => fail(
            Exit::Input,
            format!("{} has {corners} corners, but needs at least three", face(*f)),
            "delete that line, or repair the export",
        ),
        BuildError::IndexOutOfRange { face: f, vertex, count } => fail(
            Exit::Input,
            format!("{} names vertex {}, but there are only {count}", face(*f), u64::from(*vertex) + 1),
            "the file is cut off, or its indices do not belong to it",
        ),
        BuildError::NonFiniteCoordinate { vertex: v } => fail(
            Exit::Input,
            format!("{} has a coordinate that is not finite, or beyond 1e60", vertex(*v)),
            "repair the coordinates of that vertex",
        ),
        BuildError::RepeatedVertex { face: f, vertex: v } => fail(
            Exit::Mesh,
            format!("{} visits {} more than once", face(*f), vertex(*v)),
            "dissolve the degenerate face in a modelling program (merge by distance does)",
        ),
        BuildError::NonManifoldEdge { vertices: [a, b], faces } => {
            const SHOWN: usize = 6;
            let mut list: Vec<_> = faces.iter().take(SHOWN).map(|&f| face(f)).collect();
            if faces.len() > SHOWN {
                list.push("…".into());
            }
            fail(
                Exit::Mesh,
                format!(
                    "the edge between {} and {} is not manifold: {} faces share it",
                    vertex(*a),
                    vertex(*b),
                    faces.len()
                ),
                "split the mesh there: at most two faces may share an edge",
            )
            .note(format!("they are {}", list.join(", ")))
        }
        BuildError::DuplicateFaces { faces: [f, g] } => fail(
            Exit::Mesh,
            format!("{} and {} are the same face twice", face(*f), face(*g)),
            "delete one of the two lines; if the surface is meant to be double, give each side vertices of its own",
        ),
        BuildError::InconsistentOrientation { vertices: [a, b], faces: [f, g] } => fail(
            Exit::Mesh,
            format!(
                "{} and {} run the same way along the edge from {} to {}: one of them is turned over",
                face(*f),
                face(*g),
                vertex(*a),
                vertex(*b)
            ),
            "make the normals consistent; a Möbius strip has to be cut first",
        ),
        BuildError::NonManifoldVertex { vertex: v, faces: [f, g] } => fail(
            Exit::Mesh,
            format!(
                "{} is not manifold: {} and {} lie in separate fans that touch only there",
                vertex(*v),
                face(*f),
                face(*g)
            ),
            "give each fan a vertex of its own",
        ),
        other => Failure::new(Exit::Mesh, format!("{}: the faces are no mesh", input.name)).cause(other),
    }
}

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
        AtlasError::Island {
            mesh,
            error: ParameterizeError::Embed(EmbedError::Closed { .. } | EmbedError::Handles { .. }),
            first_face,
        } => {
            let line = input.document.face_line(*first_face as usize);
            let place = format!("the island of face {} (line {line})", first_face + 1);
            let message =
                format!("{}: {place} cannot be flattened: {}", input.name, describe(&mesh.topology()));
            Failure::new(Exit::Mesh, message)
                .help("leave --seams none out: it is cut open automatically then")
        }
        AtlasError::KeptFaceFlipped { face } => Failure::new(
            Exit::Computation,
            format!(
                "{}: face {} (line {}) cannot keep its UVs: it is turned over in the plane, or has no area there",
                input.name,
                face + 1,
                input.document.face_line(*face as usize)
            ),
        )
        .help("`qparam check` names all such faces; leave them out of the group"),
        AtlasError::Island { mesh, error, .. } if islands == 1 => no_map(error, mesh, input),
        AtlasError::Island { mesh, error, first_face } => {
            let line = input.document.face_line(*first_face as usize);
            no_map(error, mesh, input).note(format!("in the island of face {} (line {line})", first_face + 1))
        }
        other => Failure::new(Exit::Computation, format!("{}: no map was found", input.name)).cause(other),
    }
}

/// Why there is no map of `mesh`, which was built from `input`.
pub(crate) fn no_map(error: &ParameterizeError, mesh: &QuadMesh, input: &Input) -> Failure {
    let number = |vertex: VertexId| mesh.source_vertex(vertex) as usize;
    let vertex = |vertex: VertexId| {
        let number = number(vertex);
        format!("vertex {} (line {})", number + 1, input.document.vertex_line(number))
    };
    let edge = |[a, b]: [VertexId; 2]| format!("{}-{}", number(a) + 1, number(b) + 1);
    let failure = Failure::new(Exit::Computation, format!("{}: no map was found", input.name));
    let embed = match error {
        ParameterizeError::Embed(embed) => embed,
        ParameterizeError::BoundaryMeets { edges: [first, second] } => {
            return failure.note(format!(
                "the boundary meets itself at the edges between the vertices {} and {}",
                edge(*first),
                edge(*second)
            ));
        }
        ParameterizeError::FlatCorner { corner } => {
            return failure
                .note(format!(
                    "face {} lies with three vertices on the boundary, which does not turn left at {}: it cannot be convex there",
                    mesh.face(*corner).index() + 1,
                    vertex(mesh.vertex(*corner))
                ))
                .help("use --boundary free or circle");
        }
        ParameterizeError::Start(StartError::Tangled { corner, count }) => {
            return failure
                .note(format!(
                    "no start without flips was found: {} left, the worst in face {} at {}",
                    counted(*count, "corner"),
                    mesh.face(*corner).index() + 1,
                    vertex(mesh.vertex(*corner))
                ))
                .help("a free or convex boundary leaves more room; cut limbs that are longer than floating point reaches");
        }
        ParameterizeError::Symmetry(SymmetryError::Shape { vertex: v, deviation, .. }) => {
            return failure
                .note(format!(
                    "the mesh has no mirror symmetry: the nearest one misses {} by {} of the size of the mesh",
                    vertex(*v),
                    short(*deviation)
                ))
                .help("leave --symmetric out, or repair the symmetry of the model");
        }
        ParameterizeError::Symmetry(SymmetryError::Connectivity { vertices: [a, b] }) => {
            return failure
                .note(format!(
                    "the mesh has no mirror symmetry: the nearest one would have to swap {} and {}, where the faces differ",
                    vertex(*a),
                    vertex(*b)
                ))
                .help("leave --symmetric out, or repair the symmetry of the model");
        }
        ParameterizeError::PinOnHeldBoundary { vertex: v } => {
            return failure
                .note(format!("{} is pinned, but the boundary is held already", vertex(*v)))
                .help("use --boundary free, or move the vertex in the file of --boundary-uv");
        }
        ParameterizeError::PinTwice { vertex: v } => {
            return failure.note(format!("{} is pinned twice", vertex(*v)));
        }
        ParameterizeError::PinsMeet { vertices: [a, b] } => {
            return failure.note(format!("{} and {} are pinned to the same place", vertex(*a), vertex(*b)));
        }
        ParameterizeError::PinOutOfReach { vertex: v, distance } => {
            return failure
                .note(format!(
                    "the pin of {} stays {} short of its place: on the way a corner would flip, or the boundary pass itself",
                    vertex(*v),
                    short(*distance)
                ))
                .help("move the pin, or leave others out");
        }
        ParameterizeError::Rounding(certificate) => return lost_in_rounding(certificate, failure, input),
        _ => return failure.cause(error),
    };
    match embed {
        EmbedError::TooManyCorners { vertex: v, count } => failure
            .note(format!(
                "the square has four corners, but {count} boundary vertices, among them {}, have a single face, \
                 which would collapse on a side",
                vertex(*v)
            ))
            .help("use --boundary circle"),
        EmbedError::ChordOnSide { edge: chord } => failure
            .note(format!(
                "the edge between the vertices {} would lie along a side of the square, with faces between",
                edge(*chord)
            ))
            .help("use --boundary circle"),
        EmbedError::BoundaryFolds { edges: [first, second] } if first == second => failure
            .note(format!(
                "projected to its best-fit plane, the boundary has no length at the edge between the vertices {}",
                edge(*first)
            ))
            .help("use --boundary circle"),
        EmbedError::BoundaryFolds { edges: [first, second] } => failure
            .note(format!(
                "projected to its best-fit plane, the boundary meets itself at the edges between the vertices {} \
                 and {}",
                edge(*first),
                edge(*second)
            ))
            .help("use --boundary circle"),
        EmbedError::NoPlane => failure
            .note("the boundary has no best-fit plane, since it encloses no area")
            .help("use --boundary circle"),
        EmbedError::FixedNotFinite { vertex: v } => {
            failure.note(format!("the position given for {} is not finite, or beyond 1e60", vertex(*v)))
        }
        EmbedError::Solve(_) => failure
            .cause(embed)
            .help("try another --method or --backend; --residual-bound accepts less accurate solutions"),
        other => failure.cause(other),
    }
}

/// Which faces single precision cannot hold.
fn lost_in_rounding(certificate: &Certificate, failure: Failure, input: &Input) -> Failure {
    const SHOWN: usize = 8;
    let faces: BTreeSet<usize> = certificate
        .violations
        .iter()
        .flat_map(|violation| violation.places.iter().map(|place| place.face))
        .collect();
    let mut list: Vec<String> = faces
        .iter()
        .take(SHOWN)
        .map(|&face| format!("{} (line {})", face + 1, input.document.face_line(face)))
        .collect();
    if faces.len() > SHOWN {
        list.push("…".to_owned());
    }
    failure
        .note(format!("in single precision the map would overlap itself: the certificate {certificate}"))
        .note(format!("at the faces {}", list.join(", ")))
        .help("use --uv-precision f64; or another method, which may give these faces more room")
}
