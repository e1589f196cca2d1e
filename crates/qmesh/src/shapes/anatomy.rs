//! A head as a solid: ellipsoids and capsules, melted together.
//!
//! In decimetres: `x` to the head's left, `y` up from the eyes, `z` forward. Proportions are those of drawing books:
//! eyes at half height, nose and mouth a quarter and a third of the way from there to the chin.

use rayon::prelude::*;

use super::implicit::{ball, capsule, carve, cast, ellipsoid, melt};
use crate::{QuadMesh, Vec3, VertexData};

/// Where the eye is that has positive `x`.
pub(crate) const EYE: [f64; 3] = [0.315, 0.0, 0.665];
/// Half the width of the opened eye, and half its height.
pub(crate) const EYE_OPENING: [f64; 2] = [0.155, 0.066];
/// Half the width of the mouth, and how far its lips reach above and below [`MOUTH_HEIGHT`].
pub(crate) const MOUTH: [f64; 3] = [0.235, 0.085, 0.10];
/// Where the lips meet.
pub(crate) const MOUTH_HEIGHT: f64 = -0.735;

/// The middle of the ear that has positive `x`.
pub(crate) const EAR: [f64; 3] = [0.69, -0.13, -0.10];
/// How far back it goes by every step up.
pub(crate) const EAR_LEAN: f64 = 0.25;

/// Farther from any origin of a ray than the head is large.
const REACH: f64 = 2.2;

/// A mesh close to the head, every vertex moved along its ray onto the head.
pub(crate) fn shrink_wrapped(mesh: QuadMesh) -> QuadMesh {
    const CLOSE: f64 = 0.15; // the refined cage strays less from the head; all of the reach gives the same mesh, later
    let wrap = |&target: &Vec3| {
        let origin = origin(target);
        cast(head, origin, target, (target - origin).norm() + CLOSE)
    };
    let positions = mesh.positions().par_iter().map(wrap).collect();
    mesh.with_positions(VertexData::from_vec(positions))
}

/// The point of the head towards `target`, seen from inside.
pub(crate) fn shrink_wrap(target: Vec3) -> Vec3 {
    cast(head, origin(target), target, REACH)
}

/// The point of the head at this height, in the direction of `[x, z]` from the axis.
pub(crate) fn at_height(y: f64, [x, z]: [f64; 2]) -> Vec3 {
    cast(head, Vec3::new(0.0, y, 0.0), Vec3::new(x, y, z), REACH)
}

/// The point of the face at `x`, `y`, seen from the front.
pub(crate) fn from_front(x: f64, y: f64) -> Vec3 {
    cast(head, Vec3::new(x, y, 0.0), Vec3::new(x, y, 1.0), REACH)
}

/// The point of the head at `y`, `z`, seen from the side of positive `x` (`side` 1) or negative (−1).
pub(crate) fn from_side(side: f64, y: f64, z: f64) -> Vec3 {
    cast(head, Vec3::new(0.0, y, z), Vec3::new(side, y, z), REACH)
}

/// From where rays leave. Their height is the same for all of the face, so that they rise steeply under the jaw, and
/// that of the target at the foot of the neck. In front they run almost side by side: rays that fan out from the
/// axis would miss the flanks of the nose.
pub(super) fn origin(target: Vec3) -> Vec3 {
    const KNOTS: [[f64; 2]; 4] = [[-1.8, -1.8], [-1.2, -0.45], [-0.1, 0.1], [0.2, 0.15]];
    const PARALLEL: f64 = 0.75;
    const CHIN: f64 = -1.0;
    const THROAT: f64 = -1.3;
    let y = target.y.clamp(KNOTS[0][0], KNOTS[3][0]);
    let knot = KNOTS.windows(2).find(|pair| y <= pair[1][0]).unwrap_or(&KNOTS[2..]);
    let part = (y - knot[0][0]) / (knot[1][0] - knot[0][0]);
    let [x, z] = [target.x, target.z.max(0.0)];
    let ahead = if z > 0.0 { z * z / (x * x + z * z) } else { 0.0 };
    let face = ((target.y - THROAT) / (CHIN - THROAT)).clamp(0.0, 1.0);
    Vec3::new(PARALLEL * face * ahead * ahead * x, knot[0][1] + (knot[1][1] - knot[0][1]) * part, 0.0)
}

