//! From pieces to meshes: vertices are split where no edge joins their faces.

use rayon::prelude::*;

use super::orient::Sides;
use super::pairs::after;
use super::{Chart, Repairs};
use crate::build::NONE;
use crate::components::Components;
use crate::error::BuildError;
use crate::mesh::QuadMesh;
use crate::polygons::{PolygonView, Polygons};

pub(super) fn charts(
    polygons: PolygonView<'_>,
    mates: &[u32],
    sides: &Sides,
    layer: &[u32],
    alone: &[u32],
    repairs: &mut Repairs,
) -> Result<Vec<Chart>, BuildError> {
    // Corners of one fan are one vertex.
    let mut fans = Components::new(polygons.corner_count());
    for (corner, &mate) in
        mates.iter().enumerate().filter(|&(corner, &mate)| mate != NONE && mate > corner as u32)
    {
        let corner = corner as u32;
        let [next, next_of_mate] = [corner, mate].map(|c| after(polygons, c, sides.corner_face[c as usize]));
        let same_way = polygons.corner_vertex[corner as usize] == polygons.corner_vertex[mate as usize];
        let (beside, beside_next) = if same_way { (mate, next_of_mate) } else { (next_of_mate, mate) };
        fans.join(corner, beside);
        fans.join(next, beside_next);
    }
    let vertices = Vertices::new(polygons, &mut fans, sides);
    note_split_vertices(polygons, mates, sides, &vertices, (layer, alone), repairs);
    let (starts, faces) = by_piece(sides);
    (0..sides.pieces)
        .into_par_iter()
        .map(|piece| {
            let faces = faces[starts[piece] as usize..starts[piece + 1] as usize].to_vec();
            chart(polygons, sides, &vertices, faces, vertices.of_piece(piece))
        })
        .collect()
}

fn chart(
    polygons: PolygonView<'_>,
    sides: &Sides,
    vertices: &Vertices,
    faces: Vec<u32>,
    sources: &[u32],
) -> Result<Chart, BuildError> {
    let mut corners = Vec::with_capacity(faces.iter().map(|&f| polygons.face(f as usize).len()).sum());
    let mut face_start = Vec::with_capacity(faces.len() + 1);
    face_start.push(0);
    for &face in &faces {
        let range = polygons.corners(face as usize);
        if sides.is_flipped[face as usize] {
            // The first corner stays the first.
            corners.push(range.start as u32);
            corners.extend(range.skip(1).rev().map(|corner| corner as u32));
        } else {
            corners.extend(range.map(|corner| corner as u32));
        }
        face_start.push(corners.len() as u32);
    }
    let corner_vertex = corners.iter().map(|&corner| vertices.of_corner[corner as usize]).collect();
    let positions = sources.iter().map(|&vertex| polygons.positions[vertex as usize]).collect();
    let mut mesh = QuadMesh::build(Polygons { positions, face_start, corner_vertex })?;
    mesh.set_sources(sources, polygons.positions.len());
    Ok(Chart { mesh, faces, corners })
}

/// The vertices of all charts.
struct Vertices {
    /// The vertex of each corner, in the numbers of its chart.
    of_corner: Vec<u32>,
    /// The caller's vertex of each vertex, chart after chart.
    sources: Vec<u32>,
    starts: Vec<u32>,
}

impl Vertices {
    /// Numbered in the order of the caller's vertices, and of several for one by first corner.
    fn new(polygons: PolygonView<'_>, fans: &mut Components, sides: &Sides) -> Self {
        let piece = |corner: u32| sides.piece[sides.corner_face[corner as usize] as usize] as usize;
        let corners = polygons.corner_count();
        let roots: Vec<u32> = (0..corners as u32).map(|corner| fans.root(corner)).collect();
        let mut starts = vec![0u32; sides.pieces + 1];
        for corner in (0..corners as u32).filter(|&c| roots[c as usize] == c) {
            starts[piece(corner) + 1] += 1;
        }
        for piece in 0..sides.pieces {
            starts[piece + 1] += starts[piece];
        }
        // A root is the first corner of its fan.
        let mut by_vertex: Vec<u32> = (0..corners as u32).filter(|&c| roots[c as usize] == c).collect();
        by_vertex.par_sort_unstable_by_key(|&corner| (polygons.corner_vertex[corner as usize], corner));
        let mut cursor = starts.clone();
        let mut sources = vec![0; by_vertex.len()];
        let mut number = vec![NONE; corners];
        for root in by_vertex {
            let place = &mut cursor[piece(root)];
            sources[*place as usize] = polygons.corner_vertex[root as usize];
            number[root as usize] = *place - starts[piece(root)];
            *place += 1;
        }
        let of_corner = roots.iter().map(|&root| number[root as usize]).collect();
        Self { of_corner, sources, starts }
    }

    fn of_piece(&self, piece: usize) -> &[u32] {
        &self.sources[self.starts[piece] as usize..self.starts[piece + 1] as usize]
    }
}

/// Names the vertices that were split though no edge at them was opened.
fn note_split_vertices(
    polygons: PolygonView<'_>,
    mates: &[u32],
    sides: &Sides,
    vertices: &Vertices,
    (layer, alone): (&[u32], &[u32]),
    repairs: &mut Repairs,
) {
    let mut fans = vec![0u32; polygons.positions.len()];
    vertices.sources.iter().for_each(|&vertex| fans[vertex as usize] += 1);
    if fans.iter().all(|&count| count <= 1) {
        return;
    }
    // What has another cause: opened edges, second layers, faces that are alone.
    let mut explained = vec![false; polygons.positions.len()];
    let of_face = |face: usize| polygons.face(face).iter().copied();
    for face in (0..polygons.face_count()).filter(|&face| layer[face] > 0) {
        of_face(face).for_each(|vertex| explained[vertex as usize] = true);
    }
    for &face in alone {
        of_face(face as usize).for_each(|vertex| explained[vertex as usize] = true);
    }
    let mut open: Vec<[u32; 2]> = Vec::new();
    for (corner, _) in mates.iter().enumerate().filter(|&(_, &mate)| mate == NONE) {
        let next = after(polygons, corner as u32, sides.corner_face[corner]);
        let [a, b] = [corner, next as usize].map(|c| polygons.corner_vertex[c]);
        open.push([a.min(b), a.max(b)]);
    }
    open.par_sort_unstable();
    for same in open.chunk_by(|a, b| a == b).filter(|same| same.len() > 1) {
        same[0].iter().for_each(|&vertex| explained[vertex as usize] = true);
    }
    let split = (0..fans.len()).filter(|&vertex| fans[vertex] > 1 && !explained[vertex]);
    split.for_each(|vertex| repairs.nonmanifold_vertices.push(vertex as u32));
}

/// The faces of each piece, in order.
fn by_piece(sides: &Sides) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; sides.pieces + 1];
    sides.piece.iter().for_each(|&piece| starts[piece as usize + 1] += 1);
    for piece in 0..sides.pieces {
        starts[piece + 1] += starts[piece];
    }
    let mut cursor = starts.clone();
    let mut faces = vec![0; sides.piece.len()];
    for (face, &piece) in sides.piece.iter().enumerate() {
        let place = &mut cursor[piece as usize];
        faces[*place as usize] = face as u32;
        *place += 1;
    }
    (starts, faces)
}
