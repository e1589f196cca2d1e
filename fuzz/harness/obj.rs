//! Any bytes: read or refused, and what is read is written back with nothing changed but UVs.

use qparam_cli::qmesh::Vec2;
use qparam_cli::qmesh::obj::{EXCERPT_LIMIT, ObjDocument, ObjError};

pub(crate) fn run(data: &[u8]) {
    let document = match ObjDocument::parse(data.to_vec()) {
        Ok(document) => document,
        Err(error) => return check_message(data, &error),
    };
    let view = document.view();
    assert!(document.face_count() > 0 && view.face_count() == document.face_count());
    for face in 0..view.face_count() {
        assert!(view.face(face).len() >= 3);
        assert!(view.face(face).iter().all(|&vertex| (vertex as usize) < document.vertex_count()));
        assert!(document.line(document.face_line(face)).is_some());
    }
    assert!(document.positions().iter().all(|p| p.iter().all(|x| x.is_finite())));
    let ascending = |lines: Vec<usize>| lines.is_sorted_by(|a, b| a < b || (a == b && data.contains(&b'\\')));
    assert!(ascending((0..document.face_count()).map(|face| document.face_line(face)).collect()));
    assert!(ascending((0..document.vertex_count()).map(|vertex| document.vertex_line(vertex)).collect()));
    let _ = document.face_labels(&["g", "o", "usemtl"]);

    // UVs of which some neighbours agree and some do not.
    let value = |corner: usize| ((corner.wrapping_mul(0x9e37_79b9) >> 7) % 5) as f64 / 3.0 - 0.7;
    let uv: Vec<Vec2> = (0..document.corner_count()).map(|c| Vec2::new(value(c), value(c / 3))).collect();
    let written = write(&document, &uv);
    let again = ObjDocument::parse(written.clone()).expect("what was written can be read");
    assert_eq!(again.polygons(), document.polygons());
    assert_eq!(again.corner_uv(), Some(uv.clone()));
    // Where lines refer to `vt` lines, those that are there are kept.
    let is_reference = |line: &[u8]| {
        let start = line.iter().position(|&byte| byte > b' ').unwrap_or(line.len());
        [&b"l"[..], b"surf"].iter().any(|word| line[start..].starts_with(word))
    };
    if !data.split(|&byte| byte == b'\n' || byte == b'\r').any(is_reference) {
        assert!(write(&again, &uv) == written, "writing twice is writing once");
        assert_eq!(again.texture_coordinates().len(), distinct(&document, &uv));
    }
}

/// A message has its place in the file, and is short whatever the file is.
fn check_message(data: &[u8], error: &ObjError) {
    assert!((1..2000).contains(&error.to_string().len()), "{error}");
    if let ObjError::Mistake(mistake) = error {
        assert!(mistake.line >= 1 && mistake.column >= 1 && mistake.length <= data.len());
        assert!(mistake.found.chars().count() <= EXCERPT_LIMIT + 1);
        assert!(mistake.source_column <= mistake.source_line.chars().count());
        assert!(!mistake.source_line.chars().any(char::is_control));
    }
}

fn write(document: &ObjDocument, uv: &[Vec2]) -> Vec<u8> {
    let mut bytes = Vec::new();
    document.write_with_uv(&mut bytes, uv).expect("memory can be written");
    bytes
}

fn distinct(document: &ObjDocument, uv: &[Vec2]) -> usize {
    let vertices = document.view().corner_vertex;
    let mut pairs: Vec<_> = vertices.iter().zip(uv).map(|(v, p)| (v, p.x.to_bits(), p.y.to_bits())).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.len()
}
