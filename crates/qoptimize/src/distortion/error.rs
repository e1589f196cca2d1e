//! Why UVs cannot be measured.

use qembed::qmesh::{PolygonView, Vec2};
use rayon::prelude::*;

/// Why UVs cannot be measured. Indices count from 0, as in the caller's arrays.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// There is no face at all.
    #[error("there are no faces to measure")]
    NoFaces,
    /// The flat arrays contradict each other.
    #[error(
        "face_start must begin with 0, never fall, and end with the number of corners; entry {entry} does not fit"
    )]
    BadFaceStart {
        /// The offending entry of `face_start`.
        entry: usize,
    },
    /// Not one UV per corner.
    #[error("there are {found} UVs for {expected} corners: one per corner is needed")]
    UvCount {
        /// Corners of the polygons.
        expected: usize,
        /// UVs given.
        found: usize,
    },
    /// A corner names a vertex that does not exist.
    #[error("corner {corner} names vertex {vertex}, but there are only {count} vertices")]
    IndexOutOfRange {
        /// The corner.
        corner: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// A UV is not finite.
    #[error("corner {corner} of the faces has a UV that is not finite")]
    NonFinite {
        /// The corner.
        corner: usize,
    },
    /// The position of a vertex that a face uses is not finite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFinitePosition {
        /// The vertex.
        vertex: usize,
    },
    /// Nothing to scale by.
    #[error("the UVs cover no area")]
    NoArea,
    /// Nothing to compare with.
    #[error("the faces have no area in space")]
    NoSurface,
}

/// The least that a thread looks at.
const AT_ONCE: usize = 1 << 15;

/// The place of the first item that `is_bad`.
pub(crate) fn first<T: Sync>(items: &[T], is_bad: impl Fn(&T) -> bool + Sync) -> Option<usize> {
    let chunks = items.par_chunks(AT_ONCE).enumerate();
    chunks.find_map_first(|(number, chunk)| Some(number * AT_ONCE + chunk.iter().position(&is_bad)?))
}

/// Everything that the measures rely on.
pub(crate) fn check(polygons: PolygonView<'_>, uv: &[Vec2]) -> Result<(), MeasureError> {
    check_arrays(polygons, uv)?;
    let is_lost = |p: &Vec2| !p.iter().all(|x| x.is_finite());
    if let Some(corner) = first(uv, is_lost) {
        return Err(MeasureError::NonFinite { corner });
    }
    let finite = |&v: &u32| polygons.positions[v as usize].iter().all(|x| x.is_finite());
    match first(polygons.corner_vertex, |vertex| !finite(vertex)) {
        Some(corner) => {
            Err(MeasureError::NonFinitePosition { vertex: polygons.corner_vertex[corner] as usize })
        }
        None => Ok(()),
    }
}

/// Whether the flat arrays fit together.
pub(crate) fn check_arrays(polygons: PolygonView<'_>, uv: &[Vec2]) -> Result<(), MeasureError> {
    check_polygons(polygons)?;
    let corners = polygons.corner_count();
    if uv.len() != corners {
        return Err(MeasureError::UvCount { expected: corners, found: uv.len() });
    }
    Ok(())
}

/// Whether those of the polygons do.
pub(crate) fn check_polygons(polygons: PolygonView<'_>) -> Result<(), MeasureError> {
    let corners = polygons.corner_count();
    let starts = polygons.face_start;
    if polygons.face_count() == 0 {
        return Err(MeasureError::NoFaces);
    }
    let bad = if starts[0] != 0 {
        Some(0)
    } else if starts[starts.len() - 1] as usize != corners {
        Some(starts.len() - 1)
    } else {
        starts.windows(2).position(|pair| pair[1] < pair[0]).map(|i| i + 1)
    };
    if let Some(entry) = bad {
        return Err(MeasureError::BadFaceStart { entry });
    }
    let count = polygons.positions.len();
    let is_outside = |&v: &u32| v as usize >= count;
    if let Some(corner) = first(polygons.corner_vertex, is_outside) {
        let vertex = polygons.corner_vertex[corner];
        return Err(MeasureError::IndexOutOfRange { corner, vertex, count });
    }
    Ok(())
}
