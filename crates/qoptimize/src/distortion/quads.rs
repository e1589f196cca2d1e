//! Sums over quads, two at a time, where nothing is out of the ordinary.
#![allow(clippy::needless_range_loop)] // loops over lanes become vector instructions

use super::eight::{CORNERS, Eight, Stretches};
use super::tally::{ANGLE_CLAMP, Frame, STRETCH_LIMIT, Tally, face_weight};
use crate::lanes::{LANES, Lanes};

/// What [`Tally`] has of them, lane by lane.
pub(super) struct Quads {
    angle_squares: Lanes,
    angle_symmetric: Lanes,
    area_symmetric: Lanes,
    weight: Lanes,
    stretch_squares: Lanes,
    stretch_max: Lanes,
    dirichlet: Lanes,
    dirichlet_max: Lanes,
    mips: Lanes,
    arap: Lanes,
    singular_ratio: Lanes,
}

#[inline(always)]
fn largest(a: Lanes, b: Lanes) -> Lanes {
    a.if_less(b, b, a)
}

/// `(max(r, 1/r) − 1)²`.
#[inline(always)]
fn either_way(ratio: Lanes) -> Lanes {
    let more = largest(ratio, ratio.recip()) - 1.0;
    more * more
}

impl Quads {
    pub(super) const NONE: Self = Self {
        angle_squares: Lanes::ZERO,
        angle_symmetric: Lanes::ZERO,
        area_symmetric: Lanes::ZERO,
        weight: Lanes::ZERO,
        stretch_squares: Lanes::ZERO,
        stretch_max: Lanes::ZERO,
        dirichlet: Lanes::ZERO,
        dirichlet_max: Lanes::ZERO,
        mips: Lanes::ZERO,
        arap: Lanes::ZERO,
        singular_ratio: Lanes::ZERO,
    };

    /// Adds two quads whose corners start at `first`, to these sums and to the lists of `tally`. False, with nothing done, when one
    /// of them is to be looked at closely.
    #[inline(always)]
    pub(super) fn add(&mut self, frame: &Frame<'_>, first: usize, tally: &mut Tally) -> bool {
        let Some(eight) = Eight::of::<8>(&frame.surface, first, &CORNERS) else { return false };
        let Some(stretches) = eight.stretches(1.0, frame.scale) else { return false };
        let [theta, phi] = eight.angles();
        let area = eight.plane_area * (frame.scale * frame.scale);
        if !(theta.all_above(ANGLE_CLAMP)
            && phi.all_above(ANGLE_CLAMP)
            && area.all_above(frame.least_plane_area)
            && eight.space_area.all_above(frame.least_space_area))
        {
            return false;
        }
        let (turned, ratio) = (theta - phi, theta * phi.recip());
        self.angle_squares += turned * turned;
        self.angle_symmetric += either_way(ratio);
        tally.angle_terms.extend(((ratio - 1.0) * (ratio - 1.0)).0);
        let ratio = eight.space_area * area.recip();
        self.area_symmetric += either_way(ratio);
        tally.area_ratios.extend(ratio.0);
        self.add_stretches(&stretches, eight.space_area * (face_weight(4) / frame.space_area), tally);
        tally.concave_corners += concave_corners(&eight.normal);
        tally.area_positive += LANES;
        true
    }

    #[inline(always)]
    fn add_stretches(&mut self, stretches: &Stretches, weight: Lanes, tally: &mut Tally) {
        let (s1, s2) = (stretches.large, stretches.small);
        let per_squared = (stretches.determinant * stretches.determinant).recip();
        let inverse_squares = stretches.frobenius * per_squared * 0.5;
        let limit = Lanes::all(STRETCH_LIMIT * STRETCH_LIMIT);
        self.weight += weight;
        self.stretch_squares += weight * inverse_squares.if_less(limit, inverse_squares, limit);
        self.stretch_max = largest(self.stretch_max, s2.recip());
        let dirichlet = (stretches.frobenius + stretches.frobenius * per_squared) * 0.25;
        self.dirichlet += weight * dirichlet;
        self.dirichlet_max = largest(self.dirichlet_max, dirichlet);
        let ratio = s1 * s2.recip();
        self.mips += weight * (ratio + s2 * s1.recip()) * 0.5;
        self.arap += weight * ((s1 - 1.0) * (s1 - 1.0) + (s2 - 1.0) * (s2 - 1.0));
        self.singular_ratio += weight * ratio;
        tally.singular_ratios.extend(ratio.0);
    }

    /// Adds all sums to those of `tally`.
    pub(super) fn add_to(&self, tally: &mut Tally) {
        let sum = |lanes: Lanes| lanes.0.iter().sum::<f64>();
        let largest = |lanes: Lanes| lanes.0.into_iter().fold(0.0, f64::max);
        tally.angle_squares += sum(self.angle_squares);
        tally.angle_symmetric += sum(self.angle_symmetric);
        tally.area_symmetric += sum(self.area_symmetric);
        tally.positive_weight += sum(self.weight);
        tally.stretch_weight += sum(self.weight);
        tally.stretch_squares += sum(self.stretch_squares);
        tally.stretch_max = tally.stretch_max.max(largest(self.stretch_max));
        tally.symmetric_dirichlet += sum(self.dirichlet);
        tally.symmetric_dirichlet_max = tally.symmetric_dirichlet_max.max(largest(self.dirichlet_max));
        tally.mips += sum(self.mips);
        tally.arap += sum(self.arap);
        tally.singular_ratio += sum(self.singular_ratio);
    }
}

/// Corners whose normal is against the mean of their quad's.
#[inline(always)]
fn concave_corners(normal: &[Lanes; 3]) -> usize {
    let mut count = 0;
    for quad in [0, 4] {
        let mean = normal.map(|of| of.0[quad..quad + 4].iter().sum::<f64>());
        for l in quad..quad + 4 {
            let along = normal[0].0[l] * mean[0] + normal[1].0[l] * mean[1] + normal[2].0[l] * mean[2];
            count += usize::from(along <= 0.0);
        }
    }
    count
}
