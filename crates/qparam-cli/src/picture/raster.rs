//! Which patch is seen at each of sixteen samples a pixel, and where in the patch.
//!
//! Patches are cut into as many triangles as they are twisted in the picture: each place of a patch is drawn less than a
//! tenth of a pixel from where it belongs, so no diagonal shows. Colours are looked up in the whole patch.
//! A sample within a billionth of a triangle counts as inside; of what covers a sample the nearest is seen, of equals the
//! first. So nothing gapes, whatever is cut how often, and the order of the work decides nothing.

use qoptimize::qmesh::Vec2;

use super::camera::Seen;
use super::model::{NO_CORNER, Patch};

/// Samples a pixel.
pub(super) const SAMPLES: usize = 16;
/// No patch.
pub(super) const NOTHING: u32 = u32::MAX;
/// Side of a tile, in pixels: its samples fit into a processor's cache.
pub(super) const TILE: usize = 32;

/// How far outside a triangle still counts as inside, as a share of its height.
const SLACK: f64 = 1e-9;
/// A patch is cut until it is this near to what is drawn, in pixels.
const TOLERANCE: f64 = 0.1;
/// And into no more parts a side than this.
const MOST_PARTS: f64 = 48.0;

/// Where in the pixel the samples are: each in a row and in a column of its own, so that every edge is smooth.
pub(super) const OFFSETS: [[f64; 2]; SAMPLES] = {
    let mut offsets = [[0.0; 2]; SAMPLES];
    let mut i = 0;
    while i < SAMPLES {
        // The bits of `i` in reverse order.
        let reversed = (i & 1) << 3 | (i & 2) << 1 | (i & 4) >> 1 | (i & 8) >> 3;
        offsets[i] = [(i as f64 + 0.5) / SAMPLES as f64, (reversed as f64 + 0.5) / SAMPLES as f64];
        i += 1;
    }
    offsets
};

/// What one sample sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    nearness: f32,
    pub(super) patch: u32,
    pub(super) s: f32,
    pub(super) t: f32,
}

impl Sample {
    const EMPTY: Self = Self { nearness: f32::MIN, patch: NOTHING, s: 0.0, t: 0.0 };
}

/// A square of the picture with its samples.
pub(super) struct Tile {
    left: f64,
    top: f64,
    width: usize,
    height: usize,
    samples: Vec<Sample>,
}

/// A corner of a triangle, seen from the tile's upper left corner.
#[derive(Clone, Copy)]
struct Point {
    x: f64,
    y: f64,
    nearness: f64,
    inverse_depth: f64,
    /// Times the inverse depth.
    s: f64,
    t: f64,
}

impl Tile {
    pub(super) fn new() -> Self {
        Self { left: 0.0, top: 0.0, width: 0, height: 0, samples: vec![Sample::EMPTY; TILE * TILE * SAMPLES] }
    }

    /// Moves the tile and forgets what it saw.
    pub(super) fn place(&mut self, left: usize, top: usize, width: usize, height: usize) {
        (self.left, self.top, self.width, self.height) = (left as f64, top as f64, width, height);
        self.samples.fill(Sample::EMPTY);
    }

    /// The samples of a pixel of the tile.
    pub(super) fn pixel(&self, x: usize, y: usize) -> &[Sample] {
        let start = (y * TILE + x) * SAMPLES;
        &self.samples[start..start + SAMPLES]
    }

    /// Draws a patch, whose corners are there; a triangle has only three.
    pub(super) fn draw(&mut self, number: u32, patch: &Patch, corners: &[Seen; 4]) {
        let at = |i: usize, s: f64, t: f64| self.point(&corners[i], s, t);
        if patch.corners[3] == NO_CORNER {
            self.triangle(number, [at(0, 0.0, 0.0), at(1, 1.0, 0.0), at(2, 0.0, 1.0)]);
            return;
        }
        let square = [at(0, 0.0, 0.0), at(1, 1.0, 0.0), at(2, 1.0, 1.0), at(3, 0.0, 1.0)];
        let parts = parts(corners);
        if parts == 1 {
            self.triangle(number, [square[0], square[1], square[2]]);
            self.triangle(number, [square[0], square[2], square[3]]);
            return;
        }
        let place = |i: usize, j: usize| bilinear(corners, i as f64 / parts as f64, j as f64 / parts as f64);
        for j in 0..parts {
            for i in 0..parts {
                let [s, t] = [i, j].map(|k| k as f64 / parts as f64);
                let [s1, t1] = [i + 1, j + 1].map(|k| k as f64 / parts as f64);
                let cell = [
                    self.point(&place(i, j), s, t),
                    self.point(&place(i + 1, j), s1, t),
                    self.point(&place(i + 1, j + 1), s1, t1),
                    self.point(&place(i, j + 1), s, t1),
                ];
                self.triangle(number, [cell[0], cell[1], cell[2]]);
                self.triangle(number, [cell[0], cell[2], cell[3]]);
            }
        }
    }

    fn point(&self, seen: &Seen, s: f64, t: f64) -> Point {
        let inverse_depth = seen.inverse_depth;
        Point {
            x: seen.place.x - self.left,
            y: seen.place.y - self.top,
            nearness: seen.nearness,
            inverse_depth,
            s: s * inverse_depth,
            t: t * inverse_depth,
        }
    }

