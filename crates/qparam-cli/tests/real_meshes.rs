//! Every mesh of the folder `QPARAM_MESHES` gets UVs, and nothing but UVs changes in any file.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod common;

use std::path::PathBuf;

use common::{Folder, without_uv};

/// Larger meshes are for the benches.
const FACE_LIMIT: u64 = 50_000;
/// Up to here minimising is quick enough for a test.
const DIRECT_LIMIT: u64 = 4_000;

#[test]
fn real_meshes_are_mapped() {
    let Some(meshes) = std::env::var_os("QPARAM_MESHES").map(PathBuf::from) else {
        println!("skipped: QPARAM_MESHES is not set");
        return;
    };
    let mut mapped = 0;
    for name in common::names(&meshes).iter().filter(|name| name.ends_with(".obj")) {
        let input = meshes.join(name);
        let input = input.to_str().unwrap();
        let folder = Folder::new();
        let info = folder.qparam(&["info", input, "--json"]).code(0).json();
        let faces = info["faces"].as_u64().unwrap();
        if faces <= FACE_LIMIT {
            let method = if faces <= DIRECT_LIMIT { "direct" } else { "mean-value" };
            unwrap_and_compare(&folder, name, input, method);
            mapped += 1;
        }
    }
    assert!(mapped > 0, "the folder holds meshes");
}

/// The report speaks of the file as it was written, and the file is the input with UVs.
fn unwrap_and_compare(folder: &Folder, name: &str, input: &str, method: &str) {
    let run = folder.qparam(&["unwrap", input, "-o", "out.obj", "--json", "--method", method]);
    let report = run.json();
    assert_eq!(run.code, if report["valid"] == true { 0 } else { 7 }, "{name}: {}", run.stderr);
    let measured = folder.qparam(&["measure", "out.obj", "--json"]).code(0).json();
    for field in ["angle_error", "area_error", "symmetric_dirichlet", "flipped_corners", "boundary_crossings"]
    {
        let value = |json: &serde_json::Value| json["distortion"][field].as_f64().unwrap();
        let (said, found) = (value(&report), value(&measured["files"][0]));
        assert!((said - found).abs() <= 1e-9 * said.abs(), "{name}, {field}: {said}, {found}");
    }
    let text = |path: &std::path::Path| String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
    let (before, after) = (text(input.as_ref()), text(&folder.path("out.obj")));
    assert!(without_uv(&before) == without_uv(&after), "{name}: more than UVs changed");
}
