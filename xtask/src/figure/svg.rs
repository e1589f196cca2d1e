//! A short SVG: paths of many polygons, in whole tenths of a pixel.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use qparam_cli::qmesh::Vec2;

/// Tenths of a pixel are the unit of the file.
pub(super) const UNITS_PER_PIXEL: f64 = 10.0;

/// Colours of the checks, in this order of painting.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Ink {
    Clay,
    Light,
    Dark,
}

const SHADES: usize = 10;

impl Ink {
    const ALL: [(Self, char, [f64; 3], [f64; 3]); 3] = [
        (Self::Clay, 'c', [92.0, 88.0, 84.0], [226.0, 219.0, 210.0]),
        (Self::Light, 'l', [112.0, 112.0, 116.0], [250.0, 249.0, 246.0]),
        (Self::Dark, 'd', [12.0, 34.0, 66.0], [44.0, 104.0, 176.0]),
    ];

    fn letter(self) -> char {
        Self::ALL[self as usize].1
    }
}

/// The styles that the classes of [`Slab`] need.
pub(super) fn styles() -> String {
    let mut text = String::from("path{stroke-width:3;stroke-linejoin:round}");
    for (ink, letter, shadow, lit) in Ink::ALL {
        for shade in 0..SHADES {
            let share = shade as f64 / (SHADES - 1) as f64;
            let colour = |factor: f64| {
                let channel = |i: usize| ((shadow[i] + (lit[i] - shadow[i]) * share) * factor).round() as u8;
                format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
            };
            // The quads of the plain model are outlined; a check's outline has its own colour and closes the gaps that
            // anti-aliasing leaves between neighbours.
            let stroke = colour(if ink == Ink::Clay { 0.62 } else { 1.0 });
            let _ = write!(text, ".{letter}{shade}{{fill:{};stroke:{stroke}}}", colour(1.0));
        }
    }
    text
}

/// Polygons at about one distance: no order among those of one ink, so that one path holds all of a shade.
#[derive(Default)]
pub(super) struct Slab(BTreeMap<(Ink, usize), String>);

impl Slab {
    /// Adds a polygon in pixels; `light` is from 0 to 1.
    pub(super) fn add(&mut self, ink: Ink, light: f64, polygon: &[Vec2]) {
        let mut points: Vec<[i64; 2]> = polygon.iter().map(|p| [unit(p.x), unit(p.y)]).collect();
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return;
        }
        let shade = (light * (SHADES - 1) as f64).round() as usize;
        push_outline(self.0.entry((ink, shade.min(SHADES - 1))).or_default(), &points);
    }

    pub(super) fn write(&self, text: &mut String) {
        for ((ink, shade), outline) in &self.0 {
            let _ = writeln!(text, "<path class=\"{}{shade}\" d=\"{outline}\"/>", ink.letter());
        }
    }
}

fn unit(pixels: f64) -> i64 {
    (pixels * UNITS_PER_PIXEL).round() as i64
}

/// `M` to the first point, `l` along the differences, `z`.
fn push_outline(text: &mut String, points: &[[i64; 2]]) {
    let mut last = [0, 0];
    for (i, &[x, y]) in points.iter().enumerate() {
        let (dx, dy) = (x - last[0], y - last[1]);
        let lead = match i {
            0 => "M",
            1 => "l",
            // A minus sign separates, too.
            _ if dx < 0 => "",
            _ => " ",
        };
        let gap = if dy < 0 { "" } else { " " };
        let _ = write!(text, "{lead}{dx}{gap}{dy}");
        last = [x, y];
    }
    text.push('z');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_are_short() {
        let mut text = String::new();
        push_outline(&mut text, &[[10, 20], [5, 25], [7, 22]]);
        assert_eq!(text, "M10 20l-5 5 2-3z");
    }

    /// Slivers that vanish in the rounding leave no trace, not even an empty path.
    #[test]
    fn slivers_vanish() {
        let mut slab = Slab::default();
        slab.add(Ink::Dark, 0.5, &[Vec2::new(0.0, 0.0), Vec2::new(0.01, 0.0), Vec2::new(3.0, 3.0)]);
        let mut text = String::new();
        slab.write(&mut text);
        assert_eq!(text, "");
    }
}
