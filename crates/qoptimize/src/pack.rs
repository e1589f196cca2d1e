//! Packing islands into the unit square, exactly without overlaps.
//!
//! Islands are neither turned nor mirrored, since they stand upright already. Each is covered, with half the margin
//! around it, by cells of a grid; covers are placed one after the other, large ones first, in the lowest row and there
//! at the leftmost place where no cell is taken, which fills the holes of large islands with small ones. All places in a
//! row are tested at once, 64 to a machine word. What counts as large is tried in several ways, lying and standing
//! (`pack/order.rs`), as long as there are few islands. The largest scale at which all find a place is found by bisection.
//!
//! The cover contains its island with a slack of a millionth of a cell, far more than coordinates round: islands whose
//! covers share no cell do not overlap, and lie a margin apart.

mod bitmap;
mod cover;
mod order;

use qembed::qmesh::Vec2;
use rayon::prelude::*;

use self::bitmap::Bitmap;
use self::cover::Cover;
use self::order::Order;

/// How islands are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct PackOptions {
    /// Texels along a side of the unit square, at least 1. Default 2048.
    pub resolution: u32,
    /// Texels between islands at least, and half as many to the edges of the square; at least 0. Default 4.
    pub margin: f64,
}

impl Default for PackOptions {
    fn default() -> Self {
        Self { resolution: 2048, margin: 4.0 }
    }
}

/// An island in the plane: the corners of its faces, in any unit.
#[derive(Clone, Copy, Debug)]
pub struct Shape<'a> {
    /// Where each face's corners start, and one entry more for the end.
    pub face_start: &'a [u32],
    /// One position per corner, face after face.
    pub uv: &'a [Vec2],
}

impl Shape<'_> {
    /// The area of the island, faces taken as they are.
    #[must_use]
    pub fn area(&self) -> f64 {
        let face = |range: &[u32]| {
            let corners = &self.uv[range[0] as usize..range[1] as usize];
            let fan =
                corners.windows(2).skip(1).map(|pair| (pair[0] - corners[0]).perp(&(pair[1] - corners[0])));
            0.5 * fan.sum::<f64>().abs()
        };
        self.face_start.windows(2).map(face).sum()
    }
}

/// Where islands are put: `scale · p + offset`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Packed {
    /// The same for all islands.
    pub scale: f64,
    /// One per island.
    pub offsets: Vec<Vec2>,
    /// The margin that was kept, in texels: less than was asked for when so many islands leave no room for it.
    pub margin: f64,
    /// Width and height of the layout; at most 1 when it was fitted.
    pub extent: Vec2,
}

/// Attempts of the bisection; each halves what is known of the logarithm of the scale.
const ATTEMPTS: usize = 6;

