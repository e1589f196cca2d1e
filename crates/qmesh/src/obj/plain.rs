//! OBJ text for polygons that never were a file.

use std::io::{self, Write};
use std::ops::Range;

use super::output::{Piece, write_pieces};
use super::texture::{TextureTable, invalid};
use crate::Vec2;
use crate::polygons::PolygonView;

/// Writes polygons as OBJ text: `v` lines, `vt` lines if there are UVs (one per corner), `f` lines. Lines end with LF.
///
/// ```
/// let square = qmesh::Polygons::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.5, 0.0]], [[0, 1, 2]]);
/// let mut out = Vec::new();
/// qmesh::obj::write_obj(&mut out, square.view(), None)?;
/// assert_eq!(out, b"v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 1.0 2.5 0.0\nf 1 2 3\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// What `out` reports, and `InvalidInput` when the flat arrays contradict each other, a position or UV is not finite,
/// or there is not one UV per corner; then nothing is written.
pub fn write_obj(
    out: &mut impl Write,
    polygons: PolygonView<'_>,
    corner_uv: Option<&[Vec2]>,
) -> io::Result<()> {
    check(polygons)?;
    let table = corner_uv
        .map(|uv| TextureTable::new(polygons.positions.len(), polygons.corner_vertex, uv))
        .transpose()?;
    let faces = polygons.face_count();
    let vertices = polygons.positions.len();
    let of_table = if table.is_some() { vertices } else { 0 };
    let mut jobs = Vec::new();
    jobs.extend(ranges(vertices).map(Job::Vertices));
    jobs.extend(ranges(of_table).map(Job::Values));
    jobs.extend(ranges(faces).map(Job::Faces));
    write_pieces(out, &jobs, |job, piece| match job {
        Job::Vertices(range) => {
            for position in &polygons.positions[range.clone()] {
                piece.vertex(position);
                piece.bytes(b"\n");
            }
        }
        Job::Values(range) => {
            for uv in table.iter().flat_map(|table| table.values(range.clone())) {
                piece.texture(uv);
                piece.bytes(b"\n");
            }
        }
        Job::Faces(range) => write_faces(polygons, table.as_ref(), range.clone(), piece),
    })
}

/// What becomes a piece of the text.
enum Job {
    Vertices(Range<usize>),
    Values(Range<usize>),
    Faces(Range<usize>),
}

fn ranges(count: usize) -> impl Iterator<Item = Range<usize>> {
    const AT_ONCE: usize = 1 << 14;
    (0..count).step_by(AT_ONCE).map(move |start| start..count.min(start + AT_ONCE))
}

fn write_faces(
    polygons: PolygonView<'_>,
    table: Option<&TextureTable<'_>>,
    faces: Range<usize>,
    piece: &mut Piece,
) {
    let mut seams = table.map(|table| (table, table.seam_corners(polygons.face_start[faces.start] as usize)));
    for face in faces {
        piece.bytes(b"f");
        for corner in polygons.corners(face) {
            piece.bytes(b" ");
            piece.integer(polygons.corner_vertex[corner] as usize + 1);
            if let Some((table, seams)) = &mut seams {
                piece.bytes(b"/");
                piece.integer(table.place(corner, seams) + 1);
            }
        }
        piece.bytes(b"\n");
    }
}

fn check(polygons: PolygonView<'_>) -> io::Result<()> {
    let PolygonView { positions, face_start, corner_vertex } = polygons;
    let ends = (face_start.first().copied(), face_start.last().copied());
    let is_covered = match ends {
        (None, None) => corner_vertex.is_empty(),
        (first, last) => first == Some(0) && last.map(|end| end as usize) == Some(corner_vertex.len()),
    };
    if !is_covered || face_start.windows(2).any(|pair| pair[0] > pair[1]) {
        return Err(invalid("face_start does not divide the corners".to_owned()));
    }
    if let Some(vertex) = corner_vertex.iter().find(|&&vertex| vertex as usize >= positions.len()) {
        return Err(invalid(format!("a face names vertex {vertex} of {}", positions.len())));
    }
    match positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        Some(vertex) => Err(invalid(format!("vertex {vertex} is not finite"))),
        None => Ok(()),
    }
}
