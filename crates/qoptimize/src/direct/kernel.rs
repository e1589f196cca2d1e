//! The energy of [`element`](super::element) for eight corners at a time.
//!
//! Whatever is out of the ordinary (a corner without area, an angle near zero, the last corners of a chunk, other objectives) goes
//! through `element` one by one.

mod group;

use std::ops::Range;

use super::element::{self, Edges};
use super::layout::Triangle;
use super::rest::{Corners, unframed, unframed_triangle};
use super::{AngleTerm, Objective};
use crate::lanes::{LANES, Lanes, vectorized};
use crate::qmesh::Vec2;
use group::Group;

/// The sum of the energies of `corners`; infinite where one is not positive.
pub(super) fn value(objective: &Objective, chunk: Corners<'_>, uv: &[Vec2]) -> f64 {
    let count = chunk.corners.len();
    let one_by_one = |places: Range<usize>| {
        places.map(|at| element::value(objective, &chunk.corners[at], chunk.edges(at, uv))).sum::<f64>()
    };
    let Objective::Direct { q, shape, angle_term } = *objective else { return one_by_one(0..count) };
    vectorized(
        #[inline(always)]
        || {
            let (groups, last) = chunk.corners.as_chunks::<LANES>();
            let mut sums = Lanes::ZERO;
            let mut others = 0.0;
            for (number, corners) in groups.iter().enumerate() {
                let places = number * LANES..(number + 1) * LANES;
                match Group::new(corners, chunk.frames.get(places.clone()), uv).value(q, shape, angle_term) {
                    Some(values) => sums += values,
                    None => others += one_by_one(places),
                }
            }
            sums.0.iter().sum::<f64>() + others + one_by_one(count - last.len()..count)
        },
    )
}

/// The sums of the angle, area and symmetric Dirichlet terms of `corners`, each weighted as in the energy but for q and shape, and how
/// many corners are stretched beyond `limit`.
pub(super) fn terms(term: AngleTerm, limit: f64, chunk: Corners<'_>, uv: &[Vec2]) -> ([f64; 3], usize) {
    let count = chunk.corners.len();
    let add_one_by_one = |places: Range<usize>, (sums, beyond): &mut ([f64; 3], usize)| {
        for at in places {
            let (corner, edges) = (&chunk.corners[at], chunk.edges(at, uv));
            let alone =
                |q, shape| element::value(&Objective::Direct { q, shape, angle_term: term }, corner, edges);
            let area = alone(0.0, 0.0);
            let terms = [alone(1.0, 0.0), area, alone(0.0, 1.0) - area];
            sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            *beyond += usize::from(element::is_stretched_beyond(limit, corner, edges));
        }
    };
    vectorized(
        #[inline(always)]
        || {
            let (groups, last) = chunk.corners.as_chunks::<LANES>();
            let mut sums = [Lanes::ZERO; 3];
            let mut others = ([0.0; 3], 0);
            add_one_by_one(count - last.len()..count, &mut others);
            for (number, corners) in groups.iter().enumerate() {
                let places = number * LANES..(number + 1) * LANES;
                match Group::new(corners, chunk.frames.get(places.clone()), uv).terms(term, limit) {
                    Some((terms, beyond)) => {
                        (0..3).for_each(|i| sums[i] += terms[i]);
                        others.1 += beyond;
                    }
                    None => add_one_by_one(places, &mut others),
                }
            }
            (std::array::from_fn(|i| sums[i].0.iter().sum::<f64>() + others.0[i]), others.1)
        },
    )
}

/// Fills in gradient and Hessian of every corner and returns the sum of the energies, or the place of the first corner that is
/// not positive.
pub(super) fn derivatives(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
    triangles: &mut [Triangle],
) -> Result<f64, usize> {
    let value = derivatives_by_edges(objective, chunk, uv, gradients, triangles)?;
    for ((frame, gradient), triangle) in chunk.frames.iter().zip(gradients).zip(triangles) {
        *gradient = unframed(frame, *gradient);
        *triangle = unframed_triangle(frame, triangle);
    }
    Ok(value)
}

/// The same without second derivatives, for less than half of the work.
pub(super) fn gradients(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
) -> Result<f64, usize> {
    let value = gradients_by_edges(objective, chunk, uv, gradients)?;
    for (frame, gradient) in chunk.frames.iter().zip(gradients) {
        *gradient = unframed(frame, *gradient);
    }
    Ok(value)
}

fn gradients_by_edges(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
) -> Result<f64, usize> {
    let corners = chunk.corners;
    let one_by_one = |places: Range<usize>, gradients: &mut [Edges]| {
        let mut sum = 0.0;
        for at in places {
            let element = element::derivatives(objective, &corners[at], chunk.edges(at, uv)).ok_or(at)?;
            sum += element.value;
            gradients[at] = element.gradient;
        }
        Ok(sum)
    };
    let Objective::Direct { q, shape, angle_term } = *objective else {
        return one_by_one(0..corners.len(), gradients);
    };
    vectorized(
        #[inline(always)]
        || {
            let (groups, last) = corners.as_chunks::<LANES>();
            let mut sums = Lanes::ZERO;
            let mut others = 0.0;
            for (number, corners) in groups.iter().enumerate() {
                let places = number * LANES..(number + 1) * LANES;
                let group = Group::new(corners, chunk.frames.get(places.clone()), uv);
                match group.derivatives::<false>(q, shape, angle_term) {
                    Some(eight) => {
                        sums += eight.value;
                        eight.store_gradients(&mut gradients[places]);
                    }
                    None => others += one_by_one(places, gradients)?,
                }
            }
            others += one_by_one(corners.len() - last.len()..corners.len(), gradients)?;
            Ok(sums.0.iter().sum::<f64>() + others)
        },
    )
}

/// The same by the edge vectors of what the triangles stand for.
fn derivatives_by_edges(
    objective: &Objective,
    chunk: Corners<'_>,
    uv: &[Vec2],
    gradients: &mut [Edges],
    triangles: &mut [Triangle],
) -> Result<f64, usize> {
    let corners = chunk.corners;
    let one_by_one = |places: Range<usize>, gradients: &mut [Edges], triangles: &mut [Triangle]| {
        let mut sum = 0.0;
        for at in places {
            let element = element::derivatives(objective, &corners[at], chunk.edges(at, uv)).ok_or(at)?;
            sum += element.value;
            gradients[at] = element.gradient;
            triangles[at] = element.hessian;
        }
        Ok(sum)
    };
    let Objective::Direct { q, shape, angle_term } = *objective else {
        return one_by_one(0..corners.len(), gradients, triangles);
    };
    vectorized(
        #[inline(always)]
        || {
            let (groups, last) = corners.as_chunks::<LANES>();
            let mut sums = Lanes::ZERO;
            let mut others = 0.0;
            for (number, corners) in groups.iter().enumerate() {
                let places = number * LANES..(number + 1) * LANES;
                let group = Group::new(corners, chunk.frames.get(places.clone()), uv);
                match group.derivatives::<true>(q, shape, angle_term) {
                    Some(eight) => {
                        sums += eight.value;
                        eight.store(&mut gradients[places.clone()], &mut triangles[places]);
                    }
                    None => others += one_by_one(places, gradients, triangles)?,
                }
            }
            others += one_by_one(corners.len() - last.len()..corners.len(), gradients, triangles)?;
            Ok(sums.0.iter().sum::<f64>() + others)
        },
    )
}
