//! Where the blocks of the Hessian stand, and which corners add to each: found once for all steps.
//!
//! Two unknowns a vertex, so 2 × 2 blocks. Every vertex gathers what its corner triangles say about it, in the order of the
//! corners. So rows are filled in parallel, and the sums do not depend on the number of threads.

use std::ops::Range;

use rayon::prelude::*;

use super::element::Edges;
use super::rest::RestCorner;

/// The upper triangle, row by row, of a corner's Hessian by its edge vectors.
pub(super) type Triangle = [f64; 10];

/// A 2 × 2 block, row by row.
pub(super) type Block = [f64; 4];

/// Stands for a slot that does not fit into eight bits.
const FAR: u8 = u8::MAX;
const CHUNK: usize = 2048;

/// A corner triangle at one of its vertices.
#[derive(Clone, Copy, Debug, Default)]
struct Incidence {
    /// Three times the corner's number, plus the vertex's place in (here, next, previous).
    place: u32,
    /// Where in the vertex's row the blocks of (here, next, previous) stand.
    slots: [u8; 3],
}

/// The pattern of the Hessian.
#[derive(Debug)]
pub(super) struct Layout {
    /// Where the blocks of each vertex's row start, and the vertices that they belong to, ascending.
    pub(super) starts: Vec<u32>,
    pub(super) columns: Vec<u32>,
    incidence_starts: Vec<u32>,
    incidences: Vec<Incidence>,
}

