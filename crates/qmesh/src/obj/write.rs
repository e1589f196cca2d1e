//! The same text with other UVs: every byte is copied but `vt` lines and the middle indices of face corners.

use std::io::{self, Write};
use std::ops::Range;

use super::ObjDocument;
use super::chunks::CHUNK;
use super::corner::Corners;
use super::output::{Piece, write_pieces};
use super::plan::{Job, Plan};
use super::text::{Keyword, Statement, Statements, usual_line_end};
use super::texture::{SeamCorners, TextureTable};
use crate::Vec2;

/// What writing UVs did to the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
    /// The text is made in parallel and written in few large pieces; `out` needs no buffer.
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
        self.write_in_chunks(out, corner_uv, CHUNK)
    }

    fn write_in_chunks(
        &self,
        out: &mut impl Write,
        corner_uv: &[Vec2],
        chunk: usize,
    ) -> io::Result<UvWriteSummary> {
        let view = self.view();
        let table = TextureTable::new(view.positions.len(), view.corner_vertex, corner_uv)?;
        let plan = Plan::new(self.bytes(), chunk, view.positions.len());
        let old = self.texture_coordinates().len();
        let summary = UvWriteSummary {
            written: table.len(),
            removed: if plan.keeps_old { 0 } else { old },
            kept: if plan.keeps_old { old } else { 0 },
            split_vertices: table.split_vertices(),
        };
        let editor = Editor {
            text: self.bytes(),
            face_start: view.face_start,
            line_end: usual_line_end(self.bytes()),
            keeps_old: plan.keeps_old,
            first_index: summary.kept + 1,
            table,
        };
        write_pieces(out, &plan.jobs, |job, piece| editor.make(job, piece))?;
        Ok(summary)
    }
}

/// Makes the pieces of the new text.
struct Editor<'a> {
    text: &'a [u8],
    face_start: &'a [u32],
    line_end: &'a [u8],
    keeps_old: bool,
    /// The number of the first new `vt`.
    first_index: usize,
    table: TextureTable<'a>,
}

impl Editor<'_> {
    fn make(&self, job: &Job, out: &mut Piece) {
        match job {
            Job::Text(range, first_face) => self.edit(range.clone(), *first_face, out),
            Job::Values(vertices) => {
                for uv in self.table.values(vertices.clone()) {
                    out.texture(uv);
                    out.bytes(self.line_end);
                }
            }
            Job::ValuesAfter(vertices) => {
                for uv in self.table.values(vertices.clone()) {
                    out.bytes(self.line_end);
                    out.texture(uv);
                }
            }
            Job::Close => {
                // After a lone CR the first LF only completes its line end.
                let is_half = self.line_end == b"\n" && self.text.last() == Some(&b'\r');
                out.bytes(if is_half { b"\n\n" } else { self.line_end });
            }
        }
    }

    /// Copies the text up to each place that changes, and writes what belongs there.
    fn edit(&self, range: Range<usize>, first_face: usize, out: &mut Piece) {
        let mut copied = range.start;
        let mut corner = self.face_start[first_face] as usize;
        let mut seams = self.table.seam_corners(corner);
        for statement in Statements::within(self.text, range.clone()) {
            match statement.keyword {
                Keyword::Texture if !self.keeps_old => {
                    out.bytes(&self.text[copied..statement.span.start]);
                    copied = statement.span.end;
                }
                Keyword::Face => self.face(&statement, &mut corner, &mut seams, &mut copied, out),
                _ => {}
            }
        }
        out.bytes(&self.text[copied..range.end]);
    }

    fn face(
        &self,
        statement: &Statement,
        corner: &mut usize,
        seams: &mut SeamCorners<'_>,
        copied: &mut usize,
        out: &mut Piece,
    ) {
        // Reading the document has accepted every corner.
        for written in Corners::new(self.text, statement).flatten() {
            out.bytes(&self.text[*copied..written.texture_at.start]);
            if written.needs_slash {
                out.bytes(b"/");
            }
            out.integer(self.first_index + self.table.place(*corner, seams));
            *copied = written.texture_at.end;
            *corner += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::obj::chunks::tests::texts;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Wherever the text is cut for the threads, the same bytes are written.
        #[test]
        fn chunks_do_not_show(text in texts(), size in 0usize..150, values in 1usize..9) {
            let Ok(document) = ObjDocument::parse(text) else { return Ok(()) };
            let uv: Vec<Vec2> =
                (0..document.corner_count()).map(|c| Vec2::new((c % values) as f64 / 3.0, (c / 7 % values) as f64)).collect();
            let written = |chunk: usize| {
                let mut out = Vec::new();
                let summary = document.write_in_chunks(&mut out, &uv, chunk).expect("to memory");
                (String::from_utf8_lossy(&out).into_owned(), summary)
            };
            prop_assert_eq!(written(size), written(usize::MAX));
        }
    }
}