/// Packs islands into the unit square at the largest scale for which this way finds room for all.
///
/// Islands should be finite; one that is a point takes a cell.
#[must_use]
pub fn pack(shapes: &[Shape<'_>], options: &PackOptions) -> Packed {
    let boxes: Vec<[Vec2; 2]> = shapes.iter().map(bounds).collect();
    let margin = options.margin / f64::from(options.resolution);
    if let [only] = boxes[..] {
        return center(only, margin, options);
    }
    let side = cells(shapes.len());
    let mut margin_cells = margin * f64::from(side);
    // So many islands that the margins alone would fill the square get smaller ones.
    let most = 0.5 * f64::from(side) / (shapes.len() as f64).sqrt();
    margin_cells = margin_cells.min(most);
    let largest = largest_scale(shapes, &boxes, margin_cells, side);
    let attempt = |scale: f64| place(shapes, &boxes, scale, margin_cells, side, Some(side));
    let (mut low, mut high) = (largest * 0.8, largest);
    let mut best = None;
    while best.is_none() && low > largest * 1e-9 {
        best = attempt(low).map(|places| (low, places));
        if best.is_none() {
            (low, high) = (0.8 * low, low);
        }
    }
    let (mut scale, mut places) = best.unwrap_or_else(|| (low, vec![[0, 0]; shapes.len()]));
    for _ in 0..if shapes.len() > order::FEW { ATTEMPTS - 2 } else { ATTEMPTS } {
        let middle = (scale * high).sqrt();
        match attempt(middle) {
            Some(found) => (scale, places) = (middle, found),
            None => high = middle,
        }
    }
    let unit = f64::from(side).recip();
    finish(&boxes, &places, scale * unit, unit, margin_cells, options)
}

/// No larger scale has room, in cells to a unit: neither for the widest island, nor for the area of all with half the margin
/// around them. For an island that hangs together the latter is `A s² + margin (w + h) s + margin²` at least.
fn largest_scale(shapes: &[Shape<'_>], boxes: &[[Vec2; 2]], margin: f64, side: u32) -> f64 {
    let sizes = || boxes.iter().map(|[low, high]| high - low);
    let area: f64 = shapes.iter().map(Shape::area).sum();
    let around: f64 = 0.5 * margin * sizes().map(|size| size.sum()).sum::<f64>();
    let side = f64::from(side);
    let room = side * side - shapes.len() as f64 * margin * margin;
    let by_area = room / (around + (around * around + area * room).sqrt());
    let by_width = (side - margin) / sizes().map(|size| size.max()).fold(0.0, f64::max);
    // Areas may be too large for numbers where lengths are not.
    let bounds = [by_area, by_width].into_iter().filter(|bound| bound.is_finite() && *bound > 0.0);
    bounds.reduce(f64::min).unwrap_or(1.0)
}

/// Lays islands out at a given scale, without overlaps, in a strip that is as wide as the unit square (or as its widest
/// island) and as high as need be. `width` is in units of the layout, after scaling.
#[must_use]
pub fn lay_out(shapes: &[Shape<'_>], scale: f64, width: f64, options: &PackOptions) -> Packed {
    let boxes: Vec<[Vec2; 2]> = shapes.iter().map(bounds).collect();
    let size = |axis: usize| boxes.iter().map(|[low, high]| scale * (high - low)[axis]).fold(0.0, f64::max);
    let margin = width * options.margin / f64::from(options.resolution);
    let width = width.max(size(0) + margin);
    // Cells small enough for the islands, but no more of them than memory has room for.
    const MOST_CELLS: f64 = 6.4e7;
    let height: f64 = boxes.iter().map(|[low, high]| scale * (high - low).y + margin).sum();
    let side = f64::from(cells(shapes.len())).min((MOST_CELLS * width / height).sqrt()).max(16.0) as u32;
    let unit = width / f64::from(side);
    // So slender that no grid fits it, or an island of it: one above the other.
    let needed = height / unit * f64::from(side);
    let highest = (size(1) + margin) / unit + 2.0;
    if needed.is_nan() || needed > 2.0 * MOST_CELLS || highest > cover::LONGEST {
        return stack(&boxes, scale, margin, options);
    }
    let places = place(shapes, &boxes, scale / unit, margin / unit, side + 2, None);
    let places = places.unwrap_or_else(|| vec![[0, 0]; shapes.len()]);
    let mut packed = finish(&boxes, &places, scale, unit, margin / unit, options);
    packed.margin = options.margin;
    packed
}

/// Islands one above the other.
fn stack(boxes: &[[Vec2; 2]], scale: f64, margin: f64, options: &PackOptions) -> Packed {
    let mut top = Vec2::repeat(0.5 * margin);
    let mut extent = Vec2::zeros();
    let offsets = boxes
        .iter()
        .map(|[low, high]| {
            let offset = top - scale * low;
            extent = extent.sup(&(scale * high + offset + Vec2::repeat(0.5 * margin)));
            top.y = extent.y + 0.5 * margin;
            offset
        })
        .collect();
    Packed { scale, offsets, margin: options.margin, extent }
}

/// Cells along a side of the square: many small islands need a finer grid than few large ones.
fn cells(islands: usize) -> u32 {
    match islands {
        0..=200 => 512,
        201..=5000 => 1024,
        _ => 2048,
    }
}

/// One island alone: in the middle, as large as the margin allows.
fn center([low, high]: [Vec2; 2], margin: f64, options: &PackOptions) -> Packed {
    let size = high - low;
    let margin = margin.min(0.5);
    let scale = (1.0 - margin) / size.max();
    let scale = if scale.is_finite() { scale } else { 1.0 };
    let offset = Vec2::repeat(0.5) - scale * (low + 0.5 * size);
    Packed {
        scale,
        offsets: vec![offset],
        margin: margin * f64::from(options.resolution),
        extent: Vec2::repeat(1.0),
    }
}

/// A cell for the lower left corner of each island's cover, `scale` cells to a unit; nothing when one finds no room.
fn place(
    shapes: &[Shape<'_>],
    boxes: &[[Vec2; 2]],
    scale: f64,
    margin: f64,
    width: u32,
    height: Option<u32>,
) -> Option<Vec<[u32; 2]>> {
    let covers: Vec<Cover> = shapes
        .par_iter()
        .zip(boxes)
        .map(|(shape, [low, _])| Cover::new(shape, *low, scale, 0.5 * margin))
        .collect();
    let taken: usize = covers.iter().map(Cover::cells).sum();
    if height.is_some_and(|height| taken > (width as usize) * (height as usize)) {
        return None;
    }
    // A strip has room for every order.
    if height.is_none() || covers.len() > order::FEW {
        return put_all(&covers, &order::sorted(&covers, Order::Side), width, height);
    }
    order::all(&covers).into_par_iter().find_map_first(|order| put_all(&covers, &order, width, height))
}

/// Places covers one after the other, as far as there is room.
fn put_all(covers: &[Cover], order: &[usize], width: u32, height: Option<u32>) -> Option<Vec<[u32; 2]>> {
    let mut bitmap = Bitmap::new(width, height, covers.len());
    let mut places = vec![[0, 0]; covers.len()];
    for &i in order {
        places[i] = bitmap.put(&covers[i])?;
    }
    Some(places)
}

fn finish(
    boxes: &[[Vec2; 2]],
    places: &[[u32; 2]],
    scale: f64,
    unit: f64,
    margin_cells: f64,
    options: &PackOptions,
) -> Packed {
    let corner =
        |&[x, y]: &[u32; 2]| Vec2::new(f64::from(x), f64::from(y)) + Vec2::repeat(0.5 * margin_cells);
    let offsets: Vec<Vec2> =
        boxes.iter().zip(places).map(|([low, _], place)| unit * corner(place) - scale * low).collect();
    let ends = boxes.iter().zip(&offsets).map(|([_, high], offset)| scale * high + offset);
    let extent = ends.fold(Vec2::zeros(), |extent, end| extent.sup(&end));
    Packed {
        scale,
        offsets,
        margin: margin_cells * unit * f64::from(options.resolution),
        extent: extent + Vec2::repeat(0.5 * margin_cells * unit),
    }
}

fn bounds(shape: &Shape<'_>) -> [Vec2; 2] {
    let low = shape.uv.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_else(Vec2::zeros);
    let high = shape.uv.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_else(Vec2::zeros);
    [low, high]
}
