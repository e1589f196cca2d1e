//! Boundaries that are held: on a circle, a square, or where the caller says.

use crate::ParameterizeError;
use crate::convexity::Exempt;
use crate::plane::{Scope, Segment, find_crossings, orientation};
use crate::qembed::{BoundaryShape, place_boundary};
use crate::qmesh::{QuadMesh, Vec2, VertexId};

use super::rest::{Rest, unit_length};

/// An outer boundary at its place.
pub(super) struct HeldBoundary {
    /// Its vertices, counter-clockwise.
    pub(super) places: Vec<(VertexId, Vec2)>,
    /// The area that it encloses.
    area: f64,
}

impl HeldBoundary {
    /// Places the outer boundary and checks that a map can exist there; `mesh` has no holes.
    pub(super) fn new(
        mesh: &QuadMesh,
        exempt: &Exempt,
        shape: &BoundaryShape,
    ) -> Result<Self, ParameterizeError> {
        let places = place_boundary(mesh, shape)?;
        let area = enclosed(&places)?;
        check_corners(mesh, exempt, &places)?;
        Ok(Self { places, area })
    }

    /// The problem at the scale at which surface and enclosed area are the same, so that the energy compares shapes and not sizes,
    /// with the boundary held. `filled` is the mesh without its holes.
    pub(super) fn rest(&self, mesh: &QuadMesh, exempt: &Exempt, filled: &QuadMesh) -> Rest {
        let mut rest = Rest::new(mesh, exempt);
        let unit = unit_length(self.area);
        rest.scale(rest.unit / unit * (self.area / crate::qcurv::surface_area(filled)).sqrt());
        rest.unit = unit;
        rest.constraint.held = vec![false; mesh.vertex_count()];
        for (vertex, _) in &self.places {
            rest.constraint.held[vertex.index()] = true;
        }
        rest
    }
}

/// The area of a polygon that must be simple and run counter-clockwise.
fn enclosed(places: &[(VertexId, Vec2)]) -> Result<f64, ParameterizeError> {
    let count = places.len();
    let next = |k: usize| (k + 1) % count;
    let edge = |k: usize| [places[k].0, places[next(k)].0];
    let segment = |k: usize| Segment {
        ends: [places[k].1, places[next(k)].1],
        points: [k as u32, next(k) as u32],
        island: 0,
        id: k as u32,
    };
    let crossings = find_crossings((0..count).map(segment).collect(), Scope::Everything, 1);
    if let Some(pair) = crossings.pairs.first() {
        return Err(ParameterizeError::BoundaryMeets { edges: pair.map(|k| edge(k as usize)) });
    }
    for k in 0..count {
        let [a, b, c] = [k, next(k), next(next(k))].map(|k| places[k].1);
        if a == b || (orientation(a, b, c) == 0 && (a - b).dot(&(c - b)) > 0.0) {
            return Err(ParameterizeError::BoundaryMeets { edges: [edge(k), edge(next(k))] });
        }
    }
    let from = places[0].1;
    let area = 0.5 * (0..count).map(|k| (places[k].1 - from).perp(&(places[next(k)].1 - from))).sum::<f64>();
    if area > 0.0 && area.is_normal() { Ok(area) } else { Err(ParameterizeError::BoundaryClockwise) }
}

/// Corners between three held vertices stand as they are: each has to turn left already.
fn check_corners(
    mesh: &QuadMesh,
    exempt: &Exempt,
    places: &[(VertexId, Vec2)],
) -> Result<(), ParameterizeError> {
    let mut place = vec![None; mesh.vertex_count()];
    for &(vertex, p) in places {
        place[vertex.index()] = Some(p);
    }
    let at = |corner| place[mesh.vertex(corner).index()];
    let flat = mesh.corners().find(|&corner| {
        let around = [mesh.previous_corner(corner), corner, mesh.next_corner(corner)].map(at);
        let [Some(a), Some(b), Some(c)] = around else { return false };
        orientation(a, b, c) <= 0 && !exempt.is_exempt(mesh, corner)
    });
    flat.map_or(Ok(()), |corner| Err(ParameterizeError::FlatCorner { corner }))
}
