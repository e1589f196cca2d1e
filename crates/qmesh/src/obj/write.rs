//! The same text with other UVs: every byte is copied but `vt` lines and the middle indices of face corners.

use std::io::{self, Write};
use std::ops::Range;

use super::ObjDocument;
use super::corner::Corners;
use super::output::Output;
use super::text;
use super::text::{Keyword, Statement, Statements, Tokens, usual_line_end};
use super::texture::{TextureTable, UvFormat};
use crate::Vec2;

/// What writing UVs did to the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub struct UvWriteSummary {
    /// New `vt` lines: one for each distinct pair of vertex and value.
    pub written: usize,
    /// Old `vt` lines that are gone.
    pub removed: usize,
    /// Old `vt` lines that stay, because lines other than faces refer to them.
    pub kept: usize,
    /// Vertices with more than one UV: those on seams.
    pub split_vertices: usize,
}

impl ObjDocument {
    /// Writes the text with these UVs, one per corner in file order, and everything else as it was.
    ///
    /// Old `vt` lines go; the new ones stand in the place of the first of them, or before the first face if that
    /// comes earlier. There is one for each distinct pair of vertex and value, ordered by vertex, so that without
    /// seams `vt` and `v` have the same numbers. When other lines (`l`, `surf`) name texture coordinates, the old
    /// `vt` lines stay and the new ones follow them. New lines end as the first line of the file does.
    ///
    /// ```
    /// use qmesh::{Vec2, obj::ObjDocument};
    ///
    /// let text = b"v 0 0 0 # corner\nv 2 0 0\nv 2 2 0\ng \xff\nf 1// -2 3\n".to_vec();
    /// let document = ObjDocument::parse(text)?;
    /// let mut out = Vec::new();
    /// document.write_with_uv(&mut out, &[Vec2::new(0.0, 0.0), Vec2::new(0.5, 0.0), Vec2::new(0.5, 1.0)])?;
    /// let expected = b"v 0 0 0 # corner\nv 2 0 0\nv 2 2 0\ng \xff\nvt 0.0 0.0\nvt 0.5 0.0\nvt 0.5 1.0\nf 1/1/ -2/2 3/3\n";
    /// assert_eq!(out, expected);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// What `out` reports, and `InvalidInput` when there is not one finite UV per corner; then nothing is written.
    pub fn write_with_uv(&self, out: &mut impl Write, corner_uv: &[Vec2]) -> io::Result<UvWriteSummary> {
        self.write_with_uv_as(out, corner_uv, UvFormat::default())
    }

    /// As [`write_with_uv`](Self::write_with_uv), with a choice of digits.
    ///
    /// # Errors
    /// As [`write_with_uv`](Self::write_with_uv).
    pub fn write_with_uv_as(
        &self,
        out: &mut impl Write,
        corner_uv: &[Vec2],
        format: UvFormat,
    ) -> io::Result<UvWriteSummary> {
        let view = self.view();
        let table = TextureTable::new(view.positions.len(), view.corner_vertex, corner_uv, format)?;
        let plan = Plan::new(self.bytes());
        let old = self.texture_coordinates().len();
        let summary = UvWriteSummary {
            written: table.values.len(),
            removed: if plan.keeps_old { 0 } else { old },
            kept: if plan.keeps_old { old } else { 0 },
            split_vertices: table.split_vertices,
        };
        let mut editor = Editor {
            text: self.bytes(),
            copied: 0,
            out: Output::new(out),
            first_index: summary.kept + 1,
            table,
            corner: 0,
        };
        editor.run(&plan, format)?;
        editor.out.flush()?;
        Ok(summary)
    }
}

/// What to do with old `vt` lines, and where the new ones go.
struct Plan {
    keeps_old: bool,
    insert_at: usize,
}

