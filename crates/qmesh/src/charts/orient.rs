//! Which faces are turned over, and which belong together.

use std::collections::VecDeque;

use super::Repairs;
use super::pairs::after;
use crate::build::{NONE, corner_faces};
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

/// Makes neighbours agree, and separates those that cannot. Of all faces that hang together, across seams too (`joined`), the
/// fewer are turned over; when there are as many of both, not the first. So seams have no say in which way a face goes.
pub(super) fn orient(
    polygons: PolygonView<'_>,
    mates: &mut [u32],
    joined: &[u32],
    repairs: &mut Repairs,
) -> Sides {
    let faces = polygons.face_count();
    let mut sides = Sides {
        piece: vec![NONE; faces],
        pieces: 0,
        is_flipped: vec![false; faces],
        corner_face: corner_faces(polygons.face_start, polygons.corner_count(), |face| face),
    };
    let mut members = Vec::with_capacity(faces);
    let mut starts = vec![0];
    for seed in 0..faces {
        if sides.piece[seed] == NONE {
            sides.spread(polygons, mates, seed, &mut members);
            starts.push(members.len());
        }
    }
    let turned = turned_pieces(polygons, joined, &sides, &members, &starts);
    for (face, is_flipped) in sides.is_flipped.iter_mut().enumerate() {
        *is_flipped ^= turned[sides.piece[face] as usize];
    }
    let flipped = (0..faces).filter(|&face| sides.is_flipped[face]);
    flipped.for_each(|face| repairs.flipped_faces.push(face as u32));
    separate(polygons, mates, &sides, repairs);
    sides
}

impl Sides {
    /// The piece of `seed`, in rings around it, so that where the two sides of a one-sided surface meet is about straight; its faces are
    /// appended to `members`.
    fn spread(&mut self, polygons: PolygonView<'_>, mates: &[u32], seed: usize, members: &mut Vec<u32>) {
        let mut next = members.len();
        self.piece[seed] = self.pieces as u32;
        members.push(seed as u32);
        while next < members.len() {
            let face = members[next] as usize;
            next += 1;
            for corner in polygons.corners(face).filter(|&corner| mates[corner] != NONE) {
                let neighbor = self.corner_face[mates[corner] as usize] as usize;
                if self.piece[neighbor] == NONE {
                    self.piece[neighbor] = self.pieces as u32;
                    self.is_flipped[neighbor] =
                        self.is_flipped[face] ^ same_way(polygons, corner as u32, mates[corner]);
                    members.push(neighbor as u32);
                }
            }
        }
        self.pieces += 1;
    }
}

/// Which pieces are to be turned over as a whole, so that pieces agree across the seams between them as far as that is possible.
fn turned_pieces(
    polygons: PolygonView<'_>,
    joined: &[u32],
    sides: &Sides,
    members: &[u32],
    starts: &[usize],
) -> Vec<bool> {
    let of_piece = |piece: usize| members[starts[piece]..starts[piece + 1]].iter().map(|&face| face as usize);
    let mut turned = vec![false; sides.pieces];
    let mut seen = vec![false; sides.pieces];
    let mut queue = VecDeque::new();
    for seed in 0..sides.pieces {
        if std::mem::replace(&mut seen[seed], true) {
            continue;
        }
        queue.push_back(seed);
        let (mut together, mut faces, mut flipped) = (Vec::new(), 0, 0);
        while let Some(piece) = queue.pop_front() {
            together.push(piece);
            for face in of_piece(piece) {
                let is_flipped = sides.is_flipped[face] ^ turned[piece];
                (faces, flipped) = (faces + 1, flipped + usize::from(is_flipped));
                for corner in polygons.corners(face).filter(|&corner| joined[corner] != NONE) {
                    let neighbor = sides.corner_face[joined[corner] as usize] as usize;
                    let other = sides.piece[neighbor] as usize;
                    if !std::mem::replace(&mut seen[other], true) {
                        let wanted = is_flipped ^ same_way(polygons, corner as u32, joined[corner]);
                        turned[other] = sides.is_flipped[neighbor] ^ wanted;
                        queue.push_back(other);
                    }
                }
            }
        }
        if 2 * flipped > faces {
            together.into_iter().for_each(|piece| turned[piece] ^= true);
        }
    }
    turned
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
