//! Pieces of text, made in parallel, written in order.

use std::io::{self, Write};

use rayon::prelude::*;

use crate::{Vec2, Vec3};

/// A piece of text in the making: numbers without allocation.
#[derive(Default)]
pub(super) struct Piece {
    bytes: Vec<u8>,
}

impl Piece {
    #[inline]
    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    #[inline]
    pub(super) fn integer(&mut self, mut value: usize) {
        const PAIRS: &[u8; 200] = b"00010203040506070809101112131415161718192021222324252627282930313233343536373839\
            404142434445464748495051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";
        let mut digits = [0u8; 20];
        let mut start = digits.len();
        while value >= 10 {
            let pair = value % 100;
            start -= 2;
            digits[start..start + 2].copy_from_slice(&PAIRS[2 * pair..2 * pair + 2]);
            value /= 100;
        }
        if value > 0 || start == digits.len() {
            start -= 1;
            digits[start] = b'0' + value as u8;
        } else if digits[start] == b'0' {
            start += 1;
        }
        self.bytes(&digits[start..]);
    }

    pub(super) fn vertex(&mut self, position: &Vec3) {
        self.bytes(b"v");
        for &x in position {
            self.bytes(b" ");
            self.bytes(zmij::Buffer::new().format(x).as_bytes());
        }
    }

    /// With the fewest digits that read back as the same numbers.
    pub(super) fn texture(&mut self, uv: Vec2) {
        self.bytes(b"vt");
        for &x in &uv {
            self.bytes(b" ");
            self.bytes(zmij::Buffer::new().format(x).as_bytes());
        }
    }
}

/// Writes what `make` puts into a piece for each of `jobs`, in their order. The next pieces are made while those that are ready
/// are written; a few of them are all that is held.
pub(super) fn write_pieces<J: Sync>(
    out: &mut impl Write,
    jobs: &[J],
    make: impl Fn(&J, &mut Piece) + Sync,
) -> io::Result<()> {
    let at_once = 2 * rayon::current_num_threads();
    let make_all = |jobs: &[J], pieces: &mut Vec<Piece>| {
        pieces.resize_with(jobs.len(), Piece::default);
        pieces.par_iter_mut().zip(jobs).for_each(|(piece, job)| {
            piece.bytes.clear();
            make(job, piece);
        });
    };
    let mut groups = jobs.chunks(at_once);
    let (mut ready, mut next) = (Vec::new(), Vec::new());
    make_all(groups.next().unwrap_or_default(), &mut ready);
    while !ready.is_empty() {
        let group = groups.next().unwrap_or_default();
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| make_all(group, &mut next));
            ready.iter().try_for_each(|piece| out.write_all(&piece.bytes))
        })?;
        std::mem::swap(&mut ready, &mut next);
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_have_all_their_digits() {
        for value in (0..2000).chain([9_999, 10_000, 123_456, 99_999_999, 4_294_967_296, usize::MAX]) {
            let mut piece = Piece::default();
            piece.integer(value);
            assert_eq!(piece.bytes, value.to_string().into_bytes());
        }
    }

    /// Whatever is made out of turn is written in turn, and what cannot be written is said.
    #[test]
    fn pieces_are_written_in_order() {
        let jobs: Vec<usize> = (0..1000).collect();
        let mut out = Vec::new();
        write_pieces(&mut out, &jobs, |&job, piece| piece.integer(job)).expect("memory takes all");
        let expected: String = jobs.iter().map(usize::to_string).collect();
        assert_eq!(String::from_utf8(out), Ok(expected));

        let mut short = [0u8; 100];
        let failed = write_pieces(&mut &mut short[..], &jobs, |&job, piece| piece.integer(job));
        assert_eq!(failed.map_err(|error| error.kind()), Err(io::ErrorKind::WriteZero));
    }
}
