//! Letters made of strokes, so that pictures need no font file.
//!
//! A glyph is drawn on a grid of 4 × 8: lines of small letters stand between 2 and 6, capitals reach 8, tails 0. A stroke
//! is a row of grid points, two digits each (x, y), and rounds off between its ends; sharp corners are ends of strokes.

use qoptimize::qmesh::Vec2;

use super::canvas::Canvas;
use super::color::Linear;

/// Character, width on the grid, strokes.
type Glyph = (char, u8, &'static str);

#[rustfmt::skip]
const GLYPHS: &[Glyph] = &[
    ('0', 4, "28 08 02 42 48 28"), ('1', 4, "06 28,28 22,02 42"), ('2', 4, "07 08 48 46 45 02,02 42"),
    ('3', 4, "07 08 28 48 45 25 15,15 25 45 42 22 02 03"), ('4', 4, "32 38,38 04,04 44"),
    ('5', 4, "48 08,08 05,05 26 46 42 22 02 03"), ('6', 4, "47 28 08 03 02 42 46 26 05 04"),
    ('7', 4, "08 48,48 12"), ('8', 4, "28 08 05 25 45 48 28,25 05 02 22 42 45 25"),
    ('9', 4, "03 22 42 47 48 08 04 24 45 46"),
    ('a', 4, "46 42,44 46 06 02 42 44"), ('b', 4, "08 02,04 06 46 42 02 04"), ('c', 4, "45 46 06 02 42 43"),
    ('d', 4, "48 42,44 46 06 02 42 44"), ('e', 4, "04 44,44 46 06 02 42 43"), ('f', 3, "38 18 16 12,06 36"),
    ('g', 4, "44 46 06 02 42 44,46 43 40 20 00"), ('h', 4, "08 02,04 06 46 43 42"), ('i', 2, "16 12,18 18"),
    ('j', 2, "16 11 10 00,18 18"), ('k', 4, "08 02,46 04,24 42"), ('l', 2, "18 12"),
    ('m', 6, "06 02,04 06 36 33 32,34 36 66 63 62"), ('n', 4, "06 02,04 06 46 43 42"),
    ('o', 4, "26 06 02 42 46 26"), ('p', 4, "06 00,04 06 46 42 02 04"), ('q', 4, "46 40,44 46 06 02 42 44"),
    ('r', 3, "06 02,04 06 36"), ('s', 4, "45 46 26 06 04 24 44 42 22 02 03"), ('t', 3, "18 13 12 32,06 36"),
    ('u', 4, "06 03 02 42 44,46 42"), ('v', 4, "06 22,22 46"), ('w', 6, "06 12,12 36,36 52,52 66"),
    ('x', 4, "06 42,46 02"), ('y', 4, "06 22,46 10"), ('z', 4, "06 46,46 02,02 42"),
    ('A', 4, "02 28,28 42,14 34"), ('B', 4, "02 08,08 28 48 45 25 05,05 25 45 42 22 02"),
    ('C', 4, "47 48 08 02 42 43"), ('D', 4, "02 08,08 28 48 42 22 02"), ('E', 4, "08 02,08 48,05 35,02 42"),
    ('F', 4, "08 02,08 48,05 35"), ('G', 4, "47 48 08 02 42 44,44 24"), ('H', 4, "08 02,48 42,05 45"),
    ('I', 2, "18 12"), ('J', 4, "48 43 42 02 03"), ('K', 4, "08 02,48 04,26 42"), ('L', 4, "08 02,02 42"),
    ('M', 4, "02 08,08 25,25 48,48 42"), ('N', 4, "02 08,08 42,42 48"), ('O', 4, "28 08 02 42 48 28"),
    ('P', 4, "02 08,08 28 48 45 25 05"), ('Q', 4, "28 08 02 42 48 28,23 41"),
    ('R', 4, "02 08,08 28 48 45 25 05,25 42"), ('S', 4, "47 48 28 08 05 25 45 42 22 02 03"),
    ('T', 4, "08 48,28 22"), ('U', 4, "08 03 02 42 43 48"), ('V', 4, "08 22,22 48"),
    ('W', 4, "08 12,12 26,26 32,32 48"), ('X', 4, "08 42,48 02"), ('Y', 4, "08 25,48 25,25 22"),
    ('Z', 4, "08 48,48 02,02 42"),
    (' ', 2, ""), ('.', 2, "12 12"), (',', 2, "12 01"), (':', 2, "15 15,12 12"), ('-', 3, "04 34"),
    ('–', 4, "04 44"), ('+', 4, "04 44,26 22"), ('=', 4, "05 45,03 43"), ('/', 4, "01 48"), ('%', 4,
    "02 48,18 08 06 26 28 18,32 22 24 44 42 32"), ('°', 2, "18 08 06 26 28 18"), ('×', 4, "15 33,13 35"),
    ('(', 2, "28 06 04 02 20"), (')', 2, "08 26 24 22 00"), ('|', 2, "18 10"), ('_', 4, "00 40"),
    ('<', 4, "46 04,04 42"), ('>', 4, "06 44,44 02"), ('\'', 2, "18 16"),
];

/// What stands for characters that have no glyph.
const UNKNOWN: Glyph = ('\u{fffd}', 4, "02 08,08 48,48 42,42 02");
const CAPITAL: f64 = 6.0;
const SPACING: f64 = 1.6;
const BASELINE: f64 = 2.0;

fn glyph(character: char) -> &'static Glyph {
    GLYPHS.iter().find(|(known, ..)| *known == character).unwrap_or(&UNKNOWN)
}

