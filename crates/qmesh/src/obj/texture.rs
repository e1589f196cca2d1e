//! From one UV per corner to the `vt` lines of a file: one for each distinct pair of vertex and value.

use std::io;

use crate::Vec2;

/// How UVs are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case", default))]
#[non_exhaustive]
pub struct UvFormat {
    /// How many digits coordinates get. Default: as many as `f64` needs.
    pub precision: UvPrecision,
}

/// How exactly UVs are written: always with the fewest digits that read back as the same number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum UvPrecision {
    /// The same `f64`.
    #[default]
    Double,
    /// The nearest `f32`: what most programs keep of it. Corners that differ in less share a `vt`.
    Single,
}

impl UvFormat {
    /// UVs rounded to the precision.
    #[must_use]
    pub fn with_precision(precision: UvPrecision) -> Self {
        Self { precision }
    }

    /// The value that a reader gets back. There is one zero: `-0` would be a second `vt` for the same place.
    #[must_use]
    pub fn round(&self, uv: Vec2) -> Vec2 {
        match self.precision {
            UvPrecision::Double => uv.map(|x| x + 0.0),
            UvPrecision::Single => uv.map(|x| f64::from(x as f32) + 0.0),
        }
    }
}

/// The `vt` values of a file, in its order, and which of them each corner has.
pub(super) struct TextureTable {
    pub(super) values: Vec<Vec2>,
    /// From 0, one entry per corner.
    pub(super) of_corner: Vec<u32>,
    /// How many vertices have more than one value.
    pub(super) split_vertices: usize,
}

impl TextureTable {
    /// Values are ordered by vertex, and at one vertex by corner: without seams, `vt` and `v` have the same numbers.
    pub(super) fn new(
        vertex_count: usize,
        corner_vertex: &[u32],
        corner_uv: &[Vec2],
        format: UvFormat,
    ) -> io::Result<Self> {
        check(corner_vertex, corner_uv, format)?;
        let (start, corners) = corners_by_vertex(vertex_count, corner_vertex);
        let mut table =
            Self { values: Vec::new(), of_corner: vec![0; corner_vertex.len()], split_vertices: 0 };
        let mut sorted = Vec::new();
        for around in start.windows(2) {
            let corners = &corners[around[0] as usize..around[1] as usize];
            let before = table.values.len();
            if corners.len() <= 8 {
                table.add_few(corners, corner_uv, format);
            } else {
                table.add_many(corners, corner_uv, format, &mut sorted);
            }
            table.split_vertices += usize::from(table.values.len() > before + 1);
        }
        Ok(table)
    }

    fn add_few(&mut self, corners: &[u32], corner_uv: &[Vec2], format: UvFormat) {
        let first = self.values.len();
        for &corner in corners {
            let uv = format.round(corner_uv[corner as usize]);
            let known = self.values[first..].iter().position(|&value| value == uv);
            self.of_corner[corner as usize] = match known {
                Some(place) => (first + place) as u32,
                None => {
                    self.values.push(uv);
                    self.values.len() as u32 - 1
                }
            };
        }
    }

    /// The same by sorting, so that a pole with thousands of values takes no quadratic time.
    fn add_many(&mut self, corners: &[u32], corner_uv: &[Vec2], format: UvFormat, sorted: &mut Vec<u32>) {
        let value = |corner: u32| format.round(corner_uv[corner as usize]);
        sorted.clear();
        sorted.extend_from_slice(corners);
        sorted.sort_unstable_by(|&a, &b| {
            let (p, q) = (value(a), value(b));
            p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(a.cmp(&b))
        });
        // Every corner first points to the first corner with its value, then to that corner's place.
        let mut representative = sorted[0];
        for &corner in sorted.iter() {
            if value(corner) != value(representative) {
                representative = corner;
            }
            self.of_corner[corner as usize] = representative;
        }
        for &corner in corners {
            let representative = self.of_corner[corner as usize];
            self.of_corner[corner as usize] = if representative == corner {
                self.values.push(value(corner));
                self.values.len() as u32 - 1
            } else {
                self.of_corner[representative as usize]
            };
        }
    }
}

fn check(corner_vertex: &[u32], corner_uv: &[Vec2], format: UvFormat) -> io::Result<()> {
    if corner_uv.len() != corner_vertex.len() {
        return Err(invalid(format!("{} UVs for {} corners", corner_uv.len(), corner_vertex.len())));
    }
    let is_bad = |&uv: &Vec2| !format.round(uv).iter().all(|x| x.is_finite());
    match corner_uv.iter().position(is_bad) {
        Some(corner) => Err(invalid(format!("the UV of corner {corner} is not finite"))),
        None => Ok(()),
    }
}

pub(super) fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message)
}

/// The corners of each vertex in order, as `(start, corners)`.
fn corners_by_vertex(vertex_count: usize, corner_vertex: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0u32; vertex_count + 1];
    for &vertex in corner_vertex {
        start[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertex_count {
        start[vertex + 1] += start[vertex];
    }
    let mut cursor = start.clone();
    let mut corners = vec![0u32; corner_vertex.len()];
    for (corner, &vertex) in corner_vertex.iter().enumerate() {
        let place = &mut cursor[vertex as usize];
        corners[*place as usize] = corner as u32;
        *place += 1;
    }
    (start, corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two ways to tell values apart agree, and number them by first corner.
    #[test]
    fn many_and_few_give_the_same_table() {
        let uv: Vec<Vec2> =
            (0..40u32).map(|c| Vec2::new(f64::from(c * 7 % 5), -f64::from(c * 3 % 4))).collect();
        let corners: Vec<u32> = (0..40).filter(|c| c % 3 != 0).collect();
        let empty = || TextureTable { values: vec![], of_corner: vec![0; 40], split_vertices: 0 };
        let (mut few, mut many) = (empty(), empty());
        few.add_few(&corners, &uv, UvFormat::default());
        many.add_many(&corners, &uv, UvFormat::default(), &mut Vec::new());
        assert_eq!(few.values, many.values);
        assert_eq!(few.of_corner, many.of_corner);
        assert!(few.values.len() > 8);
    }

    #[test]
    fn single_precision_merges_what_it_cannot_tell_apart() {
        let uv = [Vec2::new(0.1, 0.0), Vec2::new(0.1 + 1e-12, -0.0)];
        let count = |format| TextureTable::new(1, &[0, 0], &uv, format).expect("finite").values.len();
        assert_eq!(count(UvFormat::default()), 2);
        assert_eq!(count(UvFormat::with_precision(UvPrecision::Single)), 1);
    }
}
