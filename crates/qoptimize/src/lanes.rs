//! Eight numbers at a time. Each operation is a loop over an array, which compilers turn into vector instructions; the results
//! are those of the same operations one by one, so they are the same on every machine.
#![allow(clippy::needless_range_loop, clippy::assign_op_pattern)] // loops over lanes become vector instructions

use pulp::Arch;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Runs `act`, a closure that is always inlined, with the widest vector instructions that there are.
///
/// Closures have to come here by way of this bound, `FnOnce`: only then are they inlined where those instructions are allowed.
pub(crate) fn vectorized<R>(act: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(act)
}

/// How many numbers go together.
pub(crate) const LANES: usize = 8;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

macro_rules! lane_by_lane {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(mut self, other: Self) -> Self {
                for l in 0..LANES {
                    self.0[l] = self.0[l] $operator other.0[l];
                }
                self
            }
        }

        impl $trait<f64> for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(mut self, other: f64) -> Self {
                for l in 0..LANES {
                    self.0[l] = self.0[l] $operator other;
                }
                self
            }
        }
    };
}

lane_by_lane!(Add, add, +);
lane_by_lane!(Sub, sub, -);
lane_by_lane!(Mul, mul, *);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for l in 0..LANES {
            self.0[l] = -self.0[l];
        }
        self
    }
}

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn all(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(crate) fn recip(mut self) -> Self {
        for l in 0..LANES {
            self.0[l] = 1.0 / self.0[l];
        }
        self
    }

    #[inline(always)]
    pub(crate) fn sqrt(mut self) -> Self {
        for l in 0..LANES {
            self.0[l] = self.0[l].sqrt();
        }
        self
    }

    #[inline(always)]
    pub(crate) fn abs(mut self) -> Self {
        for l in 0..LANES {
            self.0[l] = self.0[l].abs();
        }
        self
    }

    /// Where `self < bound` the one, elsewhere the other.
    #[inline(always)]
    pub(crate) fn if_less(self, bound: Self, then: Self, otherwise: Self) -> Self {
        let mut chosen = otherwise;
        for l in 0..LANES {
            chosen.0[l] = if self.0[l] < bound.0[l] { then.0[l] } else { otherwise.0[l] };
        }
        chosen
    }

    /// Whether all are normal numbers above `bound`.
    #[inline(always)]
    pub(crate) fn all_above(self, bound: f64) -> bool {
        let mut all = true;
        for l in 0..LANES {
            all &= self.0[l] > bound && self.0[l] < f64::MAX;
        }
        all
    }

    /// The natural logarithm of positive normal numbers, to about 1e-16 of itself.
    ///
    /// [Cephes Mathematical Library, Moshier 1989, log.c]: a rational function of the mantissa between √½ and √2.
    #[inline(always)]
    pub(crate) fn ln(self) -> Self {
        const P: [f64; 6] = [
            1.018_756_638_045_809_3e-4,
            4.974_949_949_767_47e-1,
            4.705_791_198_788_817,
            1.449_892_253_416_109_3e1,
            1.793_686_785_078_198_2e1,
            7.708_387_337_558_854,
        ];
        const Q: [f64; 5] = [
            1.128_735_871_891_674_5e1,
            4.522_791_458_375_322e1,
            8.298_752_669_127_766e1,
            7.115_447_506_185_639e1,
            2.312_516_201_267_653_4e1,
        ];
        let (mut mantissa, mut exponent) = (self, self);
        for l in 0..LANES {
            let bits = self.0[l].to_bits();
            mantissa.0[l] = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3fe0_0000_0000_0000);
            // The exponent in the last places of 2^52: subtracting makes a number of it.
            exponent.0[l] =
                f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1022.0);
        }
        let half = Self::all(std::f64::consts::FRAC_1_SQRT_2);
        exponent = mantissa.if_less(half, exponent - 1.0, exponent);
        let x = mantissa.if_less(half, mantissa + mantissa, mantissa) - 1.0;
        let square = x * x;
        let ratio = x.polynomial(&P) * (x.monic(&Q)).recip();
        // The logarithm of 2 in two parts, the first of which has few digits.
        let low = x * square * ratio - exponent * 2.121_944_400_546_905_8e-4 - square * 0.5;
        x + low + exponent * 0.693_359_375
    }

    /// `atan2(y, x)` for positive `self = y`, to about 2e-16 of itself.
    ///
    /// [Cephes Mathematical Library, Moshier 1989, atan.c]: a rational function of tangents up to 0.66.
    #[inline(always)]
    pub(crate) fn atan2_positive(self, x: Self) -> Self {
        const P: [f64; 5] = [
            -8.750_608_600_031_904e-1,
            -1.615_753_718_733_365e1,
            -7.500_855_792_314_705e1,
            -1.228_866_684_490_136_1e2,
            -6.485_021_904_942_025e1,
        ];
        const Q: [f64; 5] = [
            2.485_846_490_142_306_3e1,
            1.650_270_098_316_988_4e2,
            4.328_810_604_912_902_6e2,
            4.853_903_996_359_137e2,
            1.945_506_571_482_614e2,
        ];
        use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
        let (y, size) = (self, x.abs());
        let larger = size.if_less(y, y, size);
        let smaller = size.if_less(y, size, y);
        // Above 0.66: atan(s/l) = π/4 + atan((s − l)/(s + l)).
        let bound = larger * 0.66;
        let numerator = bound.if_less(smaller, smaller - larger, smaller);
        let denominator = bound.if_less(smaller, smaller + larger, larger);
        let offset = bound.if_less(smaller, Self::all(FRAC_PI_4), Self::ZERO);
        let t = numerator * denominator.recip();
        let z = t * t;
        let angle = offset + (t + t * z * z.polynomial(&P) * z.monic(&Q).recip());
        let angle = size.if_less(y, Self::all(FRAC_PI_2) - angle, angle);
        x.if_less(Self::ZERO, Self::all(PI) - angle, angle)
    }

    /// Coefficients from the highest power down.
    #[inline(always)]
    fn polynomial<const N: usize>(self, coefficients: &[f64; N]) -> Self {
        let mut sum = Self::all(coefficients[0]);
        for &coefficient in &coefficients[1..] {
            sum = sum * self + coefficient;
        }
        sum
    }

    /// As [`Lanes::polynomial`], after a highest coefficient of one.
    #[inline(always)]
    fn monic<const N: usize>(self, coefficients: &[f64; N]) -> Self {
        let mut sum = self + coefficients[0];
        for &coefficient in &coefficients[1..] {
            sum = sum * self + coefficient;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Logarithm and angle are those of the standard library within a few units of the last place.
        #[test]
        fn functions_are_accurate(x in prop::array::uniform8(-300.0..300.0f64), phi in prop::array::uniform8(1e-9..3.1f64)) {
            let ln = Lanes(x.map(|x| 10f64.powf(x))).ln();
            let near_one = Lanes(x.map(|x| 1.0 + 1e-3 * x)).ln();
            let angle = Lanes(phi.map(|phi| 3.0 * phi.sin())).atan2_positive(Lanes(phi.map(|phi| 3.0 * phi.cos())));
            for l in 0..LANES {
                let exact = 10f64.powf(x[l]).ln();
                prop_assert!((ln.0[l] - exact).abs() <= 4e-16 * (1.0 + exact.abs()));
                let exact = (1.0 + 1e-3 * x[l]).ln();
                prop_assert!((near_one.0[l] - exact).abs() <= 4e-16 * exact.abs());
                let exact = (3.0 * phi[l].sin()).atan2(3.0 * phi[l].cos());
                prop_assert!((angle.0[l] - exact).abs() <= 6e-16 * exact, "{} {exact}", angle.0[l]);
            }
        }
    }
}
