//! Lines, statements and tokens of OBJ text, as byte ranges; nothing is copied or changed.
//!
//! A line ends with LF, CR LF or a lone CR. A statement is one line, or several when each but the last ends with a
//! backslash. Only statements made of numbers may be continued: a comment or a name that happens to end with a
//! backslash (`usemtl C:\`) must not swallow the line after it.

use std::ops::Range;

use memchr::{memchr, memchr2};

const BOM: &[u8] = b"\xef\xbb\xbf";

/// What a statement is about, as far as meshes and their UVs are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyword {
    /// `v`
    Vertex,
    /// `vt`
    Texture,
    /// `f`, or its older name `fo`
    Face,
    /// `l`, `surf`: not faces, but they may name texture coordinates.
    Reference,
    /// Other statements made of numbers.
    Numbers,
    /// Everything else: comments, names, blank lines, what we do not know.
    Other,
}

/// One statement. All offsets count bytes from the start of the text.
#[derive(Clone, Debug)]
pub(super) struct Statement {
    pub(super) keyword: Keyword,
    /// From the start of its first line to the start of the line after it.
    pub(super) span: Range<usize>,
    /// What follows the keyword, without the last line end.
    pub(super) body: Range<usize>,
    /// The number of its first line, from 1.
    pub(super) line: usize,
}

/// All statements in order; together they cover the text, but for a byte order mark.
#[derive(Clone)]
pub(super) struct Statements<'a> {
    text: &'a [u8],
    position: usize,
    end: usize,
    line: usize,
}

impl<'a> Statements<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self::within(text, 0..text.len())
    }

    /// The statements of a chunk, as [`chunks`](super::chunks::chunks) cuts it; lines are counted from its start.
    pub(super) fn within(text: &'a [u8], chunk: Range<usize>) -> Self {
        Self { text, position: chunk.start.max(content_start(text)), end: chunk.end, line: 1 }
    }

    /// How many lines have been passed.
    pub(super) fn lines(&self) -> usize {
        self.line - 1
    }
}

impl Iterator for Statements<'_> {
    type Item = Statement;

    fn next(&mut self) -> Option<Statement> {
        if self.position >= self.end {
            return None;
        }
        let (start, line) = (self.position, self.line);
        let word = start + blank_prefix(&self.text[start..]);
        let (keyword, body) = keyword_at(self.text, word);
        let (mut end, mut after) = line_end(self.text, body);
        self.line += 1;
        if keyword != Keyword::Other {
            let mut from = start;
            while after > end && is_continued(&self.text[from..end]) {
                from = after;
                (end, after) = line_end(self.text, from);
                self.line += 1;
            }
        }
        self.position = after;
        Some(Statement { keyword, span: start..after, body: body..end, line })
    }
}

/// Where the text starts: after the byte order mark, if there is one.
pub(super) fn content_start(text: &[u8]) -> usize {
    if text.starts_with(BOM) { BOM.len() } else { 0 }
}

/// Where the line that holds `from` ends: before its line end, and after it.
pub(super) fn line_end(text: &[u8], from: usize) -> (usize, usize) {
    match memchr2(b'\n', b'\r', &text[from..]) {
        None => (text.len(), text.len()),
        Some(length) => {
            let end = from + length;
            let is_pair = text[end] == b'\r' && text.get(end + 1) == Some(&b'\n');
            (end, end + 1 + usize::from(is_pair))
        }
    }
}

/// The line end for new lines: that of the first line, or LF. A lone CR is used only where every line ends so:
/// before an LF it would become half of a CR LF.
pub(super) fn usual_line_end(text: &[u8]) -> &[u8] {
    let (end, after) = line_end(text, 0);
    match &text[end..after] {
        b"\r" if memchr(b'\n', text).is_none() => b"\r",
        b"\r\n" => b"\r\n",
        _ => b"\n",
    }
}

/// Line and column, both from 1 and in bytes, of a place in the text, and the bytes of that line.
pub(super) fn locate(text: &[u8], offset: usize) -> (usize, usize, &[u8]) {
    let (mut start, mut line) = (content_start(text), 1);
    loop {
        let (end, after) = line_end(text, start);
        if offset < after || after == text.len() {
            return (line, offset.saturating_sub(start) + 1, &text[start..end]);
        }
        start = after;
        line += 1;
    }
}