impl Layout {
    pub(super) fn new(corners: &[RestCorner], vertex_count: usize) -> Self {
        let (incidence_starts, mut incidences) = incidences(corners, vertex_count);
        let (starts, columns) = blocks(corners, &incidence_starts, &incidences);
        let rows = split(&incidence_starts, &mut incidences);
        rows.into_par_iter().with_min_len(CHUNK).enumerate().for_each(|(vertex, row)| {
            let columns = &columns[starts[vertex] as usize..starts[vertex + 1] as usize];
            for incidence in row {
                let vertices = corners[incidence.place as usize / 3].vertices;
                incidence.slots = vertices.map(|v| {
                    let slot = columns.partition_point(|&column| column < v);
                    u8::try_from(slot).unwrap_or(FAR)
                });
            }
        });
        Self { starts, columns, incidence_starts, incidences }
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The columns of a vertex's row.
    pub(super) fn row(&self, vertex: usize) -> &[u32] {
        &self.columns[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    fn incidences(&self, vertex: usize) -> &[Incidence] {
        let range = self.incidence_starts[vertex] as usize..self.incidence_starts[vertex + 1] as usize;
        &self.incidences[range]
    }

    /// What the corners in `window` have to do with a vertex.
    fn incidences_in(&self, vertex: usize, window: &Range<usize>) -> &[Incidence] {
        let all = self.incidences(vertex);
        let before = |bound: usize| all.partition_point(|incidence| (incidence.place as usize) < 3 * bound);
        &all[before(window.start)..before(window.end)]
    }

    /// Adds to the gradient, two entries a vertex, what the corners in `window` add to it: `corners` are their gradients by their
    /// edge vectors. `vertices` are those that they have, ascending, or none: all.
    pub(super) fn add_gradient(
        &self,
        gradient: &mut [f64],
        window: &Range<usize>,
        vertices: Option<&[u32]>,
        corners: &[Edges],
    ) {
        let mut pairs = gradient.as_chunks_mut::<2>().0.iter_mut().enumerate();
        let rows: Vec<(usize, &mut [f64; 2])> = match vertices {
            None => pairs.collect(),
            Some(vertices) => {
                let mut passed = 0;
                let mut pick = |v: u32| {
                    let row = pairs.nth((v as usize).checked_sub(passed)?);
                    passed = v as usize + 1;
                    row
                };
                vertices.iter().filter_map(|&v| pick(v)).collect()
            }
        };
        rows.into_par_iter().with_min_len(CHUNK).for_each(|(vertex, sum)| {
            for incidence in self.incidences_in(vertex, window) {
                let [f1x, f1y, f0x, f0y] = corners[incidence.place as usize / 3 - window.start];
                let [x, y] = match incidence.place % 3 {
                    0 => [-f1x - f0x, -f1y - f0y],
                    1 => [f1x, f1y],
                    _ => [f0x, f0y],
                };
                sum[0] += x;
                sum[1] += y;
            }
        });
    }

    /// Overwrites `row` with what the corners in `window` add to the blocks of the vertex's row: `triangles` are theirs, `corners` all.
    pub(super) fn gather_row(
        &self,
        vertex: usize,
        window: &Range<usize>,
        triangles: &[Triangle],
        corners: &[RestCorner],
        row: &mut Vec<Block>,
    ) {
        row.clear();
        row.resize(self.row(vertex).len(), [0.0; 4]);
        for incidence in self.incidences_in(vertex, window) {
            let corner = incidence.place as usize / 3;
            let blocks = corner_row(incidence.place % 3, &triangles[corner - window.start]);
            for (k, (block, slot)) in blocks.iter().zip(incidence.slots).enumerate() {
                let at = if slot == FAR {
                    let v = corners[corner].vertices[k];
                    self.row(vertex).partition_point(|&column| column < v)
                } else {
                    slot as usize
                };
                let sum = &mut row[at];
                for i in 0..4 {
                    sum[i] += block[i];
                }
            }
        }
    }
}

/// The blocks that the vertex at `place` of (here, next, previous) has with these three.
///
/// The triangle is by (f1, f0), that is by the vertices next and previous; what makes the sums zero belongs to the corner's own
/// vertex.
fn corner_row(place: u32, &[a, b, c, d, e, f, g, h, i, j]: &Triangle) -> [Block; 3] {
    let (nn, np, pp) = ([a, b, b, e], [c, d, f, g], [h, i, i, j]);
    let pn = transposed(np);
    let (hn, hp) = (minus_sum(nn, pn), minus_sum(np, pp));
    match place {
        0 => [minus_sum(hn, hp), hn, hp],
        1 => [transposed(hn), nn, np],
        _ => [transposed(hp), pn, pp],
    }
}

fn transposed([xx, xy, yx, yy]: Block) -> Block {
    [xx, yx, xy, yy]
}

fn minus_sum(a: Block, b: Block) -> Block {
    [-a[0] - b[0], -a[1] - b[1], -a[2] - b[2], -a[3] - b[3]]
}

/// Per vertex its corner triangles in order, by a counting sort.
fn incidences(corners: &[RestCorner], vertex_count: usize) -> (Vec<u32>, Vec<Incidence>) {
    let mut starts = vec![0_u32; vertex_count + 1];
    for vertex in corners.iter().flat_map(|corner| corner.vertices) {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertex_count {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut incidences = vec![Incidence::default(); 3 * corners.len()];
    for (number, corner) in corners.iter().enumerate() {
        for (k, vertex) in corner.vertices.into_iter().enumerate() {
            let at = &mut next[vertex as usize];
            incidences[*at as usize].place = (3 * number + k) as u32;
            *at += 1;
        }
    }
    (starts, incidences)
}

/// Per vertex itself and all vertices that share a corner triangle with it, ascending.
fn blocks(corners: &[RestCorner], starts: &[u32], incidences: &[Incidence]) -> (Vec<u32>, Vec<u32>) {
    let vertex_count = starts.len() - 1;
    let chunks: Vec<(Vec<u32>, Vec<u32>)> = (0..vertex_count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let (mut ends, mut columns, mut list) = (Vec::new(), Vec::new(), Vec::new());
            for vertex in chunk * CHUNK..((chunk + 1) * CHUNK).min(vertex_count) {
                list.clear();
                list.push(vertex as u32);
                for incidence in &incidences[starts[vertex] as usize..starts[vertex + 1] as usize] {
                    list.extend(corners[incidence.place as usize / 3].vertices);
                }
                list.sort_unstable();
                list.dedup();
                columns.extend_from_slice(&list);
                ends.push(columns.len() as u32);
            }
            (ends, columns)
        })
        .collect();
    let (mut block_starts, mut columns) = (vec![0], Vec::new());
    for (ends, chunk) in chunks {
        let first = columns.len() as u32;
        block_starts.extend(ends.into_iter().map(|end| first + end));
        columns.extend(chunk);
    }
    (block_starts, columns)
}

/// `values` cut at `starts`.
pub(super) fn split<'a, T>(starts: &[u32], values: &'a mut [T]) -> Vec<&'a mut [T]> {
    let mut rest = values;
    let mut rows = Vec::with_capacity(starts.len() - 1);
    for pair in starts.windows(2) {
        let (row, tail) = rest.split_at_mut((pair[1] - pair[0]) as usize);
        rows.push(row);
        rest = tail;
    }
    rows
}

/// Per window of `size` corners the vertices that they have, ascending.
pub(super) fn windows(corners: &[RestCorner], size: usize) -> Vec<Vec<u32>> {
    let vertices = |window: &[RestCorner]| {
        let mut vertices: Vec<u32> = window.iter().flat_map(|corner| corner.vertices).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.shrink_to_fit();
        vertices
    };
    corners.par_chunks(size).map(vertices).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convexity::Exempt;
    use crate::direct::rest::Rest;
    use crate::qmesh::shapes;

    /// What windows of corners add up to is the same to the bit as all corners at once.
    #[test]
    fn windows_add_up() {
        let mesh = shapes::jittered_grid(9, 7, 0.3, 2);
        let rest = Rest::new(&mesh, &Exempt::find(&mesh));
        let layout = Layout::new(&rest.corners, rest.vertex_count);
        let count = rest.corners.len();
        let number = |k: usize| (k as f64 * 0.7).sin() * 1e3_f64.powi((k % 5) as i32);
        let gradients: Vec<Edges> = (0..count).map(|c| std::array::from_fn(|i| number(4 * c + i))).collect();
        let triangles: Vec<Triangle> =
            (0..count).map(|c| std::array::from_fn(|i| number(10 * c + i))).collect();
        let mut whole = vec![0.0; 2 * rest.vertex_count];
        layout.add_gradient(&mut whole, &(0..count), None, &gradients);
        const SIZE: usize = 37;
        let mut added = vec![0.0; whole.len()];
        let mut seen = 0;
        for (number, vertices) in windows(&rest.corners, SIZE).iter().enumerate() {
            let window = number * SIZE..((number + 1) * SIZE).min(count);
            layout.add_gradient(&mut added, &window, Some(vertices), &gradients[window.clone()]);
            assert!(vertices.is_sorted_by(|a, b| a < b));
            seen += vertices.len();
        }
        assert_eq!(whole, added);
        assert!(seen > rest.vertex_count);
        let (mut blocks, mut part) = (Vec::new(), Vec::new());
        for vertex in 0..rest.vertex_count {
            layout.gather_row(vertex, &(0..count), &triangles, &rest.corners, &mut blocks);
            let mut sums = vec![[0.0; 4]; blocks.len()];
            for start in (0..count).step_by(count / 2 + 1) {
                let window = start..(start + count / 2 + 1).min(count);
                layout.gather_row(vertex, &window, &triangles[window.clone()], &rest.corners, &mut part);
                sums.iter_mut().zip(&part).for_each(|(sum, part)| (0..4).for_each(|i| sum[i] += part[i]));
            }
            let close = |(a, b): (&Block, &Block)| {
                (0..4).all(|i| (a[i] - b[i]).abs() <= 1e-12 * a[i].abs().max(1e12))
            };
            assert!(blocks.iter().zip(&sums).all(close), "{vertex}");
        }
    }
}
