//! The scale of a heat map beside the picture, and labels beneath it.

use super::canvas::Canvas;
use super::color::{Linear, Rgba};
use super::heat::{FLIPPED, HeatScale};
use super::text;

/// A strip with the colours of a scale, its values and its title.
pub struct Legend<'a> {
    /// The scale.
    pub scale: &'a HeatScale,
    /// Whether flipped faces are in the picture, which have a colour of their own.
    pub has_flipped: bool,
}

/// Height of capitals, for a picture of this size.
#[must_use]
pub fn letter_height([width, height]: [usize; 2]) -> f64 {
    (width.min(height) as f64 / 60.0).clamp(7.0, 40.0)
}

/// A colour that is readable on `background`.
#[must_use]
pub fn text_color(background: Rgba) -> Linear {
    let light = super::color::lightness(Linear::from(background));
    match background.0[3] {
        // What is beneath is not known: a grey that is readable on black and on white.
        0..128 => Linear::from(Rgba([128, 128, 128, 255])),
        _ if light > 0.6 => Linear::from(Rgba([40, 40, 40, 255])),
        _ => Linear::from(Rgba([225, 225, 225, 255])),
    }
}

impl Legend<'_> {
    /// How wide the strip is, in pixels.
    #[must_use]
    pub fn width(&self, size: [usize; 2]) -> usize {
        let letters = letter_height(size);
        let ticks = self.scale.ticks();
        let names = ticks.iter().map(|(_, name)| text::width(name, letters)).fold(0.0, f64::max);
        let words = self.words().map(|line| text::width(&line, letters)).fold(0.0, f64::max);
        (words.max(3.0 * letters + names) + 4.0 * letters).ceil() as usize
    }

    /// The title in short lines.
    pub(super) fn words(&self) -> impl Iterator<Item = String> + Clone {
        const LONGEST: usize = 14;
        let mut lines: Vec<String> = Vec::new();
        for word in self.scale.title.split(' ') {
            match lines.last_mut() {
                Some(line) if line.len() + word.len() < LONGEST => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines.into_iter()
    }

    /// Draws the strip at the right edge of the canvas.
    pub fn draw(&self, canvas: &mut Canvas, background: Rgba) {
        let size = [canvas.width(), canvas.height()];
        let letters = letter_height(size);
        let ink = text_color(background);
        let left = size[0].saturating_sub(self.width(size)) as f64 + 2.0 * letters;
        let line = 1.9 * letters;
        let mut y = 3.0 * letters;
        for words in self.words() {
            text::write(canvas, &words, [left, y], letters, ink);
            y += line;
        }
        let bottom = size[1] as f64 - 3.0 * letters - if self.has_flipped { 2.0 * line } else { 0.0 };
        let (top, bar) = (y.round(), (1.6 * letters).round());
        let height = (bottom - top).max(1.0);
        for row in 0..height as usize {
            let place = 1.0 - (row as f64 + 0.5) / height;
            let color = self.scale.map.color(place as f32);
            canvas.fill([left as usize, top as usize + row], [bar as usize, 1], color);
        }
        for (value, name) in self.scale.ticks() {
            let y = top + (1.0 - self.scale.place(value)) * (height - 1.0);
            let tick = [(left + bar) as usize, y.round() as usize];
            canvas.fill(tick, [(0.5 * letters).ceil() as usize, (letters / 8.0).ceil() as usize], ink);
            text::write(canvas, &name, [left + bar + letters, y + letters / 2.0], letters, ink);
        }
        if self.has_flipped {
            let y = bottom + 2.0 * line;
            let box_at = [left as usize, (y - letters * 1.15) as usize];
            canvas.fill(box_at, [bar as usize, (1.3 * letters) as usize], Linear::from(FLIPPED));
            text::write(canvas, "flipped", [left + bar + letters, y], letters, ink);
        }
    }
}
