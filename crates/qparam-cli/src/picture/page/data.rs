//! What a page holds, in binary: the surface, and for each map places and measures of its faces.
//!
//! The reader is `data.js`; both know the order. Places have 16 bits a coordinate, measures of faces 8 bits on scales that
//! are fine where maps are good.

use std::collections::HashMap;

use qoptimize::FaceMeasures;
use qoptimize::qmesh::{PolygonView, Vec2, Vec3};
use serde::Serialize;

use super::super::model::{Model, NO_CORNER};
use super::super::seams::{Seams, next_corners};
use super::encode::Packer;

/// What the binary part has to be read with.
#[derive(Debug, Serialize)]
pub(super) struct Shape {
    vertices: usize,
    points: usize,
    patches: usize,
    faces: usize,
    edges: usize,
    seams: usize,
    /// For each map, where u and v begin and how far they reach: place = low + span · number / 65535.
    boxes: Vec<[f64; 4]>,
    /// Area of the surface, and of each map, in the units of the page.
    area: f64,
}

/// Packs everything that is drawn. `maps` are aligned and have one UV a corner.
pub(super) fn pack(
    model: &Model<'_>,
    maps: &[Vec<Vec2>],
    measures: &[FaceMeasures],
    packer: &mut Packer,
) -> Shape {
    let polygons = model.polygons;
    let points = Points::of(polygons, maps);
    for axis in 0..3 {
        let step = |p: &Vec3| ((p[axis] + 0.5) * 65535.0).round().clamp(0.0, 65535.0) as u16;
        packer.u16s(model.positions.iter().map(step));
    }
    packer.u32s(points.first_corner.iter().map(|&corner| polygons.corner_vertex[corner as usize]));
    packer.u32s(model.patches.iter().map(|patch| patch.face));
    for i in 0..4 {
        // A triangle has its last point twice.
        let corner = |corners: [u32; 4]| if corners[i] == NO_CORNER { corners[2] } else { corners[i] };
        packer.u32s(model.patches.iter().map(|patch| points.of_corner[corner(patch.corners) as usize]));
    }
    let first = measures.first();
    let island = |face: usize| first.map_or(0, |measures| measures.island[face]);
    packer.u32s((0..polygons.face_count()).map(island));
    let (edges, seams) = edges(polygons, maps, &points, first, packer);
    let boxes = maps.iter().map(|map| places(map, &points, packer)).collect();
    measures.iter().for_each(|measures| pack_measures(measures, packer));
    Shape {
        vertices: model.positions.len(),
        points: points.first_corner.len(),
        patches: model.patches.len(),
        faces: polygons.face_count(),
        edges,
        seams,
        boxes,
        area: maps.first().map_or(1.0, |map| crate::picture::uv_area(polygons, map)),
    }
}

/// Corners that are at the same vertex and have the same UV in every map.
struct Points {
    of_corner: Vec<u32>,
    first_corner: Vec<u32>,
}

impl Points {
    fn of(polygons: PolygonView<'_>, maps: &[Vec<Vec2>]) -> Self {
        let mut known: HashMap<u32, Vec<u32>> = HashMap::new();
        let mut points =
            Self { of_corner: Vec::with_capacity(polygons.corner_count()), first_corner: Vec::new() };
        for (corner, &vertex) in polygons.corner_vertex.iter().enumerate() {
            let same = |&point: &u32| {
                let other = points.first_corner[point as usize] as usize;
                maps.iter().all(|map| map[other] == map[corner])
            };
            let here = known.entry(vertex).or_default();
            let point = here.iter().copied().find(same).unwrap_or_else(|| {
                let point = points.first_corner.len() as u32;
                points.first_corner.push(corner as u32);
                here.push(point);
                point
            });
            points.of_corner.push(point);
        }
        points
    }
}

/// Boundary edges (run 0) and both sides of seams (their run, from 1): two points and the run each.
fn edges(
    polygons: PolygonView<'_>,
    maps: &[Vec<Vec2>],
    points: &Points,
    measures: Option<&FaceMeasures>,
    packer: &mut Packer,
) -> (usize, usize) {
    let (Some(uv), Some(measures)) = (maps.first(), measures) else { return (0, 0) };
    let seams = Seams::find(polygons, uv, &measures.island);
    let next = next_corners(polygons);
    let cuts = seams.cuts.iter().zip(&seams.run).flat_map(|(cut, &run)| cut.map(|corner| (corner, run + 1)));
    let edges: Vec<(u32, u32)> = seams.boundary.iter().map(|&corner| (corner, 0)).chain(cuts).collect();
    packer.u32s(edges.iter().map(|&(corner, _)| points.of_corner[corner as usize]));
    packer.u32s(edges.iter().map(|&(corner, _)| points.of_corner[next[corner as usize] as usize]));
    packer.u32s(edges.iter().map(|&(_, run)| run));
    (edges.len(), seams.runs)
}

fn places(map: &[Vec2], points: &Points, packer: &mut Packer) -> [f64; 4] {
    let low = map.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = map.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let span = (high - low).map(|side| side.max(f64::MIN_POSITIVE));
    for axis in 0..2 {
        let step =
            |&corner: &u32| ((map[corner as usize][axis] - low[axis]) / span[axis] * 65535.0).round() as u16;
        packer.u16s(points.first_corner.iter().map(step));
    }
    [low.x, low.y, span.x, span.y]
}

/// Measures in 254 steps, even in the square root of the angle (up to 180°), of the logarithm of the stretch (up to a million),
/// and of the binary logarithm of the area ratio (up to 10, and down to −10 with its sign). Flipped faces have 255.
fn pack_measures(measures: &FaceMeasures, packer: &mut Packer) {
    const LARGEST_STRETCH: f64 = 1e6;
    let steps = |share: f64| (share.clamp(0.0, 1.0) * 254.0).round() as u8;
    let or_flipped = |(&value, &flipped): (&f64, &bool), share: &dyn Fn(f64) -> f64| match flipped {
        true => 255,
        false => steps(share(value)),
    };
    let values = |values: &[f64], share: &dyn Fn(f64) -> f64| -> Vec<u8> {
        values.iter().zip(&measures.flipped).map(|pair| or_flipped(pair, share)).collect()
    };
    let angle = |degrees: f64| (degrees / 180.0).sqrt();
    let area = |ratio: f64| {
        let doublings = ratio.max(1e-300).log2() / 10.0;
        0.5 + 0.5 * doublings.abs().sqrt() * doublings.signum()
    };
    let stretch = |energy: f64| (energy.max(1.0).ln() / LARGEST_STRETCH.ln()).sqrt();
    packer.bytes(values(&measures.angle_degrees, &angle).into_iter());
    packer.bytes(values(&measures.area_ratio, &area).into_iter());
    packer.bytes(values(&measures.symmetric_dirichlet, &stretch).into_iter());
}
