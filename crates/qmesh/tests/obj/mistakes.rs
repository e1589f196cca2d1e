//! What people read when a file is no OBJ mesh.

use qmesh::obj::{EXCERPT_LIMIT, ObjDocument, ObjError, ObjMistake};

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
    let with_vertices = |faces: &str| format!("{V}{faces}").into_bytes();
    let with_face = |line: &str| format!("{V}{line}\nf 1 2 3 4\n").into_bytes();
    let binary: Vec<u8> = (0..2000u32).map(|i| if i % 3 == 0 { (i / 3) as u8 } else { 0 }).collect();
    let table: Vec<(&str, Vec<u8>)> = vec![
        ("empty", b"".to_vec()),
        ("only a mark and blanks", b"\xef\xbb\xbf \r\n\t\n".to_vec()),
        ("no faces", with_vertices("l 1 2\n")),
        ("prose", b"Dear all,\nplease find attached the head.\n".to_vec()),
        ("binary", binary),
        ("binary that starts like a face", [&b"f 1 2 3 "[..], &[0; 100]].concat()),
        ("UTF-16", "v 0 0 0\nf 1 2 3\n".encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>()),
        ("UTF-16 with mark", [&b"\xff\xfe"[..], b"v\0 \x000\0"].concat()),
        ("PLY", b"ply\nformat ascii 1.0\n".to_vec()),
        ("STL", b"solid cube\nfacet normal 0 0 1\n".to_vec()),
        ("gzip", b"\x1f\x8b\x08\x00\x00".to_vec()),
        ("word for a coordinate", with_face("v 1 two 3")),
        ("decimal comma", with_face("v 1,5 2 3")),
        ("two points", with_face("v 1.2.3 2 3")),
        ("number glued to a word", with_face("v 1 2 3f")),
        ("lone sign", with_face("v 1 2 -")),
        ("hexadecimal", with_face("v 0x10 2 3")),
        ("NaN", with_face("v nan 2 3")),
        ("infinity", with_face("v 1 -inf 3")),
        ("NaN of old C libraries", with_face("v 1 2 -1.#IND")),
        ("NaN of newer ones", with_face("v 1 2 -nan(ind)")),
        ("overflow", with_face("v 1e400 2 3")),
        ("beyond the limit", with_face("v 1 2 3e61")),
        ("two coordinates", with_face("v 1 2")),
        ("truncated line", b"v 0 0 0\nv 1 0".to_vec()),
        ("no coordinates but a comment", with_face("v # 1 2 3")),
        ("bare v", b"v".to_vec()),
        ("bare vt", with_face("vt")),
        ("word in vt", with_face("vt a b")),
        ("no corners", with_vertices("f\n")),
        ("one corner", with_vertices("f 1\n")),
        ("two corners", with_vertices("f 1 2 # 3\n")),
        ("truncated face", with_vertices("f 1 2 3 4\nf 1/")),
        ("index zero", with_vertices("f 1 2 0 4\n")),
        ("texture index zero", with_vertices("vt 0 0\nf 1/1 2/0 3/1\n")),
        ("beyond the last vertex", with_vertices("f 1 2 3 4\nf 1 2 5\n")),
        ("before the first vertex", with_vertices("f -1 -2 -5\nv 0 0 0\n")),
        ("beyond the last texture coordinate", with_vertices("vt 0 0\nf 1/1 2/2 3/1\n")),
        ("no texture coordinates", with_vertices("f 1/1 2/2 3/3\n")),
        ("before the first texture coordinate", with_vertices("f 1/-1 2/-1 3/-1\nvt 0 0\n")),
        ("wraps at 2^32", with_vertices("f 1 2 4294967299\n")),
        ("wraps at 2^32 from below", with_vertices("f 1 2 -4294967295\n")),
        ("wraps at 2^64", with_vertices("f 1 2 18446744073709551619\n")),
        ("float index", with_vertices("f 1.0 2.0 3.0\n")),
        ("word index", with_vertices("f 1 2 3 x\n")),
        ("sign without digits", with_vertices("f 1 2 -\n")),
        ("missing first index", with_vertices("f /1 /2 /3\n")),
        ("three slashes", with_vertices("f 1///1 2 3\n")),
        ("four indices", with_vertices("f 1/1/1/1 2 3\n")),
        ("word for a normal", with_vertices("f 1//n 2 3\n")),
        ("commas", with_vertices("f 1,2,3\n")),
        ("NUL in a face", with_vertices("f 1 2 \0 3\n")),
        ("backslash inside the line", with_vertices("f 1 2 \\ 3 4\n")),
        ("mistake in a continued line", with_vertices("f 1 2 \\\r\n  3 \\\n  9\n")),
        ("not UTF-8", [V.as_bytes(), b"f 1 2 \xff\xfe3\n"].concat()),
        ("very long word", with_vertices(&format!("f 1 2 {}\n", "7x".repeat(5000)))),
        ("CR only", b"v 0 0 0\rv 0 0\rf 1 2 3\r".to_vec()),
    ];
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
