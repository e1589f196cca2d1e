//! How far a step may go: no corner may reach zero area.

use rayon::prelude::*;

use crate::lanes::{LANES, Lanes, vectorized};
use crate::qmesh::Vec2;

use super::rest::{Rest, RestCorner};

/// Corners that one task takes.
const CHUNK: usize = 2048;

/// The smallest positive `t` at which a corner of `uv + t · direction` has no area; infinite when none ever has.
///
/// Each corner's area is a quadratic in `t` [Smith, Schaefer 2015].
pub(super) fn first_collapse(rest: &Rest, uv: &[Vec2], direction: &[Vec2]) -> f64 {
    let chunks = rest.corners.par_chunks(CHUNK);
    chunks.map(|corners| first_of(corners, uv, direction)).reduce(|| f64::INFINITY, f64::min)
}

fn first_of(corners: &[RestCorner], uv: &[Vec2], direction: &[Vec2]) -> f64 {
    vectorized(
        #[inline(always)]
        || {
            let mut first = Lanes::all(f64::INFINITY);
            for eight in corners.chunks(LANES) {
                let [from, along] = [uv, direction].map(|places| edges(eight, places));
                let ([ax, ay, bx, by], [cx, cy, dx, dy]) = (from, along);
                let root = smallest_root(
                    cx * dy - cy * dx,
                    ax * dy - ay * dx + cx * by - cy * bx,
                    ax * by - ay * bx,
                );
                first = root.if_less(first, root, first);
            }
            first.0.into_iter().fold(f64::INFINITY, f64::min)
        },
    )
}

/// The edge vectors, to the next and to the previous vertex, of up to eight corners; the last one's again where there are fewer.
#[inline(always)]
fn edges(corners: &[RestCorner], uv: &[Vec2]) -> [Lanes; 4] {
    let mut f = [Lanes::ZERO; 4];
    for l in 0..LANES {
        let [here, next, previous] = corners[l.min(corners.len() - 1)].vertices;
        let (here, next, previous) = (uv[here as usize], uv[next as usize], uv[previous as usize]);
        f[0].0[l] = next.x - here.x;
        f[1].0[l] = next.y - here.y;
        f[2].0[l] = previous.x - here.x;
        f[3].0[l] = previous.y - here.y;
    }
    f
}

/// The smallest positive roots of `a t² + b t + c`, where `c > 0`; infinite where there is none.
#[inline(always)]
fn smallest_root(a: Lanes, b: Lanes, c: Lanes) -> Lanes {
    let never = Lanes::all(f64::INFINITY);
    let discriminant = b * b - a * c * 4.0;
    // The form without cancellation: with c > 0 the smallest positive root is this one, if it is positive.
    let denominator = discriminant.sqrt() - b;
    let root = c * 2.0 * denominator.recip();
    let root = Lanes::ZERO.if_less(denominator, root, never);
    discriminant.if_less(Lanes::ZERO, never, root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Where a positive quadratic first has no value is a root of it, and there is none before.
        #[test]
        fn roots_are_the_first(b in prop::array::uniform8(-3.0..3.0f64), a in prop::array::uniform8(-3.0..3.0f64), c in prop::array::uniform8(1e-3..3.0f64)) {
            let roots = smallest_root(Lanes(a), Lanes(b), Lanes(c)).0;
            for l in 0..LANES {
                let value = |t: f64| (a[l] * t + b[l]) * t + c[l];
                let end = if roots[l].is_finite() {
                    prop_assert!(value(roots[l]).abs() <= 1e-12 * (c[l] + (b[l] * roots[l]).abs() + (a[l] * roots[l] * roots[l]).abs()));
                    roots[l]
                } else {
                    1e3
                };
                prop_assert!((0..100).all(|k| value(end * f64::from(k) / 100.0) > 0.0));
            }
        }
    }
}
