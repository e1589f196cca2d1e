//! The mesh of the clusters.

use std::borrow::Cow;

use crate::qmesh::{FaceId, Polygons, QuadMesh, Vec3};

use super::clusters::{Clusters, RADIUS};
use super::surface::{Surface, unit};

/// A coarse mesh has at most this part of the vertices.
const LEAST_GAIN: usize = 2;
/// Attempts at clusters that lie side by side like faces.
const ATTEMPTS: usize = 12;

/// The next coarser surface: a vertex for each cluster, triangles where three or more meet in a face of `surface`.
///
/// Around a thin limb clusters meet themselves on the other side, and the faces are no manifold. There they are made smaller, down
/// to single vertices, until they are one. `None` when that does not help, or the topology is another one, or little is
/// gained.
pub(super) fn coarsened(surface: &Surface<'_>) -> Option<(Surface<'static>, Clusters)> {
    let topology = surface.mesh.topology();
    let mut radius = vec![RADIUS; surface.mesh.vertex_count()];
    for _ in 0..ATTEMPTS {
        let clusters = Clusters::new(&surface.mesh, &radius);
        if clusters.seeds.len() * LEAST_GAIN > surface.mesh.vertex_count() {
            return None;
        }
        let (polygons, middles) = dual_faces(surface, &clusters);
        let too_large = entangled(&polygons, clusters.seeds.len());
        if !too_large.contains(&true) {
            let mesh = QuadMesh::build(polygons).ok().filter(|mesh| mesh.topology() == topology)?;
            return Some((standing_for(surface, &clusters, mesh, middles), clusters));
        }
        for (radius, &cluster) in radius.iter_mut().zip(&clusters.of) {
            if too_large[cluster as usize] {
                *radius /= 2;
            }
        }
    }
    None
}

/// The triangles between the seeds of clusters that meet in a face, and the middle of each. Where four meet, the shorter diagonal
/// that leaves both triangles facing as the surface does parts them.
fn dual_faces(surface: &Surface<'_>, clusters: &Clusters) -> (Polygons, Vec<FaceId>) {
    let mesh = &surface.mesh;
    let positions: Vec<Vec3> = clusters.seeds.iter().map(|&seed| mesh.position(seed)).collect();
    let mut polygons = Polygons { positions, ..Polygons::default() };
    let mut middles: Vec<FaceId> = Vec::new();
    let mut around = Vec::new();
    for face in mesh.faces() {
        around.clear();
        around.extend(mesh.face_vertices(face).map(|vertex| clusters.of[vertex.index()]));
        around.dedup();
        if around.len() > 1 && around.first() == around.last() {
            around.pop();
        }
        if let [a, b, c, d] = around[..] {
            let normal: Vec3 = mesh.face_vertices(face).map(|vertex| surface.normals[vertex.index()]).sum();
            let quad = [a, b, c, d].map(|v| polygons.positions[v as usize]);
            if is_parted_between_second_and_fourth(quad, normal) {
                around.rotate_left(1);
            }
        }
        // A fan; none where fewer than three meet.
        for k in 2..around.len() {
            polygons.push_face(&[around[0], around[k - 1], around[k]]);
            middles.push(surface.middle(face));
        }
    }
    (polygons, middles)
}

fn is_parted_between_second_and_fourth([a, b, c, d]: [Vec3; 4], normal: Vec3) -> bool {
    let faces = |a: Vec3, b: Vec3, c: Vec3| (b - a).cross(&(c - a)).dot(&normal) > 0.0;
    let (first, second) = (faces(a, b, c) && faces(a, c, d), faces(b, c, d) && faces(b, d, a));
    if first == second { (d - b).norm_squared() < (c - a).norm_squared() } else { second }
}

/// Per cluster, whether it stands in the way of a manifold: it comes up twice in a face or not at all, shares an edge with
/// another in more than two faces, or its faces are no single fan.
fn entangled(polygons: &Polygons, count: usize) -> Vec<bool> {
    let view = polygons.view();
    let mut is_entangled = vec![false; count];
    let mut degree = vec![0_u32; count];
    let mut directed: Vec<[u32; 2]> = Vec::with_capacity(view.corner_count());
    for face in 0..view.face_count() {
        let vertices = view.face(face);
        for (k, &v) in vertices.iter().enumerate() {
            degree[v as usize] += 1;
            directed.push([v, vertices[(k + 1) % vertices.len()]]);
            if vertices[..k].contains(&v) {
                is_entangled[v as usize] = true;
            }
        }
    }
    directed.sort_unstable();
    for pair in directed.windows(2).filter(|pair| pair[0] == pair[1]) {
        pair[0].iter().for_each(|&v| is_entangled[v as usize] = true);
    }
    // A fan is open at one edge or closed: each further edge without a partner begins another fan.
    let mut open = vec![0_u32; count];
    for &[a, b] in &directed {
        if directed.binary_search(&[b, a]).is_err() {
            open[a as usize] += 1;
        }
    }
    for v in 0..count {
        is_entangled[v] |= degree[v] == 0 || open[v] > 1;
    }
    is_entangled
}

/// The coarse surface, with what its vertices stand for.
fn standing_for(
    surface: &Surface<'_>,
    clusters: &Clusters,
    coarse: QuadMesh,
    middles: Vec<FaceId>,
) -> Surface<'static> {
    let count = coarse.vertex_count();
    let (mut normals, mut counts, mut areas) =
        (vec![Vec3::zeros(); count], vec![0.0; count], vec![0.0; count]);
    for (vertex, &cluster) in clusters.of.iter().enumerate() {
        let cluster = cluster as usize;
        normals[cluster] += surface.normals[vertex] * surface.areas[vertex];
        counts[cluster] += surface.counts[vertex];
        areas[cluster] += surface.areas[vertex];
    }
    normals.iter_mut().for_each(|normal| *normal = unit(*normal));
    Surface { mesh: Cow::Owned(coarse), normals, counts, areas, middles }
}
