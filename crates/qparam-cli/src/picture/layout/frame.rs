//! From the UV plane to the picture.

use qoptimize::qmesh::Vec2;

use super::super::PictureError;

/// Space around the layout, as a share of the narrower side.
const MARGIN: f64 = 0.04;
/// Multiples of a step above this are not told apart by floating-point numbers, so there are no lines to draw.
const LARGEST_MULTIPLE: f64 = (1_u64 << 52) as f64;
/// More tiles than this are not outlined: the UVs are no texture coordinates then.
const MOST_TILES: f64 = 64.0;

/// What part of the plane is seen, and how large.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    low: Vec2,
    high: Vec2,
    /// Pixels a unit of UV.
    pub(super) scale: f64,
    center: Vec2,
}

impl Frame {
    /// All UVs, and the unit square unless they are far from it or much smaller or larger.
    pub(super) fn around(uv: &[Vec2], size: [usize; 2]) -> Result<Self, PictureError> {
        let low = uv.iter().copied().reduce(|a, b| a.inf(&b)).ok_or(PictureError::NoExtent)?;
        let high = uv.iter().copied().reduce(|a, b| a.sup(&b)).ok_or(PictureError::NoExtent)?;
        let extent = (high - low).max();
        if !(extent > 0.0 && extent.is_finite()) {
            return Err(PictureError::NoExtent);
        }
        let is_near = low.min() > -1.0 && high.max() < 2.0 && extent > 0.2;
        let (low, high) =
            if is_near { (low.inf(&Vec2::zeros()), high.sup(&Vec2::repeat(1.0))) } else { (low, high) };
        let size = Vec2::new(size[0] as f64, size[1] as f64);
        let inner = size - Vec2::repeat(2.0 * MARGIN * size.min());
        let extent = (high - low).map(|side| side.max(1e-9 * extent));
        let scale = (inner.x / extent.x).min(inner.y / extent.y);
        Ok(Self { low, high, scale, center: size / 2.0 })
    }

    /// The UV in the middle of the picture.
    pub(super) fn middle(&self) -> Vec2 {
        (self.low + self.high) / 2.0
    }

    /// The pixel there.
    pub(super) fn center(&self) -> Vec2 {
        self.center
    }

    /// In pixels, `y` down.
    pub(super) fn place(&self, uv: Vec2) -> Vec2 {
        let away = (uv - self.middle()) * self.scale;
        self.center + Vec2::new(away.x, -away.y)
    }

    /// The outlines of the unit squares that are seen in part, as lines from end to end.
    pub(super) fn tiles(&self) -> Vec<[Vec2; 2]> {
        if (self.high - self.low).max() > MOST_TILES {
            return Vec::new();
        }
        self.lines(1.0, self.low.map(f64::floor), self.high.map(f64::ceil))
    }

    /// Lines at multiples of `step` over what is seen.
    pub(super) fn grid(&self, step: f64) -> Vec<[Vec2; 2]> {
        self.lines(step, self.low, self.high)
    }

    fn lines(&self, step: f64, low: Vec2, high: Vec2) -> Vec<[Vec2; 2]> {
        let mut lines = Vec::new();
        for axis in 0..2 {
            let slack = 1e-9 * (high - low).max() / step;
            let (first, last) = ((low[axis] / step - slack).ceil(), (high[axis] / step + slack).floor());
            if [first, last].into_iter().any(|at| at.is_nan() || at.abs() > LARGEST_MULTIPLE) {
                continue;
            }
            lines.extend((first as i64..=last as i64).map(|multiple| {
                [low, high].map(|end| {
                    let mut uv = end;
                    uv[axis] = multiple as f64 * step;
                    self.place(uv)
                })
            }));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_square_is_seen_when_the_uvs_are_near_it() {
        let frame = |points: &[[f64; 2]]| {
            let uv: Vec<Vec2> = points.iter().map(|&[u, v]| Vec2::new(u, v)).collect();
            Frame::around(&uv, [108, 100])
        };
        let near = frame(&[[0.1, 0.2], [0.9, 0.7]]).unwrap();
        assert!((near.scale - 92.0).abs() < 1e-9);
        assert!((near.place(Vec2::new(0.0, 1.0)) - Vec2::new(8.0, 4.0)).norm() < 1e-9);
        assert_eq!((near.tiles().len(), near.grid(0.25).len()), (4, 10));
        let far = frame(&[[1000.0, 0.0], [1200.0, 100.0]]).unwrap();
        assert!((far.scale - 0.5).abs() < 1e-9 && far.tiles().is_empty());
        assert!(frame(&[[0.5, 0.5], [0.5, 0.5]]).is_err() && frame(&[]).is_err());
    }

    /// Where whole numbers are no longer told apart there are no lines, and up to there they all are.
    #[test]
    fn lines_end_where_numbers_do() {
        for (at, is_drawn) in [(1e9_f64, true), (4e15, true), (1e16, false), (-1e16, false), (1e300, false)] {
            let uv = [at, at + 8.0_f64.max(1e-15 * at.abs())].map(Vec2::repeat);
            let frame = Frame::around(&uv, [100, 100]).unwrap();
            let expected = if is_drawn { 18 } else { 0 };
            assert_eq!((frame.tiles().len(), frame.grid(1.0).len()), (expected, expected), "{at}");
            assert_eq!(frame.grid(f64::NAN).len(), 0);
        }
    }
}
