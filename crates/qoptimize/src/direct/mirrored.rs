//! Maps that are exactly as symmetric as the mesh.
//!
//! The surface is made symmetric first, by the mean of itself and its mirror image, then mapped: start and steps are replaced by
//! the mean of themselves and theirs. In floating point that mean is its own mirror image to the bit, so partners get the same `v` and opposite
//! `u`, and vertices on the axis `u = 0`.

use std::sync::Arc;

use crate::ParameterizeError;
use crate::plane::outline_flaws;
use crate::qmesh::{QuadMesh, Vec2, VertexData};
use crate::symmetry::Mirror;

use super::StartError;
use super::embed::{Map, Run};
use super::pull::times;
use super::rest::Rest;
use super::scale::to_best_scale;
use super::start::judge;
use super::untangle::untangle;
use super::{DirectReport, Start, StartMethod};

/// The symmetry of a map.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct SymmetryReport {
    /// The normal of the mirror plane in space.
    pub normal: [f64; 3],
    /// How far the surface is from symmetric: the largest distance of a vertex from the mirror image of its partner, over the diameter.
    pub deviation: f64,
    /// How many vertices lie on the axis.
    pub axis_vertices: usize,
}

impl Run<'_> {
    /// A free map of a surface that is symmetric already, mirrored by `x ↦ −x` to the bit.
    pub(super) fn mirrored(&self, mirror: &Mirror) -> Result<(Map, DirectReport), ParameterizeError> {
        let mut rest = Rest::new(self.mesh, &self.exempt);
        rest.constraint.mirror = mirror.partner.iter().map(|vertex| vertex.0).collect();
        let start = self.mirrored_start(&rest, mirror)?;
        let mut first: Vec<Vec2> = start.uv.iter().map(|p| p / rest.unit).collect();
        to_best_scale(&rest, self.objective, &mut first);
        let mut uv = first.clone();
        let mut report = self.report(start.origin(), self.descend(&rest, &mut uv)?);
        if outline_flaws(self.mesh, &uv) > 0 {
            report.boundary_repair = self.problem(&rest).clear(&first, &mut uv, &mut report.descent)?;
        }
        let normal = mirror.normal;
        report.symmetry = Some(SymmetryReport {
            normal: [normal.x, normal.y, normal.z],
            deviation: mirror.deviation,
            axis_vertices: mirror.axis_vertices(),
        });
        Ok((Map { uv, rest: Arc::new(rest) }, report))
    }

    /// A start is symmetric up to rounding; made so to the bit it may lose thin corners, which the untangler mends.
    fn mirrored_start(&self, rest: &Rest, mirror: &Mirror) -> Result<Start, StartError> {
        let mut start = self.start()?;
        upright(&mut start.uv, mirror);
        rest.constraint.reflect(&mut start.uv);
        let mut verdict = judge(rest, &start.uv);
        if verdict.valid().is_none() {
            untangle(rest, self.mesh, &mut start.uv, self.observer)?;
            start.method = StartMethod::Untangled;
            verdict = judge(rest, &start.uv);
        }
        match verdict.valid() {
            Some(smallest_corner) => Ok(Start { smallest_corner, ..start }),
            None => Err(StartError::Tangled { corner: verdict.worst, count: verdict.bad }),
        }
    }
}

/// Turns a map about the origin until its mirror is `x ↦ −x`: partners then have z z' = −|z|², which must be real.
fn upright(uv: &mut VertexData<Vec2>, mirror: &Mirror) {
    let sum: Vec2 = mirror.partner.entries().map(|(vertex, &other)| times(uv[vertex], uv[other])).sum();
    let angle = 0.5 * (std::f64::consts::PI - sum.y.atan2(sum.x));
    let turn = Vec2::new(angle.cos(), angle.sin());
    uv.iter_mut().for_each(|p| *p = times(turn, *p));
}

/// The surface as symmetric as its connectivity, and its mirror.
pub(super) fn symmetrized(mesh: &QuadMesh) -> Result<(QuadMesh, Mirror), ParameterizeError> {
    let mirror = Mirror::find(mesh).map_err(ParameterizeError::Symmetry)?;
    Ok((mirror.symmetrized(mesh), mirror))
}
