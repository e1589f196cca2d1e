//! Labels beside their points, kept off each other and off the points.

/// Width of a letter of the labels, on the average, and their height, in pixels.
const LETTER: f64 = 5.6;
const HEIGHT: f64 = 11.0;

/// A rectangle on the page.
#[derive(Clone, Copy)]
pub(super) struct Box2 {
    low: [f64; 2],
    high: [f64; 2],
}

impl Box2 {
    pub(super) fn around([x, y]: [f64; 2], radius: f64) -> Self {
        Self { low: [x - radius, y - radius], high: [x + radius, y + radius] }
    }

    /// The area that both cover.
    fn shared(&self, other: &Self) -> f64 {
        let side = |k: usize| (self.high[k].min(other.high[k]) - self.low[k].max(other.low[k])).max(0.0);
        side(0) * side(1)
    }
}

/// What is taken already.
pub(super) struct Labels {
    frame: Box2,
    taken: Vec<Box2>,
}

impl Labels {
    pub(super) fn new(low: [f64; 2], high: [f64; 2]) -> Self {
        Self { frame: Box2 { low, high }, taken: Vec::new() }
    }

    pub(super) fn avoid(&mut self, space: Box2) {
        self.taken.push(space);
    }

    /// The least crowded place near a point: where the text starts or ends, and which of the two.
    pub(super) fn place(&mut self, [x, y]: [f64; 2], text: &str) -> ([f64; 2], &'static str) {
        let width = LETTER * text.chars().count() as f64;
        let mut best: Option<(f64, Box2, [f64; 2], &'static str)> = None;
        for shift in [0.0, -10.0, 10.0, -20.0, 20.0, -31.0, 31.0, -42.0, 42.0] {
            for (anchor, start) in [("start", x + 7.0), ("end", x - 7.0 - width)] {
                let base = y + 3.5 + shift;
                let space = Box2 { low: [start, base - HEIGHT + 2.0], high: [start + width, base + 2.0] };
                let crowd: f64 = self.taken.iter().map(|other| space.shared(other)).sum();
                let outside = width * HEIGHT - space.shared(&self.frame);
                let cost = crowd + 4.0 * outside.max(0.0) + 0.4 * shift.abs();
                if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                    let at = if anchor == "start" { start } else { start + width };
                    best = Some((cost, space, [at, base], anchor));
                }
            }
        }
        let Some((_, space, at, anchor)) = best else { return ([x, y], "start") };
        self.taken.push(space);
        (at, anchor)
    }
}
