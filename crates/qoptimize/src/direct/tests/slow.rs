//! Steps without systems of their own: they get as far.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::convexity::Exempt;
use crate::direct::hessian::Hessian;
use crate::direct::newton::descend;
use crate::direct::rest::Rest;
use crate::direct::scale::to_best_scale;
use crate::direct::slow::{self, Walked};
use crate::direct::start::{find_start, judge};
use crate::direct::{AngleTerm, DescentOptions, Objective, Stop};
use crate::qmesh::{Observer, QuadMesh, Vec2, shapes};

const OBJECTIVE: Objective = Objective::Direct { q: 0.5, shape: 1.0, angle_term: AngleTerm::Log };

fn started(mesh: &QuadMesh) -> (Rest, Hessian, Vec<Vec2>) {
    let exempt = Exempt::find(mesh);
    let rest = Rest::new(mesh, &exempt);
    let start = find_start(mesh, &exempt, &()).unwrap();
    let mut uv: Vec<Vec2> = start.uv.iter().map(|p| p / rest.unit).collect();
    to_best_scale(&rest, &OBJECTIVE, &mut uv);
    let hessian = Hessian::new(&rest).unwrap();
    (rest, hessian, uv)
}

fn walk(
    mesh: &QuadMesh,
    options: &DescentOptions,
    most: usize,
    observer: &dyn Observer,
) -> (Walked, Rest, Vec<Vec2>) {
    let (rest, mut hessian, mut uv) = started(mesh);
    let walked = slow::walk(&rest, &mut hessian, &mut uv, &OBJECTIVE, options, most, observer).unwrap();
    (walked, rest, uv)
}

/// They end near the minimum that Newton steps find, all the way from Tutte's embedding too, and flip nothing.
#[test]
fn the_minimum_is_the_same() {
    for mesh in [shapes::bump(12, 0.8), shapes::finger(6, 12), shapes::face(1)] {
        let options = DescentOptions { relative_decrease: 1e-7, ..DescentOptions::default() };
        let (rest, mut hessian, mut uv) = started(&mesh);
        let newton = descend(&rest, &mut hessian, &mut uv, &OBJECTIVE, &options, &()).unwrap();
        let (walked, rest, uv) = walk(&mesh, &options, 400, &());
        assert_eq!(walked.stop, Stop::Converged);
        assert!((walked.energy / newton.energy - 1.0).abs() < 1e-4, "{} {}", walked.energy, newton.energy);
        assert_eq!(judge(&rest, &uv).bad, 0);
    }
}

/// The budget is kept, and every look may be the last; the energy falls with every step until then.
#[test]
fn walks_end_when_told() {
    let mesh = shapes::finger(6, 12);
    let options = DescentOptions::default();
    let mut last = f64::INFINITY;
    for most in 0..4 {
        let (walked, ..) = walk(&mesh, &options, most, &());
        assert_eq!((walked.steps, walked.stop), (most, Stop::MaxSteps));
        assert!(walked.energy < last);
        last = walked.energy;
    }
    for looks in 0..4 {
        let left = AtomicUsize::new(looks);
        let stop = |_: &'static str, _: f64| match left.fetch_sub(1, Ordering::SeqCst) {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let (walked, rest, uv) = walk(&mesh, &options, 100, &stop);
        assert_eq!(walked.stop, Stop::Cancelled);
        assert_eq!(judge(&rest, &uv).bad, 0);
    }
}