impl Plan {
    fn new(text: &[u8]) -> Self {
        let mut first_place = None;
        let mut last_needed = 0;
        let (mut has_old, mut is_referenced) = (false, false);
        for statement in Statements::new(text) {
            match statement.keyword {
                Keyword::Texture => {
                    first_place.get_or_insert(statement.span.start);
                    last_needed = statement.span.end;
                    has_old = true;
                }
                Keyword::Face => {
                    first_place.get_or_insert(statement.span.start);
                }
                Keyword::Reference => {
                    let named = texture_reference(text, &statement);
                    is_referenced |= named.is_some();
                    // A negative index counts from where it stands: nothing may come between.
                    if named == Some(Sign::Negative) {
                        last_needed = statement.span.end;
                    }
                }
                Keyword::Vertex | Keyword::Numbers | Keyword::Other => {}
            }
        }
        let keeps_old = has_old && is_referenced;
        let insert_at = if keeps_old { last_needed } else { first_place.unwrap_or(text.len()) };
        Self { keeps_old, insert_at }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Positive,
    Negative,
}

/// Whether a line or surface names texture coordinates, and whether any of them counts backwards.
fn texture_reference(text: &[u8], statement: &Statement) -> Option<Sign> {
    let mut found = None;
    for token in Tokens::new(text, &statement.body) {
        let middle = text[token].split(|&b| b == b'/').nth(1).unwrap_or_default();
        match middle.first() {
            None => {}
            Some(b'-') => return Some(Sign::Negative),
            Some(_) => found = Some(Sign::Positive),
        }
    }
    found
}

/// Copies the text up to each place that changes, and writes what belongs there.
struct Editor<'a, W: Write> {
    text: &'a [u8],
    /// How much of the text has been copied or skipped.
    copied: usize,
    out: Output<W>,
    /// The number of the first new `vt`.
    first_index: usize,
    table: TextureTable,
    /// The next corner.
    corner: usize,
}

impl<W: Write> Editor<'_, W> {
    fn run(&mut self, plan: &Plan, format: UvFormat) -> io::Result<()> {
        let mut is_inserted = false;
        for statement in Statements::new(self.text) {
            if !is_inserted && statement.span.start >= plan.insert_at {
                self.copy_until(statement.span.start)?;
                self.insert(format)?;
                is_inserted = true;
            }
            match statement.keyword {
                Keyword::Texture if !plan.keeps_old => self.replace(statement.span, |_| Ok(()))?,
                Keyword::Face => self.face(&statement)?,
                _ => {}
            }
        }
        self.copy_until(self.text.len())?;
        if !is_inserted {
            self.insert_at_end(format)?;
        }
        Ok(())
    }

    fn face(&mut self, statement: &Statement) -> io::Result<()> {
        let corners = Corners::new(self.text, statement);
        // Reading the document has accepted every corner.
        for corner in corners.flatten() {
            let index = self.first_index + self.table.of_corner[self.corner] as usize;
            self.corner += 1;
            self.replace(corner.texture_at, |out| {
                if corner.needs_slash {
                    out.bytes(b"/")?;
                }
                out.integer(index)
            })?;
        }
        Ok(())
    }

    fn insert(&mut self, format: UvFormat) -> io::Result<()> {
        let line_end = usual_line_end(self.text);
        for &uv in &self.table.values {
            self.out.texture(uv, format)?;
            self.out.bytes(line_end)?;
        }
        Ok(())
    }

    /// After the last line, which may lack its line end: then so does the new last line.
    fn insert_at_end(&mut self, format: UvFormat) -> io::Result<()> {
        let line_end = usual_line_end(self.text);
        let is_ended = matches!(self.text.last(), Some(b'\n' | b'\r'));
        if text::is_left_open(self.text) {
            // After a lone CR the first LF only completes its line end.
            let is_half = line_end == b"\n" && self.text.last() == Some(&b'\r');
            self.out.bytes(if is_half { b"\n\n" } else { line_end })?;
        }
        for (i, &uv) in self.table.values.iter().enumerate() {
            if i > 0 || !is_ended {
                self.out.bytes(line_end)?;
            }
            self.out.texture(uv, format)?;
        }
        if is_ended { self.out.bytes(line_end) } else { Ok(()) }
    }

    fn copy_until(&mut self, end: usize) -> io::Result<()> {
        self.out.bytes(&self.text[self.copied..end])?;
        self.copied = end;
        Ok(())
    }

    fn replace(
        &mut self,
        range: Range<usize>,
        write: impl FnOnce(&mut Output<W>) -> io::Result<()>,
    ) -> io::Result<()> {
        self.copy_until(range.start)?;
        write(&mut self.out)?;
        self.copied = range.end;
        Ok(())
    }
}
