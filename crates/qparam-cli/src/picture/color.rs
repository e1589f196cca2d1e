//! Colours: linear light for computing, sRGB bytes for files, and Oklab for colours that look evenly spaced.
//!
//! (Ottosson 2020): B. Ottosson, A perceptual color space for image processing, 2020. The matrices are his.

use std::fmt;
use std::str::FromStr;

/// Linear light, each channel in [0, 1]: what adds up when light is mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear(pub [f32; 3]);

/// sRGB with opacity, a byte each: what files hold. Not premultiplied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgba(pub [u8; 4]);

impl Linear {
    /// This much of the light.
    #[must_use]
    pub fn times(self, factor: f32) -> Self {
        Self(self.0.map(|channel| channel * factor))
    }

    /// From this colour (0) to `other` (1).
    #[must_use]
    pub fn mix(self, other: Self, share: f32) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + (other.0[i] - self.0[i]) * share))
    }

    /// Opaque, in bytes.
    #[must_use]
    pub fn to_rgba(self) -> Rgba {
        let [r, g, b] = self.0.map(encode);
        Rgba([r, g, b, 255])
    }
}

impl From<Rgba> for Linear {
    fn from(color: Rgba) -> Self {
        let [r, g, b, _] = color.0;
        Self([r, g, b].map(decode))
    }
}

/// An sRGB byte as linear light.
#[must_use]
pub fn decode(byte: u8) -> f32 {
    let x = f32::from(byte) / 255.0;
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// Linear light as the nearest sRGB byte.
#[must_use]
pub fn encode(light: f32) -> u8 {
    let x = light.clamp(0.0, 1.0);
    let x = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (x * 255.0).round() as u8
}

/// A colour of this Oklab lightness (0 to 1), chroma and hue (degrees); chroma is lowered until sRGB has the colour.
#[must_use]
pub fn oklch(lightness: f32, chroma: f32, hue: f32) -> Linear {
    let mut chroma = chroma;
    loop {
        let (sin, cos) = hue.to_radians().sin_cos();
        let color = oklab_to_linear([lightness, chroma * cos, chroma * sin]);
        let is_inside = color.iter().all(|channel| (-1e-4..=1.0 + 1e-4).contains(channel));
        if is_inside || chroma < 1e-3 {
            return Linear(color.map(|channel| channel.clamp(0.0, 1.0)));
        }
        chroma *= 0.97;
    }
}

fn oklab_to_linear([l, a, b]: [f32; 3]) -> [f32; 3] {
    let cube = |x: f32| x * x * x;
    let long = cube(l + 0.396_337_78 * a + 0.215_803_76 * b);
    let medium = cube(l - 0.105_561_346 * a - 0.063_854_17 * b);
    let short = cube(l - 0.089_484_18 * a - 1.291_485_5 * b);
    [
        4.076_741_7 * long - 3.307_711_6 * medium + 0.230_969_94 * short,
        -1.268_438 * long + 2.609_757_4 * medium - 0.341_319_38 * short,
        -0.004_196_086_3 * long - 0.703_418_6 * medium + 1.707_614_7 * short,
    ]
}

/// Oklab lightness, 0 for black and 1 for white.
#[must_use]
pub fn lightness(color: Linear) -> f32 {
    let [r, g, b] = color.0;
    let long = (0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b).cbrt();
    let medium = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b).cbrt();
    let short = (0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b).cbrt();
    0.210_454_26 * long + 0.793_617_8 * medium - 0.004_072_047 * short
}

/// The `n`-th of colours that are easy to tell apart: hues by the golden angle, at two lightnesses.
#[must_use]
pub fn category(n: usize) -> Linear {
    const GOLDEN_ANGLE: f32 = 137.507_77;
    let lightness = if n.is_multiple_of(2) { 0.72 } else { 0.58 };
    oklch(lightness, 0.15, (250.0 + GOLDEN_ANGLE * (n % 1000) as f32) % 360.0)
}

/// The colour of island `n` beside seams that have the colours of [`category`].
#[must_use]
pub fn pale(n: usize) -> Linear {
    Linear([1.0; 3]).mix(category(n), 0.4)
}

impl Rgba {
    /// Nothing at all.
    pub const CLEAR: Self = Self([0, 0, 0, 0]);

    /// `#rrggbb`.
    #[must_use]
    pub fn hex(self) -> String {
        let [r, g, b, _] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

impl fmt::Display for Rgba {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [.., alpha] = self.0;
        f.write_str(&self.hex())?;
        if alpha == 255 { Ok(()) } else { write!(f, "{alpha:02x}") }
    }
}

impl FromStr for Rgba {
    type Err = String;

    /// `#rgb`, `#rrggbb`, `#rrggbbaa`, `white`, `black`, `gray`, `transparent`.
    fn from_str(text: &str) -> Result<Self, String> {
        let refuse =
            || format!("`{text}` is no colour: write #rrggbb, #rrggbbaa, white, black, gray or transparent");
        match text {
            "white" => return Ok(Self([255, 255, 255, 255])),
            "black" => return Ok(Self([0, 0, 0, 255])),
            "gray" | "grey" => return Ok(Self([128, 128, 128, 255])),
            "transparent" => return Ok(Self::CLEAR),
            _ => {}
        }
        let digits: Vec<u8> = text
            .strip_prefix('#')
            .ok_or_else(refuse)?
            .chars()
            .map(|digit| digit.to_digit(16).map(|digit| digit as u8).ok_or_else(refuse))
            .collect::<Result<_, _>>()?;
        match *digits.as_slice() {
            [r, g, b] => Ok(Self([r * 17, g * 17, b * 17, 255])),
            [r, rr, g, gg, b, bb] => Ok(Self([r * 16 + rr, g * 16 + gg, b * 16 + bb, 255])),
            [r, rr, g, gg, b, bb, a, aa] => Ok(Self([r * 16 + rr, g * 16 + gg, b * 16 + bb, a * 16 + aa])),
            _ => Err(refuse()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every byte survives the way to linear light and back.
    #[test]
    fn bytes_survive_linear_light() {
        assert!((0..=255).all(|byte| encode(decode(byte)) == byte));
    }

    /// Chroma and hue leave the lightness as it is: that is what Oklab is for.
    #[test]
    fn lightness_is_what_was_asked_for() {
        for hue in 0..24 {
            let color = oklch(0.6, 0.12, hue as f32 * 15.0);
            assert!((lightness(color) - 0.6).abs() < 2e-3, "hue {}: {}", hue * 15, lightness(color));
        }
    }

    #[test]
    fn colours_are_read_as_people_write_them() {
        let read = |text: &str| text.parse::<Rgba>().map(|color| color.to_string());
        assert_eq!(read("#1e90ff").as_deref(), Ok("#1e90ff"));
        assert_eq!(read("#fff").as_deref(), Ok("#ffffff"));
        assert_eq!(read("transparent").as_deref(), Ok("#00000000"));
        assert_eq!(read("#11223380").as_deref(), Ok("#11223380"));
        assert!(["", "#12", "#ggg", "red!", "#é"].iter().all(|text| read(text).is_err()));
    }
}
