//! Where bytes come from, and what a document tells about places in them.

use std::io::{self, Read};

use qmesh::obj::{ObjDocument, ObjError};

const TEXT: &[u8] = b"\xef\xbb\xbfv 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 \\\r\n 3\r\nf 3 2 1";

#[test]
fn a_stream_reads_like_bytes() {
    let from_stream = ObjDocument::read(TEXT).expect("a good text");
    assert_eq!(from_stream.bytes(), TEXT);
}

#[test]
fn a_broken_stream_is_an_error() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the cable is cut"))
        }
    }
    let error = ObjDocument::read(Broken).expect_err("broken");
    assert!(matches!(error, ObjError::Io(_)));
    assert_eq!(error.to_string(), "the file cannot be read: the cable is cut");
}

#[test]
fn elements_know_their_lines() {
    let document = ObjDocument::parse(TEXT.to_vec()).expect("a good text");
    assert_eq!([0, 1, 2].map(|vertex| document.vertex_line(vertex)), [1, 2, 4]);
    assert_eq!([0, 1].map(|face| document.face_line(face)), [5, 7]);
    assert_eq!(document.line(1), Some(&b"v 0 0 0"[..]));
    assert_eq!(document.line(3), Some(&b""[..]));
    assert_eq!(document.line(7), Some(&b"f 3 2 1"[..]));
    assert_eq!((document.line(0), document.line(8)), (None, None));
}
