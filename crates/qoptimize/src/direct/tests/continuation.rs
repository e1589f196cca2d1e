//! Maps that start from their neighbours: the same minima, for less.

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

fn series(mesh: &QuadMesh) -> Vec<(VertexData<Vec2>, DirectReport)> {
    let mut continuation = Continuation::default();
    let map = |q| {
        embed_from(&mut continuation, mesh, &at(q), &Wishes::default(), &DescentOptions::default(), &())
            .unwrap()
    };
    DIALS.into_iter().map(map).collect()
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
