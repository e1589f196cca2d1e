//! Numbers as text for a page: small, and quick to read back.
//!
//! Arrays become differences from one element to the next, their bytes are sorted by place value, everything is
//! deflated together (zlib), and written in base64.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Arrays one after the other. Readers know kinds and lengths.
#[derive(Default)]
pub(super) struct Packer(Vec<u8>);

impl Packer {
    /// Differences modulo 2³², zigzag, four planes of bytes.
    pub(super) fn u32s(&mut self, values: impl Iterator<Item = u32>) {
        let mut before = 0_u32;
        let differences: Vec<u32> = values
            .map(|value| {
                let difference = value.wrapping_sub(before) as i32;
                before = value;
                ((difference << 1) ^ (difference >> 31)) as u32
            })
            .collect();
        for byte in 0..4 {
            self.0.extend(differences.iter().map(|difference| (difference >> (8 * byte)) as u8));
        }
    }

    /// Differences modulo 2¹⁶, zigzag, two planes of bytes.
    pub(super) fn u16s(&mut self, values: impl Iterator<Item = u16>) {
        let mut before = 0_u16;
        let differences: Vec<u16> = values
            .map(|value| {
                let difference = value.wrapping_sub(before) as i16;
                before = value;
                ((difference << 1) ^ (difference >> 15)) as u16
            })
            .collect();
        for byte in 0..2 {
            self.0.extend(differences.iter().map(|difference| (difference >> (8 * byte)) as u8));
        }
    }

    /// As they are.
    pub(super) fn bytes(&mut self, values: impl Iterator<Item = u8>) {
        self.0.extend(values);
    }

    /// Deflated, in base64.
    pub(super) fn text(self) -> std::io::Result<String> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(&self.0)?;
        Ok(base64(&encoder.finish()?))
    }
}

/// RFC 4648, with padding.
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use super::*;

    /// The test vectors of RFC 4648.
    #[test]
    fn base64_is_that_of_the_standard() {
        let words = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let expected = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        assert_eq!(words.map(|word| base64(word.as_bytes())), expected);
    }

    /// Whatever goes in comes out again by undoing each step.
    #[test]
    fn arrays_can_be_read_back() {
        let values = [5_u32, 0, u32::MAX, 7, 1 << 31, 3];
        let mut packer = Packer::default();
        packer.u32s(values.into_iter());
        let mut deflated = ZlibEncoder::new(Vec::new(), Compression::fast());
        deflated.write_all(&packer.0).unwrap();
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(&*deflated.finish().unwrap()).read_to_end(&mut bytes).unwrap();
        let mut before = 0_u32;
        for (i, &value) in values.iter().enumerate() {
            let zigzag =
                (0..4).fold(0_u32, |sum, plane| sum | u32::from(bytes[plane * 6 + i]) << (8 * plane));
            let difference = (zigzag >> 1) ^ (zigzag & 1).wrapping_neg();
            before = before.wrapping_add(difference);
            assert_eq!(before, value);
        }
    }
}
