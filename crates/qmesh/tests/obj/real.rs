//! Meshes made by others, from the folder that `QPARAM_MESHES` names.

use std::fs::File;
use std::path::{Path, PathBuf};

use qmesh::QuadMesh;
use qmesh::obj::ObjDocument;

use crate::independent::assert_same_faces;
use crate::slow::without_uv;
use crate::trimmings::some_uv;

#[expect(clippy::print_stdout, reason = "a skipped test should say so")]
fn real_meshes() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("QPARAM_MESHES") else {
        println!("skipped: QPARAM_MESHES is not set");
        return Vec::new();
    };
    let entries = std::fs::read_dir(folder).expect("QPARAM_MESHES is a folder");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "obj"));
    paths.sort();
    assert!(!paths.is_empty(), "QPARAM_MESHES has no .obj file");
    paths
}

fn open(path: &Path) -> File {
    File::open(path).expect("a readable file")
}

/// Output differs from input in `vt` lines and middle indices only; the UVs are read back exactly.
#[test]
fn every_real_mesh_comes_back() {
    for path in real_meshes() {
        let name = path.display();
        let document = ObjDocument::read(open(&path)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let uv = some_uv(document.corner_count(), 5);
        let mut out = Vec::new();
        let summary = document.write_with_uv(&mut out, &uv).expect("writing to memory");
        assert!(without_uv(&out) == without_uv(document.bytes()), "{name}: more than UVs has changed");
        assert_eq!(summary.removed, document.texture_coordinates().len(), "{name}");
        let again = ObjDocument::parse(out).unwrap_or_else(|error| panic!("{name}, rewritten: {error}"));
        assert!(again.polygons() == document.polygons(), "{name}: polygons");
        assert!(again.corner_uv() == Some(uv), "{name}: UVs");
    }
}

/// Every one of them is a mesh, and another reader sees the same faces before and after.
#[test]
fn every_real_mesh_is_a_mesh_and_reads_the_same_elsewhere() {
    for path in real_meshes() {
        let name = path.display().to_string();
        let document = ObjDocument::read(open(&path)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let mesh = QuadMesh::build(document.polygons()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(mesh.face_count(), document.face_count(), "{name}");
        assert_same_faces(&name, document.bytes());
        let mut out = Vec::new();
        let uv = some_uv(document.corner_count(), 6);
        document.write_with_uv(&mut out, &uv).expect("writing to memory");
        assert_same_faces(&name, &out);
    }
}
