//! Images for surfaces: PNG read into linear light, with smaller copies for where they are seen from afar.

use std::io::{BufRead, Seek};

use thiserror::Error;

use super::color::{Linear, Rgba};

/// An image with copies of half the size each, down to one texel.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    /// Rows from the top.
    texels: Vec<Linear>,
}

/// Why an image could not be read.
#[derive(Debug, Error)]
pub enum TextureError {
    /// Not PNG, or damaged.
    #[error("it is no PNG that can be read")]
    Decode(#[from] png::DecodingError),
    /// More texels than memory should be spent on.
    #[error("it has {0} × {1} pixels; at most {limit} in each direction are read", limit = Texture::SIDE_LIMIT)]
    TooLarge(u32, u32),
}

impl Texture {
    /// The longest side that is read, in texels.
    pub const SIDE_LIMIT: u32 = 16384;

    /// One texel of this colour.
    #[must_use]
    pub fn plain(color: Linear) -> Self {
        Self { levels: vec![Level { width: 1, height: 1, texels: vec![color] }] }
    }

    /// Reads a PNG of any kind. What is transparent is laid over white.
    ///
    /// # Errors
    /// See [`TextureError`].
    pub fn read_png(input: impl BufRead + Seek) -> Result<Self, TextureError> {
        let mut decoder = png::Decoder::new(input);
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info()?;
        let (width, height) = reader.info().size();
        if width.max(height) > Self::SIDE_LIMIT {
            return Err(TextureError::TooLarge(width, height));
        }
        let mut bytes = vec![0; reader.output_buffer_size().ok_or(TextureError::TooLarge(width, height))?];
        let frame = reader.next_frame(&mut bytes)?;
        let samples = frame.color_type.samples();
        let texels = bytes[..frame.buffer_size()].chunks_exact(samples).map(|texel| match *texel {
            [grey] => Linear::from(Rgba([grey, grey, grey, 255])),
            [grey, alpha] => over_white([grey, grey, grey, alpha]),
            [r, g, b] => Linear::from(Rgba([r, g, b, 255])),
            [r, g, b, alpha] => over_white([r, g, b, alpha]),
            _ => Linear::default(),
        });
        let full = Level { width: width as usize, height: height as usize, texels: texels.collect() };
        Ok(Self::with_copies(full))
    }

    /// The mean of all texels.
    #[must_use]
    pub fn mean(&self) -> Linear {
        self.levels.last().and_then(|level| level.texels.first()).copied().unwrap_or_default()
    }

    fn with_copies(full: Level) -> Self {
        let mut levels = vec![full];
        while let Some(half) = levels.last().and_then(Level::half) {
            levels.push(half);
        }
        Self { levels }
    }

    /// The copy whose texels are about as large as pixels, where this area of UV covers so many pixels.
    pub(super) fn level(&self, uv_area: f32, pixels: f32) -> usize {
        let full = &self.levels[0];
        let texels_a_pixel = uv_area * (full.width * full.height) as f32 / pixels.max(1e-6);
        // Half a level finer than one texel a pixel: samples within the pixel average the rest.
        let level = 0.5 * texels_a_pixel.max(1.0).log2() - 1.0;
        (level.max(0.0).round() as usize).min(self.levels.len() - 1)
    }

    /// The colour at a UV, bilinear between texels; (0, 0) is the lower left corner of the image.
    pub(super) fn color(&self, u: f32, v: f32, level: usize) -> Linear {
        let level = &self.levels[level];
        let wrap = |x: f32, count: usize| {
            let x = (x - x.floor()) * count as f32 - 0.5;
            let low = x.floor();
            let first = (low as i64).rem_euclid(count as i64) as usize;
            (first, (first + 1) % count, x - low)
        };
        let (left, right, x) = wrap(u, level.width);
        let (top, bottom, y) = wrap(1.0 - v, level.height);
        let at = |column: usize, row: usize| level.texels[row * level.width + column];
        at(left, top).mix(at(right, top), x).mix(at(left, bottom).mix(at(right, bottom), x), y)
    }
}

impl Level {
    /// The mean of two by two texels; nothing when there is only one.
    fn half(&self) -> Option<Self> {
        if self.width * self.height <= 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mean = |i: usize| {
            let (x, y) = (i % width * self.width / width, i / width * self.height / height);
            let at = |dx: usize, dy: usize| {
                self.texels[(y + dy).min(self.height - 1) * self.width + (x + dx).min(self.width - 1)]
            };
            at(0, 0).mix(at(1, 0), 0.5).mix(at(0, 1).mix(at(1, 1), 0.5), 0.5)
        };
        Some(Self { width, height, texels: (0..width * height).map(mean).collect() })
    }
}

fn over_white([r, g, b, alpha]: [u8; 4]) -> Linear {
    Linear([1.0; 3]).mix(Linear::from(Rgba([r, g, b, 255])), f32::from(alpha) / 255.0)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::super::canvas::Canvas;
    use super::*;

    fn two_by_two() -> Texture {
        let mut canvas = Canvas::new(2, 2, Rgba([0, 0, 0, 255]));
        canvas.fill([0, 0], [1, 1], Linear([1.0, 0.0, 0.0]));
        canvas.fill([1, 1], [1, 1], Linear([0.0, 0.0, 1.0]));
        let mut file = Vec::new();
        canvas.write_png(&mut file).unwrap();
        Texture::read_png(Cursor::new(file)).unwrap()
    }

    /// v points up: the upper left pixel is at u small, v large. Beyond the square the image repeats.
    #[test]
    fn images_stand_upright() {
        let texture = two_by_two();
        for shift in [-3.0, 0.0, 5.0] {
            assert_eq!(texture.color(0.25 + shift, 0.75 - shift, 0), Linear([1.0, 0.0, 0.0]));
            assert_eq!(texture.color(0.75 - shift, 0.25 + shift, 0), Linear([0.0, 0.0, 1.0]));
            assert_eq!(texture.color(0.25 + shift, 0.25, 0), Linear::default());
        }
    }

    /// From afar an image is its mean.
    #[test]
    fn the_last_copy_is_the_mean() {
        let texture = two_by_two();
        let level = texture.level(1.0, 1e-3);
        assert_eq!((level, texture.level(1.0, 4.0)), (1, 0));
        assert_eq!(texture.color(0.1, 0.9, level), Linear([0.25, 0.0, 0.25]));
    }

    #[test]
    fn what_is_no_png_is_refused() {
        assert!(matches!(Texture::read_png(Cursor::new(b"GIF89a")), Err(TextureError::Decode(_))));
    }
}
