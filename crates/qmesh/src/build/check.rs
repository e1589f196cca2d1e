//! What can be said of polygons face by face: sizes, indices, coordinates.

use rayon::prelude::*;

use crate::error::BuildError;
use crate::polygons::PolygonView;
use crate::{COORDINATE_LIMIT, Vec3};

/// Checks arrays, indices and coordinates. `repeats(face, vertex)` hears of faces that visit a vertex twice.
pub(crate) fn check_polygons(
    polygons: PolygonView<'_>,
    mut repeats: impl FnMut(u32, u32) -> Result<(), BuildError>,
) -> Result<(), BuildError> {
    check_sizes(polygons)?;
    let count = polygons.positions.len();
    let is_plain = |face: usize| {
        let vertices = polygons.face(face);
        (3..=8).contains(&vertices.len())
            && vertices.iter().all(|&v| (v as usize) < count)
            && repeated(vertices, &mut Vec::new()).is_none()
    };
    let beyond = |p: &Vec3| !p.iter().all(|x| x.abs() <= COORDINATE_LIMIT);
    const AT_ONCE: usize = 1 << 14;
    let odd: Vec<usize> =
        (0..polygons.face_count()).into_par_iter().with_min_len(AT_ONCE).filter(|&f| !is_plain(f)).collect();
    let mut sorted = Vec::new();
    for face in odd {
        let vertices = polygons.face(face);
        let face = face as u32;
        if vertices.len() < 3 {
            return Err(BuildError::TooFewCorners { face, corners: vertices.len() });
        }
        if let Some(&vertex) = vertices.iter().find(|&&v| v as usize >= count) {
            return Err(BuildError::IndexOutOfRange { face, vertex, count });
        }
        if let Some(vertex) = repeated(vertices, &mut sorted) {
            repeats(face, vertex)?;
        }
    }
    if !polygons.positions.par_chunks(AT_ONCE).any(|some| some.iter().any(beyond)) {
        return Ok(());
    }
    match polygons.positions.iter().position(beyond) {
        Some(vertex) => Err(BuildError::NonFiniteCoordinate { vertex: vertex as u32 }),
        None => Ok(()),
    }
}

fn check_sizes(polygons: PolygonView<'_>) -> Result<(), BuildError> {
    let limit = (u32::MAX / 2) as usize;
    for (what, count) in [("corners", polygons.corner_count()), ("vertices", polygons.positions.len())] {
        if count > limit {
            return Err(BuildError::TooLarge { what, count });
        }
    }
    if polygons.face_count() == 0 {
        return Err(BuildError::NoFaces);
    }
    let starts = polygons.face_start;
    if starts[0] != 0 {
        return Err(BuildError::BadFaceStart { entry: 0 });
    }
    if let Some(before) = starts.windows(2).position(|pair| pair[0] > pair[1]) {
        return Err(BuildError::BadFaceStart { entry: before + 1 });
    }
    if starts[starts.len() - 1] as usize != polygons.corner_count() {
        return Err(BuildError::BadFaceStart { entry: starts.len() - 1 });
    }
    Ok(())
}

fn repeated(vertices: &[u32], sorted: &mut Vec<u32>) -> Option<u32> {
    if vertices.len() <= 8 {
        return (1..vertices.len()).find(|&i| vertices[..i].contains(&vertices[i])).map(|i| vertices[i]);
    }
    sorted.clear();
    sorted.extend_from_slice(vertices);
    sorted.sort_unstable();
    sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}
