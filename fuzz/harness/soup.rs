//! Any polygons: a mesh or a refusal, and charts in which every corner lies once, each of which can be opened into planar patches.

use qparam_cli::qcurv::seams::{creases, opening};
use qparam_cli::qcurv::{VertexArea, gaussian_curvature};
use qparam_cli::qembed::check_patch;
use qparam_cli::qmesh::{Chart, HalfedgeId, Id, PolygonView, Polygons, QuadMesh, Seams, Vec3, charts};

use super::bytes::Bytes;

pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (polygons, seams) =
        if bytes.byte().is_multiple_of(4) { arrays(&mut bytes) } else { lists(&mut bytes) };
    if let Ok(mesh) = QuadMesh::build(polygons.clone()) {
        check_mesh(&mesh);
    }
    let Ok(cut) = charts::cut(polygons.view(), &seams) else { return };
    check_charts(polygons.view(), &cut.charts);
    for chart in &cut.charts {
        let Ok(edges) = opening(&chart.mesh, &()) else { panic!("nobody interrupts") };
        let pieces = chart.cut(&edges);
        assert!(
            pieces.iter().all(|piece| check_patch(&piece.mesh).is_ok()),
            "opened charts are planar patches"
        );
        let _ = creases(&chart.mesh, 30.0);
    }
}

/// Flat arrays that may contradict each other.
fn arrays(bytes: &mut Bytes<'_>) -> (Polygons, Seams) {
    let positions = (0..bytes.below(12)).map(|_| Vec3::new(bytes.coordinate(), f64::NAN, 0.0)).collect();
    let face_start = (0..bytes.below(8)).map(|_| u32::from(bytes.byte())).collect();
    let vertex = |byte: u8| if byte == 255 { u32::MAX } else { u32::from(byte) };
    let corner_vertex = bytes.0.iter().map(|&byte| vertex(byte)).collect();
    (Polygons { positions, face_start, corner_vertex }, Seams::default())
}

/// Faces with any vertices, here and there one that does not exist or a place that is no place.
fn lists(bytes: &mut Bytes<'_>) -> (Polygons, Seams) {
    let count = 3 + bytes.below(30);
    let spread = bytes.byte();
    let place = |v: usize, bytes: &mut Bytes<'_>| match spread {
        0..200 => [(2.4 * v as f64).cos() * v as f64, (2.4 * v as f64).sin() * v as f64, 0.3 * v as f64],
        _ => [bytes.coordinate(), bytes.coordinate(), bytes.coordinate()],
    };
    let positions: Vec<[f64; 3]> = (0..count).map(|v| place(v, bytes)).collect();
    let seams = (0..bytes.below(6)).map(|_| [bytes.below(count) as u32, bytes.below(count) as u32]).collect();
    let mut polygons = Polygons::new(&positions, Vec::<Vec<u32>>::new());
    while !bytes.is_empty() {
        let degree = [4, 4, 4, 3, 5, 6, 9, 2][bytes.below(8)];
        let face: Vec<u32> = (0..degree).map(|_| bytes.below(count) as u32).collect();
        polygons.push_face(&face);
    }
    (polygons, seams)
}

/// Connectivity as it is promised.
fn check_mesh(mesh: &QuadMesh) {
    for halfedge in (0..mesh.halfedge_count()).map(HalfedgeId::from_index) {
        let (twin, next) = (mesh.twin(halfedge), mesh.next(halfedge));
        assert!(twin != halfedge && mesh.twin(twin) == halfedge);
        assert_eq!(mesh.origin(next), mesh.target(halfedge));
        assert_eq!(mesh.edge(twin), mesh.edge(halfedge));
        assert!(!(mesh.is_boundary_halfedge(halfedge) && mesh.is_boundary_halfedge(twin)));
    }
    for vertex in mesh.vertices() {
        let gaps = mesh.outgoing(vertex).filter(|&halfedge| mesh.is_boundary_halfedge(halfedge)).count();
        assert_eq!(gaps, usize::from(mesh.is_boundary(vertex)));
    }
    let topology = mesh.topology();
    let loops: usize = mesh.boundary_loops().iter().map(Vec::len).sum();
    assert_eq!(loops, mesh.halfedge_count() - mesh.corner_count());
    let euler = 2 * (topology.components as i64 - topology.genus) - topology.boundary_loops as i64;
    assert_eq!(topology.euler_characteristic, euler, "Euler's formula");
    assert_eq!(gaussian_curvature(mesh, VertexArea::default()).len(), mesh.vertex_count());
}

/// Every corner lies in exactly one chart, at the vertex that it had.
fn check_charts(view: PolygonView<'_>, charts: &[Chart]) {
    let mut seen = vec![0; view.corner_count()];
    for chart in charts {
        check_mesh(&chart.mesh);
        assert_eq!(chart.mesh.components().1, 1, "a chart is connected");
        for corner in chart.mesh.corners() {
            let source = chart.source_corner(corner) as usize;
            seen[source] += 1;
            assert_eq!(chart.mesh.source_vertex(chart.mesh.vertex(corner)), view.corner_vertex[source]);
        }
    }
    assert!(seen.iter().all(|&times| times == 1), "every corner lies in exactly one chart");
}