/// How wide `text` is, in pixels, with capitals of this height.
#[must_use]
pub fn width(text: &str, height: f64) -> f64 {
    let grid: f64 = text.chars().map(|character| f64::from(glyph(character).1) + SPACING).sum();
    (grid - SPACING).max(0.0) * height / CAPITAL
}

/// Writes `text` with capitals of `height` pixels; it starts at `start`, on its base line.
pub fn write(canvas: &mut Canvas, text: &str, start: [f64; 2], height: f64, color: Linear) {
    let unit = height / CAPITAL;
    let mut x = start[0];
    for character in text.chars() {
        let (_, advance, strokes) = glyph(character);
        let to_picture = |p: Vec2| Vec2::new(x + p.x * unit, start[1] - (p.y - BASELINE) * unit);
        let strokes: Vec<Vec<Vec2>> = strokes
            .split(',')
            .map(|stroke| rounded(points(stroke)).into_iter().map(to_picture).collect())
            .collect();
        draw(canvas, &strokes, (0.16 * height).max(1.1), color);
        x += (f64::from(*advance) + SPACING) * unit;
    }
}

fn points(stroke: &str) -> Vec<Vec2> {
    let digit = |byte: u8| f64::from(byte.wrapping_sub(b'0'));
    let pairs = stroke.split_whitespace().map(str::as_bytes);
    pairs.filter_map(|pair| Some(Vec2::new(digit(*pair.first()?), digit(*pair.get(1)?)))).collect()
}

/// Corners cut three times (Chaikin): a smooth curve between the ends, or all around when they are one.
fn rounded(mut points: Vec<Vec2>) -> Vec<Vec2> {
    if points.len() < 3 {
        return points;
    }
    let is_closed = points.first() == points.last();
    for _ in 0..3 {
        let mut next = Vec::with_capacity(2 * points.len());
        for pair in points.windows(2) {
            next.extend([pair[0].lerp(&pair[1], 0.25), pair[0].lerp(&pair[1], 0.75)]);
        }
        if let (false, [first, .., last]) = (is_closed, points.as_slice()) {
            next.insert(0, *first);
            next.push(*last);
        } else if let Some(&first) = next.first() {
            next.push(first);
        }
        points = next;
    }
    points
}

/// Covers what lies within half of `width` of the strokes.
fn draw(canvas: &mut Canvas, strokes: &[Vec<Vec2>], width: f64, color: Linear) {
    let all = || strokes.iter().flatten();
    let Some(&first) = all().next() else { return };
    let low = all().fold(first, |a, b| a.inf(b)) - Vec2::repeat(width);
    let high = all().fold(first, |a, b| a.sup(b)) + Vec2::repeat(width);
    for y in low.y.floor() as i64..=high.y.ceil() as i64 {
        for x in low.x.floor() as i64..=high.x.ceil() as i64 {
            let place = Vec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let nearest = strokes
                .iter()
                .flat_map(|stroke| stroke.windows(2))
                .map(|pair| distance(place, pair[0], pair[1]))
                .fold(f64::MAX, f64::min);
            let share = (width / 2.0 + 0.5 - nearest).clamp(0.0, 1.0);
            canvas.blend(x, y, color, share as f32);
        }
    }
}

/// From a point to a line segment.
pub(super) fn distance(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let edge = b - a;
    let along = ((p - a).dot(&edge) / edge.norm_squared().max(1e-300)).clamp(0.0, 1.0);
    (p - a - edge * along).norm()
}

#[cfg(test)]
mod tests {
    use super::super::color::Rgba;
    use super::*;

    /// Every character of what pictures say has a glyph of its own that leaves ink between its lines.
    #[test]
    fn glyphs_are_complete_and_within_their_lines() {
        for character in ('a'..='z').chain('A'..='Z').chain('0'..='9').chain("., :-–+=/%°×()|_<>'".chars())
        {
            let (found, advance, strokes) = glyph(character);
            assert_eq!(*found, character);
            for p in strokes.split(',').flat_map(points) {
                assert!(p.x <= f64::from(*advance) && p.y <= 8.0, "{character}: {p}");
            }
        }
        let mut canvas = Canvas::new(20, 20, Rgba([255; 4]));
        write(&mut canvas, "8", [5.0, 15.0], 12.0, Linear::default());
        let rows = canvas.bytes().chunks(80).map(|row| row.iter().any(|&b| b < 128)).collect::<Vec<_>>();
        assert!(rows[3] && rows[14] && !rows[1] && !rows[17], "{rows:?}");
    }

    #[test]
    fn widths_add_up() {
        assert!((width("00", 6.0) - 2.0 * width("0", 6.0) - SPACING).abs() < 1e-12);
        assert!(width("", 10.0) < 1e-12);
    }
}
