//! From one UV per corner to the `vt` lines of a file: one for each distinct pair of vertex and value.

use std::io;
use std::ops::Range;

use rayon::prelude::*;

use super::parse::NONE;
use crate::Vec2;

/// How UVs are rounded before they are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case", default))]
#[non_exhaustive]
pub struct UvFormat {
    /// What they are rounded to. Default: nothing is.
    pub precision: UvPrecision,
}

/// How exact UVs are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum UvPrecision {
    /// The same `f64`.
    #[default]
    Double,
    /// The nearest `f32`: what most programs keep of it.
    Single,
}

impl UvFormat {
    /// UVs rounded to the precision.
    #[must_use]
    pub fn with_precision(precision: UvPrecision) -> Self {
        Self { precision }
    }

    /// The rounded value. There is one zero: `-0` would be a second `vt` for the same place.
    #[must_use]
    pub fn round(&self, uv: Vec2) -> Vec2 {
        match self.precision {
            UvPrecision::Double => uv.map(|x| x + 0.0),
            UvPrecision::Single => uv.map(|x| f64::from(x as f32) + 0.0),
        }
    }
}

/// The `vt` values of a file, in its order, and which of them each corner has.
///
/// Values are ordered by vertex, and at one vertex by corner: without seams, `vt` and `v` have the same numbers.
pub(super) struct TextureTable<'a> {
    corner_vertex: &'a [u32],
    corner_uv: &'a [Vec2],
    /// The first value of each vertex, and the end of the last.
    start: Vec<u32>,
    /// A corner that has the value, one entry per value.
    representative: Vec<u32>,
    /// The corners at vertices with several values, ascending, and which value each has.
    seams: Vec<[u32; 2]>,
    split_vertices: usize,
}

/// Goes through the corners at vertices with several values.
pub(super) struct SeamCorners<'a> {
    rest: &'a [[u32; 2]],
}

impl<'a> TextureTable<'a> {
    pub(super) fn new(
        vertex_count: usize,
        corner_vertex: &'a [u32],
        corner_uv: &'a [Vec2],
    ) -> io::Result<Self> {
        check(corner_vertex, corner_uv)?;
        let value = |corner: u32| written(corner_uv[corner as usize]);
        let first = first_corners(vertex_count, corner_vertex);
        let mut at_seams = corners_at_seams(corner_vertex, &first, value);
        let mut table = Self {
            corner_vertex,
            corner_uv,
            start: Vec::with_capacity(vertex_count + 1),
            representative: Vec::with_capacity(vertex_count),
            seams: Vec::with_capacity(at_seams.len()),
            split_vertices: 0,
        };
        let mut groups = at_seams.chunk_by_mut(|a, b| a[0] == b[0]).peekable();
        for (vertex, first) in first.into_iter().enumerate() {
            table.start.push(table.representative.len() as u32);
            match groups.next_if(|group| group[0][0] as usize == vertex) {
                Some(corners) => table.split(corners, value),
                None if first != NONE => table.representative.push(first),
                None => {}
            }
        }
        table.start.push(table.representative.len() as u32);
        table.seams.par_sort_unstable();
        Ok(table)
    }

    /// The values of a vertex that has several; `corners` are `[vertex, corner]`, corners ascending.
    fn split(&mut self, corners: &mut [[u32; 2]], value: impl Fn(u32) -> Vec2) {
        let before = self.representative.len();
        if corners.len() <= 8 {
            for &mut [_, corner] in corners {
                let known = self.representative[before..].iter().position(|&r| value(r) == value(corner));
                let place = before + known.unwrap_or(self.representative.len() - before);
                if known.is_none() {
                    self.representative.push(corner);
                }
                self.seams.push([corner, place as u32]);
            }
        } else {
            self.split_many(corners, value);
        }
        self.split_vertices += 1;
    }

    /// The same by sorting, so that a pole with thousands of values takes no quadratic time.
    fn split_many(&mut self, corners: &mut [[u32; 2]], value: impl Fn(u32) -> Vec2) {
        corners.sort_unstable_by(|a, b| {
            let (p, q) = (value(a[1]), value(b[1]));
            p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(a[1].cmp(&b[1]))
        });
        // Every corner first points to the first corner with its value, then to that corner's place.
        for same in corners.chunk_by_mut(|a, b| value(a[1]) == value(b[1])) {
            let representative = same[0][1];
            same.iter_mut().for_each(|corner| corner[0] = representative);
        }
        let before = self.representative.len();
        self.representative.extend(corners.iter().filter(|[first, corner]| first == corner).map(|c| c[1]));
        let known = &mut self.representative[before..];
        known.sort_unstable();
        for &[representative, corner] in corners.iter() {
            let place = known.binary_search(&representative).unwrap_or_default();
            self.seams.push([corner, (before + place) as u32]);
        }
    }

    /// How many values there are.
    pub(super) fn len(&self) -> usize {
        self.representative.len()
    }

    /// How many vertices have more than one value.
    pub(super) fn split_vertices(&self) -> usize {
        self.split_vertices
    }

