//! The meshes of the comparison: files, or shapes from formulas, such as `nose:100`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use qparam_cli::qmesh::{QuadMesh, shapes};

use super::places::Places;

/// What a mesh may be called besides a file: a shape of `qmesh::shapes` and its arguments.
pub(super) const FORMULAS: &str = "bump:CELLS, nose:CELLS, saddle:CELLS, cap:RINGS or finger:RINGS,ROWS";

/// The meshes to run on, as absolute paths; by default the face and the head of `fixtures/`.
pub(super) fn files(chosen: &[String], places: &Places) -> Result<Vec<PathBuf>, String> {
    if chosen.is_empty() {
        return Ok(["face.obj", "head.obj"].map(|name| places.root.join("fixtures").join(name)).into());
    }
    chosen.iter().map(|name| file(name, places)).collect()
}

fn file(name: &str, places: &Places) -> Result<PathBuf, String> {
    let path = Path::new(name);
    let failed = |error: std::io::Error| format!("{name}: {error}");
    if path.exists() {
        return std::path::absolute(path).map_err(failed);
    }
    let mesh = by_formula(name).ok_or_else(|| format!("{name}: neither a file nor {FORMULAS}"))?;
    let path = places.meshes.join(format!("{}.obj", name.replace([':', ','], "-")));
    std::fs::write(&path, obj(name, &mesh)).map_err(failed)?;
    Ok(path)
}

/// The shape that `name` calls.
fn by_formula(name: &str) -> Option<QuadMesh> {
    let (shape, arguments) = name.split_once(':')?;
    let numbers: Vec<usize> =
        arguments.split(',').map(|word| word.parse().ok()).collect::<Option<Vec<_>>>()?;
    match (shape, numbers[..].as_ref()) {
        ("bump", &[cells]) => Some(shapes::bump(cells, 0.5)),
        ("nose", &[cells]) => Some(shapes::nose(cells)),
        ("saddle", &[cells]) => Some(shapes::saddle(cells)),
        ("cap", &[rings]) => Some(shapes::cap(rings, 2.6)),
        ("finger", &[rings, rows]) => Some(shapes::finger(rings, rows)),
        _ => None,
    }
}

/// OBJ text with all digits.
fn obj(name: &str, mesh: &QuadMesh) -> String {
    let mut text = format!("# {name}, of qmesh::shapes\n");
    // Writing to a string does not fail.
    for position in mesh.positions().iter() {
        let _ = writeln!(text, "v {} {} {}", position.x, position.y, position.z);
    }
    for face in mesh.faces() {
        text.push('f');
        for corner in mesh.face_corners(face) {
            let _ = write!(text, " {}", mesh.vertex(corner).index() + 1);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use qparam_cli::qmesh::obj::ObjDocument;

    use super::*;

    #[test]
    fn shapes_are_called_by_name_and_read_back_as_they_are() {
        let mesh = by_formula("finger:2,5").unwrap();
        assert_eq!(mesh.face_count(), 48 + 5 * 16);
        let document = ObjDocument::parse(obj("finger:2,5", &mesh).into_bytes()).unwrap();
        let read = QuadMesh::build(document.polygons()).unwrap();
        assert_eq!(read.positions().to_vec(), mesh.positions().to_vec());
        assert_eq!(read.topology(), mesh.topology());
        for wrong in ["nose", "nose:", "nose:1,2", "nose:x", "heart:3"] {
            assert!(by_formula(wrong).is_none(), "{wrong}");
        }
    }
}
