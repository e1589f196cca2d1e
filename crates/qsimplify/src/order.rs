//! Which vertices are candidates, and in which order: steps 2 and 3 of section 2.1.
//!
//! On symmetric meshes many vertices have the same curvature, and which goes first must not hang on the last bits,
//! which turn with the mesh. So the angle defect is rounded to a fixed step and the area to a number of digits
//! before they are compared, and vertices that are equal then go by index.

use std::f64::consts::TAU;

use qcurv::qmesh::{QuadMesh, VertexData, VertexId};
use qcurv::{integrated_curvature, surface_area, vertex_areas};

use crate::error::SimplifyError;
use crate::options::{CurvatureMeasure, RemovedSide, SimplifyOptions, Threshold};

/// Defects are multiples of this angle (1.5e-11 radians): well above the rounding of a sum of angles, well below the
/// defects of a sphere of ten million vertices (1e-6).
const ANGLE_STEP: f64 = 1.0 / (1u64 << 36) as f64;

/// Areas are equal when they agree in 26 of their 53 bits (8 decimal digits).
const AREA_BITS_DROPPED: u32 = 26;

/// What [`simplify`](crate::simplify) tries to remove, in order.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RemovalOrder {
    /// The measure of each vertex, as rounded for comparison. Nothing is read from the values at the boundary.
    pub measure: VertexData<f64>,
    /// The interior vertices on the removed side of the threshold: by measure, ties by index.
    pub candidates: Vec<VertexId>,
    /// The measure of the last candidate: the threshold that was reached. `None` without candidates.
    pub limit: Option<f64>,
}

/// The candidates of `options`, in the order in which they are tried. The rule does not matter here.
///
/// # Errors
/// [`SimplifyError::BadThreshold`].
pub fn removal_order(mesh: &QuadMesh, options: &SimplifyOptions) -> Result<RemovalOrder, SimplifyError> {
    options.check()?;
    let measure = measure(mesh, options);
    let mut candidates: Vec<VertexId> = mesh.vertices().filter(|&v| !mesh.is_boundary(v)).collect();
    candidates.sort_by(|&a, &b| {
        let low_first = measure[a].total_cmp(&measure[b]);
        match options.side {
            RemovedSide::Low => low_first,
            RemovedSide::High => low_first.reverse(),
        }
    });
    let count = match (options.threshold, options.side) {
        (Threshold::Fraction(fraction), _) => (fraction * candidates.len() as f64).round() as usize,
        (Threshold::Value(value), RemovedSide::Low) => candidates.partition_point(|&v| measure[v] < value),
        (Threshold::Value(value), RemovedSide::High) => candidates.partition_point(|&v| measure[v] > value),
    };
    candidates.truncate(count);
    let limit = candidates.last().map(|&v| measure[v]);
    Ok(RemovalOrder { measure, candidates, limit })
}

fn measure(mesh: &QuadMesh, options: &SimplifyOptions) -> VertexData<f64> {
    let defects = integrated_curvature(mesh);
    let rounded = |v: VertexId| (defects[v].abs() / ANGLE_STEP).round() * ANGLE_STEP;
    match options.measure {
        CurvatureMeasure::Integrated => mesh.vertex_data(rounded),
        CurvatureMeasure::Normalized => {
            let areas = vertex_areas(mesh, options.area);
            let unit = surface_area(mesh) / (2.0 * TAU);
            // |K| · A / 4π with K = K̄ / S (Eq. 2) and S in parts of A / 4π.
            mesh.vertex_data(|v| {
                let share = significant(areas[v] / unit);
                if share > 0.0 { (rounded(v) / share).min(f64::MAX) } else { 0.0 }
            })
        }
    }
}

/// `x`, not negative, rounded to fewer bits; 0 for what is no number.
fn significant(x: f64) -> f64 {
    if x.is_nan() || x.is_infinite() {
        return 0.0;
    }
    let half = 1u64 << (AREA_BITS_DROPPED - 1);
    f64::from_bits((x.to_bits() + half) & !(2 * half - 1))
}
