//! Which faces are turned over, and which belong together.

use std::collections::VecDeque;

use super::Repairs;
use super::pairs::after;
use crate::build::NONE;
use crate::polygons::PolygonView;

/// The piece of each face, and whether it is turned over there.
pub(super) struct Sides {
    /// Numbered by first face.
    pub(super) piece: Vec<u32>,
    pub(super) pieces: usize,
    pub(super) is_flipped: Vec<bool>,
    /// The face of each corner.
    pub(super) corner_face: Vec<u32>,
}

/// Makes neighbours agree, and separates those that cannot. Of each piece the fewer faces are turned over; when there
/// are as many of both, not the first.
pub(super) fn orient(polygons: PolygonView<'_>, mates: &mut [u32], repairs: &mut Repairs) -> Sides {
    let faces = polygons.face_count();
    let mut sides = Sides {
        piece: vec![NONE; faces],
        pieces: 0,
        is_flipped: vec![false; faces],
        corner_face: corner_faces(polygons),
    };
    let mut queue = VecDeque::new();
    let mut members = Vec::new();
    for seed in 0..faces {
        if sides.piece[seed] != NONE {
            continue;
        }
        sides.piece[seed] = sides.pieces as u32;
        queue.push_back(seed);
        members.clear();
        // In rings around the seed, so that where the two sides of a one-sided surface meet is about straight.
        while let Some(face) = queue.pop_front() {
            members.push(face);
            for corner in polygons.corners(face) {
                let mate = mates[corner];
                if mate == NONE {
                    continue;
                }
                let neighbor = sides.corner_face[mate as usize] as usize;
                if sides.piece[neighbor] == NONE {
                    sides.piece[neighbor] = sides.pieces as u32;
                    sides.is_flipped[neighbor] =
                        sides.is_flipped[face] ^ same_way(polygons, corner as u32, mate);
                    queue.push_back(neighbor);
                }
            }
        }
        let flipped = members.iter().filter(|&&face| sides.is_flipped[face]).count();
        if 2 * flipped > members.len() {
            members.iter().for_each(|&face| sides.is_flipped[face] ^= true);
        }
        sides.pieces += 1;
    }
    (0..faces)
        .filter(|&face| sides.is_flipped[face])
        .for_each(|face| repairs.flipped_faces.push(face as u32));
    separate(polygons, mates, &sides, repairs);
    sides
}

/// Takes apart neighbours that still run the same way along their edge.
fn separate(polygons: PolygonView<'_>, mates: &mut [u32], sides: &Sides, repairs: &mut Repairs) {
    for corner in 0..mates.len() as u32 {
        let mate = mates[corner as usize];
        if mate == NONE || mate < corner {
            continue;
        }
        let [face, other] = [corner, mate].map(|c| sides.corner_face[c as usize]);
        let flips = sides.is_flipped[face as usize] ^ sides.is_flipped[other as usize];
        if flips != same_way(polygons, corner, mate) {
            mates[corner as usize] = NONE;
            mates[mate as usize] = NONE;
            let [a, b] = [corner, after(polygons, corner, face)].map(|c| polygons.corner_vertex[c as usize]);
            repairs.one_sided_edges.push([a.min(b), a.max(b)]);
        }
    }
}

/// Whether two faces run the same way along their edge: neighbours that agree do not.
fn same_way(polygons: PolygonView<'_>, corner: u32, mate: u32) -> bool {
    polygons.corner_vertex[corner as usize] == polygons.corner_vertex[mate as usize]
}

fn corner_faces(polygons: PolygonView<'_>) -> Vec<u32> {
    let mut faces = Vec::with_capacity(polygons.corner_count());
    for (face, pair) in polygons.face_start.windows(2).enumerate() {
        faces.resize(pair[1] as usize, face as u32);
    }
    faces
}
