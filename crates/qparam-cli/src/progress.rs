//! Watching the work: a bar on a terminal, the time of each stage, and ctrl-C.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use qoptimize::qmesh::Observer;
use serde::Serialize;

use crate::interrupt::Interrupt;

const TICKS: u64 = 1000;

/// How long a stage took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct StageTime {
    pub(crate) stage: &'static str,
    pub(crate) seconds: f64,
}

/// An observer that draws, keeps the time, and hands on the request to stop.
pub(crate) struct Watch<'a> {
    interrupt: &'a Interrupt,
    deadline: Option<Instant>,
    bar: Option<ProgressBar>,
    clock: Mutex<Clock>,
}

#[derive(Default)]
struct Clock {
    current: Option<(&'static str, Instant)>,
    stages: Vec<StageTime>,
}

impl<'a> Watch<'a> {
    /// With `draw`, a bar appears on standard error.
    pub(crate) fn new(interrupt: &'a Interrupt, draw: bool) -> Self {
        let bar = draw.then(|| {
            let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{msg:>20} [{bar:40}] {percent:>3}% {elapsed}") {
                bar.set_style(style.progress_chars("=> "));
            }
            bar
        });
        Self { interrupt, deadline: None, bar, clock: Mutex::default() }
    }

    /// Time is up at `deadline`, if there is one.
    pub(crate) fn until(self, deadline: Option<Instant>) -> Self {
        Self { deadline, ..self }
    }

    /// Clears the bar and returns the times, stages in order of their first call.
    pub(crate) fn finish(self) -> Vec<StageTime> {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        let mut clock = self.clock.into_inner().unwrap_or_else(PoisonError::into_inner);
        clock.enter(None);
        clock.stages
    }
}

impl Clock {
    /// Books the time since the last change to the stage that ends.
    fn enter(&mut self, stage: Option<&'static str>) {
        let now = Instant::now();
        if let Some((ended, since)) = self.current.take() {
            let seconds = (now - since).as_secs_f64();
            match self.stages.iter_mut().find(|known| known.stage == ended) {
                Some(known) => known.seconds += seconds,
                None => self.stages.push(StageTime { stage: ended, seconds }),
            }
        }
        self.current = stage.map(|stage| (stage, now));
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, stage: &'static str, fraction: f64) -> ControlFlow<()> {
        let mut clock = self.clock.lock().unwrap_or_else(PoisonError::into_inner);
        if clock.current.is_none_or(|(current, _)| current != stage) {
            clock.enter(Some(stage));
            if let Some(bar) = &self.bar {
                bar.set_message(stage);
            }
        }
        drop(clock);
        if let Some(bar) = &self.bar {
            bar.set_position((fraction.clamp(0.0, 1.0) * TICKS as f64) as u64);
        }
        if self.interrupt.is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }
}

#[cfg(test)]
mod tests {
    use super::{Interrupt, Observer, Watch};

    #[test]
    fn stages_are_listed_once_in_order() {
        let interrupt = Interrupt::new();
        let watch = Watch::new(&interrupt, false);
        for stage in ["curvature", "solve", "solve", "curvature"] {
            assert!(watch.progress(stage, 0.5).is_continue());
        }
        interrupt.request();
        assert!(watch.progress("measure", 0.0).is_break());
        let names: Vec<_> = watch.finish().into_iter().map(|time| time.stage).collect();
        assert_eq!(names, ["curvature", "solve", "measure"]);
    }
}
