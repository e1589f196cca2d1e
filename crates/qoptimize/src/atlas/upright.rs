//! Which way is up in an island.

use qembed::qmesh::{QuadMesh, Vec2, Vec3};

use super::UpAxis;

/// Below this fraction of its area a surface counts as level: its slope says nothing about up.
const LEVEL: f64 = 0.02;

/// The rotation, as a unit vector `(cos, sin)`, that turns the up axis in the island to the v axis, as the area-weighted mean
/// over the island. Where the surface is level, the axis that leads away from the viewer takes its place.
pub(super) fn rotation(mesh: &QuadMesh, uv: &[Vec2], up: UpAxis) -> Vec2 {
    for axis in up.directions() {
        let (direction, area) = pushed_forward(mesh, uv, axis);
        if direction.norm() > LEVEL * area {
            let direction = direction.normalize();
            // From `direction` to (0, 1).
            return Vec2::new(direction.y, direction.x);
        }
    }
    Vec2::new(1.0, 0.0)
}

/// `Σ area · J t` over the corner triangles, with `t` the part of `axis` in the plane of the triangle and `J` the map's
/// derivative, rescaled to keep the area of the triangle; and the sum of the areas.
fn pushed_forward(mesh: &QuadMesh, uv: &[Vec2], axis: Vec3) -> (Vec2, f64) {
    let (mut sum, mut total) = (Vec2::zeros(), 0.0);
    for corner in mesh.corners() {
        let [a, b] = mesh.corner_vectors(corner);
        let (aa, ab, bb) = (a.norm_squared(), a.dot(&b), b.norm_squared());
        let gram = aa * bb - ab * ab;
        if gram <= 1e-18 * aa * bb {
            continue;
        }
        let area = 0.5 * gram.sqrt();
        let (along_a, along_b) = (axis.dot(&a), axis.dot(&b));
        let (x, y) = ((bb * along_a - ab * along_b) / gram, (aa * along_b - ab * along_a) / gram);
        let here = uv[corner.index()];
        let [p, q] = [mesh.next_corner(corner), mesh.previous_corner(corner)].map(|c| uv[c.index()] - here);
        let flat = 0.5 * p.perp(&q).abs();
        if flat > 0.0 {
            sum += area * (area / flat).sqrt() * (x * p + y * q);
        }
        total += area;
    }
    (sum, total)
}

/// `p` turned by a rotation that is given as `(cos, sin)`.
pub(super) fn turned(p: Vec2, rotation: Vec2) -> Vec2 {
    Vec2::new(rotation.x * p.x - rotation.y * p.y, rotation.y * p.x + rotation.x * p.y)
}
