//! From text to an index of what matters for meshes: positions, texture coordinates, faces and their lines.

use std::borrow::Cow;
use std::ops::Range;

use super::FACE_CORNER_LIMIT;
use super::corner::{Corner, CornerMistake, Corners};
use super::error::{ObjError, ObjMistakeKind};
use super::lines::LineRuns;
use super::sniff::evidence_against;
use super::text::{Keyword, Statement, Statements, Tokens, content_start};
use crate::{COORDINATE_LIMIT, Vec2, Vec3};

/// "No texture coordinate" in [`Index::corner_texture`].
pub(super) const NONE: u32 = u32::MAX;
/// The same bound as for meshes.
const ELEMENT_LIMIT: usize = (u32::MAX / 2) as usize;

/// What a document knows about its text.
#[derive(Clone, Debug, Default)]
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

/// Reads a whole text.
pub(super) fn parse(text: &[u8]) -> Result<Index, ObjError> {
    let index = Reader::new(text, ELEMENT_LIMIT).read().map_err(|error| match evidence_against(text) {
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

struct Reader<'a> {
    text: &'a [u8],
    limit: usize,
    index: Index,
    /// One more than the largest vertex that a corner names; it may be defined further down.
    vertices_named: usize,
    /// The same for texture coordinates.
    textures_named: usize,
}

impl<'a> Reader<'a> {
    fn new(text: &'a [u8], limit: usize) -> Self {
        let index = Index { face_start: vec![0], ..Index::default() };
        Self { text, limit, index, vertices_named: 0, textures_named: 0 }
    }

    fn read(mut self) -> Result<Index, ObjError> {
        for statement in Statements::new(self.text) {
            match statement.keyword {
                Keyword::Vertex => self.vertex(&statement)?,
                Keyword::Texture => self.texture(&statement)?,
                Keyword::Face => self.face(&statement)?,
                Keyword::Reference | Keyword::Numbers | Keyword::Other => {}
            }
        }
        if self.vertices_named > self.index.positions.len()
            || self.textures_named > self.index.texture_coordinates.len()
        {
            return Err(self.first_beyond_the_end());
        }
        let index = &mut self.index;
        index.positions.shrink_to_fit();
        index.texture_coordinates.shrink_to_fit();
        index.face_start.shrink_to_fit();
        index.corner_vertex.shrink_to_fit();
        index.corner_texture.shrink_to_fit();
        index.vertex_lines.shrink_to_fit();
        index.face_lines.shrink_to_fit();
        Ok(self.index)
    }

    fn vertex(&mut self, statement: &Statement) -> Result<(), ObjError> {
        self.check_room("vertices", self.index.positions.len(), statement)?;
        let mut words = Tokens::new(self.text, &statement.body);
        let mut position = Vec3::zeros();
        for coordinate in position.iter_mut() {
            let Some(rest) = words.peek() else {
                return Err(self.missing(words.position(), "x, y and z after `v`"));
            };
            *coordinate = match self.number(&rest, &mut words)? {
                Some(value) => value,
                None => return Err(self.not_finite(rest.start..words.position())),
            };
        }
        self.index.vertex_lines.push(self.index.positions.len() as u32, statement.line as u64);
        self.index.positions.push(position);
        Ok(())
    }

    /// `v` is 0 when it is left out, as in the format's one-dimensional textures.
    fn texture(&mut self, statement: &Statement) -> Result<(), ObjError> {
        self.check_room("texture coordinates", self.index.texture_coordinates.len(), statement)?;
        let mut words = Tokens::new(self.text, &statement.body);
        let mut uv = Vec2::zeros();
        for (i, coordinate) in uv.iter_mut().enumerate() {
            match words.peek() {
                Some(rest) => *coordinate = self.number(&rest, &mut words)?.unwrap_or(f64::NAN),
                None if i == 0 => return Err(self.missing(words.position(), "u and v after `vt`")),
                None => {}
            }
        }
        self.index.texture_coordinates.push(uv);
        Ok(())
    }

    fn face(&mut self, statement: &Statement) -> Result<(), ObjError> {
        let mut corners = Corners::new(self.text, statement);
        let mut count = 0;
        for corner in corners.by_ref() {
            let corner = corner.map_err(|CornerMistake { kind, at }| {
                let expected = match kind {
                    ObjMistakeKind::ZeroIndex => "1 for the first, or -1 for the last so far",
                    _ => "integers as in `v`, `v/vt`, `v//vn` or `v/vt/vn`",
                };
                ObjError::mistake(self.text, at, kind, expected)
            })?;
            self.check_room("face corners", self.index.corner_vertex.len(), statement)?;
            self.corner(&corner)?;
            count += 1;
            if count > FACE_CORNER_LIMIT {
                let (what, limit) = ("corners in one face", FACE_CORNER_LIMIT);
                return Err(ObjError::TooLarge { what, limit, line: statement.line });
            }
        }
        if count < 3 {
            let end = corners.position();
            let expected = format!("at least three corners after `f`, there are {count}");
            return Err(ObjError::mistake(self.text, end..end, ObjMistakeKind::TooFewCorners, expected));
        }
        self.index.face_lines.push(self.index.face_start.len() as u32 - 1, statement.line as u64);
        self.index.face_start.push(self.index.corner_vertex.len() as u32);
        Ok(())
    }

    fn corner(&mut self, corner: &Corner) -> Result<(), ObjError> {
        let index = &mut self.index;
        let vertex = resolve(corner.vertex, index.positions.len(), self.limit);
        let Some(vertex) = vertex else {
            return Err(self.out_of_range("vertices", corner.vertex, &corner.vertex_at));
        };
        self.vertices_named = self.vertices_named.max(vertex as usize + 1);
        let mut texture = NONE;
        if let Some(written) = corner.texture {
            let Some(found) = resolve(written, index.texture_coordinates.len(), self.limit) else {
                return Err(self.out_of_range("texture coordinates", written, &corner.texture_at));
            };
            self.textures_named = self.textures_named.max(found as usize + 1);
            texture = found;
            if index.corner_texture.is_empty() {
                index.corner_texture.resize(index.corner_vertex.len(), NONE);
            }
        }
        index.corner_vertex.push(vertex);
        if texture != NONE || !index.corner_texture.is_empty() {
            index.corner_texture.push(texture);
        }
        Ok(())
    }

    /// The coordinate at the start of `rest`; nothing when it is NaN, infinite or too large.
    #[inline]
    fn number(&self, rest: &Range<usize>, words: &mut Tokens<'_>) -> Result<Option<f64>, ObjError> {
        match fast_float2::parse_partial::<f64, _>(&self.text[rest.clone()]) {
            Ok((value, length)) if words.take_until(rest.start + length) => {
                Ok((value.abs() <= COORDINATE_LIMIT).then_some(value))
            }
            _ => self.odd_number(words),
        }
    }

    #[cold]
    fn odd_number(&self, words: &mut Tokens<'_>) -> Result<Option<f64>, ObjError> {
        let word = words.next().unwrap_or_default();
        let bytes = &self.text[word.clone()];
        if is_spelled_non_finite(bytes) {
            return Ok(None);
        }
        // A comment may follow without a space.
        if let Some(comment) = memchr::memchr(b'#', bytes)
            && let Ok(value) = fast_float2::parse::<f64, _>(&bytes[..comment])
        {
            words.stop_at(word.start + comment);
            return Ok((value.abs() <= COORDINATE_LIMIT).then_some(value));
        }
        let expected = if bytes.contains(&b',') {
            "a decimal point instead of the comma"
        } else {
            "a number such as -1.5e3"
        };
        Err(ObjError::mistake(self.text, word.clone(), ObjMistakeKind::NotANumber, expected))
    }

    fn not_finite(&self, word: Range<usize>) -> ObjError {
        let expected = format!("a number of at most {COORDINATE_LIMIT:e} either way");
        ObjError::mistake(self.text, word, ObjMistakeKind::NotFinite, expected)
    }

    fn missing(&self, at: usize, expected: &'static str) -> ObjError {
        ObjError::mistake(self.text, at..at, ObjMistakeKind::TooFewCoordinates, expected)
    }

    fn check_room(&self, what: &'static str, count: usize, statement: &Statement) -> Result<(), ObjError> {
        if count < self.limit {
            return Ok(());
        }
        Err(ObjError::TooLarge { what, limit: self.limit, line: statement.line })
    }

    /// The count that an out-of-range index is held against: for a negative one what came before it, else all.
    #[cold]
    fn out_of_range(&self, what: &str, written: i64, at: &Range<usize>) -> ObjError {
        let is_texture = what == "texture coordinates";
        let expected: Cow<'static, str> = if written < 0 {
            let index = &self.index;
            let count = if is_texture { index.texture_coordinates.len() } else { index.positions.len() };
            match count {
                0 => format!("no negative index, no {what} come before this line").into(),
                _ => format!("at most {count} back, as many {what} come before this line").into(),
            }
        } else {
            let keyword = if is_texture { Keyword::Texture } else { Keyword::Vertex };
            match Statements::new(self.text).filter(|s| s.keyword == keyword).count() {
                0 => format!("no index, the file has no {what}").into(),
                count => format!("1 to {count}, as many {what} as the file has").into(),
            }
        };
        ObjError::mistake(self.text, at.clone(), ObjMistakeKind::IndexOutOfRange, expected)
    }

    /// The first corner that names something which never came.
    #[cold]
    fn first_beyond_the_end(&self) -> ObjError {
        let vertices = self.index.positions.len() as i64;
        let textures = self.index.texture_coordinates.len() as i64;
        for statement in Statements::new(self.text).filter(|s| s.keyword == Keyword::Face) {
            for corner in Corners::new(self.text, &statement).flatten() {
                if corner.vertex > vertices {
                    return self.out_of_range("vertices", corner.vertex, &corner.vertex_at);
                }
                match corner.texture {
                    Some(written) if written > textures => {
                        return self.out_of_range("texture coordinates", written, &corner.texture_at);
                    }
                    _ => {}
                }
            }
        }
        unreachable!("a corner named an element beyond the last")
    }
}

/// The element, from 0, that an index names when `count` of its kind came before. It may still have to come.
#[inline]
fn resolve(written: i64, count: usize, limit: usize) -> Option<u32> {
    let index = if written < 0 { count as i64 + written } else { written - 1 };
    (0..limit as i64).contains(&index).then_some(index as u32)
}

/// The ways in which C libraries print what is no finite number, of which `nan` and `inf` are read as numbers.
fn is_spelled_non_finite(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let starts = |start: &[u8]| word.get(..start.len()).is_some_and(|w| w.eq_ignore_ascii_case(start));
    starts(b"nan(") || starts(b"1.#")
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
