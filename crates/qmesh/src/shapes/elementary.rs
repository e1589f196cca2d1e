//! Sine, cosine, exponential and a generator of random numbers that give the same bits everywhere.
//!
//! The functions of the standard library may differ in the last digit between platforms. These use only
//! `+ − × /` and rounding, which IEEE 754 defines to the bit.

use std::f64::consts::{FRAC_PI_2, LN_2};

/// `[sin, cos]` of an angle in turns (`1.0` is a full circle): reducing such an angle is exact.
pub(crate) fn sin_cos(turns: f64) -> [f64; 2] {
    let quarters = (4.0 * turns).round();
    let x = (4.0 * turns - quarters) * FRAC_PI_2; // |x| ≤ π/4
    let square = x * x;
    let sine = x * alternating(square, 1.0);
    let cosine = alternating(square, 0.0);
    match quarters.rem_euclid(4.0) as u8 {
        0 => [sine, cosine],
        1 => [cosine, -sine],
        2 => [-sine, -cosine],
        _ => [-cosine, sine],
    }
}

/// The Taylor series `1 − s/((f+1)(f+2)) · (1 − s/((f+3)(f+4)) · …)`: cosine for `first` 0, `sin x / x` for 1.
fn alternating(square: f64, first: f64) -> f64 {
    (0..9).rev().fold(1.0, |tail, term| {
        let n = first + 2.0 * f64::from(term);
        1.0 - square / ((n + 1.0) * (n + 2.0)) * tail
    })
}

/// `e^x`, for `x` between −700 and 700 (clamped).
pub(crate) fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    let doublings = (x / LN_2).round();
    let rest = x - doublings * LN_2;
    let series = (1..=16).rev().fold(1.0, |tail, n| 1.0 + rest / f64::from(n) * tail);
    let factor = if doublings < 0.0 { 0.5 } else { 2.0 };
    (0..doublings.abs() as u32).fold(series, |value, _| value * factor)
}

/// A bell of height 1 and standard deviation `width` over the squared distance from its centre.
pub(crate) fn gauss(squared_distance: f64, width: f64) -> f64 {
    exp(-0.5 * squared_distance / (width * width))
}

/// Steele, Lea and Flood's SplitMix64: small, and good enough to shake vertices.
pub(crate) struct SplitMix64(pub(crate) u64);

impl SplitMix64 {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly distributed in `[−1, 1)`.
    pub(crate) fn signed(&mut self) -> f64 {
        const BITS_53: f64 = 9_007_199_254_740_992.0;
        (self.next() >> 11) as f64 / BITS_53 * 2.0 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn sine_and_cosine_agree_with_the_standard_library() {
        for i in -4000..4000 {
            let turns = f64::from(i) / 1317.0;
            let [sine, cosine] = sin_cos(turns);
            assert!((sine - (turns * TAU).sin()).abs() < 4e-15, "sin of {turns} turns");
            assert!((cosine - (turns * TAU).cos()).abs() < 4e-15, "cos of {turns} turns");
        }
        assert_eq!(sin_cos(0.25), [1.0, -0.0], "quarter turns are exact");
        assert_eq!(sin_cos(-0.5), [0.0, -1.0]);
    }

    #[test]
    fn the_exponential_agrees_with_the_standard_library() {
        for i in -3000..3000 {
            let x = f64::from(i) / 10.0;
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-13, "exp({x}): {} and {}", exp(x), x.exp());
        }
        assert!(exp(-1e300) > 0.0 && exp(1e300).is_finite());
    }

    /// The first outputs for seed 1234567, as published with the reference implementation.
    #[test]
    fn the_generator_is_splitmix64() {
        let mut random = SplitMix64(1_234_567);
        let outputs = [random.next(), random.next(), random.next()];
        assert_eq!(
            outputs,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
    }
}
