//! A picture in memory: linear light with coverage, and PNG bytes.

use std::io::{self, Write};

use qoptimize::qmesh::Vec2;

use super::color::{Linear, Rgba, encode};

/// Pixels in rows from the top; linear light premultiplied with opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 4]>,
}

impl Canvas {
    /// Filled with one colour.
    #[must_use]
    pub fn new(width: usize, height: usize, background: Rgba) -> Self {
        Self { width, height, pixels: vec![premultiplied(background); width * height] }
    }

    /// In pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// In pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The rows, from the top: `width` values each.
    pub(super) fn pixels_mut(&mut self) -> &mut [[f32; 4]] {
        &mut self.pixels
    }

    /// Lays `color` over a pixel with this share of its opacity; outside the picture nothing happens.
    pub fn blend(&mut self, x: i64, y: i64, color: Linear, share: f32) {
        let inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        if inside && share > 0.0 {
            let pixel = &mut self.pixels[y as usize * self.width + x as usize];
            for (channel, light) in pixel.iter_mut().zip([color.0[0], color.0[1], color.0[2], 1.0]) {
                *channel += (light - *channel) * share.min(1.0);
            }
        }
    }

    /// A level or upright line of this width in pixels, with smooth sides.
    pub fn straight(&mut self, a: Vec2, b: Vec2, width: f64, color: Linear, strength: f32) {
        let (low, high) = (a.inf(&b), a.sup(&b));
        let is_upright = high.x - low.x < high.y - low.y;
        let half = if is_upright { Vec2::new(width / 2.0, 0.0) } else { Vec2::new(0.0, width / 2.0) };
        let limit = Vec2::new(self.width as f64, self.height as f64);
        let (low, high) = ((low - half).sup(&Vec2::zeros()), (high + half).inf(&limit));
        let overlap = |i: i64, low: f64, high: f64| ((i + 1) as f64).min(high) - (i as f64).max(low);
        for y in low.y.floor() as i64..high.y.ceil() as i64 {
            for x in low.x.floor() as i64..high.x.ceil() as i64 {
                let share = overlap(x, low.x, high.x).max(0.0) * overlap(y, low.y, high.y).max(0.0);
                self.blend(x, y, color, share as f32 * strength);
            }
        }
    }

    /// Fills a rectangle; what lies outside the picture is left out.
    pub fn fill(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], color: Linear) {
        for y in top..(top + height).min(self.height) {
            for x in left..(left + width).min(self.width) {
                self.pixels[y * self.width + x] = [color.0[0], color.0[1], color.0[2], 1.0];
            }
        }
    }

    /// Puts another picture in the place of what is there, with its upper left corner there.
    pub fn put(&mut self, other: &Self, [left, top]: [usize; 2]) {
        let width = other.width.min(self.width.saturating_sub(left));
        for y in 0..other.height.min(self.height.saturating_sub(top)) {
            let start = (top + y) * self.width + left;
            self.pixels[start..start + width].copy_from_slice(&other.pixels[y * other.width..][..width]);
        }
    }

    /// sRGB with opacity, four bytes a pixel.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        let table = EncodeTable::new();
        self.pixels
            .iter()
            .flat_map(|&[r, g, b, alpha]| {
                let light = |channel: f32| if alpha > 0.0 { table.encode(channel / alpha) } else { 0 };
                [light(r), light(g), light(b), (alpha.clamp(0.0, 1.0) * 255.0).round() as u8]
            })
            .collect()
    }

    /// Writes the picture as PNG: without opacity when it is opaque everywhere.
    ///
    /// # Errors
    /// What `out` reports, and pictures without a pixel.
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        let mut bytes = self.bytes();
        let is_opaque = bytes.chunks_exact(4).all(|pixel| pixel[3] == 255);
        if is_opaque {
            bytes = bytes.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        }
        let mut encoder = png::Encoder::new(out, self.width as u32, self.height as u32);
        encoder.set_color(if is_opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        Ok(writer.finish()?)
    }
}

fn premultiplied(color: Rgba) -> [f32; 4] {
    let alpha = f32::from(color.0[3]) / 255.0;
    let Linear([r, g, b]) = Linear::from(color).times(alpha);
    [r, g, b, alpha]
}

/// [`encode`] without a power for each pixel: the nearest of 8192 lights decides, which is at most a byte off.
struct EncodeTable(Vec<u8>);

impl EncodeTable {
    const LAST: f32 = 8191.0;

    fn new() -> Self {
        // Steps that are even in √light: dark tones, where sRGB is steep, get their share.
        Self((0..=Self::LAST as usize).map(|i| encode((i as f32 / Self::LAST).powi(2))).collect())
    }

    fn encode(&self, light: f32) -> u8 {
        self.0[(light.clamp(0.0, 1.0).sqrt() * Self::LAST).round() as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::super::color::decode;
    use super::*;

    /// The table gives every byte back from its own light.
    #[test]
    fn the_table_is_exact_on_bytes() {
        let table = EncodeTable::new();
        assert!((0..=255).all(|byte| table.encode(decode(byte)) == byte));
    }

    /// A PNG read back has the same pixels, with and without opacity.
    #[test]
    fn png_gives_the_pixels_back() {
        for background in [Rgba([30, 60, 90, 255]), Rgba([200, 100, 0, 128]), Rgba::CLEAR] {
            let mut canvas = Canvas::new(3, 2, background);
            canvas.blend(1, 1, Linear::from(Rgba([255, 255, 255, 255])), 1.0);
            canvas.blend(-1, 7, Linear::default(), 1.0);
            let mut file = Vec::new();
            canvas.write_png(&mut file).unwrap();
            let mut reader = png::Decoder::new(io::Cursor::new(file)).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            let step = info.color_type.samples();
            assert_eq!(step == 3, background.0[3] == 255);
            let expected = canvas.bytes();
            assert!((0..6).all(|i| pixels[i * step..][..step] == expected[i * 4..][..step]));
            assert_eq!(expected[4 * 4..][..4], [255; 4]);
        }
    }
}
