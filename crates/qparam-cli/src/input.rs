//! Reading OBJ files, and meshes out of them.

use std::fmt::Display;
use std::io::Read;
use std::path::Path;

use qoptimize::qmesh::obj::{ObjDocument, ObjError};
use qoptimize::qmesh::{QuadMesh, Topology};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::table::counted;
use crate::translate::refused;

/// A file that was read and parsed.
pub(crate) struct Input {
    /// What messages call it.
    pub(crate) name: String,
    pub(crate) document: ObjDocument,
}

/// What messages call a path.
pub(crate) fn name_of(path: &Path) -> String {
    if path.as_os_str() == "-" { "<stdin>".to_owned() } else { path.display().to_string() }
}

/// The bytes of a file, or of standard input for `-`.
pub(crate) fn read_bytes(path: &Path, stdin: &mut dyn Read) -> Result<Vec<u8>, Failure> {
    let read = if path.as_os_str() == "-" {
        let mut bytes = Vec::new();
        stdin.read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    read.map_err(|error| {
        let failure = Failure::new(Exit::Input, format!("{} could not be read", name_of(path))).cause(&error);
        match error.kind() {
            std::io::ErrorKind::NotFound => failure.help("check the path; `-` reads standard input"),
            std::io::ErrorKind::IsADirectory => failure.help("name one file in that folder"),
            _ => failure,
        }
    })
}

impl Input {
    pub(crate) fn read(path: &Path, stdin: &mut dyn Read) -> Result<Self, Failure> {
        let name = name_of(path);
        let document =
            ObjDocument::parse(read_bytes(path, stdin)?).map_err(|error| unparsed(&name, &error))?;
        Ok(Self { name, document })
    }

    /// `file:line` of a face.
    pub(crate) fn at_face(&self, face: u32) -> String {
        at(&self.name, self.document.face_line(face as usize))
    }

    /// `file:line` of a vertex.
    pub(crate) fn at_vertex(&self, vertex: u32) -> String {
        at(&self.name, self.document.vertex_line(vertex as usize))
    }

    /// The faces as a mesh; refusals in the numbers of the file.
    pub(crate) fn mesh(&self) -> Result<QuadMesh, Failure> {
        QuadMesh::build(self.document.polygons()).map_err(|error| refused(&error, self))
    }
}

fn at(name: &str, line: impl Display) -> String {
    format!("{name}:{line}")
}

/// A mesh that is not a disk, and what it is instead.
pub(crate) fn require_disk(mesh: &QuadMesh, input: &Input) -> Result<(), Failure> {
    let topology = mesh.topology();
    if topology.is_disk() {
        return Ok(());
    }
    let message = format!("{}: the mesh is not a disk: {}", input.name, describe(&topology));
    let mut failure = Failure::new(Exit::Mesh, message);
    let loops = mesh.boundary_loops();
    if topology.components > 1 {
        let (component, count) = mesh.components();
        let mut first = vec![None; count];
        for (face, &part) in component.entries() {
            first[part as usize].get_or_insert(face.0);
        }
        let places: Vec<_> = first.iter().flatten().take(4).map(|&face| input.at_face(face)).collect();
        failure = failure
            .note(format!("the components start at {}", places.join(", ")))
            .help("write each component into a file of its own and unwrap them one by one");
    } else if loops.is_empty() {
        failure = failure.help("cut it open along edges first, so that it has one boundary");
    } else if loops.len() > 1 {
        let places: Vec<_> = loops
            .iter()
            .take(4)
            .map(|walk| {
                let vertex = mesh.source_vertex(mesh.origin(walk[0]));
                format!(
                    "vertex {} ({}, {})",
                    vertex + 1,
                    input.at_vertex(vertex),
                    counted(walk.len(), "edge")
                )
            })
            .collect();
        failure = failure
            .note(format!("the boundary loops pass {}", places.join(", ")))
            .help("fill the holes, or cut the mesh along edges that join the loops");
    } else {
        failure = failure.help("cut the handles open along edges first");
    }
    Err(failure)
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

/// `file:line:column: what`, and the line with a mark beneath the mistake.
pub(crate) fn unparsed(name: &str, error: &ObjError) -> Failure {
    let ObjError::Mistake(mistake) = error else {
        return Failure::new(Exit::Input, format!("{name}: {error}"));
    };
    let (line, column) = (mistake.line, mistake.column);
    let text = mistake.to_string();
    let what = text.strip_prefix(&format!("line {line}, column {column}: ")).unwrap_or(&text);
    let source: String =
        mistake.source_line.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect();
    Failure::new(Exit::Input, format!("{name}:{line}:{column}: {what}"))
        .note(format!("  {source}"))
        .note(format!("  {}^", " ".repeat(mistake.source_column)))
}
