//! Maps that start from their neighbours: the same minima, for less.

use crate::certify;
use crate::direct::{
    AngleTerm, Continuation, DescentOptions, DirectReport, Objective, Wishes, embed, embed_from,
};
use crate::plane::outline_flaws;
use crate::qmesh::shapes;
use crate::qmesh::{QuadMesh, Vec2, VertexData};

const DIALS: [f64; 5] = [1.0, 0.8, 0.5, 0.2, 0.0];

fn at(q: f64) -> Objective {
    Objective::Direct { q, shape: 1.0, angle_term: AngleTerm::Log }
}

fn next(
    continuation: &mut Continuation,
    mesh: &QuadMesh,
    objective: &Objective,
) -> (VertexData<Vec2>, DirectReport) {
    embed_from(continuation, mesh, objective, &Wishes::default(), &DescentOptions::default(), &()).unwrap()
}

fn series(mesh: &QuadMesh) -> Vec<(VertexData<Vec2>, DirectReport)> {
    let mut continuation = Continuation::default();
    DIALS.into_iter().map(|q| next(&mut continuation, mesh, &at(q))).collect()
}

fn alone(mesh: &QuadMesh, q: f64) -> (VertexData<Vec2>, DirectReport) {
    embed(mesh, &at(q), &Wishes::default(), &DescentOptions::default(), &()).unwrap()
}

/// The first map of a series is that of a single call to the bit; the others have its energy within a thousandth, and all of
/// them together take fewer steps.
#[test]
fn a_series_has_the_energies_of_single_maps() {
    for mesh in [shapes::bump(12, 0.8), shapes::finger(6, 12), shapes::face(1)] {
        let single: Vec<_> = DIALS.iter().map(|&q| alone(&mesh, q)).collect();
        let series = series(&mesh);
        assert_eq!(series[0].0, single[0].0);
        for ((_, warm), (_, cold)) in series.iter().zip(&single) {
            let (warm, cold) = (warm.descent.energy, cold.descent.energy);
            assert!(warm < cold * 1.001, "{warm} {cold}");
        }
        let steps = |maps: &[(VertexData<Vec2>, DirectReport)]| -> usize {
            maps.iter().map(|(_, report)| report.descent.steps).sum()
        };
        assert!(steps(&series) < steps(&single), "{} {}", steps(&series), steps(&single));
    }
}

/// A surface whose free boundary meets itself stays clear of itself in all maps of a series.
#[test]
fn boundaries_stay_clear_in_a_series() {
    let mesh = shapes::ramp(1.2, 36, 3);
    for (i, (uv, report)) in series(&mesh).iter().enumerate() {
        assert!(report.boundary_repair.is_some(), "{i}");
        assert_eq!(outline_flaws(&mesh, uv), 0, "{i}");
    }
}

/// Another surface starts afresh.
#[test]
fn another_surface_starts_afresh() {
    let mut continuation = Continuation::default();
    for mesh in [shapes::bump(8, 0.5), shapes::bump(9, 0.5)] {
        let (uv, _) = embed_from(
            &mut continuation,
            &mesh,
            &at(0.5),
            &Wishes::default(),
            &DescentOptions::default(),
            &(),
        )
        .unwrap();
        assert!(continuation.is_warm());
        assert_eq!(uv, alone(&mesh, 0.5).0);
    }
}

/// A fine dial costs a step or two a map and reaches what single maps reach: never worse by more than what ends a descent, and
/// certified.
#[test]
fn a_fine_dial_arrives_within_the_tolerance() {
    let tolerance = DescentOptions::default().relative_decrease;
    for mesh in [shapes::bump(24, 0.8), shapes::finger(8, 20), shapes::face(1), shapes::bump(90, 0.8)] {
        let (mut continuation, mut steps) = (Continuation::default(), 0);
        let dials: Vec<f64> = (0..9).map(|k| f64::from(k) / 8.0).collect();
        for &q in &dials {
            let warm = next(&mut continuation, &mesh, &at(q));
            let cold = alone(&mesh, q).1.descent;
            assert!(
                warm.1.descent.energy <= cold.energy * (1.0 + tolerance),
                "{q}: {:?} {cold:?}",
                warm.1.descent
            );
            assert!(certify(mesh.view(), &mesh.to_corners(&warm.0), 1).is_ok_and(|c| c.holds), "{q}");
            steps += warm.1.descent.steps;
        }
        let single = alone(&mesh, dials[0]).1.descent.steps;
        assert!(steps - single <= 8 * 6, "{steps} {single}");
    }
}

/// The order of the dials plays no part for what is reached: up, down, or to and fro.
#[test]
fn dials_may_come_in_any_order() {
    let mesh = shapes::bump(24, 0.8);
    for dials in [[0.0, 0.5, 1.0, 0.25, 0.75], [1.0, 0.0, 1.0, 0.5, 0.5], [0.5, 0.499, 0.501, 0.5005, 0.0]] {
        let mut continuation = Continuation::default();
        for q in dials {
            let (warm, cold) = (next(&mut continuation, &mesh, &at(q)), alone(&mesh, q));
            let (warm, cold) = (warm.1.descent.energy, cold.1.descent.energy);
            assert!(warm <= cold * (1.0 + 1e-5), "{q}: {warm} {cold}");
        }
    }
}

/// Objectives of another kind in between are no neighbours to predict from.
#[test]
fn other_objectives_may_come_in_between() {
    let mesh = shapes::bump(24, 0.8);
    let conformal = |q| Objective::Conformal { q };
    let stiff = Objective::Direct { q: 0.5, shape: 10.0, angle_term: AngleTerm::Log };
    let mut continuation = Continuation::default();
    for objective in [at(0.5), stiff, at(0.6), conformal(0.5), conformal(0.9), at(0.55), conformal(0.8)] {
        let warm = next(&mut continuation, &mesh, &objective).1.descent.energy;
        let single = embed(&mesh, &objective, &Wishes::default(), &DescentOptions::default(), &());
        let cold = single.unwrap().1.descent.energy;
        assert!(warm <= cold * (1.0 + 1e-5), "{objective:?}: {warm} {cold}");
    }
}

/// A series is the same to the bit on one thread and on several: for systems that are factorized, and for those that are not.
#[test]
fn a_series_does_not_depend_on_threads() {
    for mesh in [shapes::face(1), shapes::bump(84, 0.8)] {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut continuation = Continuation::default();
                [0.3, 0.4, 0.5, 0.9].map(|q| next(&mut continuation, &mesh, &at(q)).0)
            })
        };
        let one = on(1);
        assert!([2, 3].into_iter().all(|threads| on(threads) == one));
    }
}
