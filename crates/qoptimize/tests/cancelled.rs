//! Cancelled at every place where the work can be cancelled: an error that says so, or a map that was done already. Late at every
//! place that asks for the time: the best map so far, or none.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use qoptimize::direct::{StartError, find_start};
use qoptimize::qembed::qmesh::charts::cut;
use qoptimize::qembed::qmesh::shapes::{Hostility, hostile_disk};
use qoptimize::qembed::qmesh::{Observer, Polygons, QuadMesh, Seams, shapes};
use qoptimize::{
    AtlasError, AtlasOptions, Exempt, Method, Options, ParameterizeError, Stop, atlas, certify, parameterize,
};

/// Calls of the observer, counted; the one with number `stop` (from 0) and all later ones ask to stop.
fn run(
    polygons: &Polygons,
    options: &AtlasOptions,
    stop: usize,
) -> (Result<atlas::Atlas, AtlasError>, usize) {
    let calls = AtomicUsize::new(0);
    let observer = |_: &'static str, fraction: f64| {
        assert!((0.0..=1.0).contains(&fraction), "{fraction} is no fraction");
        let call = calls.fetch_add(1, Ordering::SeqCst);
        if call < stop { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let result = atlas::unwrap(polygons.view(), &Seams::default(), options, &observer);
    (result, calls.into_inner())
}

fn meshes() -> Vec<(&'static str, Polygons)> {
    let of = |mesh: &QuadMesh| {
        let view = mesh.view();
        Polygons {
            positions: view.positions.to_vec(),
            face_start: view.face_start.to_vec(),
            corner_vertex: view.corner_vertex.to_vec(),
        }
    };
    let mut pair = of(&shapes::sphere(2));
    let before = pair.positions.len() as u32;
    let other = of(&shapes::cylinder(6, 2));
    pair.positions.extend(&other.positions);
    for face in 0..other.view().face_count() {
        let face: Vec<u32> = other.view().face(face).iter().map(|v| v + before).collect();
        pair.push_face(&face);
    }
    vec![
        ("a cap", of(&shapes::cap(4, 2.0))),
        ("a tube", of(&shapes::cylinder(8, 3))),
        ("a sphere", of(&shapes::sphere(2))),
        ("a sphere and a tube", pair),
    ]
}

fn options() -> Vec<(&'static str, AtlasOptions)> {
    let with = |method: Method| AtlasOptions {
        map: Options { method, ..Options::default() },
        ..AtlasOptions::default()
    };
    let mut all: Vec<_> = [
        ("direct", Method::Direct),
        ("conformal", Method::Conformal),
        ("paper", Method::Paper),
        ("uniform", Method::Uniform),
        ("lscm", Method::Lscm),
    ]
    .map(|(name, method)| (name, with(method)))
    .into();
    all.push(("more cuts", AtlasOptions { max_stretch: Some(1.8), ..with(Method::Direct) }));
    all
}

/// Each stage hears of the request: whichever call it comes with, the work ends cancelled, and never with a map that is half done. Only when
/// the last call has been answered there is a map, the same as ever.
#[test]
fn every_call_may_be_the_last() {
    let mut total = 0;
    for (shape, polygons) in meshes() {
        for (name, options) in options() {
            let (whole, calls) = run(&polygons, &options, usize::MAX);
            let whole = whole.unwrap_or_else(|error| panic!("{name} of {shape}: {error}"));
            assert!(calls > 4, "{name} of {shape}: {calls} calls");
            total += calls;
            for stop in 0..calls {
                let (stopped, _) = run(&polygons, &options, stop);
                match stopped {
                    Err(AtlasError::Cancelled) => {}
                    other => panic!("{name} of {shape}, call {stop} of {calls}: {other:?}"),
                }
            }
            let (again, _) = run(&polygons, &options, calls);
            assert_eq!(again.unwrap().uv, whole.uv, "{name} of {shape}");
        }
    }
    assert!(total > 300, "{total} places to stop at");
}

/// Charts that are there already: the same.
#[test]
fn charts_can_be_cancelled_too() {
    let polygons = meshes().remove(0).1;
    let charts = cut(polygons.view(), &Seams::default()).unwrap();
    let stop = |_: &'static str, _: f64| ControlFlow::Break(());
    let result =
        atlas::unwrap_charts(polygons.view(), charts.charts, charts.repairs, &AtlasOptions::default(), &stop);
    assert_eq!(result.unwrap_err(), AtlasError::Cancelled);
}

/// An observer that is late from look `late` (from 0) on.
struct Clock {
    looks: AtomicUsize,
    late: usize,
}

impl Observer for Clock {
    fn progress(&self, _: &'static str, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn is_late(&self) -> bool {
        self.looks.fetch_add(1, Ordering::SeqCst) >= self.late
    }
}

fn timed(
    polygons: &Polygons,
    options: &AtlasOptions,
    late: usize,
) -> (Result<atlas::Atlas, AtlasError>, usize) {
    let clock = Clock { looks: AtomicUsize::new(0), late };
    let result = atlas::unwrap(polygons.view(), &Seams::default(), options, &clock);
    (result, clock.looks.into_inner())
}

/// Whenever time is up, there is a map that says so and folds nowhere, or none because there was none yet; with more time the energy
/// is never higher, and time that suffices changes nothing.
#[test]
fn time_may_be_up_at_any_moment() {
    let mut maps = 0;
    for (shape, polygons) in meshes() {
        let islands = if shape == "a sphere and a tube" { 2 } else { 1 };
        for (name, options) in options() {
            let (whole, looks) = timed(&polygons, &options, usize::MAX);
            let whole = whole.unwrap_or_else(|error| panic!("{name} of {shape}: {error}"));
            assert_eq!(run(&polygons, &options, usize::MAX).0.unwrap().uv, whole.uv, "{name} of {shape}");
            assert!(whole.islands.iter().all(|island| !island.ended_by_time), "{name} of {shape}");
            let mut last = f64::INFINITY;
            // With several islands, or several ways to cut, who looks when depends on the threads.
            let in_turn = islands == 1 && options.max_stretch.is_none();
            for late in (0..looks).step_by(if in_turn { 1 } else { 5 }) {
                let map = match timed(&polygons, &options, late).0 {
                    Ok(map) => map,
                    Err(AtlasError::OutOfTime) if islands == 1 => continue,
                    Err(error) => panic!("{name} of {shape}, look {late}: {error}"),
                };
                // Least squares may fold a tube: what time did not end is as it is with all the time there is.
                let is_valid =
                    |island: &atlas::Island| island.flipped_corners + island.boundary_crossings == 0;
                assert!(
                    map.certificate.holds || !whole.certificate.holds,
                    "{name} of {shape}, look {late}: {}",
                    map.certificate
                );
                for (island, whole) in map.islands.iter().zip(&whole.islands) {
                    let is_whole = !island.ended_by_time && island.flipped_corners == whole.flipped_corners;
                    assert!(is_whole || is_valid(island), "{name} of {shape}, look {late}: {island:?}");
                }
                maps += 1;
                if in_turn {
                    let island = &map.islands[0];
                    assert!(island.ended_by_time, "{name} of {shape}, look {late}");
                    let energy = island.record.direct.as_ref().map_or(0.0, |direct| direct.descent.energy);
                    assert!(energy <= last, "{name} of {shape}, look {late}");
                    last = energy;
                }
            }
            let enough = timed(&polygons, &options, looks).0.unwrap();
            assert!(!in_turn || enough.uv == whole.uv, "{name} of {shape}");
        }
    }
    assert!(maps > 60, "{maps} maps");
    let (none, _) = timed(&meshes()[0].1, &options()[0].1, 0);
    assert_eq!(none.unwrap_err(), AtlasError::OutOfTime);
}

/// The start asks before each of its systems: whoever breaks at any of its questions, even once, is asked no more, and gets the best
/// valid map so far, or none where there is none yet.
#[test]
fn starts_can_be_stopped_between_systems() {
    let (mut questions, mut maps) = (0, 0);
    for mesh in
        [shapes::finger(4, 60), hostile_disk(Hostility::Fingers, 1), hostile_disk(Hostility::Fingers, 2)]
    {
        let exempt = Exempt::find(&mesh);
        let started = |stop: usize| {
            let calls = AtomicUsize::new(0);
            let observer = |stage: &'static str, fraction: f64| {
                assert!(["start", "untangle"].contains(&stage), "{stage}");
                assert!((0.0..=1.0).contains(&fraction), "{fraction} is no fraction");
                let call = calls.fetch_add(1, Ordering::SeqCst);
                if call == stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            (find_start(&mesh, &exempt, &observer), calls.into_inner())
        };
        let (whole, calls) = started(usize::MAX);
        assert!(whole.is_ok() && calls > 0, "{calls} questions");
        questions += calls;
        for stop in 0..calls {
            let (start, asked) = started(stop);
            assert_eq!(asked, stop + 1);
            match start {
                Ok(start) => {
                    let certificate = certify(mesh.view(), &mesh.to_corners(&start.uv), 1).unwrap();
                    assert!(certificate.holds, "stopped at {stop}: {certificate}");
                    maps += 1;
                }
                Err(error) => assert_eq!(error, StartError::Cancelled),
            }
        }
    }
    assert!(questions > 10 && maps > 5, "{questions} questions, {maps} maps");
}

/// Time that is up during the start leaves a valid map, too.
#[test]
fn time_may_be_up_during_the_start() {
    let mesh = shapes::finger(4, 60);
    let timed = |late: usize| {
        let clock = Clock { looks: AtomicUsize::new(0), late };
        let map = parameterize(&mesh, &Options::default(), &clock);
        (map, clock.looks.into_inner())
    };
    for late in 0..8 {
        match timed(late).0 {
            Ok(map) => {
                let stop = map.record.direct.map(|direct| direct.descent.stop);
                assert!(map.certificate.holds && stop == Some(Stop::Cancelled), "late at {late}: {stop:?}");
            }
            Err(error) => {
                assert!(late < 4 && error == ParameterizeError::OutOfTime, "late at {late}: {error}");
            }
        }
    }
}
