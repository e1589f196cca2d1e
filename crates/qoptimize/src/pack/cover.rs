//! The cells that an island needs.

use qembed::qmesh::Vec2;

use super::Shape;

/// Cells are covered when an island comes within this fraction of a cell: far more than coordinates round.
const SLACK: f64 = 1e-6;

/// Cells in a row, and rows, at most: what is larger is cut off, has no place on any grid, and is only to do no harm.
pub(super) const LONGEST: f64 = 1e6;

/// The cells that contain an island and its margin; the lowest and leftmost have coordinate 0.
pub(super) struct Cover {
    width: u32,
    /// For each row the cells that are covered, as runs `[from, to)`; rows by their place in `runs`.
    rows: Vec<u32>,
    runs: Vec<[u32; 2]>,
}

impl Cover {
    /// The cover of a shape whose bounding box starts at `low`, with `scale` cells to a unit and `around` cells on
    /// each side.
    pub(super) fn new(shape: &Shape<'_>, low: Vec2, scale: f64, around: f64) -> Self {
        let at = |p: &Vec2| (p - low) * scale + Vec2::repeat(around);
        let around = around + SLACK;
        let mut spans: Vec<[u32; 3]> = Vec::new();
        let mut corners: Vec<Vec2> = Vec::new();
        for pair in shape.face_start.windows(2) {
            corners.clear();
            corners.extend(shape.uv[pair[0] as usize..pair[1] as usize].iter().map(at));
            cover_face(&corners, around, &mut spans);
        }
        if spans.is_empty() {
            spans.push([0, 0, 1]);
        }
        spans.sort_unstable();
        let height = spans[spans.len() - 1][0] + 1;
        let mut rows = vec![0];
        let mut runs: Vec<[u32; 2]> = Vec::new();
        let mut next = spans.iter().peekable();
        for row in 0..height {
            let first = runs.len();
            while let Some(&&[_, from, to]) = next.peek().filter(|span| span[0] == row) {
                match runs[first..].last_mut() {
                    Some(last) if last[1] >= from => last[1] = last[1].max(to),
                    _ => runs.push([from, to]),
                }
                next.next();
            }
            rows.push(runs.len() as u32);
        }
        let width = runs.iter().map(|run| run[1]).max().unwrap_or(1);
        Self { width, rows, runs }
    }

    pub(super) fn width(&self) -> u32 {
        self.width
    }

    pub(super) fn height(&self) -> u32 {
        self.rows.len() as u32 - 1
    }

    /// How many cells are covered.
    pub(super) fn cells(&self) -> usize {
        self.runs.iter().map(|[from, to]| (to - from) as usize).sum()
    }

    /// The covered runs of a row.
    pub(super) fn row(&self, row: u32) -> &[[u32; 2]] {
        &self.runs[self.rows[row as usize] as usize..self.rows[row as usize + 1] as usize]
    }
}

/// Appends `[row, from, to]` for each row of cells that comes within `around` of the convex hull of a face.
fn cover_face(corners: &[Vec2], around: f64, spans: &mut Vec<[u32; 3]>) {
    let cell = |x: f64| x.clamp(0.0, LONGEST).floor() as u32;
    let low = corners.iter().map(|p| p.y).fold(f64::INFINITY, f64::min) - around;
    let high = corners.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max) + around;
    for row in cell(low)..=cell(high) {
        // The part of each edge that lies in the row or within `around` of it.
        let (bottom, top) = (f64::from(row) - around, f64::from(row + 1) + around);
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut previous = corners[corners.len() - 1];
        for &corner in corners {
            let (a, b) = if previous.y <= corner.y { (previous, corner) } else { (corner, previous) };
            previous = corner;
            if b.y < bottom || a.y > top {
                continue;
            }
            let slope = if b.y > a.y { (b.x - a.x) / (b.y - a.y) } else { 0.0 };
            let start = if a.y < bottom { a.x + slope * (bottom - a.y) } else { a.x };
            let end = if b.y > top { b.x - slope * (b.y - top) } else { b.x };
            // Rounding of steep slopes stays within the edge.
            for x in [start, end] {
                let x = x.max(a.x.min(b.x)).min(a.x.max(b.x));
                (left, right) = (left.min(x), right.max(x));
            }
            if a.y == b.y {
                (left, right) = (left.min(b.x), right.max(b.x));
            }
        }
        if left <= right {
            spans.push([row, cell(left - around), cell(right + around) + 1]);
        }
    }
}
