//! The picture of a surface: tiles in parallel, each with its samples, then light, paint and lines.

use qoptimize::qmesh::{Vec2, Vec3};
use rayon::prelude::*;

use super::bins::{Bins, Span, tile};
use super::camera::{Camera, Projection, Seen, UpAxis, View};
use super::canvas::Canvas;
use super::color::{Linear, Rgba};
use super::model::{Model, Patch};
use super::paint::{Ink, Lines, Paint, PatchPaint};
use super::raster::{NOTHING, OFFSETS, SAMPLES, Sample, TILE, Tile};
use super::text::distance;

/// How a surface is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// From where.
    pub view: View,
    /// Which axis points up.
    pub up: UpAxis,
    /// How distance makes things smaller.
    pub projection: Projection,
    /// Width and height in pixels, neither of them 0.
    pub size: [usize; 2],
    /// What is seen where there is no surface.
    pub background: Rgba,
    /// How much light and shade change the paint: 0 not at all, 1 as on plaster.
    pub relief: f32,
}

/// A picture of `model` in these colours. The same for any number of threads.
#[must_use]
pub fn render(model: &Model<'_>, paint: &Paint<'_>, lines: &Lines, shot: &Shot) -> Canvas {
    let used = model.used_positions();
    let camera = Camera::framing(&used, shot.view, shot.up, shot.projection, shot.size);
    Stage::new(model, paint, lines, camera, shot.relief).draw(shot.size, shot.background)
}

/// The same without light and shade, for a camera that looks at the plane.
pub(super) fn render_with(
    model: &Model<'_>,
    paint: &Paint<'_>,
    lines: &Lines,
    camera: Camera,
    size: [usize; 2],
    background: Rgba,
) -> Canvas {
    Stage::new(model, paint, lines, camera, 0.0).draw(size, background)
}

/// Everything that tiles share.
struct Stage<'a> {
    model: &'a Model<'a>,
    paint: &'a Paint<'a>,
    lines: &'a Lines,
    camera: Camera,
    relief: f32,
    /// Each vertex in the picture.
    seen: Vec<Seen>,
}

/// The samples of one pixel that see one patch.
struct Group {
    patch: u32,
    /// A bit a sample.
    mask: u16,
    /// Mean place in the patch.
    s: f32,
    t: f32,
}

impl<'a> Stage<'a> {
    fn new(
        model: &'a Model<'a>,
        paint: &'a Paint<'a>,
        lines: &'a Lines,
        camera: Camera,
        relief: f32,
    ) -> Self {
        let seen = model.positions.par_iter().map(|position| camera.see(position)).collect();
        Self { model, paint, lines, camera, relief, seen }
    }

