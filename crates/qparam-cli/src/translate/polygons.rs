//! Why polygons are no mesh.

use qoptimize::qmesh::BuildError;

use super::names;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;

/// Why the polygons of `input` are no mesh.
pub(crate) fn refused(error: &BuildError, input: &Input) -> Failure {
    let other = || Failure::new(Exit::Mesh, format!("{}: the faces are no mesh", input.name)).cause(error);
    unusable(error, input)
        .or_else(|| face_of_no_surface(error, input))
        .or_else(|| no_manifold(error, input))
        .unwrap_or_else(other)
}

/// What no program could read.
fn unusable(error: &BuildError, input: &Input) -> Option<Failure> {
    let face = |face: u32| names::face(face as usize, input);
    let (text, help) = match error {
        BuildError::NoFaces => (
            "there are no faces".into(),
            "a mesh needs lines `f a b c d`; points and lines alone have no surface",
        ),
        BuildError::TooFewCorners { face: f, corners } => (
            format!("{} has {corners} corners, but needs at least three", face(*f)),
            "delete that line, or repair the export",
        ),
        BuildError::IndexOutOfRange { face: f, vertex, count } => (
            format!("{} names vertex {}, but there are only {count}", face(*f), u64::from(*vertex) + 1),
            "the file is cut off, or its indices do not belong to it",
        ),
        BuildError::NonFiniteCoordinate { vertex } => (
            format!(
                "{} has a coordinate that is not finite, or beyond 1e60",
                names::vertex(*vertex as usize, input)
            ),
            "repair the coordinates of that vertex",
        ),
        _ => return None,
    };
    Some(Failure::new(Exit::Input, format!("{}: {text}", input.name)).help(help))
}

/// Faces that are none, or are there twice.
fn face_of_no_surface(error: &BuildError, input: &Input) -> Option<Failure> {
    let face = |face: u32| names::face(face as usize, input);
    let (text, help) = match error {
        BuildError::RepeatedVertex { face: f, vertex } => (
            format!("{} visits {} more than once", face(*f), names::vertex(*vertex as usize, input)),
            "dissolve the degenerate face in a modelling program (merge by distance does)",
        ),
        BuildError::DuplicateFaces { faces: [f, g] } => (
            format!("{} and {} are the same face twice", face(*f), face(*g)),
            "delete one of the two lines; if the surface is meant to be double, give each side vertices of its own",
        ),
        _ => return None,
    };
    Some(Failure::new(Exit::Mesh, format!("{}: {text}", input.name)).help(help))
}

/// Faces that do not fit together.
fn no_manifold(error: &BuildError, input: &Input) -> Option<Failure> {
    let face = |face: u32| names::face(face as usize, input);
    let vertex = |vertex: u32| names::vertex(vertex as usize, input);
    let (text, help) = match error {
        BuildError::NonManifoldEdge { vertices: [a, b], faces } => (
            format!(
                "the edge between {} and {} is not manifold: {} faces share it",
                vertex(*a),
                vertex(*b),
                faces.len()
            ),
            "split the mesh there: at most two faces may share an edge",
        ),
        BuildError::InconsistentOrientation { vertices: [a, b], faces: [f, g] } => (
            format!(
                "{} and {} run the same way along the edge from {} to {}: one of them is turned over",
                face(*f),
                face(*g),
                vertex(*a),
                vertex(*b)
            ),
            "make the normals consistent; a Möbius strip has to be cut first",
        ),
        BuildError::NonManifoldVertex { vertex: v, faces: [f, g] } => (
            format!(
                "{} is not manifold: {} and {} lie in separate fans that touch only there",
                vertex(*v),
                face(*f),
                face(*g)
            ),
            "give each fan a vertex of its own",
        ),
        _ => return None,
    };
    let failure = Failure::new(Exit::Mesh, format!("{}: {text}", input.name)).help(help);
    Some(match error {
        BuildError::NonManifoldEdge { faces, .. } => {
            failure.note(format!("they are {}", listed(faces, face)))
        }
        _ => failure,
    })
}

/// The first faces, by name.
fn listed(faces: &[u32], name: impl Fn(u32) -> String) -> String {
    const SHOWN: usize = 6;
    let mut list: Vec<String> = faces.iter().take(SHOWN).map(|&face| name(face)).collect();
    if faces.len() > SHOWN {
        list.push("…".into());
    }
    list.join(", ")
}
