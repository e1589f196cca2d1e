//! Measures of faces as colours, and the scale that says what a colour means.

use qoptimize::FaceMeasures;

use super::color::{Linear, Rgba};
use super::colormap::Colormap;

/// What a heat map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// By how many degrees corner angles are off.
    Angle,
    /// Area in the plane over area in space.
    Area,
    /// Symmetric Dirichlet energy.
    Stretch,
}

/// Which value has which colour.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatScale {
    /// What the values are, for the legend.
    pub title: &'static str,
    /// What they look like.
    pub map: Colormap,
    /// The values at the ends. What lies beyond has the colour of the end.
    pub range: [f64; 2],
    is_logarithmic: bool,
}

/// Of faces with a flipped corner, whatever their values.
pub const FLIPPED: Rgba = Rgba([255, 0, 220, 255]);

/// This share of the values lies below the upper end of a scale.
const QUANTILE: f64 = 0.98;

impl Measure {
    /// The values of all faces.
    #[must_use]
    pub fn values(self, measures: &FaceMeasures) -> &[f64] {
        match self {
            Self::Angle => &measures.angle_degrees,
            Self::Area => &measures.area_ratio,
            Self::Stretch => &measures.symmetric_dirichlet,
        }
    }

    /// What the values are.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Angle => "angle error, degrees",
            Self::Area => "area in the map / on the surface",
            Self::Stretch => "stretch (symmetric Dirichlet)",
        }
    }

    /// Whether `range` can be the ends of a scale: rising, finite, and for areas and stretches positive.
    #[must_use]
    pub fn accepts(self, range: [f64; 2]) -> bool {
        let [low, high] = range;
        low < high && low.is_finite() && high.is_finite() && (self == Self::Angle || low > 0.0)
    }

    /// A scale for these values that ends at round numbers; outliers are beyond it.
    #[must_use]
    pub fn scale(self, measures: &FaceMeasures) -> HeatScale {
        let mut values: Vec<f64> = match self {
            // Twice as large and half as large are equally far off.
            Self::Area => self.values(measures).iter().map(|ratio| ratio.max(1e-12).ln().abs()).collect(),
            _ => self.values(measures).to_vec(),
        };
        values.retain(|value| value.is_finite());
        values.sort_unstable_by(f64::total_cmp);
        let place = (values.len().saturating_sub(1) as f64 * QUANTILE).round() as usize;
        let most = values.get(place).copied().unwrap_or(1.0);
        match self {
            Self::Angle => self.scale_of([0.0, round_up(most.max(0.1))]),
            Self::Area => {
                let factor = round_up_factor(most.exp());
                self.scale_of([1.0 / factor, factor])
            }
            Self::Stretch => self.scale_of([1.0, round_up_factor(most)]),
        }
    }

    /// A scale with these ends, for comparing pictures; see [`accepts`](Self::accepts).
    #[must_use]
    pub fn scale_of(self, range: [f64; 2]) -> HeatScale {
        let map = if self == Self::Area { Colormap::Diverging } else { Colormap::Sequential };
        HeatScale { title: self.title(), map, range, is_logarithmic: self != Self::Angle }
    }
}

/// The next of 1, 1.5, 2, 3, 5, 7 times a power of ten.
fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|&step| step >= value * (1.0 - 1e-9)).unwrap_or(value)
}

/// The next round factor above 1.
fn round_up_factor(value: f64) -> f64 {
    let near = [1.05, 1.1, 1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0];
    near.into_iter().find(|&factor| value <= factor).unwrap_or_else(|| round_up(value.min(1e12)))
}

