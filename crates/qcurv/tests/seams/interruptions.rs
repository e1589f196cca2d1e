//! Cancelled at every place where the search can be: an error that says so. Late at every place: seams all the same.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use qcurv::qmesh::{Chart, Observer, shapes};
use qcurv::seams::{Interrupted, opening};

/// Asks to stop from call `stop` on, and is late from look `late` on.
struct Clock {
    calls: AtomicUsize,
    stop: usize,
    looks: AtomicUsize,
    late: usize,
}

impl Clock {
    fn new(stop: usize, late: usize) -> Self {
        Self { calls: AtomicUsize::new(0), stop, looks: AtomicUsize::new(0), late }
    }
}

impl Observer for Clock {
    fn progress(&self, _: &'static str, fraction: f64) -> ControlFlow<()> {
        assert!((0.0..=1.0).contains(&fraction), "{fraction} is no fraction");
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        if call < self.stop { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    fn is_late(&self) -> bool {
        self.looks.fetch_add(1, Ordering::Relaxed) >= self.late
    }
}

#[test]
fn any_look_may_be_the_last() {
    for mesh in [shapes::sphere(3), shapes::torus(8, 5)] {
        let patient = Clock::new(usize::MAX, usize::MAX);
        let whole = opening(&mesh, &patient).unwrap();
        let calls = patient.calls.into_inner();
        assert!(calls > 24, "{calls} calls");
        for call in 0..calls {
            let stopped = opening(&mesh, &Clock::new(call, usize::MAX));
            assert_eq!(stopped, Err(Interrupted::Cancelled), "call {call} of {calls}");
            let late = opening(&mesh, &Clock::new(usize::MAX, call)).unwrap();
            let pieces = Chart::whole(mesh.clone()).cut(&late);
            assert!(pieces.len() == 1 && pieces[0].mesh.topology().is_disk(), "look {call} of {calls}");
        }
        assert_eq!(opening(&mesh, &Clock::new(calls, calls)).unwrap(), whole);
    }
}
