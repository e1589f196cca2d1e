//! Texts in chunks, so that several threads can work on one.

use std::ops::Range;

use memchr::memchr;

/// About how many bytes a chunk has: enough that its overhead is nothing, and few enough that some in flight take no room.
pub(super) const CHUNK: usize = 1 << 20;

/// Cuts a text into chunks of whole statements, `size` bytes or a little more each; together they are the text.
///
/// A cut is made behind an LF whose line cannot go on in the next. A text whose lines end with a lone CR is one chunk.
pub(super) fn chunks(text: &[u8], size: usize) -> Vec<Range<usize>> {
    let mut chunks = Vec::with_capacity(text.len() / size.max(1) + 1);
    let mut start = 0;
    while start < text.len() {
        let end = next_cut(text, start.saturating_add(size.max(1)));
        chunks.push(start..end);
        start = end;
    }
    chunks
}

/// The first place from `from` on where a statement is sure to start.
fn next_cut(text: &[u8], mut from: usize) -> usize {
    while from < text.len() {
        let Some(length) = memchr(b'\n', &text[from..]) else { break };
        let end = from + length;
        let line = text[..end].strip_suffix(b"\r").unwrap_or(&text[..end]);
        if !line.ends_with(b"\\") {
            return end + 1;
        }
        from = end + 1;
    }
    text.len()
}

#[cfg(test)]
pub(super) mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::obj::text::{Statements, content_start};

    /// Lines of all kinds that make sense in any order, and their ends.
    pub(in crate::obj) fn texts() -> impl Strategy<Value = Vec<u8>> {
        const LINES: &[&str] = &[
            "v 0 0 0",
            "v 1 0.5 0 # c",
            "v 1 1 \\\n 2",
            "v 2 \\\r\n2 2 1 1 1",
            "vt 0 1",
            "vt .5 nan",
            "vt 1",
            "vn 0 0 1",
            "f 1 2 3",
            "f -1 -2 -3",
            "f 1/1 2/2 3/1",
            "f -3/-1 -2 -1/-2",
            "f 1//1 2//1 3//1 -1//1 # \\",
            "f 1 \\\n2 3/1/1",
            "fo 3 2 1",
            "g a \\",
            "usemtl C:\\",
            "",
            "  ",
            "# f 1 2 3",
            "l 1/1 2/2",
            "l -1/-1 -2/-1",
            "l 1 2",
            "l 1 \\\n2/1",
            "\u{feff}v 0 0 0",
            "bevel on",
            "f 1 2 3",
            "f 1 2 3",
            "f 3/2 -1 1",
            "v 0 0 1",
        ];
        let line = (0..LINES.len(), 0u8..12).prop_map(|(line, end)| {
            let end = match end {
                0 | 1 => "\r\n",
                2 => "\r",
                _ => "\n",
            };
            format!("{}{end}", LINES[line])
        });
        let head = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\n";
        (prop::collection::vec(line, 0..60), any::<bool>(), 0usize..8).prop_map(
            move |(lines, marked, end)| {
                let mark = if marked { "\u{feff}" } else { "" };
                let end = ["", "", "", "", "f 1 2 3", "v 1 2 3", "f 1 2 3 \\", "f 1 2 99999"][end];
                format!("{mark}{head}{}{end}", lines.concat()).into_bytes()
            },
        )
    }

    proptest! {
        /// Wherever it is cut, a text has the same statements.
        #[test]
        fn chunks_are_whole_statements(text in texts(), size in 0usize..200) {
            let spans = |statements: Statements<'_>| statements.map(|s| (s.keyword, s.span)).collect::<Vec<_>>();
            let cut = chunks(&text, size);
            prop_assert_eq!(cut.iter().flat_map(|chunk| text[chunk.clone()].to_vec()).collect::<Vec<_>>(), text.clone());
            let apart: Vec<_> = cut.into_iter().flat_map(|chunk| spans(Statements::within(&text, chunk))).collect();
            prop_assert_eq!(apart, spans(Statements::new(&text)));
            prop_assert!(content_start(&text) <= text.len());
        }
    }
}
