//! What surfaces are, in words; `sweep` maps one disk, with or without holes.

use qoptimize::qmesh::{QuadMesh, Topology};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::table::counted;

/// How many places a message names.
const SHOWN: usize = 4;

/// Refuses a mesh that is no disk (perhaps with holes), and says what it is instead.
pub(crate) fn require_patch(mesh: &QuadMesh, input: &Input) -> Result<(), Failure> {
    let topology = mesh.topology();
    if topology.components == 1 && topology.boundary_loops > 0 && topology.genus == 0 {
        return Ok(());
    }
    let message = format!("{}: the mesh is not a disk: {}", input.name, describe(&topology));
    let failure = Failure::new(Exit::Mesh, message);
    Err(if topology.components > 1 {
        failure
            .note(format!("the components start at {}", component_places(mesh, input)))
            .help("write each component into a file of its own and map them one by one")
    } else {
        failure.help("cut it open along edges first; `qparam unwrap` does so by itself")
    })
}

/// The first face of each component.
fn component_places(mesh: &QuadMesh, input: &Input) -> String {
    let (component, count) = mesh.components();
    let mut first = vec![None; count];
    for (face, &part) in component.entries() {
        first[part as usize].get_or_insert(face.index());
    }
    list(
        first
            .iter()
            .flatten()
            .map(|&face| format!("face {} (line {})", face + 1, input.document.face_line(face))),
    )
}

fn list(mut places: impl Iterator<Item = String>) -> String {
    let mut shown: Vec<_> = places.by_ref().take(SHOWN).collect();
    if places.next().is_some() {
        shown.push("…".to_owned());
    }
    shown.join(", ")
}

/// What a surface is, in words.
pub(crate) fn describe(topology: &Topology) -> String {
    if topology.is_disk() {
        return "a disk: one component, one boundary loop".to_owned();
    }
    if topology.components > 1 {
        return format!(
            "it has {} components, {}, genus {}",
            topology.components,
            counted(topology.boundary_loops, "boundary loop"),
            topology.genus
        );
    }
    match (topology.boundary_loops, topology.genus) {
        (0, 0) => "it is closed, a sphere without a boundary".to_owned(),
        (0, 1) => "it is closed, a torus without a boundary".to_owned(),
        (0, genus) => format!("it is closed, with {} and no boundary", counted(genus as usize, "handle")),
        (1, genus) => format!("it has one boundary loop and {}", counted(genus as usize, "handle")),
        (loops, 0) => format!("it has {loops} boundary loops, a disk with {}", counted(loops - 1, "hole")),
        (loops, genus) => format!("it has {loops} boundary loops and {}", counted(genus as usize, "handle")),
    }
}
