//! Maps brought to one size and turned alike, so that one can become the next without a jump.

use qoptimize::qmesh::{PolygonView, Vec2};

use crate::picture::uv_area;

/// Turns the first map so that what is high in space (y) is high in the plane, as far as there is such a direction. Scales
/// every other map so that it has the area of the first, and moves and turns it (without mirroring) to where it differs
/// least from the first, corners weighted alike.
pub(super) fn align(polygons: PolygonView<'_>, maps: &mut [Vec<Vec2>]) {
    let Some((first, others)) = maps.split_first_mut() else { return };
    let area = uv_area(polygons, first);
    center(first);
    let heights = polygons.corner_vertex.iter().map(|&vertex| polygons.positions[vertex as usize].y);
    let upwards: Vec2 = first.iter().zip(heights).map(|(uv, height)| uv * height).sum();
    // The direction that takes `upwards` to (0, 1), as a complex number.
    turn(first, Vec2::new(upwards.y, upwards.x).try_normalize(0.0).unwrap_or(Vec2::x()), 1.0);
    for map in others {
        center(map);
        let scale = (area / uv_area(polygons, map)).sqrt();
        // The best turn is the direction of Σ first · conjugate(map), as complex numbers.
        let best: Vec2 = first.iter().zip(&*map).map(|(a, b)| Vec2::new(a.dot(b), b.perp(a))).sum();
        turn(map, best.try_normalize(0.0).unwrap_or(Vec2::x()), scale);
    }
}

/// Multiplies with a complex number of length 1, and a factor.
fn turn(map: &mut [Vec2], by: Vec2, scale: f64) {
    for uv in map {
        *uv = Vec2::new(uv.x * by.x - uv.y * by.y, uv.x * by.y + uv.y * by.x) * scale;
    }
}

fn center(map: &mut [Vec2]) {
    let middle = map.iter().sum::<Vec2>() / map.len().max(1) as f64;
    map.iter_mut().for_each(|uv| *uv -= middle);
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::shapes;

    use super::*;

    /// A map that was scaled, turned and moved comes back to where it was.
    #[test]
    fn similar_maps_become_equal() {
        let mesh = shapes::grid(3, 2);
        let plain: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy()).collect();
        let (sin, cos) = 2.3_f64.sin_cos();
        let moved = |uv: &Vec2| {
            Vec2::new(cos * uv.x - sin * uv.y, sin * uv.x + cos * uv.y) * 7.0 + Vec2::new(5.0, -3.0)
        };
        let mut maps = vec![plain.clone(), plain.iter().map(moved).collect()];
        align(mesh.view(), &mut maps);
        assert!(maps[0].iter().zip(&maps[1]).all(|(a, b)| (a - b).norm() < 1e-12));
        // The grid lies upright already: only its middle is elsewhere.
        let shift = maps[0][0] - plain[0];
        assert!(maps[0].iter().zip(&plain).all(|(a, b)| (a - b - shift).norm() < 1e-12));
        let mut upside_down = vec![plain.iter().map(|uv| -uv).collect()];
        align(mesh.view(), &mut upside_down);
        assert!(upside_down[0].iter().zip(&maps[0]).all(|(a, b): (&Vec2, &Vec2)| (a - b).norm() < 1e-12));
    }
}
