//! OBJ texts with everything that occurs in them, together with what they mean.

use proptest::collection::vec;
use proptest::prelude::*;

/// A text and what it says, known from how it was made.
#[derive(Clone, Debug, Default)]
pub(crate) struct Text {
    pub(crate) bytes: Vec<u8>,
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) texture_coordinates: Vec<[f64; 2]>,
    /// Vertex and texture coordinate of every corner of every face.
    pub(crate) faces: Vec<Vec<(u32, Option<u32>)>>,
    /// Whether a line (`l`) names texture coordinates.
    pub(crate) has_references: bool,
}

/// Four numbers decide a line; `u32`s shrink well.
type Dice = [u32; 4];

pub(crate) fn texts() -> impl Strategy<Value = Text> {
    (vec(any::<Dice>(), 0..40), any::<Dice>(), any::<bool>(), any::<bool>())
        .prop_map(|(lines, dice, has_mark, ends_early)| Maker::make(&lines, dice, has_mark, ends_early))
}

struct Maker {
    text: Text,
    line_ends: &'static [&'static str],
    lines: usize,
    /// How many vertices and texture coordinates there will be in the end: faces may look ahead.
    totals: [usize; 2],
}

impl Maker {
    fn make(lines: &[Dice], dice: Dice, has_mark: bool, ends_early: bool) -> Text {
        const LINE_ENDS: [&[&str]; 4] = [&["\n"], &["\r\n"], &["\r"], &["\n", "\r\n", "\n", "\r"]];
        let kinds: Vec<u32> = lines.iter().map(|dice| dice[0] % 12).collect();
        let count = |wanted: [u32; 2]| kinds.iter().filter(|kind| wanted.contains(kind)).count();
        let mut maker = Self {
            text: Text::default(),
            line_ends: LINE_ENDS[dice[0] as usize % 4],
            lines: 0,
            totals: [1 + count([0, 1]), count([2, 2])],
        };
        if has_mark {
            maker.put("\u{feff}");
        }
        maker.vertex([1; 4]);
        for (dice, kind) in lines.iter().zip(kinds) {
            match kind {
                0 | 1 => maker.vertex(*dice),
                2 => maker.texture(*dice),
                3..=6 => maker.face(*dice),
                7 => maker.reference(*dice),
                _ => maker.other(*dice),
            }
        }
        maker.face(dice);
        if ends_early {
            maker.cut_last_line_end();
        }
        maker.text
    }

    fn put(&mut self, text: &str) {
        self.text.bytes.extend_from_slice(text.as_bytes());
    }

    fn line_end(&mut self) {
        self.put(self.line_ends[self.lines % self.line_ends.len()]);
        self.lines += 1;
    }

    /// White space between words: sometimes the line goes on below.
    fn gap(&mut self, dice: u32) {
        match dice % 11 {
            0 => self.put("\t"),
            1 => self.put("   "),
            2 => {
                self.put(" \\");
                self.line_end();
                self.put("\t");
            }
            _ => self.put(" "),
        }
    }

    fn tail(&mut self, dice: u32) {
        match dice % 9 {
            0 => self.put("  "),
            1 => self.put(" # 1/1 vt 3 \\"),
            2 => self.put("#touching"),
            3 => self.put("\t"),
            _ => {}
        }
        self.line_end();
    }

    fn vertex(&mut self, [_, a, b, c]: Dice) {
        let position = [f64::from(a % 1000) / 8.0, -f64::from(b % 77), f64::from(c) * 1e-3];
        self.put(["v", "  v", "v", "\tv"][a as usize % 4]);
        for (i, x) in position.iter().enumerate() {
            self.gap(b.rotate_left(5 * i as u32));
            self.put(&if c % 5 == 0 { format!("{x:e}") } else { x.to_string() });
        }
        self.put(["", " 1.0", " 0.5 0.25 1", " 255 0 0 1"][c as usize % 4]);
        self.tail(a ^ b);
        self.text.positions.push(position);
    }

    fn texture(&mut self, [_, a, b, c]: Dice) {
        let uv = [f64::from(a % 100) / 100.0, f64::from(b % 3)];
        self.put(["vt", " vt"][c as usize % 2]);
        for x in uv {
            self.gap(a);
            self.put(&x.to_string());
        }
        self.put(["", " 0"][a as usize % 2]);
        self.tail(c);
        self.text.texture_coordinates.push(uv);
    }

    fn face(&mut self, [_, a, b, c]: Dice) {
        let mut corners = Vec::new();
        self.put(["f", "f", "fo", "  f"][a as usize % 4]);
        for i in 0..3 + b % 4 {
            let dice = c.rotate_left(7 * i) ^ a;
            self.gap(dice >> 8);
            let vertex = dice as usize % self.totals[0];
            self.index(vertex, self.text.positions.len(), dice >> 5);
            let form = if c.is_multiple_of(3) { dice >> 9 } else { a } % 6;
            let has_texture = form >= 3 && self.totals[1] > 0;
            let texture = has_texture.then(|| dice as usize / 7 % self.totals[1]);
            if let Some(texture) = texture {
                self.put("/");
                self.index(texture, self.text.texture_coordinates.len(), dice >> 4);
            }
            self.put(match (form, has_texture) {
                (1, _) => "//2",
                (2, _) => "//-1",
                (3, true) => "/",
                (4, true) => "/1",
                (4, false) => "/",
                (5, false) => "//",
                _ => "",
            });
            corners.push((vertex as u32, texture.map(|t| t as u32)));
        }
        self.tail(b ^ c);
        self.text.faces.push(corners);
    }

    /// An element as a number from 1, or if it came already perhaps counted back from here.
    fn index(&mut self, element: usize, before: usize, dice: u32) {
        if element < before && dice.is_multiple_of(3) {
            self.put(&format!("-{}", before - element));
        } else {
            self.put(&(element + 1).to_string());
        }
    }

    fn reference(&mut self, [_, a, b, _]: Dice) {
        let before = self.text.texture_coordinates.len();
        if before > 0 && a.is_multiple_of(2) {
            let texture = b as usize % before;
            self.put("l 1/");
            self.index(texture, before, b >> 3);
            self.put(" 1/1");
            self.text.has_references = true;
        } else {
            self.put("l 1 1 1");
        }
        self.tail(b);
    }

    fn other(&mut self, [_, a, b, _]: Dice) {
        const LINES: [&[u8]; 16] = [
            b"# comment, with f 1/1/1 and a backslash \\",
            b"g caf\xe9 vt f",
            b"o \x93\xfa\x96\x7b \\",
            b"usemtl C:\\maps\\",
            b"mtllib a b.mtl \\",
            b"s off",
            b"vn 0 0 1",
            b"vn 0 \\\n0 1",
            b"",
            b" \t ",
            b"t crease 1/2/3 vt",
            b"vp 0.5 \\\n0.5",
            b"g nul \0 inside",
            b"ctech cspace 1/1",
            b"vtx 1 2",
            b"\xff\xfe\x80",
        ];
        self.text.bytes.extend_from_slice(LINES[a as usize % LINES.len()]);
        self.tail(if a.is_multiple_of(16) { 8 } else { b });
    }

    fn cut_last_line_end(&mut self) {
        while matches!(self.text.bytes.last(), Some(b'\n' | b'\r')) {
            self.text.bytes.pop();
        }
    }
}