    fn draw(&self, [width, height]: [usize; 2], background: Rgba) -> Canvas {
        let columns = width.div_ceil(TILE);
        let bins = self.bins(columns, height.div_ceil(TILE));
        let mut canvas = Canvas::new(width, height, background);
        let bands = canvas.pixels_mut().par_chunks_mut(width * TILE).enumerate();
        bands.for_each_init(Tile::new, |tile, (row, band)| {
            let mut seen = bins.band(row);
            for column in 0..columns {
                let (left, top) = (column * TILE, row * TILE);
                let patches = seen.patches(column);
                if patches.len() == 0 {
                    continue;
                }
                let size = [(width - left).min(TILE), (height - top).min(TILE)];
                tile.place(left, top, size[0], size[1]);
                for patch in patches {
                    let shape = &self.model.patches[patch as usize];
                    tile.draw(patch, shape, &self.corners(shape));
                }
                for (y, x) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (y, x))) {
                    let place = Vec2::new((left + x) as f64, (top + y) as f64);
                    self.resolve(tile.pixel(x, y), place, &mut band[y * width + left + x]);
                }
            }
        });
        canvas
    }

    /// Where the boxes around the patches are, in tiles.
    fn bins(&self, columns: usize, rows: usize) -> Bins {
        let span = |patch: &Patch| {
            let corners = self.corners(patch).map(|corner| corner.place / TILE as f64);
            let low = corners.iter().fold(corners[0], |a, b| a.inf(b));
            let high = corners.iter().fold(corners[0], |a, b| a.sup(b));
            Span {
                columns: [tile(low.x, columns), tile(high.x, columns)],
                rows: [tile(low.y, rows), tile(high.y, rows)],
            }
        };
        Bins::new(self.model.patches.par_iter().map(span).collect())
    }

    fn corners(&self, patch: &Patch) -> [Seen; 4] {
        let last = patch.degree() - 1;
        std::array::from_fn(|i| {
            let corner = patch.corners[i.min(last)];
            self.seen[self.model.polygons.corner_vertex[corner as usize] as usize]
        })
    }

    /// Mixes what the samples of a pixel see over what is there.
    fn resolve(&self, samples: &[Sample], place: Vec2, pixel: &mut [f32; 4]) {
        let mut left: u16 = 0;
        for (i, sample) in samples.iter().enumerate() {
            left |= u16::from(sample.patch != NOTHING) << i;
        }
        let uncovered = 1.0 - left.count_ones() as f32 / SAMPLES as f32;
        if left == 0 {
            return;
        }
        let mut sum = [0.0_f32; 3];
        while left != 0 {
            let group = Group::first(samples, left);
            left &= !group.mask;
            let light = self.shade(&group, samples, place);
            (0..3).for_each(|i| sum[i] += light.0[i]);
        }
        let share = 1.0 / SAMPLES as f32;
        *pixel = std::array::from_fn(|i| {
            let seen = if i < 3 { sum[i] * share } else { 1.0 - uncovered };
            pixel[i] * uncovered + seen
        });
    }

    /// The sum of the group's samples.
    fn shade(&self, group: &Group, samples: &[Sample], place: Vec2) -> Linear {
        let patch = &self.model.patches[group.patch as usize];
        let corners = self.corners(patch);
        let pixels = screen_area(&corners, patch.degree());
        let paint = self.paint.of(patch, pixels);
        let light = self.light(patch, group);
        let edges = Edges::new(self, patch, &corners, pixels, place);
        let mut sum = [0.0_f32; 3];
        if let (PatchPaint::Plain(color), true) = (&paint, edges.is_empty()) {
            return light.on(*color).times(group.mask.count_ones() as f32);
        }
        for i in (0..SAMPLES).filter(|i| group.mask >> i & 1 == 1) {
            let Sample { s, t, .. } = samples[i];
            let color = light.on(paint.color(patch.shares(s, t)));
            let color = edges.over(color, Vec2::new(OFFSETS[i][0], OFFSETS[i][1]));
            (0..3).for_each(|k| sum[k] += color.0[k]);
        }
        Linear(sum)
    }

    fn light(&self, patch: &Patch, group: &Group) -> Light {
        if self.relief <= 0.0 {
            return Light { factor: 1.0, is_back: false };
        }
        let shares = patch.shares(group.s, group.t);
        let (mut normal, mut position) = (Vec3::zeros(), Vec3::zeros());
        for (&corner, share) in patch.corners[..patch.degree()].iter().zip(shares.map(f64::from)) {
            normal += Vec3::from(self.model.normals[corner as usize].map(f64::from)) * share;
            position += self.model.position(corner) * share;
        }
        let towards = self.camera.towards(&position);
        let is_back = self.outward(patch, group).dot(&towards) < 0.0;
        let normal = normal.try_normalize(0.0).unwrap_or(towards) * if is_back { -1.0 } else { 1.0 };
        let [right, up, back] = self.camera.axes;
        // A lamp over the left shoulder, a weaker one from the right, and light from everywhere.
        let key = (back * 0.8 - right * 0.5 + up * 0.55).normalize().dot(&normal).max(0.0);
        let fill = (back * 0.6 + right * 0.8).normalize().dot(&normal).max(0.0);
        let plaster = (0.16 + 0.80 * key + 0.14 * fill) as f32;
        Light { factor: 1.0 + (plaster - 1.0) * self.relief, is_back }
    }

    /// The normal of the patch itself, which decides on its side, not that of the smoothed surface.
    fn outward(&self, patch: &Patch, group: &Group) -> Vec3 {
        let at = |i: usize| self.model.position(patch.corners[i]);
        if patch.degree() == 3 {
            return (at(1) - at(0)).cross(&(at(2) - at(0)));
        }
        let (s, t) = (f64::from(group.s), f64::from(group.t));
        let along_s = (at(1) - at(0)) * (1.0 - t) + (at(2) - at(3)) * t;
        let along_t = (at(3) - at(0)) * (1.0 - s) + (at(2) - at(1)) * s;
        along_s.cross(&along_t)
    }
}