impl HeatScale {
    /// Where `value` stands on the colour map, from 0 to 1. On scales for areas 1 is in the middle.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let share = |value: f64, from: f64, to: f64| (value / from).ln() / (to / from).ln();
        let place = match (self.map, self.is_logarithmic) {
            (_, true) if value <= 0.0 => 0.0,
            (Colormap::Diverging, true) if low < 1.0 && high > 1.0 => {
                let side = if value < 1.0 { low } else { high };
                0.5 + 0.5 * share(value, 1.0, side) * if value < 1.0 { -1.0 } else { 1.0 }
            }
            (_, true) => share(value, low, high),
            (_, false) => (value - low) / (high - low),
        };
        place.clamp(0.0, 1.0)
    }

    /// The colour of a value.
    #[must_use]
    pub fn color(&self, value: f64) -> Linear {
        self.map.color(self.place(value) as f32)
    }

    /// A colour for each face.
    #[must_use]
    pub fn colors(&self, values: &[f64], flipped: &[bool]) -> Vec<Linear> {
        let table = self.map.table(1024);
        let color = |value: f64| table[(self.place(value) * 1023.0).round() as usize];
        let of_face = |(&value, &flipped)| if flipped { Linear::from(FLIPPED) } else { color(value) };
        values.iter().zip(flipped).map(of_face).collect()
    }

    /// Round values within the scale, with their names; at least the two ends.
    #[must_use]
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let [low, high] = self.range;
        let ratio = high / low;
        let mut values: Vec<f64> = if !self.is_logarithmic || ratio < 3.0 {
            let step = round_step((high - low) / 5.0);
            ((low / step).ceil() as i64..=(high / step + 1e-9).floor() as i64)
                .map(|i| i as f64 * step)
                .collect()
        } else {
            let base: f64 = if ratio <= 300.0 { 2.0 } else { 10.0 };
            let exponent = |value: f64| value.ln() / base.ln();
            let first = (exponent(low) - 1e-9).ceil() as i32;
            (first..=(exponent(high) + 1e-9).floor() as i32).map(|i| base.powi(i)).collect()
        };
        for end in self.range {
            let is_far = |value: &f64| (self.place(*value) - self.place(end)).abs() > 0.06;
            values.retain(is_far);
            values.push(end);
        }
        values.sort_unstable_by(f64::total_cmp);
        values.into_iter().map(|value| (value, self.name(value))).collect()
    }

    fn name(&self, value: f64) -> String {
        if self.map == Colormap::Diverging && value < 0.7 && value > 0.0 {
            return format!("1/{}", plain(1.0 / value));
        }
        plain(value)
    }
}

fn round_step(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|step| step * power)
        .into_iter()
        .find(|&step| step >= value * (1.0 - 1e-9))
        .unwrap_or(value)
}

/// Three digits, without zeros at the end.
fn plain(value: f64) -> String {
    if value >= 1e5 {
        return format!("{value:.0e}");
    }
    let decimals = if value.abs() < 1e-9 { 0 } else { (2 - value.abs().log10().floor() as i32).clamp(0, 6) };
    let text = format!("{value:.*}", decimals as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(scale: &HeatScale) -> String {
        scale.ticks().into_iter().map(|(_, name)| name).collect::<Vec<_>>().join(" ")
    }

    /// A face half as large and one twice as large are equally far from the middle.
    #[test]
    fn areas_are_compared_by_factors() {
        let scale = Measure::Area.scale_of([0.25, 4.0]);
        for (value, place) in [(1.0, 0.5), (2.0, 0.75), (0.5, 0.25), (4.0, 1.0), (100.0, 1.0), (-1.0, 0.0)] {
            assert!((scale.place(value) - place).abs() < 1e-12, "{value}: {}", scale.place(value));
        }
        assert_eq!(ticks(&scale), "1/4 1/2 1 2 4");
    }

    #[test]
    fn scales_end_at_round_numbers() {
        let measures = |values: &[f64]| {
            let mut measures = FaceMeasures::default();
            measures.angle_degrees = values.to_vec();
            measures.area_ratio = values.to_vec();
            measures.symmetric_dirichlet = values.to_vec();
            measures
        };
        assert_eq!(ticks(&Measure::Angle.scale(&measures(&[0.0, 3.0, 17.0]))), "0 5 10 15 20");
        assert_eq!(ticks(&Measure::Area.scale(&measures(&[0.3, 2.0]))), "1/4 1/2 1 2 4");
        assert_eq!(ticks(&Measure::Stretch.scale(&measures(&[1.0, 1.04]))), "1 1.01 1.02 1.03 1.04 1.05");
        assert_eq!(
            ticks(&Measure::Stretch.scale(&measures(&[1.0, f64::INFINITY, 5000.0]))),
            "1 10 100 1000 5000"
        );
        assert_eq!(ticks(&Measure::Angle.scale(&measures(&[]))), "0 0.2 0.4 0.6 0.8 1");
    }
}
