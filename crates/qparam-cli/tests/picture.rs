//! What pictures guarantee: no gaps, no diagonals, nothing mirrored, nothing in front of what hides it.

#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

use proptest::prelude::*;
use qparam_cli::picture::color::{Linear, decode};
use qparam_cli::picture::{
    Canvas, Lines, Model, Paint, Projection, Rgba, Shot, Texture, UpAxis, View, render,
};
use qparam_cli::qmesh::{PolygonView, Polygons, QuadMesh, Vec2, Vec3, shapes};

const RED: Linear = Linear([1.0, 0.0, 0.0]);
const BLUE: Linear = Linear([0.0, 0.0, 1.0]);

fn shot(view: View, side: usize) -> Shot {
    Shot {
        view,
        up: UpAxis::Y,
        projection: Projection::Orthographic,
        size: [side, side],
        background: Rgba::CLEAR,
        relief: 0.0,
    }
}

fn picture(polygons: PolygonView<'_>, paint: &Paint<'_>, shot: &Shot) -> Canvas {
    render(&Model::new(polygons).unwrap(), paint, &Lines::default(), shot)
}

fn alpha(canvas: &Canvas) -> Vec<u8> {
    canvas.bytes().chunks_exact(4).map(|pixel| pixel[3]).collect()
}

/// Pixels that are not fully covered though all around them are.
fn holes(canvas: &Canvas) -> usize {
    let (alpha, width) = (alpha(canvas), canvas.width());
    let inner = (1..canvas.height() - 1).flat_map(|y| (1..width - 1).map(move |x| (x, y)));
    inner
        .filter(|&(x, y)| {
            let at = |dx: usize, dy: usize| alpha[(y + dy - 1) * width + x + dx - 1];
            let around = [at(0, 0), at(1, 0), at(2, 0), at(0, 1), at(2, 1), at(0, 2), at(1, 2), at(2, 2)];
            at(1, 1) < 255 && around.iter().all(|&a| a == 255)
        })
        .count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Closed surfaces and crooked quads leave no gap between them, from anywhere, with and without perspective: where
    /// one quad is cut more often than its neighbour, too.
    #[test]
    fn there_are_no_cracks(
        x in -1.0_f64..1.0, y in -1.0_f64..1.0, z in 0.1_f64..1.0, perspective: bool, seed in 0_u64..99,
    ) {
        for mesh in [shapes::sphere(7), shapes::jittered_grid(9, 9, 0.45, seed), shapes::bump(10, 2.0)] {
            let mut shot = shot(View::From(Vec3::new(x, y, z)), 90);
            if perspective {
                shot.projection = Projection::Perspective(60.0);
            }
            prop_assert_eq!(holes(&picture(mesh.view(), &Paint::Plain(RED), &shot)), 0);
        }
    }

    /// A quad has no first corner: turning its corners round changes no pixel by more than rounding, however crooked the
    /// quad is in space and its UVs in the plane. A diagonal would show here.
    #[test]
    fn no_diagonal_shows(
        offsets in proptest::array::uniform12(-0.25_f64..0.25), uv in proptest::array::uniform8(-0.3_f64..0.3),
        perspective: bool,
    ) {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corner = |i: usize| {
            let [x, y] = square[i];
            [x + offsets[3 * i], y + offsets[3 * i + 1], offsets[3 * i + 2]]
        };
        let uvs: Vec<Vec2> =
            (0..4).map(|i| Vec2::new(square[i][0] + uv[2 * i], square[i][1] + uv[2 * i + 1])).collect();
        let mut shot = shot(View::Front, 96);
        if perspective {
            shot.projection = Projection::Perspective(50.0);
        }
        let turned = |by: usize| {
            let order: Vec<usize> = (0..4).map(|i| (i + by) % 4).collect();
            let positions: Vec<[f64; 3]> = order.iter().map(|&i| corner(i)).collect();
            let uv: Vec<Vec2> = order.iter().map(|&i| uvs[i]).collect();
            let polygons = Polygons::new(&positions, [[0, 1, 2, 3]]);
            let paint = Paint::Checker { uv: &uv, per_unit: 6.0, colors: [RED, BLUE] };
            picture(polygons.view(), &paint, &shot).bytes()
        };
        let (one, other) = (turned(0), turned(1));
        // What is drawn is a tenth of a pixel off at most, each time; a diagonal moves borders by whole pixels, which are hundreds of bytes.
        let different = one.iter().zip(&other).filter(|(a, b)| (decode(**a) - decode(**b)).abs() > 0.45).count();
        prop_assert!(different <= 8, "{} bytes", different);
    }
}

