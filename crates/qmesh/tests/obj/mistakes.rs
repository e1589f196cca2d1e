//! What people read when a file is no OBJ mesh.

use crate::bad_texts::bad_texts;
use qmesh::obj::{EXCERPT_LIMIT, FACE_CORNER_LIMIT, ObjDocument, ObjError, ObjMistake};

fn error(text: &[u8]) -> ObjError {
    ObjDocument::parse(text.to_vec()).expect_err("a bad text")
}

fn mistake(text: &[u8]) -> ObjMistake {
    match error(text) {
        ObjError::Mistake(mistake) => *mistake,
        other => panic!("{other}"),
    }
}

const V: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn bad_texts_and_what_is_said_about_them() {
    let table = bad_texts();
    let said: Vec<String> =
        table.iter().map(|(name, text)| format!("{name}\n    {}\n", error(text))).collect();
    insta::assert_snapshot!(said.concat());
}

/// An error quotes little of a file, however long its lines are, and nothing that upsets a terminal.
#[test]
fn excerpts_are_bounded_and_printable() {
    let long = format!("{V}f 1 2 {}é\x1b[2J{} 3\n", "x".repeat(30), "y".repeat(100_000));
    let mistake = mistake(long.as_bytes());
    assert_eq!(mistake.found.chars().count(), EXCERPT_LIMIT + 1);
    assert!(mistake.found.ends_with('…') && !mistake.found.contains('\x1b'));
    assert!(mistake.source_line.len() < 600);
    assert_eq!(mistake.length, 30 + 'é'.len_utf8() + 4 + 100_000);
}

/// `source_column` points at the mistake in `source_line`, wherever in the line it is.
#[test]
fn a_caret_can_be_drawn() {
    for before in [0, 1, 40, 200, 5000] {
        let text = format!("{V}f 1 2 3 {}x4\n", "\t".repeat(before));
        let mistake = mistake(text.as_bytes());
        assert_eq!((mistake.line, mistake.column, mistake.length), (5, 9 + before, 2));
        let pointed: String = mistake.source_line.chars().skip(mistake.source_column).take(2).collect();
        assert_eq!(pointed, "x4");
    }
}

/// A line of ten million corners is no face: it is refused while it is read.
#[test]
fn faces_have_a_bounded_number_of_corners() {
    let face = |corners: usize| format!("{V}f{}\n", " 1 2 3 4".repeat(corners / 4)).into_bytes();
    assert_eq!(
        error(&face(10_000_000)).to_string(),
        "line 5: too large: more than 1048576 corners in one face"
    );
    let most = ObjDocument::parse(face(FACE_CORNER_LIMIT)).expect("as many as are allowed");
    assert_eq!(most.corner_count(), FACE_CORNER_LIMIT);
}
