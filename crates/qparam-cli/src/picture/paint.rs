//! What a surface is painted with, and the lines on it.

use qoptimize::qmesh::Vec2;

use super::color::Linear;
use super::model::Patch;
use super::texture::Texture;

/// What a surface is painted with.
#[derive(Clone, Debug)]
pub enum Paint<'a> {
    /// One colour.
    Plain(Linear),
    /// A colour for each face.
    Faces(&'a [Linear]),
    /// Two colours by turns in squares of the UV plane.
    Checker {
        /// One a corner.
        uv: &'a [Vec2],
        /// Checks a unit of UV.
        per_unit: f64,
        /// Where the check between 0 and 1 has this colour; then the other one.
        colors: [Linear; 2],
    },
    /// An image for each face; it repeats beyond the unit square.
    Textures {
        /// One a corner.
        uv: &'a [Vec2],
        /// Which one of `textures` each face has.
        of_face: &'a [u32],
        /// The images.
        textures: &'a [Texture],
    },
}

/// A kind of line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// Its colour.
    pub color: Linear,
    /// From 0 (nothing) to 1.
    pub strength: f32,
    /// In pixels of the picture.
    pub width: f32,
    /// Whether it fades where faces are not much larger than the line is wide.
    pub fades: bool,
}

/// Lines along edges of faces, drawn half on each face that has the edge.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    /// The kinds of line.
    pub inks: Vec<Ink>,
    /// For each corner, which ink the edge to the next corner has, from 1; 0 for none. Empty for no lines.
    pub of_corner: Vec<u32>,
}

impl Lines {
    /// The ink of the edge that leaves `corner`.
    pub(super) fn ink(&self, corner: u32) -> Option<&Ink> {
        let number = *self.of_corner.get(corner as usize)?;
        self.inks.get((number as usize).checked_sub(1)?)
    }
}

/// A patch whose paint has been looked up: all that is left depends on where in the patch.
pub(super) enum PatchPaint<'a> {
    Plain(Linear),
    Checker { uv: [[f32; 2]; 4], colors: [Linear; 2] },
    Texture { uv: [[f32; 2]; 4], texture: &'a Texture, level: usize },
}

impl Paint<'_> {
    /// `pixels` is about how many pixels the patch covers, for choosing how much of an image's detail is seen.
    pub(super) fn of(&self, patch: &Patch, pixels: f32) -> PatchPaint<'_> {
        match self {
            Self::Plain(color) => PatchPaint::Plain(*color),
            Self::Faces(colors) => PatchPaint::Plain(colors[patch.face as usize]),
            Self::Checker { uv, per_unit, colors } => {
                // Whole pairs of checks are taken away, so that `f32` has its digits for the place within one.
                let at = |corner: u32| uv[corner as usize] * *per_unit;
                let origin = at(patch.corners[0]).map(|x| 2.0 * (x / 2.0).floor());
                PatchPaint::Checker { uv: near(patch, origin, at), colors: *colors }
            }
            Self::Textures { uv, of_face, textures } => {
                let texture = &textures[of_face[patch.face as usize] as usize];
                let at = |corner: u32| uv[corner as usize];
                let corners = near(patch, at(patch.corners[0]).map(f64::floor), at);
                let area = match patch.degree() {
                    3 => 0.5 * cross(corners, [0, 1], [0, 2]),
                    _ => 0.5 * cross(corners, [0, 2], [1, 3]),
                };
                PatchPaint::Texture { uv: corners, texture, level: texture.level(area.abs(), pixels) }
            }
        }
    }
}

fn near(patch: &Patch, origin: Vec2, at: impl Fn(u32) -> Vec2) -> [[f32; 2]; 4] {
    let mut corners = [[0.0; 2]; 4];
    for (place, &corner) in corners.iter_mut().zip(&patch.corners[..patch.degree()]) {
        let uv = at(corner) - origin;
        *place = [uv.x as f32, uv.y as f32];
    }
    corners
}

fn cross(p: [[f32; 2]; 4], [a, b]: [usize; 2], [c, d]: [usize; 2]) -> f32 {
    let edge = |from: usize, to: usize| [p[to][0] - p[from][0], p[to][1] - p[from][1]];
    let ([x, y], [z, w]) = (edge(a, b), edge(c, d));
    x * w - y * z
}

impl PatchPaint<'_> {
    /// The colour where the corners have these shares.
    pub(super) fn color(&self, shares: [f32; 4]) -> Linear {
        let mix = |uv: &[[f32; 2]; 4]| -> [f32; 2] {
            std::array::from_fn(|axis| (0..4).map(|i| shares[i] * uv[i][axis]).sum())
        };
        match self {
            Self::Plain(color) => *color,
            Self::Checker { uv, colors } => {
                let [u, v] = mix(uv);
                colors[((u.floor() as i64 + v.floor() as i64) & 1) as usize]
            }
            Self::Texture { uv, texture, level } => {
                let [u, v] = mix(uv);
                texture.color(u, v, *level)
            }
        }
    }
}
