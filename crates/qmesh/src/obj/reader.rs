//! From statements to an index of what matters for meshes; what is wrong is said with its place.

use std::borrow::Cow;
use std::ops::Range;

use super::FACE_CORNER_LIMIT;
use super::corner::{Corner, CornerMistake, Corners};
use super::error::{ObjError, ObjMistakeKind};
use super::parse::{Index, NONE};
use super::text::{Keyword, Statement, Statements, Tokens};
use crate::{COORDINATE_LIMIT, Vec2, Vec3};

/// What a part of a text says.
#[derive(Default)]
pub(super) struct Part {
    /// Lines, faces and corners counted from the start of the part.
    pub(super) index: Index,
    /// The corners whose vertex counts back: `index` has how far behind the start of the part it is, as `i32`.
    pub(super) backward_vertices: Vec<u32>,
    /// The same for texture coordinates.
    pub(super) backward_textures: Vec<u32>,
    /// One more than the largest vertex that a corner names; it may be defined further down.
    pub(super) vertices_named: usize,
    /// The same for texture coordinates.
    pub(super) textures_named: usize,
    /// How many lines the part has.
    pub(super) lines: usize,
}

/// Reads statements, from the start of a text or of a part of it.
pub(super) struct Reader<'a> {
    text: &'a [u8],
    limit: usize,
    /// Whether something may have come before.
    is_part: bool,
    part: Part,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a [u8], limit: usize) -> Self {
        let index = Index { face_start: vec![0], ..Index::default() };
        Self { text, limit, is_part: false, part: Part { index, ..Part::default() } }
    }

    /// The whole text.
    pub(super) fn read(mut self) -> Result<Index, ObjError> {
        self.statements(0..self.text.len())?;
        let part = &mut self.part;
        if part.vertices_named > part.index.positions.len()
            || part.textures_named > part.index.texture_coordinates.len()
        {
            return Err(self.first_beyond_the_end());
        }
        part.index.shrink_to_fit();
        Ok(self.part.index)
    }

    /// One chunk of the text.
    pub(super) fn read_part(mut self, chunk: Range<usize>) -> Result<Part, ObjError> {
        self.is_part = true;
        self.statements(chunk)?;
        Ok(self.part)
    }

    fn statements(&mut self, chunk: Range<usize>) -> Result<(), ObjError> {
        let mut statements = Statements::within(self.text, chunk);
        for statement in statements.by_ref() {
            match statement.keyword {
                Keyword::Vertex => self.vertex(&statement)?,
                Keyword::Texture => self.texture(&statement)?,
                Keyword::Face => self.face(&statement)?,
                Keyword::Reference | Keyword::Numbers | Keyword::Other => {}
            }
        }
        self.part.lines = statements.lines();
        Ok(())
    }

    fn vertex(&mut self, statement: &Statement) -> Result<(), ObjError> {
        self.check_room("vertices", self.part.index.positions.len(), statement)?;
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
        self.part.index.vertex_lines.push(self.part.index.positions.len() as u32, statement.line as u64);
        self.part.index.positions.push(position);
        Ok(())
    }

    /// `v` is 0 when it is left out, as in the format's one-dimensional textures.
    fn texture(&mut self, statement: &Statement) -> Result<(), ObjError> {
        self.check_room("texture coordinates", self.part.index.texture_coordinates.len(), statement)?;
        let mut words = Tokens::new(self.text, &statement.body);
        let mut uv = Vec2::zeros();
        for (i, coordinate) in uv.iter_mut().enumerate() {
            match words.peek() {
                Some(rest) => *coordinate = self.number(&rest, &mut words)?.unwrap_or(f64::NAN),
                None if i == 0 => return Err(self.missing(words.position(), "u and v after `vt`")),
                None => {}
            }
        }
        self.part.index.texture_coordinates.push(uv);
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
            self.check_room("face corners", self.part.index.corner_vertex.len(), statement)?;
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
        self.part.index.face_lines.push(self.part.index.face_start.len() as u32 - 1, statement.line as u64);
        self.part.index.face_start.push(self.part.index.corner_vertex.len() as u32);
        Ok(())
    }

    fn corner(&mut self, corner: &Corner) -> Result<(), ObjError> {
        let place = self.part.index.corner_vertex.len() as u32;
        let count = self.part.index.positions.len();
        let Some(vertex) = self.resolve(corner.vertex, count) else {
            return Err(self.out_of_range("vertices", corner.vertex, &corner.vertex_at));
        };
        match vertex {
            Named::Here(vertex) => {
                self.part.vertices_named = self.part.vertices_named.max(vertex as usize + 1);
            }
            Named::Back(_) => self.part.backward_vertices.push(place),
        }
        if let Some(written) = corner.texture {
            let Some(found) = self.resolve(written, self.part.index.texture_coordinates.len()) else {
                return Err(self.out_of_range("texture coordinates", written, &corner.texture_at));
            };
            match found {
                Named::Here(found) => {
                    self.part.textures_named = self.part.textures_named.max(found as usize + 1);
                }
                Named::Back(_) => self.part.backward_textures.push(place),
            }
            if self.part.index.corner_texture.is_empty() {
                self.part.index.corner_texture.resize(place as usize, NONE);
            }
            self.part.index.corner_texture.push(found.bits());
        } else if !self.part.index.corner_texture.is_empty() {
            self.part.index.corner_texture.push(NONE);
        }
        self.part.index.corner_vertex.push(vertex.bits());
        Ok(())
    }

    /// The element, from 0, that an index names when `count` of its kind came before. It may still have to come.
    #[inline]
    fn resolve(&self, written: i64, count: usize) -> Option<Named> {
        if written < 0 && self.is_part {
            return i32::try_from(count as i64 + written).ok().map(Named::Back);
        }
        let index = if written < 0 { count as i64 + written } else { written - 1 };
        (0..self.limit as i64).contains(&index).then_some(Named::Here(index as u32))
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
            let index = &self.part.index;
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
        let vertices = self.part.index.positions.len() as i64;
        let textures = self.part.index.texture_coordinates.len() as i64;
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

/// An element that a corner names.
#[derive(Clone, Copy)]
enum Named {
    /// From the start of the text.
    Here(u32),
    /// From the start of the part; negative when it comes before.
    Back(i32),
}

impl Named {
    fn bits(self) -> u32 {
        match self {
            Self::Here(index) => index,
            Self::Back(index) => index as u32,
        }
    }
}

/// The ways in which C libraries print what is no finite number, of which `nan` and `inf` are read as numbers.
fn is_spelled_non_finite(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let starts = |start: &[u8]| word.get(..start.len()).is_some_and(|w| w.eq_ignore_ascii_case(start));
    starts(b"nan(") || starts(b"1.#")
}