    /// The values of some vertices.
    pub(super) fn values(&self, vertices: Range<usize>) -> impl Iterator<Item = Vec2> + '_ {
        let range = self.start[vertices.start] as usize..self.start[vertices.end] as usize;
        self.representative[range].iter().map(|&corner| written(self.corner_uv[corner as usize]))
    }

    /// For [`place`](Self::place), from `corner` on.
    pub(super) fn seam_corners(&self, corner: usize) -> SeamCorners<'_> {
        let start = self.seams.partition_point(|seam| (seam[0] as usize) < corner);
        SeamCorners { rest: &self.seams[start..] }
    }

    /// Which value a corner has, from 0. Corners have to be asked for in order.
    #[inline]
    pub(super) fn place(&self, corner: usize, seams: &mut SeamCorners<'_>) -> usize {
        if let [[next, place], rest @ ..] = seams.rest
            && *next as usize == corner
        {
            seams.rest = rest;
            return *place as usize;
        }
        self.start[self.corner_vertex[corner] as usize] as usize
    }
}

/// The value that stands in the file.
fn written(uv: Vec2) -> Vec2 {
    UvFormat::default().round(uv)
}

/// The first corner of each vertex; `NONE` where there is none.
fn first_corners(vertex_count: usize, corner_vertex: &[u32]) -> Vec<u32> {
    let mut first = vec![NONE; vertex_count];
    for (corner, &vertex) in corner_vertex.iter().enumerate() {
        let first = &mut first[vertex as usize];
        *first = (*first).min(corner as u32);
    }
    first
}

/// All corners at vertices with several values, as `[vertex, corner]`, ascending.
fn corners_at_seams(
    corner_vertex: &[u32],
    first: &[u32],
    value: impl Fn(u32) -> Vec2 + Sync,
) -> Vec<[u32; 2]> {
    const LEAST: usize = 1 << 14;
    let corners = || corner_vertex.par_iter().enumerate().with_min_len(LEAST);
    let splits = |&(corner, &vertex): &(usize, &u32)| {
        let first = first[vertex as usize];
        first != corner as u32 && value(first) != value(corner as u32)
    };
    let split: Vec<u32> = corners().filter(splits).map(|(_, &vertex)| vertex).collect();
    if split.is_empty() {
        return Vec::new();
    }
    let mut is_split = vec![false; first.len()];
    split.into_iter().for_each(|vertex| is_split[vertex as usize] = true);
    let mut at_seams: Vec<[u32; 2]> = corners()
        .filter(|&(_, &vertex)| is_split[vertex as usize])
        .map(|(corner, &vertex)| [vertex, corner as u32])
        .collect();
    at_seams.par_sort_unstable();
    at_seams
}

fn check(corner_vertex: &[u32], corner_uv: &[Vec2]) -> io::Result<()> {
    if corner_uv.len() != corner_vertex.len() {
        return Err(invalid(format!("{} UVs for {} corners", corner_uv.len(), corner_vertex.len())));
    }
    let is_bad = |&uv: &Vec2| !uv.iter().all(|x| x.is_finite());
    if !corner_uv.par_chunks(1 << 14).any(|some| some.iter().any(is_bad)) {
        return Ok(());
    }
    match corner_uv.iter().position(is_bad) {
        Some(corner) => Err(invalid(format!("the UV of corner {corner} is not finite"))),
        None => Ok(()),
    }
}

pub(super) fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table by the definition: values in the order of vertices, then of first corners.
    fn by_definition(vertices: usize, corner_vertex: &[u32], uv: &[Vec2]) -> (Vec<Vec2>, Vec<usize>, usize) {
        let (mut values, mut places, mut split) = (Vec::<Vec2>::new(), vec![0; uv.len()], 0);
        for vertex in 0..vertices as u32 {
            let before = values.len();
            for corner in (0..uv.len()).filter(|&corner| corner_vertex[corner] == vertex) {
                let known = values[before..].iter().position(|&value| value == uv[corner]);
                places[corner] = before + known.unwrap_or(values.len() - before);
                values.extend(known.is_none().then_some(uv[corner]));
            }
            split += usize::from(values.len() > before + 1);
        }
        (values, places, split)
    }

    proptest::proptest! {
        /// Values are found by sorting, by looking, and by their vertex alone; which way does not show.
        #[test]
        fn tables_are_what_they_are_defined_to_be(
            corners in proptest::collection::vec((0u32..12, 0u32..4, 0u32..3), 1..200),
            kinds in 1u32..5,
        ) {
            let corner_vertex: Vec<u32> = corners.iter().map(|c| c.0 * c.0 / 8).collect();
            let uv: Vec<Vec2> =
                corners.iter().map(|c| Vec2::new(f64::from(c.1 % kinds), -f64::from(c.2 % kinds) + 0.0)).collect();
            let table = TextureTable::new(18, &corner_vertex, &uv).expect("finite");
            let mut seams = table.seam_corners(0);
            let places: Vec<usize> = (0..uv.len()).map(|corner| table.place(corner, &mut seams)).collect();
            let values: Vec<Vec2> = table.values(0..7).chain(table.values(7..18)).collect();
            proptest::prop_assert_eq!(table.len(), values.len());
            proptest::prop_assert_eq!((values, places, table.split_vertices()), by_definition(18, &corner_vertex, &uv));
        }
    }

    #[test]
    fn both_zeros_are_one_value() {
        let uv = [Vec2::new(0.1, 0.0), Vec2::new(0.1, -0.0), Vec2::new(0.1 + 1e-12, 0.0)];
        assert_eq!(TextureTable::new(1, &[0, 0, 0], &uv).expect("finite").len(), 2);
    }
}