    fn triangle(&mut self, patch: u32, mut p: [Point; 3]) {
        let mut doubled = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
        if doubled < 0.0 {
            p.swap(1, 2);
            doubled = -doubled;
        }
        let low = |a: f64, b: f64, c: f64| a.min(b).min(c).max(0.0) as usize;
        let high =
            |a: f64, b: f64, c: f64, end: usize| (a.max(b).max(c).max(-1.0) + 1.0).min(end as f64) as usize;
        let (x0, x1) = (low(p[0].x, p[1].x, p[2].x), high(p[0].x, p[1].x, p[2].x, self.width));
        let (y0, y1) = (low(p[0].y, p[1].y, p[2].y), high(p[0].y, p[1].y, p[2].y, self.height));
        if x0 >= x1 || y0 >= y1 || doubled.is_nan() || doubled <= 1e-12 {
            return;
        }
        // Barycentric coordinates as planes over the picture: value at the tile's corner, slopes along x and y. Loops
        // over plain arrays, since this is where the time goes and processors take several samples at once.
        let (mut planes, mut steps, mut reach) = ([[0.0; 3]; 3], [[0.0; SAMPLES]; 3], [SLACK; 3]);
        for i in 0..3 {
            let (a, b) = (&p[(i + 1) % 3], &p[(i + 2) % 3]);
            let (dx, dy) = ((a.y - b.y) / doubled, (b.x - a.x) / doubled);
            planes[i] = [-(a.x * dx + a.y * dy), dx, dy];
            reach[i] += dx.max(0.0) + dy.max(0.0);
            for (step, [x, y]) in steps[i].iter_mut().zip(&OFFSETS) {
                *step = dx * x + dy * y;
            }
        }
        let at = |i: usize, x: f64, y: f64| planes[i][0] + planes[i][1] * x + planes[i][2] * y;
        for y in y0..y1 {
            for x in x0..x1 {
                let (px, py) = (x as f64, y as f64);
                let (c0, c1, c2) = (at(0, px, py), at(1, px, py), at(2, px, py));
                if c0 + reach[0] < 0.0 || c1 + reach[1] < 0.0 || c2 + reach[2] < 0.0 {
                    continue;
                }
                let mut least = [0.0; SAMPLES];
                for k in 0..SAMPLES {
                    least[k] = (c0 + steps[0][k]).min(c1 + steps[1][k]).min(c2 + steps[2][k]);
                }
                let start = (y * TILE + x) * SAMPLES;
                for (k, sample) in self.samples[start..start + SAMPLES].iter_mut().enumerate() {
                    if least[k] >= -SLACK {
                        see(sample, patch, &p, [c0 + steps[0][k], c1 + steps[1][k], c2 + steps[2][k]]);
                    }
                }
            }
        }
    }
}

#[inline]
fn see(sample: &mut Sample, patch: u32, p: &[Point; 3], share: [f64; 3]) {
    let mix = |a: f64, b: f64, c: f64| share[0] * a + share[1] * b + share[2] * c;
    let nearness = mix(p[0].nearness, p[1].nearness, p[2].nearness) as f32;
    if nearness > sample.nearness {
        let depth = 1.0 / mix(p[0].inverse_depth, p[1].inverse_depth, p[2].inverse_depth);
        let [s, t] = [mix(p[0].s, p[1].s, p[2].s) * depth, mix(p[0].t, p[1].t, p[2].t) * depth];
        *sample = Sample { nearness, patch, s: s as f32, t: t as f32 };
    }
}

/// Into how many parts each side of a quad is cut: what a cell's two triangles miss falls with the square of their number.
/// Triangles are drawn with perspective, so what they miss is twist before the division by depth: that of places, seen from where
/// the cell is, since depths twist too. Of all such places a corner is the worst.
fn parts(corners: &[Seen; 4]) -> usize {
    let depth = corners.map(|corner| 1.0 / corner.inverse_depth);
    let least = depth.iter().copied().fold(f64::INFINITY, f64::min);
    let twist = |from: &Seen| {
        let offset: [Vec2; 4] = std::array::from_fn(|i| (corners[i].place - from.place) * depth[i]);
        (offset[0] - offset[1] + offset[2] - offset[3]).norm() / (4.0 * least)
    };
    let twist = corners.iter().map(twist).fold(0.0, f64::max);
    ((twist / TOLERANCE).sqrt().ceil().clamp(1.0, MOST_PARTS)) as usize
}

/// A point of the bilinear patch in space, as the picture has it: mixed before the division by depth.
fn bilinear(corners: &[Seen; 4], s: f64, t: f64) -> Seen {
    let shares = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
    let (mut depth, mut place, mut flat_nearness) = (0.0, Vec2::zeros(), 0.0);
    for (corner, share) in corners.iter().zip(shares) {
        let weight = share / corner.inverse_depth;
        depth += weight;
        place += corner.place * weight;
        flat_nearness += corner.nearness * weight;
    }
    // Without perspective every depth is 1; with it, nearness is the inverse depth and its weighted sum is 1.
    Seen { place: place / depth, nearness: flat_nearness / depth, inverse_depth: 1.0 / depth }
}
