//! OBJ files, kept as text: what is not UVs comes out as it went in.
//!
//! An [`ObjDocument`] owns the bytes of a file and an index of what a mesh is made of. Nothing is thrown away that
//! the index does not know: groups, objects, materials, normals, vertex colours, comments, names in any encoding,
//! LF, CR LF or CR, a byte order mark, negative indices and continued lines all survive
//! [`write_with_uv`](ObjDocument::write_with_uv).
//!
//! ```
//! use qmesh::{QuadMesh, obj::ObjDocument};
//!
//! let document = ObjDocument::parse(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\nf 1 2 \\\n  3 -1\n".to_vec())?;
//! let mesh = QuadMesh::build(document.polygons())?;
//! assert_eq!((mesh.face_count(), document.face_line(0)), (1, 6));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! How the format's loose ends are read:
//! - Only `v`, `vt`, `f` and its old name `fo` matter; what follows the third coordinate of a `v` is carried along.
//! - A face may name vertices that are defined further down. Indices beyond the file, 0, and negative ones that
//!   count back past the first element are refused, for `v` and `vt`; `vn` indices are carried along unchecked.
//! - Corners of one face may be written in different forms; a corner without a middle index has no UV.
//! - A `vt` that is not finite counts as none, since such UVs are usually about to be replaced; a `v` is refused.
//! - A backslash at the very end of a line continues statements made of numbers, but neither comments nor names.

mod chunks;
mod corner;
mod error;
mod join;
mod labels;
mod lines;
mod output;
mod parse;
mod plain;
mod plan;
mod reader;
mod sniff;
mod text;
mod texture;
mod write;

use std::io::Read;

pub use error::{EXCERPT_LIMIT, ObjError, ObjMistake, ObjMistakeKind};
pub use plain::write_obj;
pub use texture::{UvFormat, UvPrecision};
pub use write::UvWriteSummary;

use crate::polygons::{PolygonView, Polygons};
use crate::{Vec2, Vec3};

/// The most corners that a face may have. More are no polygon that anybody drew, and cost more than they are worth.
pub const FACE_CORNER_LIMIT: usize = 1 << 20;

/// An OBJ file: its bytes, and an index of its polygons.
///
/// Vertices, faces and corners are counted from 0 in file order; corners face after face.
#[derive(Clone, Debug)]
pub struct ObjDocument {
    bytes: Vec<u8>,
    index: parse::Index,
}

/// Reading.
impl ObjDocument {
    /// Takes the bytes of a file.
    ///
    /// # Errors
    /// [`ObjError`] when they are no OBJ with at least one face, with line and column where there is one.
    pub fn parse(bytes: Vec<u8>) -> Result<Self, ObjError> {
        let index = parse::parse(&bytes)?;
        Ok(Self { bytes, index })
    }

    /// Takes everything that `input` has, for example a file or standard input.
    ///
    /// # Errors
    /// As [`parse`](Self::parse), and [`ObjError::Io`].
    pub fn read(mut input: impl Read) -> Result<Self, ObjError> {
        let mut bytes = Vec::new();
        input.read_to_end(&mut bytes)?;
        bytes.shrink_to_fit();
        Self::parse(bytes)
    }
}

/// What the file holds.
impl ObjDocument {
    /// The file, byte by byte.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// How many vertices the file has, those included that no face uses.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.index.positions.len()
    }

    /// How many faces there are.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.index.face_start.len() - 1
    }

    /// How many face corners there are.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.index.corner_vertex.len()
    }

    /// Where each vertex is.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.index.positions
    }

    /// The `vt` lines of the file; NaN where one is not finite.
    #[must_use]
    pub fn texture_coordinates(&self) -> &[Vec2] {
        &self.index.texture_coordinates
    }

    /// The polygons, borrowed.
    #[must_use]
    pub fn view(&self) -> PolygonView<'_> {
        PolygonView {
            positions: &self.index.positions,
            face_start: &self.index.face_start,
            corner_vertex: &self.index.corner_vertex,
        }
    }

    /// The polygons, copied, as [`QuadMesh::build`](crate::QuadMesh::build) takes them.
    #[must_use]
    pub fn polygons(&self) -> Polygons {
        self.view().to_polygons()
    }
}

/// The UVs of the file.
impl ObjDocument {
    /// Which of [`texture_coordinates`](Self::texture_coordinates) `corner` names, if any.
    ///
    /// # Panics
    /// When there is no such corner.
    #[must_use]
    pub fn corner_texture(&self, corner: usize) -> Option<u32> {
        assert!(corner < self.corner_count(), "corner {corner} of {}", self.corner_count());
        self.index.corner_texture.get(corner).copied().filter(|&texture| texture != parse::NONE)
    }

    /// The UV of every corner; nothing when any corner lacks one. A UV that is not finite is lacking.
    #[must_use]
    pub fn corner_uv(&self) -> Option<Vec<Vec2>> {
        if self.index.corner_texture.is_empty() {
            return None;
        }
        (0..self.corner_count()).map(|corner| self.finite_uv(corner)).collect()
    }

    /// How many corners have a UV.
    #[must_use]
    pub fn corners_with_uv(&self) -> usize {
        if self.index.corner_texture.is_empty() {
            return 0;
        }
        (0..self.corner_count()).filter(|&corner| self.finite_uv(corner).is_some()).count()
    }

    fn finite_uv(&self, corner: usize) -> Option<Vec2> {
        let uv = self.index.texture_coordinates[self.corner_texture(corner)? as usize];
        uv.iter().all(|x| x.is_finite()).then_some(uv)
    }
}

/// Places in the file, for messages.
impl ObjDocument {
    /// The line of the `f` that gives face `face`, from 1; its first line when it is continued.
    ///
    /// # Panics
    /// When there is no such face.
    #[must_use]
    pub fn face_line(&self, face: usize) -> usize {
        assert!(face < self.face_count(), "face {face} of {}", self.face_count());
        self.index.face_lines.line(face as u32) as usize
    }

    /// The line of the `v` that gives vertex `vertex`, from 1; its first line when it is continued.
    ///
    /// # Panics
    /// When there is no such vertex.
    #[must_use]
    pub fn vertex_line(&self, vertex: usize) -> usize {
        assert!(vertex < self.vertex_count(), "vertex {vertex} of {}", self.vertex_count());
        self.index.vertex_lines.line(vertex as u32) as usize
    }

    /// The bytes of line `line` (from 1), without its line end. Searches from the start of the file.
    #[must_use]
    pub fn line(&self, line: usize) -> Option<&[u8]> {
        text::line(&self.bytes, line)
    }
}
