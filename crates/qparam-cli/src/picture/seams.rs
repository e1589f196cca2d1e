//! Where the map is cut: edges whose two faces have different UVs there, in runs that belong together.

use qoptimize::qmesh::{PolygonView, Vec2};
use rayon::prelude::*;

/// Edges of a map that are more than a line between two of its faces. Edges are named by the corner that they leave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Seams {
    /// Edges with one face.
    pub boundary: Vec<u32>,
    /// Edges whose two faces lie apart in the plane: one corner in each of them.
    pub cuts: Vec<[u32; 2]>,
    /// The run of each cut, numbered by first cut: cuts that follow each other where no third one meets them.
    pub run: Vec<u32>,
    /// How many runs there are.
    pub runs: usize,
}

impl Seams {
    /// Looks at every edge. Of edges with more than two faces the first two count.
    #[must_use]
    pub fn find(polygons: PolygonView<'_>, uv: &[Vec2], island: &[u32]) -> Self {
        let next = next_corners(polygons);
        let vertex = |corner: u32| polygons.corner_vertex[corner as usize];
        let mut edges: Vec<([u32; 2], u32)> = (0..polygons.corner_count() as u32)
            .into_par_iter()
            .map(|corner| {
                let (a, b) = (vertex(corner), vertex(next[corner as usize]));
                ([a.min(b), a.max(b)], corner)
            })
            .collect();
        edges.par_sort_unstable();
        let mut seams = Self::default();
        for edge in edges.chunk_by(|a, b| a.0 == b.0) {
            let [(_, a), (_, b), ..] = *edge else {
                seams.boundary.push(edge[0].1);
                continue;
            };
            let ends = |corner: u32| {
                let (here, there) = (uv[corner as usize], uv[next[corner as usize] as usize]);
                if vertex(corner) == edge[0].0[0] { [here, there] } else { [there, here] }
            };
            if ends(a) != ends(b) {
                seams.cuts.push([a, b]);
            }
        }
        seams.boundary.sort_unstable();
        seams.cuts.sort_unstable();
        let face_of = face_of_corners(polygons);
        let islands = |cut: &[u32; 2]| {
            let [a, b] = cut.map(|corner| island[face_of[corner as usize] as usize]);
            [a.min(b), a.max(b)]
        };
        let ends = |cut: &[u32; 2]| [vertex(cut[0]), vertex(next[cut[0] as usize])];
        (seams.run, seams.runs) = runs(&seams.cuts, ends, islands, polygons.positions.len());
        seams
    }
}

/// The corner after each corner in its face.
pub(super) fn next_corners(polygons: PolygonView<'_>) -> Vec<u32> {
    let mut next: Vec<u32> = (1..=polygons.corner_count() as u32).collect();
    for face in 0..polygons.face_count() {
        let corners = polygons.corners(face);
        if let Some(last) = corners.clone().next_back() {
            next[last] = corners.start as u32;
        }
    }
    next
}

fn face_of_corners(polygons: PolygonView<'_>) -> Vec<u32> {
    (0..polygons.face_count()).flat_map(|face| polygons.corners(face).map(move |_| face as u32)).collect()
}

/// Joins cuts over vertices where exactly two meet, when both are between the same islands.
fn runs(
    cuts: &[[u32; 2]],
    ends: impl Fn(&[u32; 2]) -> [u32; 2],
    islands: impl Fn(&[u32; 2]) -> [u32; 2],
    vertices: usize,
) -> (Vec<u32>, usize) {
    const UNSEEN: u32 = u32::MAX;
    // The first two cuts at each vertex, and how many there are.
    let mut meeting = vec![([UNSEEN; 2], 0_u32); vertices];
    for (number, cut) in cuts.iter().enumerate() {
        for vertex in ends(cut) {
            let (known, count) = &mut meeting[vertex as usize];
            if let Some(place) = known.get_mut(*count as usize) {
                *place = number as u32;
            }
            *count += 1;
        }
    }
    let mut run = vec![UNSEEN; cuts.len()];
    let mut count = 0;
    for seed in 0..cuts.len() {
        if run[seed] != UNSEEN {
            continue;
        }
        let mut stack = vec![seed];
        run[seed] = count;
        while let Some(number) = stack.pop() {
            for vertex in ends(&cuts[number]) {
                let (known, degree) = meeting[vertex as usize];
                if degree != 2 {
                    continue;
                }
                for other in known.map(|other| other as usize) {
                    if run[other] == UNSEEN && islands(&cuts[other]) == islands(&cuts[number]) {
                        run[other] = count;
                        stack.push(other);
                    }
                }
            }
        }
        count += 1;
    }
    (run, count as usize)
}

#[cfg(test)]
mod tests {
    use qoptimize::measure_faces;
    use qoptimize::qmesh::shapes;

    use super::*;

    fn seams(uv_of: impl Fn(f64, f64, usize) -> Vec2) -> Seams {
        let mesh = shapes::grid(4, 4);
        let uv: Vec<Vec2> = mesh
            .corners()
            .map(|corner| {
                let p = mesh.position(mesh.vertex(corner));
                uv_of(p.x, p.y, mesh.face(corner).index())
            })
            .collect();
        let island = measure_faces(mesh.view(), &uv).unwrap().island;
        Seams::find(mesh.view(), &uv, &island)
    }

    /// A sheet in one piece has no cuts; torn apart in the middle it has one run of four; torn into quarters, four of two.
    #[test]
    fn tears_are_found_in_runs() {
        let whole = seams(|x, y, _| Vec2::new(x, y));
        assert_eq!((whole.boundary.len(), whole.cuts.len(), whole.runs), (16, 0, 0));
        let column = |face: usize| (face % 4 / 2) as f64;
        let halves = seams(|x, y, face| Vec2::new(x + column(face), y));
        assert_eq!((halves.boundary.len(), halves.cuts.len(), halves.runs), (16, 4, 1));
        let quarters = seams(|x, y, face| Vec2::new(x + column(face), y + (face / 8) as f64));
        assert_eq!((quarters.cuts.len(), quarters.runs), (8, 4));
        assert!((0..4).all(|run| quarters.run.iter().filter(|&&r| r == run).count() == 2));
    }
}
