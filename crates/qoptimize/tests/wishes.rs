//! What callers ask of a map besides low distortion: held boundaries, pins, kept UVs.

use qoptimize::direct::{DescentOptions, Objective, Wishes, embed};
use qoptimize::qembed::{BoundaryShape, EmbedError, place_boundary};
use qoptimize::qmesh::{PolygonView, Polygons, QuadMesh, Repairs, Seams, Vec2, VertexData, VertexId, shapes};
use qoptimize::{
    AtlasError, AtlasOptions, Continuation, DirectReport, Method, Options, ParameterizeError, atlas, certify,
    parameterize,
};

type Made = Result<(VertexData<Vec2>, DirectReport), ParameterizeError>;

fn made(mesh: &QuadMesh, boundary: &BoundaryShape, pins: &[(VertexId, Vec2)]) -> Made {
    let wishes = Wishes { boundary, pins, symmetric: false };
    embed(mesh, &Objective::default(), &wishes, &DescentOptions::default(), &())
}

fn is_certified(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> bool {
    certify(mesh.view(), &mesh.to_corners(uv), 1).is_ok_and(|certificate| certificate.holds)
}

/// The boundary of a flat mesh, each vertex moved by `place`.
fn moved(mesh: &QuadMesh, place: impl Fn(Vec2) -> Vec2) -> BoundaryShape {
    let rim = mesh.vertices().filter(|&v| mesh.is_boundary(v));
    BoundaryShape::Fixed(rim.map(|v| (v, place(mesh.position(v).xy()))).collect())
}

/// Every vertex of a held boundary is where it was put, to the bit, and the map is proven injective; holes stay free.
#[test]
fn held_boundaries_are_kept() {
    let bent = moved(&shapes::grid(7, 5), |p| Vec2::new(p.x, p.y + (0.9 * p.x).sin()));
    let curled = moved(&shapes::grid(16, 3), |p| {
        let (sin, cos) = (0.3 * p.x).sin_cos();
        (6.0 - p.y) * Vec2::new(cos, sin)
    });
    for (name, mesh, shape) in [
        ("bump on a circle", shapes::bump(8, 0.8), BoundaryShape::Circle),
        ("bump on a square", shapes::bump(8, 0.8), BoundaryShape::Square),
        ("bump as it lies", shapes::bump(8, 0.8), BoundaryShape::Projection),
        ("a wavy outline, not convex", shapes::grid(7, 5), bent),
        ("a C, where Tutte's embedding flips", shapes::grid(16, 3), curled),
        ("a tube, its far rim free", shapes::cylinder(10, 3), BoundaryShape::Circle),
    ] {
        let (uv, report) = made(&mesh, &shape, &[]).expect(name);
        for (vertex, place) in place_boundary(&mesh, &shape).unwrap() {
            assert_eq!(uv[vertex], place, "{name}: {vertex}");
        }
        assert!(is_certified(&mesh, &uv), "{name}");
        assert!(report.descent.energy < report.descent.energy_before, "{name}: {:?}", report.descent);
    }
}

/// A flat mesh on its own outline, however large that is drawn, stays as it is: the energy is that of an isometry.
#[test]
fn flat_meshes_fit_their_own_outline() {
    let mesh = shapes::jittered_grid(6, 6, 0.2, 3);
    for scale in [1e-20, 0.37, 1.0, 5e7] {
        let (uv, report) = made(&mesh, &moved(&mesh, |p| scale * p), &[]).unwrap();
        assert!(report.descent.energy < 1e-9, "{scale}: {:?}", report.descent);
        let off = mesh.vertices().map(|v| (uv[v] / scale - mesh.position(v).xy()).norm()).fold(0.0, f64::max);
        assert!(off < 1e-4, "{scale}: {off}");
    }
}

/// Boundaries on which no map can exist are refused with the place.
#[test]
fn impossible_boundaries_are_refused_with_the_place() {
    let mesh = shapes::grid(4, 4);
    let refusal = |shape: &BoundaryShape| made(&mesh, shape, &[]).unwrap_err();
    let clockwise = moved(&mesh, |p| Vec2::new(-p.x, p.y));
    assert_eq!(refusal(&clockwise), ParameterizeError::BoundaryClockwise);
    let crossed = moved(&mesh, |p| if p == Vec2::new(4.0, 4.0) { Vec2::new(2.0, -1.0) } else { p });
    assert!(matches!(refusal(&crossed), ParameterizeError::BoundaryMeets { .. }));
    // The corner of the grid pushed inwards: its only face cannot be convex.
    let dented = moved(&mesh, |p| if p == Vec2::zeros() { Vec2::new(0.9, 0.9) } else { p });
    let ParameterizeError::FlatCorner { corner } = refusal(&dented) else { panic!("{:?}", refusal(&dented)) };
    assert_eq!(mesh.vertex(corner), VertexId(0));
}

/// One pin moves the map and two turn and scale it as well: neither bends it. The pins are where they were asked for, to the bit.
#[test]
fn two_pins_fix_the_frame_and_nothing_else() {
    let mesh = shapes::bump(8, 0.8);
    let free = made(&mesh, &BoundaryShape::Auto, &[]).unwrap().1.descent.energy;
    let one = [(VertexId(5), Vec2::new(0.1, 0.7))];
    let two = [(VertexId(0), Vec2::new(0.3, 0.1)), (VertexId(80), Vec2::new(-0.55, 0.2))];
    for pins in [&one[..], &two[..]] {
        let (uv, report) = made(&mesh, &BoundaryShape::Auto, pins).unwrap();
        assert!(pins.iter().all(|&(vertex, place)| uv[vertex] == place));
        assert!((report.descent.energy / free - 1.0).abs() < 1e-4, "{} {free}", report.descent.energy);
        assert!(is_certified(&mesh, &uv));
    }
}

/// Pins that bend the map are reached exactly, on free and on held boundaries, and the map stays injective.
#[test]
fn pins_are_reached_without_flips() {
    let mesh = shapes::grid(8, 6);
    let at = |x: u32, y: u32| VertexId(y * 9 + x);
    let corners = [at(0, 0), at(8, 0), at(8, 6), at(0, 6)];
    let places = [[0.0, 0.0], [1.0, 0.2], [0.8, 1.0], [0.1, 0.9]].map(|[u, v]| Vec2::new(u, v));
    let quad: Vec<_> = corners.into_iter().zip(places).collect();
    let twisted: Vec<_> = quad.iter().copied().chain([(at(4, 3), Vec2::new(0.2, 0.3))]).collect();
    let inside = [(at(4, 3), Vec2::new(0.4, -0.3)), (at(2, 3), Vec2::new(-0.5, 0.1))];
    for (boundary, pins) in [
        (BoundaryShape::Auto, &quad[..]),
        (BoundaryShape::Free, &twisted[..]),
        (BoundaryShape::Circle, &inside[..]),
        (BoundaryShape::Circle, &inside[..1]),
    ] {
        let (uv, report) = made(&mesh, &boundary, pins).unwrap();
        assert!(pins.iter().all(|&(vertex, place)| uv[vertex] == place), "{boundary:?}");
        assert!(is_certified(&mesh, &uv), "{boundary:?}: {report:?}");
    }
}

/// A ramp that lies on itself when free keeps clear of itself when pinned, too.
#[test]
fn pinned_boundaries_stay_clear_of_themselves() {
    let mesh = shapes::ramp(1.2, 36, 3);
    let pins = [(VertexId(0), Vec2::new(0.0, 0.0)), (VertexId(18), Vec2::new(1.0, 0.0))];
    let (uv, report) = made(&mesh, &BoundaryShape::Auto, &pins).unwrap();
    assert!(is_certified(&mesh, &uv), "{report:?}");
    assert!(report.boundary_repair.is_some());
    assert!(pins.iter().all(|&(vertex, place)| uv[vertex] == place));
}

/// What cannot be reached is refused, and so are pins that contradict each other.
#[test]
fn impossible_pins_are_named() {
    let mesh = shapes::grid(4, 4);
    let at = |v: u32, u: f64, w: f64| (VertexId(v), Vec2::new(u, w));
    let refusal = |boundary: &BoundaryShape, pins: &[_]| made(&mesh, boundary, pins).unwrap_err();
    // Three corners of one face, clockwise.
    let mirrored = [at(0, 0.0, 0.0), at(1, 0.0, 1.0), at(6, 1.0, 0.0)];
    let error = refusal(&BoundaryShape::Auto, &mirrored);
    assert!(matches!(error, ParameterizeError::PinOutOfReach { .. }), "{error}");
    // A place outside of a held boundary.
    let outside = refusal(&BoundaryShape::Circle, &[at(12, 3.0, 0.0)]);
    let ParameterizeError::PinOutOfReach { vertex, distance } = outside else { panic!("{outside}") };
    assert!(vertex == VertexId(12) && distance > 2.0, "{distance}");
    let on_boundary = refusal(&BoundaryShape::Circle, &[at(0, 0.0, 0.0)]);
    assert_eq!(on_boundary, ParameterizeError::PinOnHeldBoundary { vertex: VertexId(0) });
    let twice = [at(3, 0.0, 0.0), at(4, 1.0, 0.0), at(3, 2.0, 0.0)];
    assert_eq!(refusal(&BoundaryShape::Auto, &twice), ParameterizeError::PinTwice { vertex: VertexId(3) });
    let met = refusal(&BoundaryShape::Auto, &[at(3, 1.0, 0.0), at(4, 1.0, 0.0)]);
    assert_eq!(met, ParameterizeError::PinsMeet { vertices: [VertexId(3), VertexId(4)] });
    let nowhere = refusal(&BoundaryShape::Auto, &[at(99, 1.0, 0.0)]);
    assert_eq!(nowhere, ParameterizeError::BadPin { vertex: VertexId(99) });
    let options = Options { method: Method::Paper, pins: vec![at(0, 0.0, 0.0)], ..Options::default() };
    assert_eq!(parameterize(&mesh, &options, &()).unwrap_err(), ParameterizeError::OtherMethod("pins"));
}

/// One pin moves the normalised map; two switch normalisation off, as a fixed boundary does.
#[test]
fn pins_and_normalisation() {
    let mesh = shapes::bump(6, 0.5);
    let options = |pins| Options { method: Method::Direct, pins, ..Options::default() };
    let plain = parameterize(&mesh, &options(vec![]), &()).unwrap().uv;
    let pin = (VertexId(7), Vec2::new(5.0, -2.0));
    let moved = parameterize(&mesh, &options(vec![pin]), &()).unwrap().uv;
    let shift = moved[qoptimize::qmesh::CornerId(0)] - plain[qoptimize::qmesh::CornerId(0)];
    assert!(plain.iter().zip(moved.iter()).all(|(a, b)| (b - a - shift).norm() < 1e-12));
    let pins = vec![pin, (VertexId(20), Vec2::new(5.5, -2.0))];
    let placed = parameterize(&mesh, &options(pins.clone()), &()).unwrap().uv;
    for corner in mesh.corners() {
        let wanted = pins.iter().find(|pin| pin.0 == mesh.vertex(corner));
        assert!(wanted.is_none_or(|pin| placed[corner] == pin.1));
    }
}

/// A free boundary is nothing that the paper's method could keep.
#[test]
fn methods_that_need_positions_refuse_a_free_boundary() {
    let options = Options { method: Method::Paper, boundary: BoundaryShape::Free, ..Options::default() };
    let error = parameterize(&shapes::grid(3, 3), &options, &()).unwrap_err();
    assert_eq!(error, ParameterizeError::Embed(EmbedError::NoFreeBoundary));
}

fn unwrapped(polygons: PolygonView<'_>, keep: Vec<Option<Vec2>>) -> Result<atlas::Atlas, AtlasError> {
    let options = AtlasOptions { keep, ..AtlasOptions::default() };
    atlas::unwrap(polygons, &Seams::default(), &options, &())
}

/// A list of kept UVs that is not as long as there are corners is refused, by every way in, with both numbers.
#[test]
fn kept_uvs_are_one_per_corner() {
    let mesh = shapes::grid(3, 2);
    let corners = mesh.corner_count();
    for found in [1, corners - 1, corners + 1] {
        for kept in [Some(Vec2::zeros()), None] {
            let refusal = AtlasError::KeptCount { expected: corners, found };
            assert_eq!(unwrapped(mesh.view(), vec![kept; found]).unwrap_err(), refusal);
            let options = AtlasOptions { keep: vec![kept; found], ..AtlasOptions::default() };
            let (view, repairs) = (mesh.view(), Repairs::default());
            let charts = atlas::unwrap_charts(view, Vec::new(), repairs.clone(), &options, &());
            assert_eq!(charts.unwrap_err(), refusal);
            let mut before: Vec<Continuation> = Vec::new();
            let series = atlas::unwrap_charts_from(&mut before, view, Vec::new(), repairs, &options, &());
            assert_eq!(series.unwrap_err(), refusal);
            assert!(atlas::kept_seams(view, &options.keep).is_empty());
        }
    }
}

/// Keeping nothing, corner by corner, is keeping nothing.
#[test]
fn kept_uvs_may_all_be_none() {
    let (near, far) = (shapes::grid(3, 2), shapes::bump(4, 0.5));
    let mut two = near.view().to_polygons();
    let before = two.positions.len() as u32;
    two.positions.extend(far.view().positions.iter().map(|p| p.add_scalar(9.0)));
    for face in 0..far.view().face_count() {
        let face: Vec<u32> = far.view().face(face).iter().map(|v| v + before).collect();
        two.push_face(&face);
    }
    for polygons in [near.view().to_polygons(), two] {
        let nothing = unwrapped(polygons.view(), Vec::new()).unwrap();
        let none = unwrapped(polygons.view(), vec![None; polygons.view().corner_count()]).unwrap();
        assert!(none.certificate.holds && none.uv == nothing.uv && none.layout == nothing.layout);
    }
}

/// Polygons that contradict themselves are refused, whatever they are to keep.
#[test]
fn kept_uvs_of_broken_polygons_are_refused() {
    let good = shapes::grid(2, 1).view().to_polygons();
    let beyond =
        Polygons { corner_vertex: good.corner_vertex.iter().map(|v| v + 3).collect(), ..good.clone() };
    let torn = Polygons { face_start: vec![0, 9, 4, 8], ..good.clone() };
    for broken in [beyond, torn] {
        let keep = vec![Some(Vec2::zeros()); broken.view().corner_count()];
        assert!(matches!(unwrapped(broken.view(), keep), Err(AtlasError::Build(_))));
    }
}
