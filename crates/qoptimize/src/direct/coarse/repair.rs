//! What flipped on the way up is unfolded again, where it lies.

use crate::qmesh::{Observer, Vec2};

use super::super::constraint::Constraint;
use super::super::energy::edges;
use super::super::rest::{Rest, RestCorner};
use super::super::untangle::mend;

/// How many rings of corners around flipped ones may move, one attempt after the other.
const RINGS: [usize; 4] = [2, 5, 10, 20];
/// With more flipped corners than this fraction the map is no place to start from.
const MOST_FLIPPED: f64 = 0.1;
const STEPS: usize = 80;

/// Moves the surroundings of corners of `uv` that do not turn left until they do. Whether that succeeded is for the caller to judge.
pub(super) fn repair(rest: &Rest, uv: &mut [Vec2], observer: &dyn Observer) {
    for rings in RINGS {
        let mut free = vec![false; uv.len()];
        let mut flipped = 0;
        for corner in rest.corners.iter().filter(|corner| is_flipped(corner, uv)) {
            corner.vertices.iter().for_each(|&v| free[v as usize] = true);
            flipped += 1;
        }
        if flipped == 0 || flipped as f64 > MOST_FLIPPED * rest.corners.len() as f64 {
            return;
        }
        for _ in 0..rings {
            grow(rest, &mut free);
        }
        let (part, vertices) = around(rest, &free);
        let fixed: Vec<bool> = vertices.iter().map(|&v| !free[v as usize]).collect();
        let mut moved: Vec<Vec2> = vertices.iter().map(|&v| uv[v as usize]).collect();
        if mend(&part, &fixed, &mut moved, STEPS, observer).is_err() {
            return;
        }
        for (&v, place) in vertices.iter().zip(moved) {
            uv[v as usize] = place;
        }
    }
}

fn is_flipped(corner: &RestCorner, uv: &[Vec2]) -> bool {
    let [f1x, f1y, f0x, f0y] = edges(corner, uv);
    let doubled = f1x * f0y - f1y * f0x;
    doubled.is_nan() || doubled <= 0.0
}

/// Adds all vertices that share a corner with one that is in.
fn grow(rest: &Rest, vertices: &mut [bool]) {
    let before = vertices.to_vec();
    for corner in &rest.corners {
        if corner.vertices.iter().any(|&v| before[v as usize]) {
            corner.vertices.iter().for_each(|&v| vertices[v as usize] = true);
        }
    }
}

/// The corners at the marked vertices as a problem of their own, with the vertices that they have.
fn around(rest: &Rest, marked: &[bool]) -> (Rest, Vec<u32>) {
    let mut number = vec![u32::MAX; marked.len()];
    let mut vertices = Vec::new();
    let (mut corners, mut ids) = (Vec::new(), Vec::new());
    for (corner, &id) in rest.corners.iter().zip(&rest.ids) {
        if corner.vertices.iter().any(|&v| marked[v as usize]) {
            let own = corner.vertices.map(|v| {
                let number = &mut number[v as usize];
                if *number == u32::MAX {
                    *number = vertices.len() as u32;
                    vertices.push(v);
                }
                *number
            });
            corners.push(RestCorner { vertices: own, ..*corner });
            ids.push(id);
        }
    }
    let part = Rest {
        corners,
        frames: Vec::new(),
        ids,
        vertex_count: vertices.len(),
        unit: rest.unit,
        constraint: Constraint::default(),
    };
    (part, vertices)
}
