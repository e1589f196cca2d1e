//! What a file that is no OBJ may be instead. Asked only after reading has failed, so no OBJ is refused for its looks.

const SAMPLE: usize = 1 << 16;

/// What speaks against the bytes being an OBJ at all.
pub(super) fn evidence_against(bytes: &[u8]) -> Option<&'static str> {
    const STARTS: [(&[u8], &str); 18] = [
        (b"\xff\xfe", "it is UTF-16 text; save it as UTF-8"),
        (b"\xfe\xff", "it is UTF-16 text; save it as UTF-8"),
        (b"ply\n", "it starts like a PLY file"),
        (b"ply\r", "it starts like a PLY file"),
        (b"solid ", "it starts like an STL file"),
        (b"OFF\n", "it starts like an OFF file"),
        (b"OFF\r", "it starts like an OFF file"),
        (b"OFF ", "it starts like an OFF file"),
        (b"glTF", "it starts like a binary glTF file"),
        (b"Kaydara FBX Binary", "it starts like an FBX file"),
        (b"; FBX", "it starts like an FBX file"),
        (b"BLENDER", "it starts like a Blender file"),
        (b"PXR-USDC", "it starts like a USD file"),
        (b"#usda", "it starts like a USD file"),
        (b"PK\x03\x04", "it is a ZIP archive; unpack it first"),
        (b"\x1f\x8b", "it is compressed with gzip; unpack it first"),
        (b"{", "it starts like JSON"),
        (b"<", "it starts like XML or HTML"),
    ];
    if let Some((_, evidence)) = STARTS.iter().find(|(start, _)| bytes.starts_with(start)) {
        return Some(evidence);
    }
    let sample = &bytes[..bytes.len().min(SAMPLE)];
    // Text has no control characters but white space, or a few by mistake; compressed bytes are at 10 %, binary
    // numbers far above.
    let control = sample.iter().filter(|&&b| b < b'\t' || (b > b'\r' && b < b' ')).count();
    (control > 8 + sample.len() / 50).then_some("it is binary, not text")
}
