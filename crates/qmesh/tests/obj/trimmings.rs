//! Theorems about reading and writing, over generated texts.

use std::collections::BTreeSet;

use proptest::prelude::*;
use qmesh::obj::ObjDocument;
use qmesh::{Vec2, Vec3};

use crate::slow::{lines_of, without_uv};
use crate::texts::{Text, texts};

/// UVs of which some agree and some do not, whatever the corners are.
pub(crate) fn some_uv(corner_count: usize, seed: u64) -> Vec<Vec2> {
    let value = |n: u64| (n % 5) as f64 / 3.0 - 0.7;
    let mixed = |corner: u64| (corner + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
    (0..corner_count as u64).map(|c| Vec2::new(value(mixed(c)), value(mixed(c) / 5))).collect()
}

fn write(document: &ObjDocument, uv: &[Vec2]) -> Vec<u8> {
    let mut out = Vec::new();
    document.write_with_uv(&mut out, uv).expect("writing to memory");
    out
}

fn corner_textures(document: &ObjDocument) -> Vec<Option<u32>> {
    (0..document.corner_count()).map(|corner| document.corner_texture(corner)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    /// What is read is what the text was made to say, with the lines where it says so.
    #[test]
    fn reading_finds_what_was_written(text in texts()) {
        let document = ObjDocument::parse(text.bytes.clone()).expect("a good text");
        let positions: Vec<Vec3> = text.positions.iter().map(|&p| p.into()).collect();
        let uv: Vec<Vec2> = text.texture_coordinates.iter().map(|&p| p.into()).collect();
        prop_assert_eq!(document.positions(), &positions[..]);
        prop_assert_eq!(document.texture_coordinates(), &uv[..]);
        prop_assert_eq!(document.face_count(), text.faces.len());
        for (face, corners) in text.faces.iter().enumerate() {
            let vertices: Vec<u32> = corners.iter().map(|&(vertex, _)| vertex).collect();
            prop_assert_eq!(document.view().face(face), &vertices[..]);
        }
        let textures: Vec<Option<u32>> = text.faces.iter().flatten().map(|&(_, texture)| texture).collect();
        prop_assert_eq!(document.corners_with_uv(), textures.iter().flatten().count());
        prop_assert_eq!(document.corner_uv().is_some(), textures.iter().all(Option::is_some));
        prop_assert_eq!(corner_textures(&document), textures);

        let face_lines: Vec<usize> = (0..document.face_count()).map(|face| document.face_line(face)).collect();
        let vertex_lines: Vec<usize> = (0..positions.len()).map(|v| document.vertex_line(v)).collect();
        prop_assert_eq!(face_lines, lines_of(&text.bytes, &[b"f", b"fo"]));
        prop_assert_eq!(vertex_lines, lines_of(&text.bytes, &[b"v"]));
    }

    /// Nothing changes but `vt` lines and middle indices; the new UVs and the same polygons are read back.
    #[test]
    fn writing_changes_uvs_alone(text in texts(), seed in 0u64..1000) {
        let document = ObjDocument::parse(text.bytes.clone()).expect("a good text");
        let uv = some_uv(document.corner_count(), seed);
        let mut out = Vec::new();
        let summary = document.write_with_uv(&mut out, &uv).expect("writing to memory");

        let (left, expected) = (without_uv(&out), without_uv(&text.bytes));
        prop_assert_eq!(left.escape_ascii().to_string(), expected.escape_ascii().to_string());

        let again = ObjDocument::parse(out.clone()).expect("what was written");
        prop_assert_eq!(again.polygons(), document.polygons());
        prop_assert_eq!(again.corner_uv(), Some(uv.clone()));

        let corners = document.view().corner_vertex.iter().zip(&uv);
        let distinct: BTreeSet<_> = corners.clone().map(|(&v, uv)| (v, uv.x.to_bits(), uv.y.to_bits())).collect();
        let used: BTreeSet<u32> = corners.map(|(&v, _)| v).collect();
        prop_assert_eq!(summary.written, distinct.len());
        let values = |vertex: u32| distinct.iter().filter(|entry| entry.0 == vertex).count();
        prop_assert_eq!(summary.split_vertices, used.iter().filter(|&&vertex| values(vertex) > 1).count());
        let old = text.texture_coordinates.len();
        let (removed, kept) = if text.has_references { (0, old) } else { (old, 0) };
        prop_assert_eq!((summary.removed, summary.kept), (removed, kept));
        prop_assert_eq!(again.texture_coordinates().len(), kept + summary.written);
    }

    /// Writing twice is writing once, unless old `vt` lines had to stay.
    #[test]
    fn writing_is_idempotent(text in texts(), seed in 0u64..1000) {
        prop_assume!(!text.has_references);
        let document = ObjDocument::parse(text.bytes).expect("a good text");
        let uv = some_uv(document.corner_count(), seed);
        let once = write(&document, &uv);
        let twice = write(&ObjDocument::parse(once.clone()).expect("what was written"), &uv);
        prop_assert_eq!(twice, once);
    }

    /// Any bytes at all are read or refused; mutations of good texts reach deep.
    #[test]
    fn no_bytes_panic(text in texts(), edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6), cut in prop::option::of(any::<prop::sample::Index>())) {
        let Text { mut bytes, .. } = text;
        for (place, byte) in edits {
            let place = place.index(bytes.len());
            bytes[place] = if byte < 128 { b"/-#\\0 9\nfv.e"[byte as usize % 12] } else { byte };
        }
        bytes.truncate(cut.map_or(bytes.len(), |cut| cut.index(bytes.len()) + 1));
        match ObjDocument::parse(bytes.clone()) {
            Ok(document) => {
                let uv = some_uv(document.corner_count(), 1);
                let again = ObjDocument::parse(write(&document, &uv)).expect("what was written");
                prop_assert_eq!(again.corner_uv(), Some(uv));
                // New lines at the very end may need the line end that the last line lacked.
                let (left, expected) = (without_uv(again.bytes()), without_uv(&bytes));
                prop_assert_eq!(left.trim_ascii_end(), expected.trim_ascii_end());
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

fn document(text: &str) -> ObjDocument {
    ObjDocument::parse(text.as_bytes().to_vec()).expect("a good text")
}

fn rewritten(text: &str) -> String {
    let document = document(text);
    let uv: Vec<Vec2> = document.view().corner_vertex.iter().map(|&v| Vec2::new(f64::from(v), 0.5)).collect();
    String::from_utf8(write(&document, &uv)).expect("ASCII")
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// The new lines stand where the old ones stood.
#[test]
fn new_lines_take_the_place_of_the_first_old_one() {
    let text = format!("vt 9 9 # old\n{TRIANGLE}# between\nvt 8 8\nf 1/1 2/1 3/2\n");
    let expected = format!("vt 0.0 0.5\nvt 1.0 0.5\nvt 2.0 0.5\n{TRIANGLE}# between\nf 1/1 2/2 3/3\n");
    assert_eq!(rewritten(&text), expected);
}

/// Many readers want a `vt` to be known when a face names it, even in files whose first object had no UVs.
#[test]
fn new_lines_come_before_the_first_face() {
    let text = format!("{TRIANGLE}o first\r\nf 1 2 3\no second\nvt 8 8\nf 1/1 2/1 3/1");
    let new = "vt 0.0 0.5\nvt 1.0 0.5\nvt 2.0 0.5\n";
    let expected = format!("{TRIANGLE}o first\r\n{new}f 1/1 2/2 3/3\r\no second\nf 1/1 2/2 3/3");
    assert_eq!(rewritten(&text.replace("f 1 2 3\n", "f 1 2 3\r\n")), expected);
}

#[test]
fn new_lines_end_as_the_first_line_does() {
    for line_end in ["\n", "\r\n", "\r"] {
        let text = format!("{TRIANGLE}f 1 2 3\n").replace('\n', line_end);
        let expected = format!("{TRIANGLE}vt 0.0 0.5\nvt 1.0 0.5\nvt 2.0 0.5\nf 1/1 2/2 3/3\n");
        assert_eq!(rewritten(&text), expected.replace('\n', line_end));
    }
    // A lone CR before an LF would become half of a CR LF, and the line count would change.
    assert!(rewritten(&format!("# mixed\r{TRIANGLE}vt 0 0\n\nf 1 2 3\n")).contains("vt 2.0 0.5\n\nf 1/1"));
}

/// A line that names a texture coordinate names the same one afterwards, from the front or from the back.
#[test]
fn lines_keep_their_texture_coordinates() {
    let new = "vt 0.0 0.5\nvt 1.0 0.5\nvt 2.0 0.5\n";
    let faces = "f 1/1 2/1 3/1\n";
    let text = format!("{TRIANGLE}vt 7 7\n{faces}l 1/1 2/1\n");
    assert_eq!(rewritten(&text), format!("{TRIANGLE}vt 7 7\n{new}f 1/2 2/3 3/4\nl 1/1 2/1\n"));

    let text = format!("{TRIANGLE}vt 7 7\n{faces}l 1/-1 2/-1\ns off");
    assert_eq!(rewritten(&text), format!("{TRIANGLE}vt 7 7\nf 1/2 2/3 3/4\nl 1/-1 2/-1\n{new}s off"));

    // Nothing comes after the line: the new last line lacks its end as the old one did.
    let text = format!("{TRIANGLE}vt 7 7\n{faces}l 1/-1 2/-1");
    let expected = format!("{TRIANGLE}vt 7 7\nf 1/2 2/3 3/4\nl 1/-1 2/-1\n{}", new.trim_end());
    assert_eq!(rewritten(&text), expected);

    // The file stops where the line was to be continued: an empty line keeps the new ones out of it.
    let text = format!("{TRIANGLE}vt 7 7\n{faces}l 1/-1 2/-1 \\\n");
    let expected = format!("{TRIANGLE}vt 7 7\nf 1/2 2/3 3/4\nl 1/-1 2/-1 \\\n\n{new}");
    assert_eq!(rewritten(&text), expected);
}

#[test]
fn uvs_that_do_not_fit_are_refused_before_a_byte_is_written() {
    let document = document(&format!("{TRIANGLE}f 1 2 3"));
    for (uv, message) in [
        (vec![Vec2::zeros(); 2], "2 UVs for 3 corners"),
        (vec![Vec2::zeros(), Vec2::new(0.0, f64::NAN), Vec2::zeros()], "the UV of corner 1 is not finite"),
    ] {
        let mut out = Vec::new();
        let error = document.write_with_uv(&mut out, &uv).expect_err("refused");
        assert_eq!((error.kind(), error.to_string().as_str()), (std::io::ErrorKind::InvalidInput, message));
        assert!(out.is_empty());
    }
}

/// A `vt` without a number is none: it is about to be replaced, so it must not stand in the way.
#[test]
fn uvs_that_are_not_finite_count_as_none() {
    let document = document(&format!("{TRIANGLE}vt 0 0\nvt nan 0\nvt 1.#INF 0\nf 1/1 2/2 3/3"));
    assert_eq!((document.corners_with_uv(), document.corner_uv()), (1, None));
}
