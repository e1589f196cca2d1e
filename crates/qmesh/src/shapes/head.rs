//! A human head.

use super::anatomy::{EAR, EAR_LEAN, from_side, shrink_wrap, shrink_wrapped};
use super::cage::Cage;
use super::elementary::sin_cos;
use super::front::{self, COLUMNS, ROWS};
use crate::{QuadMesh, Vec3};

/// Columns over each ear; in front and behind there are [`COLUMNS`].
const SIDE: usize = 6;
/// The rows that are bent around the ears.
const EAR_ROWS: [usize; 2] = [3, 8];
/// All columns around.
const AROUND: usize = 2 * (COLUMNS + SIDE);
/// Angle of the columns of the face to the left of straight ahead, in degrees. Sides and back are spaced evenly.
const ANGLES: [f64; COLUMNS / 2 + 1] = [0.0, 9.0, 19.0, 29.0, 39.0, 47.0, 55.0];
/// Height of each row below the cap, in decimetres above the eyes: in front and behind.
const HEIGHTS: [[f64; 2]; ROWS + 3] = [
    [0.62, 0.66],
    [0.38, 0.48],
    [0.17, 0.31],
    [0.0, 0.15],
    [-0.15, 0.0],
    [-0.29, -0.14],
    [-0.42, -0.27],
    [-0.56, -0.39],
    [-0.735, -0.51],
    [-0.90, -0.62],
    [-1.02, -0.73],
    [-1.13, -0.84],
    [-1.20, -1.0],
    [-1.40, -1.32],
    [-1.72, -1.72],
];
/// Distance from the axis, in front and behind, of targets around the jaw, which level rays miss.
const JAW: [[f64; 2]; 4] = [[0.88, 0.56], [0.86, 0.50], [0.80, 0.48], [0.55, 0.48]];
/// The first row around the jaw.
const JAW_ROW: usize = 9;

/// A human head, looking along `z`: a disk whose only boundary is the neck, with quads that run around eyes, mouth
/// and ears. Mirror-symmetric in `x`.
///
/// `680·detail²` quads: 680 with 1, 2720 with 2, 6120 with 3, 17 000 with 5, a million with 39. `detail` is at least 1
/// and at most 800 (clamped).
///
/// ```
/// let mesh = qmesh::shapes::head(2);
/// assert_eq!(mesh.face_count(), 2720);
/// assert!(mesh.topology().is_disk());
/// ```
#[must_use]
pub fn head(detail: usize) -> QuadMesh {
    let mut cage = Cage::default();
    let cap = cap(&mut cage);
    let mut rows = vec![edge_of(&cap)];
    for (row, heights) in HEIGHTS.iter().enumerate() {
        rows.push((0..AROUND).map(|column| cage.vertex(band_point(row, *heights, column))).collect());
    }
    for row in &mut rows {
        row.push(row[0]);
    }
    cage.fill(&cap.iter().rev().cloned().collect::<Vec<_>>());
    let part =
        |columns: std::ops::RangeInclusive<usize>, range: std::ops::RangeInclusive<usize>| -> Vec<Vec<u32>> {
            rows[range].iter().map(|row| row[columns.clone()].to_vec()).collect()
        };
    front::fill(&mut cage, &part(0..=COLUMNS, 0..=ROWS));
    for (ear, sign) in [(COLUMNS + 1..=COLUMNS + 5, 1.0), (AROUND - 5..=AROUND - 1, -1.0)] {
        let [before, after] = [ear.start() - 1, ear.end() + 1];
        cage.fill(&part(before..=after, 0..=EAR_ROWS[0]));
        for columns in [before..=*ear.start(), *ear.end()..=after] {
            cage.fill(&part(columns, EAR_ROWS[0]..=EAR_ROWS[1]));
        }
        cage.fill(&part(before..=after, EAR_ROWS[1]..=ROWS));
        // Seen from outside, columns run to the back on the left and to the front on the right.
        cage.fill_with_inset(&part(ear, EAR_ROWS[0]..=EAR_ROWS[1]), |place| ear_point(sign, place));
    }
    cage.fill(&part(COLUMNS + SIDE..=AROUND - SIDE, 0..=ROWS));
    cage.fill(&part(0..=AROUND, ROWS..=ROWS + 3));
    shrink_wrapped(cage.refine(detail.clamp(1, 800)))
}

/// The rectangle of vertices on top: rows from the front.
fn cap(cage: &mut Cage) -> Vec<Vec<u32>> {
    const WIDTH: f64 = 0.54;
    const LENGTH: f64 = 0.66;
    const MIDDLE: f64 = -0.12;
    (0..=SIDE)
        .map(|j| {
            (0..=COLUMNS)
                .map(|i| {
                    let u = (2.0 * i as f64 - COLUMNS as f64) / COLUMNS as f64;
                    let v = (SIDE as f64 - 2.0 * j as f64) / SIDE as f64;
                    let x = WIDTH * u * (1.0 - 0.18 * v * v);
                    let z = MIDDLE + LENGTH * v * (1.0 - 0.18 * u * u);
                    cage.vertex(shrink_wrap(Vec3::new(x, 1.1 - 0.5 * (x * x + z * z), z)))
                })
                .collect()
        })
        .collect()
}

/// The boundary of the cap, from the front right corner to the left and once around.
fn edge_of(cap: &[Vec<u32>]) -> Vec<u32> {
    let front = cap[0][..COLUMNS].iter().copied();
    let left = cap[..SIDE].iter().map(|row| row[COLUMNS]);
    let back = cap[SIDE][1..].iter().rev().copied();
    let right = cap[1..].iter().rev().map(|row| row[0]);
    front.chain(left).chain(back).chain(right).collect()
}

fn band_point(row: usize, [front, back]: [f64; 2], column: usize) -> Vec3 {
    let degrees = angle(column);
    let [_, cosine] = sin_cos(degrees / 360.0);
    let mix = |front: f64, back: f64| back + (front - back) * (0.5 + 0.5 * cosine);
    let y = mix(front, back);
    match row.checked_sub(JAW_ROW).and_then(|below| JAW.get(below)) {
        Some(&[front, back]) => front::around_jaw(degrees, y, mix(front, back)),
        None => front::around(degrees, y),
    }
}

/// A point of a square pressed into the outline of an ear.
fn ear_point(sign: f64, [u, v]: [f64; 2]) -> Vec3 {
    const SIZE: [f64; 2] = [0.20, 0.32];
    let y = EAR[1] + SIZE[1] * v * (1.0 - 0.28 * u * u);
    let z = EAR[2] - sign * SIZE[0] * u * (1.0 - 0.28 * v * v) - EAR_LEAN * (y - EAR[1]);
    from_side(sign, y, z)
}

/// Degrees to the left of straight ahead; columns are counted from the right temple.
fn angle(column: usize) -> f64 {
    const TEMPLE: f64 = ANGLES[COLUMNS / 2];
    const NAPE: f64 = 55.0;
    let half = COLUMNS / 2;
    match column {
        c if c < half => -ANGLES[half - c],
        c if c <= COLUMNS => ANGLES[c - half],
        c if c <= COLUMNS + SIDE => TEMPLE + (180.0 - NAPE - TEMPLE) * (c - COLUMNS) as f64 / SIDE as f64,
        c if c <= COLUMNS + SIDE + half => 180.0 - NAPE * (COLUMNS + SIDE + half - c) as f64 / half as f64,
        c => -angle(2 * (COLUMNS + SIDE) - (c - COLUMNS)),
    }
}
