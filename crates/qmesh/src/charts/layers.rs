//! Faces that repeat an earlier one.

use std::cmp::Ordering;

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
    let turned = |mut walk: Vec<u32>| {
        let start = least_rotation(&walk);
        walk.rotate_left(start);
        walk
    };
    let backwards = vertices.iter().rev().copied().collect();
    turned(vertices.to_vec()).min(turned(backwards))
}

/// Where a closed walk starts when it is read as the least of all its rotations, in linear time however often it visits its lowest
/// vertex: of two starts that agree for `same` steps and then differ, the greater one is out, and with it the `same` starts behind it.
fn least_rotation(walk: &[u32]) -> usize {
    let count = walk.len();
    let (mut best, mut other, mut same) = (0, 1, 0);
    while best < count && other < count && same < count {
        let [here, there] = [best, other].map(|start| walk[(start + same) % count]);
        match here.cmp(&there) {
            Ordering::Equal => same += 1,
            Ordering::Less => (other, same) = (other + same + 1, 0),
            Ordering::Greater => (best, same) = (best + same + 1, 0),
        }
        if best == other {
            other += 1;
        }
    }
    best.min(other)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The least of all copies of a walk, from each start and in both directions.
    fn by_definition(walk: &[u32]) -> Vec<u32> {
        let turned = |start: usize| [&walk[start..], &walk[..start]].concat();
        let both = |walk: Vec<u32>| [walk.iter().rev().copied().collect(), walk];
        (0..walk.len()).map(turned).flat_map(both).min().unwrap_or_default()
    }

    proptest! {
        #[test]
        fn walks_are_read_from_their_least_start(
            part in proptest::collection::vec(0u32..3, 0..9),
            times in 1usize..4,
            end in proptest::collection::vec(0u32..3, 0..3),
        ) {
            let walk = [part.repeat(times), end].concat();
            prop_assert_eq!(canonical(&walk), by_definition(&walk));
        }
    }

    /// This would not end if each visit of the lowest vertex took the time of the whole walk.
    #[test]
    fn a_walk_that_visits_one_vertex_very_often() {
        let walk: Vec<u32> =
            (0..2_000_000).map(|step| if step % 2 == 0 { 0 } else { 1 + step / 2 }).collect();
        assert_eq!(canonical(&walk)[..2], [0, 1]);
        assert_eq!(canonical(&vec![7; 2_000_000]).len(), 2_000_000);
    }
}
