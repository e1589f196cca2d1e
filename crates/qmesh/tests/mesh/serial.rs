//! Meshes as data.

use proptest::collection::vec;
use proptest::prelude::*;
use qmesh::{Polygons, QuadMesh, Seams, charts};

use crate::samples::{faces, grid, patchwork};

proptest! {
    /// Storing and loading changes nothing, the way back to the caller's vertices included: of meshes, of charts, in which several
    /// vertices have one source, and of both with their holes filled.
    #[test]
    fn meshes_come_back(polygons in patchwork(), seams in vec((0u32..30, 0u32..8), 0..12)) {
        let seams: Seams = seams.into_iter().map(|(a, step)| [a, a + step]).collect();
        let cut = charts::cut(polygons.view(), &seams).map_or(Vec::new(), |cut| cut.charts);
        let meshes = cut.into_iter().map(|chart| chart.mesh).chain(QuadMesh::build(polygons));
        for mesh in meshes.flat_map(|mesh| [mesh.filled(), Some(mesh)]).flatten() {
            // What `serde_json` reads back to the last digit.
            let places = mesh.vertex_data(|vertex| mesh.position(vertex).map(|x| (1024.0 * x).round() / 1024.0));
            let mesh = mesh.with_positions(places);
            let stored = serde_json::to_string(&mesh).expect("JSON");
            prop_assert_eq!(serde_json::from_str::<QuadMesh>(&stored).expect("the same mesh"), mesh);
        }
    }
}

#[test]
fn what_is_loaded_is_checked() {
    let used = faces([[1, 2, 5, 4]]);
    let good = serde_json::to_value(QuadMesh::build(used).expect("a mesh")).expect("JSON");
    for (pointer, value) in [
        ("/corner-vertex/0", 7.into()),
        ("/corner-vertex/0", 1.into()),
        ("/face-start/1", 3.into()),
        ("/source/vertices/0", 9.into()),
        ("/source/vertices", serde_json::json!([1, 2])),
        ("/source/vertex-count", 3.into()),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).expect("a stored value") = value;
        assert!(serde_json::from_value::<QuadMesh>(bad).is_err(), "{pointer}");
    }
    let polygons: Polygons =
        serde_json::from_str(&serde_json::to_string(&grid(2, 1)).expect("JSON")).expect("polygons");
    assert_eq!(polygons, grid(2, 1));
}
