//! Colour maps from formulas in Oklab: even steps of a value are even steps for the eye.

use super::color::{Linear, oklch};

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colormap {
    /// From dark violet over green to light yellow, for what starts at a best value. Lightness rises evenly, so it reads in
    /// black and white too.
    Sequential,
    /// Blue below, light grey in the middle, red above, for what can miss its best value both ways.
    Diverging,
}

impl Colormap {
    /// The colour of `t`, which is cut to [0, 1].
    #[must_use]
    pub fn color(self, t: f32) -> Linear {
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        match self {
            // The hue turns by equal steps. Chroma stays just within what sRGB has, which is least for blue-green.
            Self::Sequential => {
                let chroma = 0.098 + 0.19 * (t - 0.45).powi(2);
                oklch(0.28 + 0.64 * t, chroma, 310.0 - 205.0 * t)
            }
            Self::Diverging => {
                let away = 2.0 * (t - 0.5).abs();
                let hue = if t < 0.5 { 255.0 } else { 32.0 };
                oklch(0.95 - 0.50 * away, 0.16 * away, hue)
            }
        }
    }

    /// `count` colours in even steps from end to end; at least two.
    #[must_use]
    pub fn table(self, count: usize) -> Vec<Linear> {
        let last = count.max(2) - 1;
        (0..=last).map(|i| self.color(i as f32 / last as f32)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::color::lightness;
    use super::*;

    /// Lightness rises by the same amount everywhere, within the rounding of the gamut.
    #[test]
    fn the_sequential_map_gets_lighter_evenly() {
        let lights: Vec<f32> = Colormap::Sequential.table(33).into_iter().map(lightness).collect();
        let step = (lights[32] - lights[0]) / 32.0;
        assert!(lights.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 0.15 * step), "{lights:?}");
    }

    /// The diverging map treats both directions alike, and is lightest in the middle.
    #[test]
    fn the_diverging_map_is_symmetric_in_lightness() {
        let lights: Vec<f32> = Colormap::Diverging.table(21).into_iter().map(lightness).collect();
        assert!((0..10).all(|i| (lights[i] - lights[20 - i]).abs() < 5e-3 && lights[i] < lights[i + 1]));
        let [r, g, b] = Colormap::Diverging.color(0.5).0;
        assert!((r - g).abs() < 1e-3 && (g - b).abs() < 1e-3, "the middle is grey");
    }
}