/// How bright a place is, and whether its back is seen.
struct Light {
    factor: f32,
    is_back: bool,
}

impl Light {
    fn on(&self, color: Linear) -> Linear {
        if self.is_back {
            // The inside of a surface is duller, so that it is not taken for the outside.
            return color.mix(Linear([0.12, 0.11, 0.10]), 0.6).times(self.factor);
        }
        color.times(self.factor)
    }
}

impl Group {
    /// The samples that see the same patch as the first of those that are left.
    fn first(samples: &[Sample], left: u16) -> Self {
        let patch = samples[left.trailing_zeros() as usize].patch;
        let mut group = Self { patch, mask: 0, s: 0.0, t: 0.0 };
        for (i, sample) in samples.iter().enumerate() {
            if left >> i & 1 == 1 && sample.patch == patch {
                group.mask |= 1 << i;
                group.s += sample.s;
                group.t += sample.t;
            }
        }
        let count = group.mask.count_ones() as f32;
        group.s /= count;
        group.t /= count;
        group
    }
}

fn screen_area(corners: &[Seen; 4], degree: usize) -> f32 {
    let (a, b, c, d) = (corners[0].place, corners[1].place, corners[2].place, corners[3].place);
    let doubled = if degree == 3 { (b - a).perp(&(c - a)) } else { (c - a).perp(&(d - b)) };
    (doubled.abs() / 2.0) as f32
}

/// The lines of a patch near a pixel.
struct Edges<'a> {
    near: [Option<(Vec2, Vec2, &'a Ink, f32)>; 4],
}

impl<'a> Edges<'a> {
    /// `place` is the pixel's upper left corner; `pixels` how many the patch covers.
    fn new(stage: &'a Stage<'_>, patch: &Patch, corners: &[Seen; 4], pixels: f32, place: Vec2) -> Self {
        let (lines, polygons) = (stage.lines, stage.model.polygons);
        let mut near = [None; 4];
        if lines.of_corner.is_empty() {
            return Self { near };
        }
        let degree = patch.degree();
        for i in 0..degree {
            let (here, next) = (patch.corners[i], patch.corners[(i + 1) % degree]);
            // A cut through a face is no edge of it.
            let face = polygons.corners(patch.face as usize);
            let after = if here as usize + 1 == face.end { face.start as u32 } else { here + 1 };
            let Some(ink) = lines.ink(here).filter(|_| next == after) else { continue };
            let (a, b) = (corners[i].place - place, corners[(i + 1) % degree].place - place);
            let strength = if ink.fades { faded(ink, pixels) } else { ink.strength };
            let reach = f64::from(ink.width) / 2.0 + 1.0;
            if strength > 0.0 && distance(Vec2::new(0.5, 0.5), a, b) <= reach {
                near[i] = Some((a, b, ink, strength));
            }
        }
        Self { near }
    }

    fn is_empty(&self) -> bool {
        self.near.iter().all(Option::is_none)
    }

    /// `color` with the lines that pass this place of the pixel over it.
    fn over(&self, color: Linear, place: Vec2) -> Linear {
        let passing = self.near.iter().flatten();
        let hit = passing.filter(|(a, b, ink, _)| distance(place, *a, *b) <= f64::from(ink.width) / 2.0);
        // Lines that do not fade, seams and outlines, lie over those that do.
        let strongest = hit.max_by_key(|(_, _, ink, _)| !ink.fades);
        strongest.map_or(color, |(_, _, ink, strength)| color.mix(ink.color, *strength))
    }
}

/// Lines around small faces fade, and around very small ones they go: they would only make everything dark.
fn faded(ink: &Ink, pixels: f32) -> f32 {
    let side = pixels.sqrt() / ink.width;
    if side < 1.5 { 0.0 } else { ink.strength * ((side - 1.0) / 6.0).clamp(0.12, 1.0) }
}