/// The colour inside a quad is that of its bilinear map, not of two triangles: the middle of a trapezoid shows the mean
/// of its corners' UVs.
#[test]
fn quads_are_bilinear() {
    // The diagonals of this trapezoid meet far above its middle.
    let polygons =
        Polygons::new(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.5, 4.0, 0.0], [1.5, 4.0, 0.0]], [[0, 1, 2, 3]]);
    let uv = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
    let paint = Paint::Checker { uv: &uv, per_unit: 2.0, colors: [RED, BLUE] };
    let canvas = picture(polygons.view(), &paint, &shot(View::Front, 100));
    let bytes = canvas.bytes();
    let is_red = |x: usize, y: usize| bytes[(y * 100 + x) * 4] > 200;
    // Halfway up, t is ½: below it the left half is red, above it the right half.
    for (y, left, right) in [(90, true, false), (54, true, false), (46, false, true), (10, false, true)] {
        assert_eq!((is_red(47, y), is_red(53, y)), (left, right), "row {y}");
    }
}

/// The upper left quarter of an image is at the upper left of a quad whose UVs stand upright, seen from its front.
#[test]
fn textures_are_not_mirrored() {
    let mut image = Canvas::new(2, 2, Rgba([0, 0, 255, 255]));
    image.fill([0, 0], [1, 1], RED);
    let mut file = Vec::new();
    image.write_png(&mut file).unwrap();
    let textures = [Texture::read_png(std::io::Cursor::new(file)).unwrap()];
    let mesh = shapes::grid(2, 2);
    let uv: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy() / 2.0).collect();
    let of_face = vec![0; mesh.face_count()];
    let paint = Paint::Textures { uv: &uv, of_face: &of_face, textures: &textures };
    let bytes = picture(mesh.view(), &paint, &shot(View::Front, 64)).bytes();
    let red_at = |x: usize, y: usize| bytes[(y * 64 + x) * 4] > 200;
    assert_eq!([red_at(18, 18), red_at(46, 18), red_at(18, 46), red_at(46, 46)], [true, false, false, false]);
}

/// Of two sheets the nearer one is seen, whichever comes first in the file.
#[test]
fn what_is_near_hides_what_is_far() {
    let sheet = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    for (first, second) in [(0.0, 1e-5), (1e-5, 0.0)] {
        let positions = [sheet(first), sheet(second)].concat();
        let polygons = Polygons::new(&positions, [[0, 1, 2, 3], [4, 5, 6, 7]]);
        let colors = if first > second { [RED, BLUE] } else { [BLUE, RED] };
        let paint = Paint::Faces(&colors);
        for projection in [Projection::Orthographic, Projection::Perspective(30.0)] {
            let shot = Shot { projection, ..shot(View::Front, 40) };
            let bytes = picture(polygons.view(), &paint, &shot).bytes();
            assert!(bytes.chunks_exact(4).all(|pixel| pixel[3] == 0 || pixel[..3] == [255, 0, 0]));
        }
    }
}

/// Neither the number of threads nor place and unit of the model change a byte.
#[test]
fn pictures_do_not_depend_on_threads_or_units() {
    let mesh = shapes::face(1);
    let paint = Paint::Plain(Linear([0.5; 3]));
    let shot =
        Shot { relief: 1.0, projection: Projection::Perspective(30.0), ..shot(View::ThreeQuarter, 100) };
    let one = picture(mesh.view(), &paint, &shot);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| picture(mesh.view(), &paint, &shot)), one);
    }
    let moved = |factor: f64| -> QuadMesh {
        let positions = mesh.vertex_data(|vertex| mesh.position(vertex) * factor);
        mesh.clone().with_positions(positions)
    };
    assert_eq!(picture(moved(f64::powi(2.0, 60)).view(), &paint, &shot), one);
    assert_eq!(picture(moved(f64::powi(2.0, -60)).view(), &paint, &shot), one);
}

/// Two views of a closed surface from opposite sides cover the same number of pixels.
#[test]
fn silhouettes_are_the_same_from_both_sides() {
    let mesh = shapes::torus(24, 12);
    let area = |view: View| -> f64 {
        let alpha = alpha(&picture(mesh.view(), &Paint::Plain(RED), &shot(view, 120)));
        alpha.iter().map(|&a| f64::from(a)).sum::<f64>() / 255.0
    };
    for (one, other) in [(View::Front, View::Back), (View::Left, View::Right), (View::Top, View::Bottom)] {
        assert!((area(one) - area(other)).abs() < 0.002 * area(one), "{one} and {other}");
    }
}
