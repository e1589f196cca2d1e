//! From text to an index of what matters for meshes: positions, texture coordinates, faces and their lines.

use rayon::prelude::*;

use super::chunks::{CHUNK, chunks};
use super::error::ObjError;
use super::join::join;
use super::lines::LineRuns;
use super::reader::{Part, Reader};
use super::sniff::evidence_against;
use super::text::content_start;
use crate::{Vec2, Vec3};

/// "No texture coordinate" in [`Index::corner_texture`].
pub(super) const NONE: u32 = u32::MAX;
/// The same bound as for meshes.
const ELEMENT_LIMIT: usize = (u32::MAX / 2) as usize;

/// What a document knows about its text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Index {
    pub(super) positions: Vec<Vec3>,
    /// NaN where the file has a `vt` that is not finite.
    pub(super) texture_coordinates: Vec<Vec2>,
    pub(super) face_start: Vec<u32>,
    pub(super) corner_vertex: Vec<u32>,
    /// One entry per corner, or none at all when no corner of the file has a middle index.
    pub(super) corner_texture: Vec<u32>,
    pub(super) vertex_lines: LineRuns,
    pub(super) face_lines: LineRuns,
}

impl Index {
    pub(super) fn shrink_to_fit(&mut self) {
        self.positions.shrink_to_fit();
        self.texture_coordinates.shrink_to_fit();
        self.face_start.shrink_to_fit();
        self.corner_vertex.shrink_to_fit();
        self.corner_texture.shrink_to_fit();
        self.vertex_lines.shrink_to_fit();
        self.face_lines.shrink_to_fit();
    }
}

/// Reads a whole text.
pub(super) fn parse(text: &[u8]) -> Result<Index, ObjError> {
    let index = read(text, CHUNK, ELEMENT_LIMIT).map_err(|error| match evidence_against(text) {
        Some(evidence) if !matches!(error, ObjError::TooLarge { .. }) => ObjError::NotObj { evidence },
        _ => error,
    })?;
    if index.face_start.len() > 1 {
        return Ok(index);
    }
    Err(if text[content_start(text)..].iter().all(u8::is_ascii_whitespace) {
        ObjError::Empty
    } else if let Some(evidence) = evidence_against(text) {
        ObjError::NotObj { evidence }
    } else if index.positions.is_empty() {
        ObjError::NotObj { evidence: "it has neither `v` lines nor `f` lines" }
    } else {
        ObjError::NoFaces { vertices: index.positions.len() }
    })
}

/// Chunks are read in parallel. What is wrong with a text is said by one who has read all before it.
pub(super) fn read(text: &[u8], chunk: usize, limit: usize) -> Result<Index, ObjError> {
    read_parts(text, chunk, limit).map_or_else(|| Reader::new(text, limit).read(), Ok)
}

/// Nothing when there is but one chunk, or something wrong.
pub(super) fn read_parts(text: &[u8], chunk: usize, limit: usize) -> Option<Index> {
    let chunks = chunks(text, chunk);
    if chunks.len() < 2 {
        return None;
    }
    let part = |chunk| Reader::new(text, limit).read_part(chunk).ok();
    join(chunks.into_par_iter().map(part).collect::<Option<Vec<Part>>>()?, limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The limit of `u32` ids, tried with a smaller one.
    #[test]
    fn too_many_elements_are_refused_by_line() {
        let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        for (limit, expected) in [(3, Some("line 4: too large: more than 3 vertices")), (4, None)] {
            let message = Reader::new(text, limit).read().err().map(|error| error.to_string());
            assert_eq!(message.as_deref(), expected);
        }
        let more = [&text[..], b"f 1 2 3"].concat();
        let message = Reader::new(&more, 6).read().err().map(|error| error.to_string());
        assert_eq!(message.as_deref(), Some("line 6: too large: more than 6 face corners"));
    }
}
