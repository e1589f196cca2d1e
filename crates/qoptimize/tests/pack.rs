//! Packed islands never overlap: proven by the exact certificate, on the coordinates as they are.

use proptest::collection::vec;
use proptest::prelude::*;
use qoptimize::pack::{PackOptions, Packed, Shape, lay_out, pack};
use qoptimize::qmesh::{Polygons, Vec2};
use qoptimize::{ViolationKind, certify};

/// Islands of unit cells: those of a `width × height` raster whose bit is set and that hang together with the first.
fn cells(width: usize, height: usize, bits: &[bool], size: f64) -> (Vec<u32>, Vec<Vec2>) {
    let is_set = |i: usize, j: usize| (i, j) == (0, 0) || bits[(j * width + i) % bits.len()];
    let mut seen = vec![false; width * height];
    let mut stack = vec![(0, 0)];
    let (mut starts, mut uv) = (vec![0], Vec::new());
    while let Some((i, j)) = stack.pop() {
        if !is_set(i, j) || std::mem::replace(&mut seen[j * width + i], true) {
            continue;
        }
        uv.extend(
            [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
                .map(|[x, y]| size * Vec2::new(x as f64, y as f64)),
        );
        starts.push(uv.len() as u32);
        stack.extend([(i + 1, j), (i, j + 1)].into_iter().filter(|&(i, j)| i < width && j < height));
        stack.extend(
            [i.checked_sub(1).map(|i| (i, j)), j.checked_sub(1).map(|j| (i, j))].into_iter().flatten(),
        );
    }
    (starts, uv)
}

/// All islands in their places as one map; corners are one vertex where they are in one place.
fn layout(islands: &[(Vec<u32>, Vec<Vec2>)], packed: &Packed) -> (Polygons, Vec<Vec2>) {
    let (mut polygons, mut uv) = (Polygons::default(), Vec::new());
    let mut number = std::collections::HashMap::new();
    for (place, ((starts, corners), offset)) in islands.iter().zip(&packed.offsets).enumerate() {
        for pair in starts.windows(2) {
            let corners = &corners[pair[0] as usize..pair[1] as usize];
            let face: Vec<u32> = corners
                .iter()
                .map(|p| {
                    let next = number.len() as u32;
                    *number.entry((place, p.x.to_bits(), p.y.to_bits())).or_insert(next)
                })
                .collect();
            polygons.push_face(&face);
            uv.extend(corners.iter().map(|p| packed.scale * p + offset));
        }
    }
    polygons.positions = vec![Default::default(); number.len()];
    (polygons, uv)
}

/// The smallest distance along an axis between cells of different islands.
fn closest(islands: &[(Vec<u32>, Vec<Vec2>)], packed: &Packed) -> f64 {
    let boxes: Vec<(usize, Vec2, Vec2)> = islands
        .iter()
        .zip(&packed.offsets)
        .enumerate()
        .flat_map(|(place, ((_, corners), offset))| {
            corners
                .chunks(4)
                .map(move |cell| (place, packed.scale * cell[0] + offset, packed.scale * cell[2] + offset))
        })
        .collect();
    let mut least = f64::INFINITY;
    for (k, a) in boxes.iter().enumerate() {
        for b in boxes[k + 1..].iter().filter(|b| b.0 != a.0) {
            let gap = (b.1 - a.2).sup(&(a.1 - b.2));
            least = least.min(gap.max());
        }
    }
    least
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn islands_never_overlap(
        sizes in vec((1usize..7, 1usize..7, 0.05f64..3.0, vec(any::<bool>(), 1..30)), 2..25),
        margin in prop_oneof![Just(0.0), 0.0..20.0],
        fit in any::<bool>(),
    ) {
        let islands: Vec<_> = sizes.iter().map(|(w, h, size, bits)| cells(*w, *h, bits, *size)).collect();
        let shapes: Vec<Shape<'_>> = islands.iter().map(|(face_start, uv)| Shape { face_start, uv }).collect();
        let options = PackOptions { resolution: 1024, margin };
        let packed = if fit { pack(&shapes, &options) } else { lay_out(&shapes, 0.7, 5.0, &options) };
        let (polygons, uv) = layout(&islands, &packed);
        let certificate = certify(polygons.view(), &uv, 4).unwrap();
        // Islands that touch themselves in a corner are pinched, but overlap nothing.
        let bad = [ViolationKind::Crossing, ViolationKind::Touching, ViolationKind::IslandOnIsland];
        let overlaps = bad.iter().filter(|kind| certificate.counts.contains_key(kind)).count();
        prop_assert_eq!(overlaps, 0, "{}", certificate);
        let width = if fit { 1.0 } else { 5.0 };
        let kept = closest(&islands, &packed);
        prop_assert!(kept > packed.margin / 1024.0 * width * (1.0 - 1e-9) - 1e-12, "{} {}", kept, packed.margin);
        if fit {
            prop_assert!(uv.iter().all(|p| p.iter().all(|x| (0.0..=1.0).contains(x))));
        } else {
            prop_assert_eq!(packed.scale, 0.7);
            prop_assert_eq!(packed.margin, margin);
        }
    }
}

/// Equal squares: as well as any grid of them would do, but for the margins and the raster.
#[test]
fn squares_fill_the_square() {
    let square = cells(1, 1, &[true], 2.5);
    for (count, least) in [(1, 0.98), (4, 0.95), (64, 0.9), (1024, 0.8)] {
        let islands = vec![square.clone(); count];
        let shapes: Vec<Shape<'_>> =
            islands.iter().map(|(face_start, uv)| Shape { face_start, uv }).collect();
        let packed = pack(&shapes, &PackOptions { resolution: 4096, margin: 1.0 });
        let filled = count as f64 * (2.5 * packed.scale).powi(2);
        assert!(filled > least, "{count}: {filled}");
    }
}

/// Small islands go into the hole of a large one.
#[test]
fn holes_are_used() {
    let ring: Vec<bool> =
        (0..100).map(|k| [0, 9].contains(&(k % 10)) || [0, 9].contains(&(k / 10))).collect();
    let mut islands = vec![cells(10, 10, &ring, 1.0)];
    islands.extend(vec![cells(3, 3, &[true], 1.0); 4]);
    let shapes: Vec<Shape<'_>> = islands.iter().map(|(face_start, uv)| Shape { face_start, uv }).collect();
    let packed = pack(&shapes, &PackOptions { resolution: 1024, margin: 2.0 });
    assert!(packed.scale > 0.095, "the ring fills the square: {}", packed.scale);
}

/// Points, slivers and more margin than room: finite places, one for each.
#[test]
fn degenerate_islands_have_places() {
    let point = (vec![0, 3], vec![Vec2::new(1.0, 1.0); 3]);
    let sliver = (vec![0, 3], vec![Vec2::zeros(), Vec2::new(1e-9, 0.0), Vec2::new(5.0, 1e-12)]);
    for islands in
        [vec![point.clone()], vec![point.clone(); 3], vec![sliver.clone(), point], vec![sliver; 400]]
    {
        let shapes: Vec<Shape<'_>> =
            islands.iter().map(|(face_start, uv)| Shape { face_start, uv }).collect();
        let packed = pack(&shapes, &PackOptions { resolution: 64, margin: 30.0 });
        assert_eq!(packed.offsets.len(), islands.len());
        assert!(packed.offsets.iter().all(|p| p.iter().all(|x| x.is_finite())) && packed.scale > 0.0);
    }
}

/// Sizes whose squares no number holds, islands without width, margins larger than the square, and layouts so slender that no grid fits
/// them: finite places all the same, and apart where there are digits enough.
#[test]
fn extreme_sizes_have_places() {
    let rectangle = |width: f64, height: f64| {
        let uv = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|[x, y]| Vec2::new(x, y));
        (vec![0, 4], uv.to_vec())
    };
    type Island = (Vec<u32>, Vec<Vec2>);
    let cases: [(&str, Vec<Island>); 5] = [
        ("squares too large to be squared", vec![rectangle(1e160, 1e160), rectangle(3e159, 1e160)]),
        ("and too small", vec![rectangle(1e-200, 2e-200), rectangle(1e-200, 1e-200)]),
        ("a needle and a square", vec![rectangle(1e-30, 1.0), rectangle(1.0, 1.0)]),
        ("points", vec![rectangle(0.0, 0.0), rectangle(0.0, 0.0)]),
        ("towers", vec![rectangle(1e-9, 1e9), rectangle(1e-9, 1e9), rectangle(1e-9, 1e9)]),
    ];
    for (name, islands) in cases {
        let shapes: Vec<Shape<'_>> =
            islands.iter().map(|(starts, uv)| Shape { face_start: starts, uv }).collect();
        for margin in [0.0, 4.0, 1e9] {
            for resolution in [1, 1024] {
                let options = PackOptions { margin, resolution };
                for packed in [pack(&shapes, &options), lay_out(&shapes, 1.0, 1e-3, &options)] {
                    let places = packed.offsets.iter().chain([&packed.extent]);
                    assert!(places.flat_map(|p| p.iter()).all(|x| x.is_finite()), "{name}: {packed:?}");
                    assert!(packed.scale > 0.0 && packed.scale.is_finite(), "{name}: {packed:?}");
                }
            }
        }
    }
    let towers = vec![rectangle(1e-3, 1e3); 3];
    let shapes: Vec<Shape<'_>> = towers.iter().map(|(starts, uv)| Shape { face_start: starts, uv }).collect();
    let packed = lay_out(&shapes, 1.0, 1e-3, &PackOptions { margin: 4.0, resolution: 1024 });
    let (polygons, uv) = layout(&towers, &packed);
    assert!(certify(polygons.view(), &uv, 1).unwrap().holds, "one above the other: {packed:?}");
}

/// Strips of fewer rows than a cover may have, and of more, though a grid has room for them: they lie apart.
#[test]
fn islands_of_extreme_aspect_do_not_overlap() {
    for height in [60.0, 30_000.0, 32_000.0, 70_000.0] {
        let strip = cells(1, 40, &[true], 1.0);
        let stretched: Vec<Vec2> = strip.1.iter().map(|p| Vec2::new(p.x, p.y * height / 40.0)).collect();
        let strips = vec![(strip.0, stretched); 2];
        let shapes: Vec<Shape<'_>> = strips.iter().map(|(face_start, uv)| Shape { face_start, uv }).collect();
        let packed = lay_out(&shapes, 1.0, 1.0, &PackOptions::default());
        let (polygons, uv) = layout(&strips, &packed);
        let certificate = certify(polygons.view(), &uv, 1).unwrap();
        assert!(certificate.holds, "{height}: {certificate}");
    }
}