/// The bytes of line `line`, from 1, without its line end.
pub(super) fn line(text: &[u8], line: usize) -> Option<&[u8]> {
    let mut start = content_start(text);
    for _ in 1..line {
        start = line_end(text, start).1;
        if start == text.len() {
            return None;
        }
    }
    (line > 0).then(|| &text[start..line_end(text, start).0])
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\x0b' | b'\x0c')
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

fn blank_prefix(text: &[u8]) -> usize {
    text.iter().position(|&byte| !is_blank(byte)).unwrap_or(text.len())
}

/// The keyword that starts at `word`, and where it ends.
fn keyword_at(text: &[u8], word: usize) -> (Keyword, usize) {
    // Nearly all lines of a mesh are of these two kinds.
    match text[word..] {
        [b'v', b' ', ..] => return (Keyword::Vertex, word + 1),
        [b'f', b' ', ..] => return (Keyword::Face, word + 1),
        _ => {}
    }
    const LONGEST: usize = 6;
    let rest = &text[word..text.len().min(word + LONGEST + 1)];
    let ends = |&byte: &u8| is_blank(byte) || is_line_end(byte) || byte == b'\\';
    let length = rest.iter().position(ends).unwrap_or(rest.len());
    let keyword = match &rest[..length] {
        b"v" => Keyword::Vertex,
        b"vt" => Keyword::Texture,
        b"f" | b"fo" => Keyword::Face,
        b"l" | b"surf" => Keyword::Reference,
        b"vn" | b"vp" | b"p" | b"curv" | b"curv2" | b"parm" | b"trim" | b"hole" | b"scrv" => Keyword::Numbers,
        _ => Keyword::Other,
    };
    (keyword, word + length)
}

/// Whether a line goes on in the next. A comment never does.
fn is_continued(line: &[u8]) -> bool {
    line.last() == Some(&b'\\') && memchr(b'#', line).is_none()
}

/// Whether the text stops where a last line was to be continued: what is appended would belong to that line.
pub(super) fn is_left_open(text: &[u8]) -> bool {
    let bare = text.strip_suffix(b"\n").unwrap_or(text);
    let bare = bare.strip_suffix(b"\r").unwrap_or(bare);
    bare.last() == Some(&b'\\')
}

/// The words of a statement, as byte ranges; a comment ends them.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    text: &'a [u8],
    position: usize,
    end: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a [u8], body: &Range<usize>) -> Self {
        Self { text, position: body.start, end: body.end }
    }

    /// Where the next search starts: after the last word.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// Takes what follows `position` as a comment.
    pub(super) fn stop_at(&mut self, position: usize) {
        self.position = position;
        self.end = position;
    }

    /// Where the next word starts, and what is left of the statement from there.
    #[inline]
    pub(super) fn peek(&mut self) -> Option<Range<usize>> {
        while self.position < self.end && self.is_separator(self.position) {
            self.position += 1;
        }
        if self.position == self.end || self.text[self.position] == b'#' {
            self.stop_at(self.position);
            return None;
        }
        Some(self.position..self.end)
    }

    /// Takes the next word to end at `position`, if a word can end there. Parsers that know where theirs ends
    /// are spared a second look at every byte.
    #[inline]
    pub(super) fn take_until(&mut self, position: usize) -> bool {
        let ends = position == self.end || self.is_separator(position);
        if ends {
            self.position = position;
        }
        ends
    }

    /// Whether a word ends at `position`.
    #[inline]
    fn is_separator(&self, position: usize) -> bool {
        match self.text[position] {
            b' ' | b'\t' | b'\n' | b'\r' | b'\x0b' | b'\x0c' => true,
            b'\\' => position + 1 == self.end || is_line_end(self.text[position + 1]),
            _ => false,
        }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Range<usize>> {
        let start = self.peek()?.start;
        let mut end = start + 1;
        while !self.take_until(end) {
            end += 1;
        }
        Some(start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Line<'a> = (Keyword, usize, &'a [u8], Vec<&'a [u8]>);

    fn lines(text: &[u8]) -> Vec<Line<'_>> {
        Statements::new(text)
            .map(|s| {
                let words = Tokens::new(text, &s.body).map(|range| &text[range]).collect();
                (s.keyword, s.line, &text[s.span], words)
            })
            .collect()
    }

    /// Whatever the bytes are, the statements put together are the text.
    #[test]
    fn statements_cover_the_text() {
        for text in
            [&b"v 1\r\n\r\nf\rfo 1 2\\\r\n3\n\nvt"[..], b"\\\n\\", b"f \\", b"v\\\n#\\\nf", b"\xef\xbb\xbfv"]
        {
            let joined: Vec<u8> = Statements::new(text).flat_map(|s| text[s.span].to_vec()).collect();
            assert_eq!(joined, text[content_start(text)..]);
        }
    }

    #[test]
    fn numbers_are_continued_and_names_are_not() {
        let text = b"f 1 2\\\n 3 # end \\\nusemtl C:\\\nv 1 \\\r2\\\r\n3\nl";
        assert_eq!(
            lines(text),
            [
                (Keyword::Face, 1, &b"f 1 2\\\n 3 # end \\\n"[..], vec![&b"1"[..], b"2", b"3"]),
                (Keyword::Other, 3, b"usemtl C:\\\n", vec![b"C:"]),
                (Keyword::Vertex, 4, b"v 1 \\\r2\\\r\n3\n", vec![b"1", b"2", b"3"]),
                (Keyword::Reference, 7, b"l", vec![]),
            ]
        );
    }

    #[test]
    fn places_are_counted_in_bytes_from_one() {
        let text = b"\xef\xbb\xbfab\r\ncd\re\n";
        let found = [3, 4, 7, 8, 10, 12].map(|offset| {
            let (line, column, _) = locate(text, offset);
            (line, column)
        });
        assert_eq!(found, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 3)]);
    }
}
