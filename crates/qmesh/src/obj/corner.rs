//! The corners of an `f` statement: `v`, `v/vt`, `v//vn` or `v/vt/vn`, and the bytes where `vt` belongs.

use std::ops::Range;

use super::error::ObjMistakeKind;
use super::text::{Statement, Tokens};

/// One corner as it is written; indices count from 1, or back from -1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) vertex: i64,
    pub(super) vertex_at: Range<usize>,
    /// The middle index, unless it is left out.
    pub(super) texture: Option<i64>,
    /// Where the middle index stands, or would stand.
    pub(super) texture_at: Range<usize>,
    /// Whether a middle index needs a slash of its own, because the corner has none.
    pub(super) needs_slash: bool,
}

/// What is wrong with a corner, and which bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CornerMistake {
    pub(super) kind: ObjMistakeKind,
    pub(super) at: Range<usize>,
}

/// Goes through the corners of a statement, in order.
pub(super) struct Corners<'a> {
    text: &'a [u8],
    tokens: Tokens<'a>,
}

impl<'a> Corners<'a> {
    pub(super) fn new(text: &'a [u8], statement: &Statement) -> Self {
        Self { text, tokens: Tokens::new(text, &statement.body) }
    }

    /// Where the last corner ends.
    pub(super) fn position(&self) -> usize {
        self.tokens.position()
    }
}

impl Iterator for Corners<'_> {
    type Item = Result<Corner, CornerMistake>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.tokens.peek()?;
        let mut scan = Scan { text: self.text, position: rest.start, end: rest.end };
        match scan.corner() {
            Ok(corner) if self.tokens.take_until(scan.position) => Some(Ok(corner)),
            corner => self.odd_corner(corner, scan.position),
        }
    }
}

impl Corners<'_> {
    /// Nothing but a comment may touch a corner that has been read up to `position`.
    #[cold]
    fn odd_corner(
        &mut self,
        corner: Result<Corner, Fault>,
        position: usize,
    ) -> Option<Result<Corner, CornerMistake>> {
        // A comment may follow without a space: `f 1 2 3#last`.
        if corner.is_ok() && self.text[position] == b'#' {
            self.tokens.stop_at(position);
            return corner.ok().map(Ok);
        }
        let mut at = self.tokens.next()?;
        if let Some(comment) = memchr::memchr(b'#', &self.text[at.clone()]) {
            at.end = at.start + comment;
        }
        let kind = match corner {
            Ok(_) if self.text[position] == b'/' => ObjMistakeKind::TooManySlashes,
            Ok(_) | Err(Fault::NotAnIndex) => ObjMistakeKind::NotAnIndex,
            Err(Fault::Zero(zero)) => {
                at = zero;
                ObjMistakeKind::ZeroIndex
            }
        };
        Some(Err(CornerMistake { kind, at }))
    }
}

/// Why reading a corner stopped.
enum Fault {
    NotAnIndex,
    Zero(Range<usize>),
}

/// Reads one corner from left to right.
struct Scan<'a> {
    text: &'a [u8],
    position: usize,
    end: usize,
}

impl Scan<'_> {
    #[inline]
    fn corner(&mut self) -> Result<Corner, Fault> {
        let start = self.position;
        let vertex = self.integer().ok_or(Fault::NotAnIndex)?;
        let vertex_at = start..self.position;
        let needs_slash = !self.slash();
        let texture_start = self.position;
        let mut texture = None;
        let mut texture_at = texture_start..texture_start;
        if !needs_slash {
            texture = self.integer();
            texture_at.end = self.position;
            if self.slash() {
                // The normal is none of our business, as long as it is a number or nothing.
                self.integer();
            }
        }
        if vertex == 0 || texture == Some(0) {
            return Err(Fault::Zero(if vertex == 0 { vertex_at } else { texture_at }));
        }
        Ok(Corner { vertex, vertex_at, texture, texture_at, needs_slash })
    }

    fn slash(&mut self) -> bool {
        let found = self.position < self.end && self.text[self.position] == b'/';
        self.position += usize::from(found);
        found
    }

    /// An integer with or without a sign; beyond the range of `i64` it stays at the end of that range.
    #[inline]
    fn integer(&mut self) -> Option<i64> {
        let text = &self.text[self.position..self.end];
        let signed = matches!(text.first(), Some(b'-' | b'+'));
        let digits = &text[usize::from(signed)..];
        let mut value = 0i64;
        let mut length = 0;
        for byte in digits {
            let digit = byte.wrapping_sub(b'0');
            if digit > 9 {
                break;
            }
            value = value.saturating_mul(10).saturating_add(i64::from(digit));
            length += 1;
        }
        if length == 0 {
            return None;
        }
        self.position += usize::from(signed) + length;
        Some(if signed && text[0] == b'-' { -value } else { value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj::text::Statements;

    fn corners(line: &str) -> Vec<Result<Corner, CornerMistake>> {
        let statement = Statements::new(line.as_bytes()).next().expect("a statement");
        Corners::new(line.as_bytes(), &statement).collect()
    }

    /// Writing `9` where the middle index belongs gives the corner with that index, in all its forms.
    #[test]
    fn the_middle_index_has_one_place() {
        for (corner, with_nine) in [
            ("1", "1/9"),
            ("-1", "-1/9"),
            ("1/", "1/9"),
            ("1/5", "1/9"),
            ("1/-5", "1/9"),
            ("1//", "1/9/"),
            ("1//3", "1/9/3"),
            ("1/5/", "1/9/"),
            ("1/55/-3", "1/9/-3"),
        ] {
            let line = format!("f {corner} # 7/7");
            let Ok(found) = &corners(&line)[0] else { panic!("{corner} was refused") };
            let slash = if found.needs_slash { "/" } else { "" };
            let edited =
                format!("{}{slash}9{}", &line[..found.texture_at.start], &line[found.texture_at.end..]);
            assert_eq!(edited, format!("f {with_nine} # 7/7"));
        }
    }

    #[test]
    fn integers_never_wrap() {
        let line = "f 4294967297 18446744073709551617 -99999999999999999999999999";
        let found: Vec<i64> = corners(line).into_iter().map(|c| c.expect("an integer").vertex).collect();
        assert_eq!(found, [4_294_967_297, i64::MAX, -i64::MAX]);
    }

    #[test]
    fn mistakes_name_their_bytes() {
        for (corner, kind) in [
            ("1.5", ObjMistakeKind::NotAnIndex),
            ("/1", ObjMistakeKind::NotAnIndex),
            ("--1", ObjMistakeKind::NotAnIndex),
            ("-", ObjMistakeKind::NotAnIndex),
            ("1/x", ObjMistakeKind::NotAnIndex),
            ("1/2/3x", ObjMistakeKind::NotAnIndex),
            ("1///2", ObjMistakeKind::TooManySlashes),
            ("1/2/3/4", ObjMistakeKind::TooManySlashes),
            ("0", ObjMistakeKind::ZeroIndex),
            ("-00", ObjMistakeKind::ZeroIndex),
            ("1\\2", ObjMistakeKind::NotAnIndex),
        ] {
            let found = corners(&format!("f 1 {corner}"));
            assert_eq!(found[1], Err(CornerMistake { kind, at: 4..4 + corner.len() }), "{corner}");
        }
    }

    #[test]
    fn a_comment_may_touch_the_last_corner() {
        assert_eq!(corners("f 1 2 3#4 5").len(), 3);
        assert!(corners("f 1 2 3/#4 5").iter().all(Result::is_ok));
    }
}
