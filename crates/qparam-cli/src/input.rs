//! Reading OBJ files, and meshes out of them.

use std::io::Read;
use std::path::Path;

use qoptimize::qmesh::QuadMesh;
use qoptimize::qmesh::obj::{ObjDocument, ObjError};

use crate::exit::Exit;
use crate::failure::Failure;
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

    /// The faces as a mesh; refusals in the numbers of the file.
    pub(crate) fn mesh(&self) -> Result<QuadMesh, Failure> {
        QuadMesh::build(self.document.polygons()).map_err(|error| refused(&error, self))
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