/// The whole head, negative inside.
fn head(p: Vec3) -> f64 {
    let side = Vec3::new(p.x.abs(), p.y, p.z);
    let skin = melt(skull(p, side), neck(p), 0.14);
    let skin = if side.x > 0.4 { melt(skin, ear(side), 0.08) } else { skin };
    // Rays that come from in front have met the face by then; the others pass it far away.
    if p.z > 0.2 { mouth(nose(eye(skin, side), p, side), p, side) } else { skin }
}

fn skull(p: Vec3, side: Vec3) -> f64 {
    let cranium = ellipsoid(p, [0.0, 0.30, -0.10], [0.74, 0.77, 0.94]);
    let face = ellipsoid(p, [0.0, -0.15, 0.20], [0.63, 0.83, 0.66]);
    let jaw = ellipsoid(p, [0.0, -0.66, 0.30], [0.53, 0.46, 0.55]);
    let chin = ellipsoid(p, [0.0, -0.98, 0.72], [0.21, 0.15, 0.15]);
    let cheekbone = ellipsoid(side, [0.41, -0.24, 0.48], [0.21, 0.18, 0.22]);
    let skull = melt(melt(cranium, face, 0.3), jaw, 0.25);
    melt(melt(skull, cheekbone, 0.25), chin, 0.17)
}

fn neck(p: Vec3) -> f64 {
    capsule(p, [[0.0, -0.5, -0.20], [0.0, -2.4, -0.30]], [0.42, 0.56])
}

fn ear(side: Vec3) -> f64 {
    // Leaning backwards.
    let p = Vec3::new(side.x, side.y, side.z + EAR_LEAN * (side.y - EAR[1]));
    let shell = ellipsoid(p, EAR, [0.11, 0.30, 0.18]);
    let hollow = ellipsoid(p, [EAR[0] + 0.10, EAR[1] + 0.02, EAR[2] + 0.03], [0.07, 0.19, 0.10]);
    carve(shell, hollow, 0.05)
}

fn eye(skin: f64, side: Vec3) -> f64 {
    let brow = capsule(side, [[0.13, 0.19, 0.825], [0.44, 0.17, 0.65]], [0.07, 0.06]);
    let socket = ellipsoid(side, [EYE[0], -0.01, 0.95], [0.20, 0.13, 0.21]);
    let skin = carve(melt(skin, brow, 0.12), socket, 0.1);
    let lids = carve(ball(side, EYE, 0.157), opening(side), 0.03);
    melt(skin, lids, 0.07).min(ball(side, EYE, 0.126))
}

/// Between the lids: a lens seen from the front, negative inside.
fn opening(side: Vec3) -> f64 {
    let across = (side.x - EYE[0]) / EYE_OPENING[0];
    (side.y - EYE[1]).abs() - EYE_OPENING[1] * (1.0 - across * across)
}

fn nose(skin: f64, p: Vec3, side: Vec3) -> f64 {
    let bridge = capsule(p, [[0.0, 0.08, 0.80], [0.0, -0.36, 0.98]], [0.055, 0.075]);
    let body = capsule(p, [[0.0, -0.05, 0.70], [0.0, -0.42, 0.82]], [0.10, 0.16]);
    let tip = ball(p, [0.0, -0.385, 1.0], 0.095);
    let wing = ellipsoid(side, [0.105, -0.435, 0.90], [0.07, 0.07, 0.10]);
    let septum = capsule(p, [[0.0, -0.44, 0.98], [0.0, -0.50, 0.86]], [0.05, 0.05]);
    let nose = melt(melt(bridge, body, 0.1), tip, 0.08);
    melt(skin, melt(nose, melt(wing, septum, 0.05), 0.06), 0.1)
}

fn mouth(skin: f64, p: Vec3, side: Vec3) -> f64 {
    let muzzle = ellipsoid(p, [0.0, -0.72, 0.52], [0.46, 0.30, 0.37]);
    let y = MOUTH_HEIGHT;
    let upper = capsule(side, [[0.04, y + 0.042, 0.895], [0.24, y + 0.016, 0.825]], [0.045, 0.022]);
    let lower = capsule(side, [[0.0, y - 0.055, 0.88], [0.22, y - 0.008, 0.825]], [0.055, 0.025]);
    melt(melt(skin, muzzle, 0.15), melt(upper, lower, 0.008), 0.03)
}
