//! Free boundaries: they never pass themselves, and what keeps them apart costs nothing where nothing is needed.

use qoptimize::direct::{DescentOptions, Objective, Wishes, embed};
use qoptimize::qmesh::{QuadMesh, shapes};
use qoptimize::{AngleTerm, Method, Options, ScaffoldEnd, certify, parameterize};

fn overlapping() -> Vec<(&'static str, QuadMesh)> {
    vec![
        ("a ramp of more than a turn", shapes::ramp(1.2, 36, 3)),
        ("a long spiral ramp", shapes::ramp(2.5, 80, 2)),
        ("a C whose ends want its gap", shapes::horseshoe(0.04, 1.0, 48, 6)),
    ]
}

/// The map of least energy lies on itself; the map that comes out does not, and is worse only as far as that needs. The turns of
/// a ramp find room beside each other without much distortion.
#[test]
fn boundaries_that_would_meet_are_kept_apart() {
    for (name, mesh) in overlapping() {
        let (uv, report) =
            embed(&mesh, &Objective::default(), &Wishes::default(), &DescentOptions::default(), &()).unwrap();
        let certificate = certify(mesh.view(), &mesh.to_corners(&uv), 1).unwrap();
        assert!(certificate.holds, "{name}: {certificate}");
        let repair = report.boundary_repair.expect(name);
        assert!(repair.free_crossings > 0, "{name}: {repair:?}");
        assert_eq!(repair.end, ScaffoldEnd::Converged, "{name}: {repair:?}");
        assert!(repair.energy > repair.free_energy, "{name}: {repair:?}");
        assert!(repair.symmetric_dirichlet < repair.free_symmetric_dirichlet + 0.01, "{name}: {repair:?}");
        assert_eq!(report.descent.energy, repair.energy, "{name}");
    }
}

/// Every objective, and also after normalisation: the certificate proves it on the coordinates that the caller gets.
#[test]
fn every_objective_is_kept_clear() {
    let mesh = shapes::ramp(1.3, 30, 2);
    for (method, angle_term, q) in [
        (Method::Conformal, AngleTerm::Log, 0.5),
        (Method::Conformal, AngleTerm::Log, 1.0),
        (Method::Direct, AngleTerm::Paper, 0.2),
        (Method::Direct, AngleTerm::Log, 1.0),
    ] {
        let mut options = Options { method, q, ..Options::default() };
        options.direct.angle_term = angle_term;
        let map = parameterize(&mesh, &options, &()).unwrap();
        assert!(map.certificate.holds, "{method:?} {q}: {:?}", map.record.direct);
    }
}

/// Stopped at any of its reports, the work ends with a map that is valid and clear of itself.
#[test]
fn stopping_leaves_a_clear_map() {
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicUsize, Ordering};
    let mesh = shapes::ramp(1.2, 24, 2);
    let run = |limit: usize| {
        let calls = AtomicUsize::new(0);
        let observer = |_: &'static str, _: f64| match calls.fetch_add(1, Ordering::Relaxed) {
            n if n >= limit => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let (uv, report) =
            embed(&mesh, &Objective::default(), &Wishes::default(), &DescentOptions::default(), &observer)
                .unwrap();
        let certificate = certify(mesh.view(), &mesh.to_corners(&uv), 1).unwrap();
        assert!(report.boundary_repair.is_some() || limit < 20, "{limit}");
        (certificate, calls.into_inner())
    };
    let total = run(usize::MAX).1;
    for limit in (0..total).step_by(9) {
        assert!(run(limit).0.holds, "stopped at report {limit}");
    }
}
