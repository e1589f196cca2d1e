//! Why bytes are no OBJ mesh: where, what was found, and what would have been right.

use std::borrow::Cow;
use std::fmt;
use std::io;

use thiserror::Error;

use super::text::locate;

/// The longest piece of a file that an error quotes, in characters.
pub const EXCERPT_LIMIT: usize = 40;
/// How many bytes of its line an error keeps at most.
const SOURCE_LIMIT: usize = 160;

/// Why bytes cannot be read as an OBJ mesh.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The bytes could not be had at all.
    #[error("the file cannot be read: {0}")]
    Io(#[from] io::Error),
    /// There is nothing in the file.
    #[error("the file is empty: an OBJ needs `v` lines and `f` lines")]
    Empty,
    /// The file is something else.
    #[error("this does not look like an OBJ: {evidence}")]
    NotObj {
        /// What speaks against it.
        evidence: &'static str,
    },
    /// The file has no face.
    #[error("there are no faces: the file has {vertices} vertices, but no `f` line")]
    NoFaces {
        /// How many vertices it has.
        vertices: usize,
    },
    /// More elements than `u32` ids can count.
    #[error("line {line}: too large: more than {limit} {what}")]
    TooLarge {
        /// What there are too many of.
        what: &'static str,
        /// How many are possible.
        limit: usize,
        /// The line that has the first too many, from 1.
        line: usize,
    },
    /// A statement that cannot be read.
    #[error(transparent)]
    Mistake(Box<ObjMistake>),
}

/// A statement that cannot be read: the place, what stands there, and what should.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub struct ObjMistake {
    /// The line, from 1. LF, CR LF and a lone CR each end a line.
    pub line: usize,
    /// The column in that line, from 1, in bytes. A byte order mark does not count.
    pub column: usize,
    /// How many bytes are wrong; 0 when something is missing at that place.
    pub length: usize,
    /// What is wrong with them.
    pub kind: ObjMistakeKind,
    /// The wrong bytes as text, at most [`EXCERPT_LIMIT`] characters; empty when something is missing.
    pub found: String,
    /// What would have been right.
    pub expected: Cow<'static, str>,
    /// The line as text, or the part of it around the mistake when it is long.
    pub source_line: String,
    /// How many characters of [`source_line`](Self::source_line) come before the mistake.
    pub source_column: usize,
}

/// What can be wrong in a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum ObjMistakeKind {
    /// A coordinate that is not a number.
    NotANumber,
    /// A coordinate that is NaN, infinite, or beyond [`COORDINATE_LIMIT`](crate::COORDINATE_LIMIT).
    NotFinite,
    /// A `v` with fewer than three coordinates, or a `vt` with none.
    TooFewCoordinates,
    /// A face with fewer than three corners.
    TooFewCorners,
    /// A face corner that is not made of integers.
    NotAnIndex,
    /// A face corner with more than two slashes.
    TooManySlashes,
    /// Index 0: OBJ counts from 1.
    ZeroIndex,
    /// An index beyond the last element, or a negative one that counts back past the first.
    IndexOutOfRange,
}

impl ObjError {
    pub(super) fn mistake(
        text: &[u8],
        at: std::ops::Range<usize>,
        kind: ObjMistakeKind,
        expected: impl Into<Cow<'static, str>>,
    ) -> Self {
        let (line, column, source) = locate(text, at.start);
        let before = column.saturating_sub(1).min(source.len());
        let first = before.saturating_sub(SOURCE_LIMIT / 2);
        let last = source.len().min(first + SOURCE_LIMIT);
        Self::Mistake(Box::new(ObjMistake {
            line,
            column,
            length: at.len(),
            kind,
            found: excerpt(&text[at]),
            expected: expected.into(),
            source_line: printable(String::from_utf8_lossy(&source[first..last]).chars()),
            source_column: String::from_utf8_lossy(&source[first..before]).chars().count(),
        }))
    }
}

impl std::error::Error for ObjMistake {}

impl fmt::Display for ObjMistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, kind, found, expected, .. } = self;
        write!(f, "line {line}, column {column}: ")?;
        match kind {
            ObjMistakeKind::NotANumber => write!(f, "`{found}` is not a number")?,
            ObjMistakeKind::NotFinite => write!(f, "`{found}` is not a finite coordinate")?,
            ObjMistakeKind::TooFewCoordinates => f.write_str("too few coordinates")?,
            ObjMistakeKind::TooFewCorners => f.write_str("too few corners")?,
            ObjMistakeKind::NotAnIndex => write!(f, "`{found}` is not an index")?,
            ObjMistakeKind::TooManySlashes => write!(f, "`{found}` has too many slashes")?,
            ObjMistakeKind::ZeroIndex => write!(f, "index `{found}`, but OBJ counts from 1")?,
            ObjMistakeKind::IndexOutOfRange => write!(f, "index `{found}` is out of range")?,
        }
        write!(f, "; expected {expected}")
    }
}

/// Bytes as text that fits on a line.
fn excerpt(bytes: &[u8]) -> String {
    // Four bytes a character at most: what lies beyond is not shown, so it need not be decoded.
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(4 * (EXCERPT_LIMIT + 1))]);
    let mut shown = printable(text.chars().take(EXCERPT_LIMIT));
    if text.chars().count() > EXCERPT_LIMIT {
        shown.push('…');
    }
    shown
}

/// One character for each, none of which would upset a terminal.
fn printable(text: impl Iterator<Item = char>) -> String {
    text.map(|c| match c {
        '\t' => ' ',
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    })
    .collect()
}
