//! Bytes on their way out: numbers without allocation, many small pieces as few large writes.

use std::io::{self, BufWriter, Write};

use super::texture::{UvFormat, UvPrecision};
use crate::{Vec2, Vec3};

pub(super) struct Output<W: Write> {
    out: BufWriter<W>,
    float: zmij::Buffer,
}

impl<W: Write> Output<W> {
    pub(super) fn new(out: W) -> Self {
        Self { out: BufWriter::with_capacity(1 << 16, out), float: zmij::Buffer::new() }
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.out.write_all(bytes)
    }

    pub(super) fn integer(&mut self, mut value: usize) -> io::Result<()> {
        let mut digits = [0u8; 20];
        let mut start = digits.len();
        loop {
            start -= 1;
            digits[start] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.out.write_all(&digits[start..])
    }

    pub(super) fn vertex(&mut self, position: &Vec3) -> io::Result<()> {
        self.bytes(b"v")?;
        for &x in position {
            self.bytes(b" ")?;
            self.out.write_all(self.float.format(x).as_bytes())?;
        }
        Ok(())
    }

    /// `uv` has been rounded by `format` already.
    pub(super) fn texture(&mut self, uv: Vec2, format: UvFormat) -> io::Result<()> {
        self.bytes(b"vt")?;
        for &x in &uv {
            self.bytes(b" ")?;
            let digits = match format.precision {
                UvPrecision::Double => self.float.format(x),
                UvPrecision::Single => self.float.format(x as f32),
            };
            self.out.write_all(digits.as_bytes())?;
        }
        Ok(())
    }

    pub(super) fn flush(mut self) -> io::Result<()> {
        self.out.flush()
    }
}
