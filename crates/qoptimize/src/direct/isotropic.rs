//! Energies of the singular values of a 2 × 2 map, with Hessians made positive semidefinite.
//!
//! An energy ψ(s1, s2) of the singular values has a Hessian whose eigenvectors are known: two that stretch along the
//! singular directions, one that turns (twist) and one that turns the two sides against each other (flip)
//! [Smith, de Goes, Kim 2019, "Analytic eigensystems for isotropic distortion energies"]. Clamping the four eigenvalues at
//! zero is therefore a few operations, not an eigendecomposition.

/// A 2 × 2 matrix, first column then second: the derivative of a map, or a direction in which it changes.
pub(crate) type Columns = [f64; 4];

/// Singular values of a map with positive determinant, and the directions in which they change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// The larger and the smaller singular value.
    pub(crate) s: [f64; 2],
    /// `∂s1/∂J` and `∂s2/∂J`.
    grow: [Columns; 2],
    twist: Columns,
    flip: Columns,
}

/// ψ with its derivatives by the singular values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Density {
    pub(crate) value: f64,
    /// `∂ψ/∂s1`, `∂ψ/∂s2`.
    pub(crate) first: [f64; 2],
    /// `∂²ψ/∂s1²`, `∂²ψ/∂s1∂s2`, `∂²ψ/∂s2²`.
    pub(crate) second: [f64; 3],
    /// `(∂ψ/∂s1 + ∂ψ/∂s2) / (s1 + s2)`.
    pub(crate) twist: f64,
    /// `(∂ψ/∂s1 − ∂ψ/∂s2) / (s1 − s2)`, in a form without cancellation.
    pub(crate) flip: f64,
}

impl Stretch {
    /// The singular values of `j`, which must have a positive determinant.
    pub(crate) fn new([a, c, b, d]: Columns) -> Self {
        // J = similarity (e, h) + anti-similarity (f, g); their sizes are half the sum and half the difference of s1, s2.
        let (e, f, g, h) = ((a + d) / 2.0, (a - d) / 2.0, (c + b) / 2.0, (c - b) / 2.0);
        let (turning, mirroring) = (e.hypot(h), f.hypot(g));
        let larger = turning + mirroring;
        let smaller = (a * d - b * c) / larger; // the difference would cancel on slivers
        let (e, h) = (e / turning, h / turning);
        let (f, g) = if mirroring > 0.0 { (f / mirroring, g / mirroring) } else { (1.0, 0.0) };
        let half = std::f64::consts::FRAC_1_SQRT_2;
        Self {
            s: [larger, smaller],
            grow: [
                [(e + f) / 2.0, (h + g) / 2.0, (g - h) / 2.0, (e - f) / 2.0],
                [(e - f) / 2.0, (h - g) / 2.0, (-g - h) / 2.0, (e + f) / 2.0],
            ],
            twist: [-h * half, e * half, -e * half, -h * half],
            flip: [-g * half, f * half, f * half, g * half],
        }
    }

    /// `∂ψ/∂J`.
    pub(crate) fn gradient(&self, density: &Density) -> Columns {
        std::array::from_fn(|i| density.first[0] * self.grow[0][i] + density.first[1] * self.grow[1][i])
    }

    /// The Hessian of ψ by J as four directions with weights that are never negative.
    pub(crate) fn projected_hessian(&self, density: &Density) -> [(f64, Columns); 4] {
        let [(low, v), (high, w)] = eigen_2x2(density.second);
        let mix = |[x, y]: [f64; 2]| std::array::from_fn(|i| x * self.grow[0][i] + y * self.grow[1][i]);
        [
            (low.max(0.0), mix(v)),
            (high.max(0.0), mix(w)),
            (density.twist.max(0.0), self.twist),
            (density.flip.max(0.0), self.flip),
        ]
    }

    /// The Hessian as it is, for tests of ellipticity and against differences.
    #[cfg(test)]
    pub(crate) fn hessian(&self, density: &Density) -> [(f64, Columns); 4] {
        let [(low, v), (high, w)] = eigen_2x2(density.second);
        let mix = |[x, y]: [f64; 2]| std::array::from_fn(|i| x * self.grow[0][i] + y * self.grow[1][i]);
        [(low, mix(v)), (high, mix(w)), (density.twist, self.twist), (density.flip, self.flip)]
    }
}

/// Eigenvalues with unit eigenvectors of the symmetric matrix `[a b; b c]`.
pub(crate) fn eigen_2x2([a, b, c]: [f64; 3]) -> [(f64, [f64; 2]); 2] {
    if b == 0.0 {
        return [(a, [1.0, 0.0]), (c, [0.0, 1.0])];
    }
    let (mean, half) = ((a + c) / 2.0, (a - c) / 2.0);
    let radius = half.hypot(b);
    // The eigenvector of the larger eigenvalue, from whichever row does not cancel.
    let (x, y) = if half >= 0.0 { (radius + half, b) } else { (b, radius - half) };
    let length = x.hypot(y);
    let (x, y) = (x / length, y / length);
    [(mean - radius, [-y, x]), (mean + radius, [x, y])]
}

/// Symmetric Dirichlet: `(s1² + s2² + s1⁻² + s2⁻²) / 4`, 1 for an isometry.
pub(crate) fn symmetric_dirichlet([s1, s2]: [f64; 2]) -> Density {
    let (i1, i2) = (s1.powi(-2), s2.powi(-2));
    let first = [(s1 - i1 / s1) / 2.0, (s2 - i2 / s2) / 2.0];
    Density {
        value: (s1 * s1 + s2 * s2 + i1 + i2) / 4.0,
        first,
        second: [(1.0 + 3.0 * i1 * i1) / 2.0, 0.0, (1.0 + 3.0 * i2 * i2) / 2.0],
        twist: (first[0] + first[1]) / (s1 + s2),
        flip: 0.5 + (s1 * s1 + s1 * s2 + s2 * s2) / (2.0 * (s1 * s2).powi(3)),
    }
}

/// MIPS [Hormann, Greiner 2000]: `(s1/s2 + s2/s1) / 2`, 1 where conformal.
pub(crate) fn mips([s1, s2]: [f64; 2]) -> Density {
    let ratio = s1 / s2;
    let inverse = s2 / s1;
    let first = [(1.0 / s2 - inverse / s1) / 2.0, (1.0 / s1 - ratio / s2) / 2.0];
    Density {
        value: (ratio + inverse) / 2.0,
        first,
        second: [inverse / (s1 * s1), -(s1.powi(-2) + s2.powi(-2)) / 2.0, ratio / (s2 * s2)],
        twist: (first[0] + first[1]) / (s1 + s2),
        flip: (s1 + s2) * (s1 + s2) / (2.0 * (s1 * s2).powi(2)),
    }
}

/// Area change that costs growing and shrinking alike: `(det + 1/det) / 2`, 1 where areas are kept.
pub(crate) fn area_change([s1, s2]: [f64; 2]) -> Density {
    let det = s1 * s2;
    let slope = (1.0 - det.powi(-2)) / 2.0;
    let curve = det.powi(-3);
    Density {
        value: (det + 1.0 / det) / 2.0,
        first: [slope * s2, slope * s1],
        second: [curve * s2 * s2, slope + curve * det, curve * s1 * s1],
        twist: slope,
        flip: -slope,
    }
}
