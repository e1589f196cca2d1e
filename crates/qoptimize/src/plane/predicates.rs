//! Signs of areas, exact for all finite coordinates.
//!
//! The adaptive predicate of [Shewchuk 1997] is exact as long as nothing overflows or underflows. Where something might, the
//! determinant is summed up as a long integer.

use std::cmp::Ordering;

use qembed::qmesh::Vec2;
use robust::{Coord, orient2d};

/// `(3 + 16 ε) ε`, ε = 2⁻⁵³: what rounding can do to the determinant, relative to the sum of its two products
/// ([Shewchuk 1997], section 4.2).
const FILTER: f64 = 3.330_669_073_875_471_6e-16;
/// Products above this lose nothing to underflow that the filter would notice.
const NORMAL: f64 = 1e-280;
/// Coordinates between this and its reciprocal are multiples of 2⁻⁵⁰², so that products of their differences are multiples of
/// 2⁻¹⁰⁰⁴ and stay finite: the adaptive predicate is exact.
const LEAST: f64 = 3.439_541_192_180_277_4e-136; // 2⁻⁴⁵⁰

/// Which way a → b → c turns: 1 left, −1 right, 0 straight on (or back). Exact. 0 for coordinates that are not finite.
#[inline]
pub(crate) fn orientation(a: Vec2, b: Vec2, c: Vec2) -> i32 {
    let (left, right) = ((a.x - c.x) * (b.y - c.y), (a.y - c.y) * (b.x - c.x));
    let (turn, size) = (left - right, left.abs() + right.abs());
    if size > NORMAL && size.is_finite() && turn.abs() > FILTER * size {
        return if turn > 0.0 { 1 } else { -1 };
    }
    closely(a, b, c)
}

fn closely(a: Vec2, b: Vec2, c: Vec2) -> i32 {
    let points = [a, b, c];
    if points.iter().flatten().all(|&x| x == 0.0 || (LEAST..=LEAST.recip()).contains(&x.abs())) {
        let [a, b, c] = points.map(|p| Coord { x: p.x, y: p.y });
        let turn = orient2d(a, b, c);
        return i32::from(turn > 0.0) - i32::from(turn < 0.0);
    }
    if points.iter().flatten().all(|x| x.is_finite()) { exactly(a, b, c) } else { 0 }
}

/// The six products of the determinant as integers in units of 2⁻²¹⁴⁸, what adds to it and what takes away apart.
fn exactly(a: Vec2, b: Vec2, c: Vec2) -> i32 {
    let (mut plus, mut minus) = ([0_u64; LIMBS], [0_u64; LIMBS]);
    for (p, q) in [(a, b), (b, c), (c, a)] {
        for (x, y, is_taken) in [(p.x, q.y, false), (p.y, q.x, true)] {
            let is_negative = is_taken ^ (x < 0.0) ^ (y < 0.0);
            add_product(if is_negative { &mut minus } else { &mut plus }, x, y);
        }
    }
    match plus.iter().rev().cmp(minus.iter().rev()) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

/// 106 bits, shifted by up to 2 · 2045, and room for the sum of six.
const LIMBS: usize = 68;

/// Adds `|x y|`.
fn add_product(sum: &mut [u64; LIMBS], x: f64, y: f64) {
    let [(m, e), (n, f)] = [x, y].map(parts);
    let product = u128::from(m) * u128::from(n);
    let (limb, bit) = ((e + f) / 64, (e + f) % 64);
    let low = product << bit;
    let high = if bit == 0 { 0 } else { product >> (128 - bit) };
    let mut carry = 0_u64;
    for (place, word) in sum[limb..].iter_mut().enumerate() {
        let add = match place {
            0 => low as u64,
            1 => (low >> 64) as u64,
            2 => high as u64,
            _ if carry == 0 => break,
            _ => 0,
        };
        let total = u128::from(*word) + u128::from(add) + u128::from(carry);
        (*word, carry) = (total as u64, (total >> 64) as u64);
    }
}

/// `|x|` as an integer m and an exponent e ≥ 0 with `|x| = m · 2^(e − 1074)`.
fn parts(x: f64) -> (u64, usize) {
    const MANTISSA: u64 = (1 << 52) - 1;
    let bits = x.to_bits();
    match (bits >> 52) & 0x7ff {
        0 => (bits & MANTISSA, 0),
        exponent => (bits & MANTISSA | 1 << 52, exponent as usize - 1),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn small() -> impl Strategy<Value = Vec2> {
        (-20_i32..20, -20_i32..20).prop_map(|(x, y)| Vec2::new(f64::from(x), f64::from(y)))
    }

    proptest! {
        /// On small integers, the sign of the integer determinant, at every scale that `f64` has: powers of two that differ
        /// in x and y change no sign.
        #[test]
        fn exact_at_every_scale(a in small(), b in small(), c in small(), i in -1074..1018, j in -1074..1018) {
            let turn = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
            let expected = i32::from(turn > 0.0) - i32::from(turn < 0.0);
            // In two steps, since 2⁻¹⁰⁷⁴ is the smallest number there is.
            let scaled = |p: Vec2| Vec2::new(p.x * f64::from(i).exp2(), p.y * f64::from(j).exp2());
            prop_assert_eq!(orientation(a, b, c), expected);
            prop_assert_eq!(exactly(a, b, c), expected);
            prop_assert_eq!(orientation(scaled(a), scaled(b), scaled(c)), expected);
        }

        /// The long integers agree with the adaptive predicate wherever that one is exact, down to the last digit.
        #[test]
        fn long_integers_agree_with_expansions(a in small(), b in small(), c in small(), ulps in prop::array::uniform6(-2_i64..3)) {
            let nudge = |p: Vec2, k: usize| {
                let bits = |x: f64, by: i64| f64::from_bits((1.0 + x / 64.0).to_bits().wrapping_add_signed(by));
                Vec2::new(bits(p.x, ulps[k]), bits(p.y, ulps[k + 1]))
            };
            let (a, b, c) = (nudge(a, 0), nudge(b, 2), nudge(c, 4));
            let expected = orient2d(Coord { x: a.x, y: a.y }, Coord { x: b.x, y: b.y }, Coord { x: c.x, y: c.y });
            let expected = i32::from(expected > 0.0) - i32::from(expected < 0.0);
            prop_assert_eq!(exactly(a, b, c), expected);
            prop_assert_eq!(orientation(a, b, c), expected);
        }
    }

    /// Two triangles that differ from collinear by the smallest number of all, beside coordinates near the largest.
    #[test]
    fn the_smallest_beside_the_largest() {
        let tiny = f64::from_bits(1);
        let [origin, far] = [Vec2::zeros(), Vec2::new(f64::MAX, 0.0)];
        assert_eq!(orientation(origin, far, Vec2::new(1.0, tiny)), 1);
        assert_eq!(orientation(origin, far, Vec2::new(1.0, -tiny)), -1);
        assert_eq!(orientation(origin, far, Vec2::new(-f64::MAX, 0.0)), 0);
        assert_eq!(orientation(origin, far, Vec2::new(f64::NAN, 1.0)), 0);
        let corner = Vec2::new(-f64::MAX, -f64::MAX);
        assert_eq!(orientation(corner, far, Vec2::new(f64::MAX, f64::MAX)), 1);
    }
}
