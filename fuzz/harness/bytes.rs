//! Bytes as a source of choices. When they are used up, every choice is the first.

/// Hands out one choice after the other.
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl Bytes<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A number below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count.max(1)
    }

    /// One of `choices`.
    pub(crate) fn one<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A coordinate: mostly a small multiple of 1/8, rarely something that is hard on floating-point numbers.
    pub(crate) fn coordinate(&mut self) -> f64 {
        const HARD: [f64; 16] = [
            0.0,
            -0.0,
            1e-300,
            -1e-300,
            1e-160,
            1e-17,
            1e-9,
            1e8,
            -1e8,
            123_456.789,
            1e30,
            1e59,
            -1e60,
            5e-324,
            0.1,
            1.0,
        ];
        let byte = self.byte();
        if byte >= 240 { HARD[usize::from(byte - 240)] } else { (f64::from(byte) - 120.0) / 8.0 }
    }
}
