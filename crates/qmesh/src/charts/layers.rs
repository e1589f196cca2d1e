//! Faces that repeat an earlier one.

use rayon::prelude::*;

use super::Repairs;
use crate::polygons::PolygonView;

/// How many earlier faces each face repeats: 0 for most. Faces meet in edges only within one layer.
pub(super) fn layers(polygons: PolygonView<'_>, repairs: &mut Repairs) -> Vec<u32> {
    let mut layer = vec![0; polygons.face_count()];
    let mut keys: Vec<(u64, u32)> = (0..polygons.face_count())
        .into_par_iter()
        .with_min_len(2048)
        .map(|face| (fingerprint(polygons.face(face)), face as u32))
        .collect();
    keys.par_sort_unstable();
    let mut doubled = Vec::new();
    for group in keys.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let mut cycles: Vec<(Vec<u32>, u32)> =
            group.iter().map(|&(_, face)| (canonical(polygons.face(face as usize)), face)).collect();
        cycles.sort_unstable();
        for same in cycles.chunk_by(|a, b| a.0 == b.0) {
            for (place, &(_, face)) in same.iter().enumerate().skip(1) {
                layer[face as usize] = place as u32;
                doubled.push(face);
            }
        }
    }
    doubled.sort_unstable();
    doubled.into_iter().for_each(|face| repairs.doubled_faces.push(face));
    layer
}

/// The same for the same vertices in any order.
fn fingerprint(vertices: &[u32]) -> u64 {
    // The finaliser of SplitMix64, which mixes all bits.
    let mixed = |vertex: u32| {
        let mut x = u64::from(vertex).wrapping_add(0x9e37_79b9_7f4a_7c15);
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    vertices.iter().fold(0, |sum, &vertex| sum.wrapping_add(mixed(vertex)))
}

/// The same for the same closed walk, wherever it starts and whichever way it goes.
fn canonical(vertices: &[u32]) -> Vec<u32> {
    let turned = |vertices: Vec<u32>| {
        let lowest = vertices.iter().min().copied().unwrap_or(0);
        let starts = (0..vertices.len()).filter(|&i| vertices[i] == lowest);
        let from = |start: usize| [&vertices[start..], &vertices[..start]].concat();
        starts.map(from).min().unwrap_or_default()
    };
    let backwards = vertices.iter().rev().copied().collect();
    turned(vertices.to_vec()).min(turned(backwards))
}
