//! Mirror symmetries: found where they are, refused where they are not, and kept exactly.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use qoptimize::direct::{DescentOptions, Objective, Wishes, embed};
use qoptimize::qmesh::obj::ObjDocument;
use qoptimize::qmesh::{QuadMesh, Vec2, Vec3, VertexData, VertexId, shapes};
use qoptimize::{
    DirectReport, Method, Mirror, Options, ParameterizeError, SymmetryError, certify, parameterize,
};

fn symmetric(mesh: &QuadMesh) -> Result<(VertexData<Vec2>, DirectReport), ParameterizeError> {
    let wishes = Wishes { symmetric: true, ..Wishes::default() };
    embed(mesh, &Objective::default(), &wishes, &DescentOptions::default(), &())
}

fn is_certified(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> bool {
    certify(mesh.view(), &mesh.to_corners(uv), 1).is_ok_and(|certificate| certificate.holds)
}

/// Partners get the same v and opposite u to the bit, vertices on the axis u = 0, and the map is injective; also where the
/// boundary has to be kept clear of itself.
#[test]
fn partners_are_mirrored_to_the_bit() {
    for (name, mesh) in [
        ("bump", shapes::bump(9, 0.8)),
        ("an even grid", shapes::grid(6, 4)),
        ("face", shapes::face(1)),
        ("finger", shapes::finger(2, 12)),
        ("tube", shapes::cylinder(8, 3)),
        ("a C that closes", shapes::horseshoe(0.04, 1.0, 48, 6)),
    ] {
        let mirror = Mirror::find(&mesh).expect(name);
        assert!(mirror.deviation < 1e-9, "{name}: {}", mirror.deviation);
        let (uv, report) = symmetric(&mesh).expect(name);
        for vertex in mesh.vertices() {
            let (here, there) = (uv[vertex], uv[mirror.partner[vertex]]);
            assert!(here.x == -there.x && here.y == there.y, "{name}: {vertex}");
        }
        assert!(is_certified(&mesh, &uv), "{name}: {report:?}");
        let found = report.symmetry.expect(name);
        assert_eq!(found.axis_vertices, mirror.axis_vertices(), "{name}");
    }
}

/// What is asked of the map costs nothing on mild shapes, whose best map is symmetric.
#[test]
fn symmetry_costs_nothing_on_mild_shapes() {
    let mesh = shapes::bump(8, 0.5);
    let free = embed(&mesh, &Objective::default(), &Wishes::default(), &DescentOptions::default(), &());
    let energy = free.unwrap().1.descent.energy;
    let mirrored = symmetric(&mesh).unwrap().1.descent.energy;
    assert!((mirrored / energy - 1.0).abs() < 1e-4, "{mirrored} {energy}");
}

/// Normalised, the mirror stands at half the width: u + u' is the same number for all partners, to the bit.
#[test]
fn normalisation_keeps_the_mirror() {
    let mesh = shapes::face(1);
    let options = Options { symmetric: true, ..Options::default() };
    let map = parameterize(&mesh, &options, &()).unwrap();
    let uv = mesh.vertex_data(|v| map.uv[mesh.vertex_corners(v).next().unwrap()]);
    let mirror = Mirror::find(&mesh).unwrap();
    let sum = uv[VertexId(0)].x + uv[mirror.partner[VertexId(0)]].x;
    for vertex in mesh.vertices() {
        let (here, there) = (uv[vertex], uv[mirror.partner[vertex]]);
        assert_eq!((here.x + there.x, here.y), (sum, there.y), "{vertex}");
    }
    assert!(uv.iter().all(|p| p.min() >= 0.0 && p.max() <= 1.0) && uv.iter().any(|p| p.max() == 1.0));
}

/// A symmetric graph with a bent shape is refused with the vertex and how far it is off; a small bend is evened out.
#[test]
fn shapes_that_are_not_symmetric_are_refused() {
    let bent = |amount: f64| {
        let mesh = shapes::grid(7, 4);
        let height = |v: VertexId| if v == VertexId(10) { Vec3::z() * amount } else { Vec3::zeros() };
        let positions = mesh.vertex_data(|v| mesh.position(v) + height(v));
        mesh.with_positions(positions)
    };
    let error = symmetric(&bent(2.0)).unwrap_err();
    let ParameterizeError::Symmetry(SymmetryError::Shape { deviation, .. }) = error else {
        panic!("{error}")
    };
    assert!(deviation > 0.05, "{deviation}");
    let (uv, report) = symmetric(&bent(0.01)).unwrap();
    let off = report.symmetry.as_ref().map_or(0.0, |symmetry| symmetry.deviation);
    assert!(off > 1e-4 && off < 0.01 && is_certified(&bent(0.01), &uv), "{report:?}");
    // A ramp turns into itself by half a turn of its own, but no mirror maps it to itself.
    let error = symmetric(&shapes::ramp(0.8, 20, 3)).unwrap_err();
    assert!(matches!(error, ParameterizeError::Symmetry(_)), "{error}");
    let with_pins =
        Options { symmetric: true, pins: vec![(VertexId(0), Vec2::zeros())], ..Options::default() };
    let error = parameterize(&shapes::grid(2, 2), &with_pins, &()).unwrap_err();
    assert_eq!(error, ParameterizeError::SymmetricAndHeld);
    let paper = Options { symmetric: true, method: Method::Paper, ..Options::default() };
    assert!(matches!(parameterize(&shapes::grid(2, 2), &paper, &()), Err(ParameterizeError::OtherMethod(_))));
}

/// A modelled head has the mirror that people see, though its shape is off by some percent in places. The face beside it has not: a
/// few quads of its rim are on one side only, which is where the refusal points.
#[test]
fn real_heads_have_a_mirror() {
    let Ok(folder) = std::env::var("QPARAM_MESHES") else {
        println!("skipped: QPARAM_MESHES is not set");
        return;
    };
    let read = |name: &str| {
        let bytes = std::fs::read(std::path::Path::new(&folder).join(name)).unwrap();
        QuadMesh::build(ObjDocument::parse(bytes).unwrap().polygons().clone()).unwrap()
    };
    let head = read("head_soma.obj");
    let mirror = Mirror::find(&head).unwrap();
    println!("largest deviation {}, mean {}", mirror.deviation, mirror.mean_deviation);
    assert!(mirror.normal.x > 0.99 && mirror.axis_vertices() > 50, "{} {}", mirror.normal, mirror.deviation);
    let options = DescentOptions { max_steps: 8, ..DescentOptions::default() };
    let wishes = Wishes { symmetric: true, ..Wishes::default() };
    let (uv, _) = embed(&head, &Objective::default(), &wishes, &options, &()).unwrap();
    let is_mirrored = |v: VertexId| {
        let (here, there) = (uv[v], uv[mirror.partner[v]]);
        here.x == -there.x && here.y == there.y
    };
    assert!(head.vertices().all(is_mirrored) && is_certified(&head, &uv));
    let face = read("face_makehuman_disk.obj");
    let Err(SymmetryError::Connectivity { vertices: [a, b] }) = Mirror::find(&face) else {
        panic!("{:?}", Mirror::find(&face))
    };
    assert!(face.is_boundary(a) && face.is_boundary(b) && face.valence(a) != face.valence(b));
}
