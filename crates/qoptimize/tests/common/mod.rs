//! Polygons with random UVs, and the measures once more: written straight from the definitions, slowly, with other
//! formulas than the crate's (metric tensors, directions, integer predicates, all pairs).

#![allow(dead_code, reason = "each test file uses its part")]

pub(crate) mod exact;
pub(crate) mod maps;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use qoptimize::qmesh::{PolygonView, Polygons, Vec2};

/// A small generator of pseudo-random numbers (Knuth's MMIX constants).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self(seed ^ 0x9e37_79b9_7f4a_7c15);
        random.below(2);
        random
    }

    pub(crate) fn below(&mut self, bound: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as u32) % bound
    }

    /// In [−1, 1), a multiple of 2⁻²⁰.
    pub(crate) fn signed(&mut self) -> f64 {
        f64::from(self.below(1 << 21)) / f64::from(1 << 20) - 1.0
    }
}

/// A bumpy grid of quads, some cut into triangles and some joined into hexagons, with UVs on a lattice: `noise` 0 keeps
/// the grid, larger values bring flips, coincident points and zero areas. `seams` gives faces UVs of their own.
pub(crate) fn random_map(seed: u64, noise: u32, seams: bool) -> (Polygons, Vec<Vec2>) {
    const N: u32 = 5;
    const SPACING: f64 = 8.0;
    let mut random = Random::new(seed);
    let mut polygons = Polygons { face_start: vec![0], ..Polygons::default() };
    let mut vertex_uv = Vec::new();
    for i in 0..=N {
        for j in 0..=N {
            let at = [f64::from(i), f64::from(j), 0.0].map(|x| x + 0.3 * random.signed());
            polygons.positions.push(at.into());
            let shift = |random: &mut Random| f64::from(random.below(2 * noise + 1)) - f64::from(noise);
            vertex_uv.push(Vec2::new(
                SPACING * f64::from(i) + shift(&mut random),
                SPACING * f64::from(j) + shift(&mut random),
            ));
        }
    }
    let id = |i: u32, j: u32| i * (N + 1) + j;
    for i in 0..N {
        let mut j = 0;
        while j < N {
            match random.below(5) {
                0 => {
                    polygons.push_face(&[id(i, j), id(i + 1, j), id(i + 1, j + 1)]);
                    polygons.push_face(&[id(i, j), id(i + 1, j + 1), id(i, j + 1)]);
                }
                1 if j + 1 < N => {
                    let right = [id(i + 1, j), id(i + 1, j + 1), id(i + 1, j + 2)];
                    let left = [id(i, j + 2), id(i, j + 1), id(i, j)];
                    polygons.push_face(&[right, left].concat());
                    j += 1;
                }
                _ => polygons.push_face(&[id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]),
            }
            j += 1;
        }
    }
    let mut uv: Vec<Vec2> = polygons.corner_vertex.iter().map(|&v| vertex_uv[v as usize]).collect();
    if seams {
        for face in 0..polygons.view().face_count() {
            if random.below(4) == 0 {
                let mirrored = random.below(2) == 0;
                for corner in polygons.view().corners(face) {
                    uv[corner].x = if mirrored { 100.0 - uv[corner].x } else { uv[corner].x + 50.0 };
                }
            }
        }
    }
    (polygons, uv)
}

/// Measures by name.
pub(crate) type Measures = BTreeMap<&'static str, f64>;

/// The slow ruler. UVs must be small integers.
pub(crate) fn slow_measures(polygons: PolygonView<'_>, uv: &[Vec2]) -> Measures {
    let faces = polygons.face_count();
    let island = islands(polygons, uv);
    let islands = island.iter().max().map_or(0, |&last| last + 1);
    let integer = |c: usize| [uv[c].x as i64, uv[c].y as i64];
    let turn =
        |a: [i64; 2], b: [i64; 2], c: [i64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let ring = |face: usize| -> Vec<[usize; 3]> {
        let corners: Vec<usize> = polygons.corners(face).collect();
        let n = corners.len();
        (0..n).map(|i| [corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]]).collect()
    };
    let shoelace = |face: usize| -> i64 {
        ring(face).iter().map(|&[_, a, b]| turn([0, 0], integer(a), integer(b))).sum()
    };
    let mirror: Vec<i64> = (0..islands)
        .map(|i| (0..faces).filter(|&f| island[f] == i).map(shoelace).sum::<i64>())
        .map(|area| if area < 0 { -1 } else { 1 })
        .collect();

    // Areas: Gram determinants in space, integers in the plane.
    let edges = |c: [usize; 3]| {
        let at = |c: usize| polygons.positions[polygons.corner_vertex[c] as usize];
        [at(c[2]) - at(c[1]), at(c[0]) - at(c[1])]
    };
    let gram = |c: [usize; 3]| {
        let [a, b] = edges(c);
        [a.dot(&a), a.dot(&b), b.dot(&b)]
    };
    let space_area = |c: [usize; 3]| {
        let [aa, ab, bb] = gram(c);
        (aa * bb - ab * ab).max(0.0).sqrt() / 2.0
    };
    let weight = |n: usize| {
        if n == 3 {
            1.0 / 3.0
        } else if n == 4 {
            0.5
        } else {
            1.0 / (n as f64 - 2.0)
        }
    };
    let mut corners = Vec::new();
    for face in 0..faces {
        let ring = ring(face);
        for &c in &ring {
            let doubled = turn(integer(c[0]), integer(c[1]), integer(c[2])) * mirror[island[face]];
            corners.push((face, c, weight(ring.len()), space_area(c), doubled));
        }
    }
    let total_space: f64 = corners.iter().map(|&(_, _, w, area, _)| w * area).sum();
    let total_plane: f64 = corners.iter().map(|&(_, _, w, _, d)| w * d.abs() as f64 / 2.0).sum();
    let scale2 = total_space / total_plane;
    let n = corners.len() as f64;
    let mean_plane = corners.iter().map(|&(.., d)| d.abs() as f64 / 2.0 * scale2).sum::<f64>() / n;
    let mean_space = corners.iter().map(|&(_, _, w, area, _)| w * area).sum::<f64>() / n;

    let mut m = Measures::new();
    let (mut angle_terms, mut angle_symmetric, mut angle_squares) = (vec![], vec![], vec![]);
    let (mut ratios, mut area_symmetric) = (vec![], vec![]);
    let (mut singular, mut inverse) = (vec![], vec![]);
    for &(_, c, w, area, doubled) in &corners {
        // Angles: Kahan's half-angle formula in space, a difference of directions in the plane.
        let [a, b] = edges(c);
        let (p, q) = (a * b.norm(), b * a.norm());
        let theta = 2.0 * (p - q).norm().atan2((p + q).norm());
        let direction = |to: usize| {
            let d = uv[to] - uv[c[1]];
            (d.y * mirror[island[face_of(polygons, c[1])]] as f64).atan2(d.x)
        };
        let same = |to: usize| integer(to) == integer(c[1]);
        let is_spike = doubled == 0 && (uv[c[0]] - uv[c[1]]).dot(&(uv[c[2]] - uv[c[1]])) > 0.0;
        let phi = if same(c[0]) || same(c[2]) || is_spike {
            0.0
        } else {
            (direction(c[0]) - direction(c[2])).rem_euclid(TAU)
        };
        *m.entry("angle_clamped").or_default() += f64::from(phi < 1e-9);
        angle_terms.push((theta / phi.max(1e-9) - 1.0).powi(2));
        let ratio = theta.max(1e-9) / phi.max(1e-9);
        angle_symmetric.push((ratio.max(1.0 / ratio) - 1.0).powi(2));
        angle_squares.push((theta - phi).powi(2));

        let plane_area = doubled as f64 / 2.0 * scale2;
        *m.entry("area_clamped").or_default() += f64::from(doubled == 0);
        let ratio = area / if doubled == 0 { 1e-12 * mean_plane } else { plane_area };
        ratios.push(ratio);
        if doubled > 0 {
            area_symmetric.push((ratio.max(1.0 / ratio) - 1.0).powi(2));
        }

        // Stretch: eigenvalues of the first fundamental form of the plane against that of space.
        assert!(area > 1e-6 * mean_space, "the positions of the tests are not degenerate");
        let [aa, ab, bb] = gram(c);
        let [e, f] = [uv[c[2]] - uv[c[1]], uv[c[0]] - uv[c[1]]].map(|edge| edge * scale2.sqrt());
        let det = aa * bb - ab * ab;
        let trace = (bb * e.dot(&e) - 2.0 * ab * e.dot(&f) + aa * f.dot(&f)) / det;
        let product = (plane_area / area).powi(2);
        let large = (trace + (trace * trace - 4.0 * product).max(0.0).sqrt()) / 2.0;
        let small = if large > 0.0 { product / large } else { 0.0 };
        if doubled > 0 {
            singular.push((w * area, large.sqrt(), small.sqrt()));
        }
        inverse.push((
            w * area,
            (trace / product.max(1e-300) / 2.0).min(1e300),
            1.0 / small.sqrt().max(1e-150),
        ));
    }
    let sum = |values: &[f64]| values.iter().sum::<f64>();
    let quantile = |values: &[f64], fraction: f64| {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let place = fraction * (sorted.len() - 1) as f64;
        let (low, high) = (place.floor() as usize, place.ceil() as usize);
        sorted[low] * (1.0 - place.fract()) + sorted[high] * place.fract()
    };
    let area_terms: Vec<f64> = ratios.iter().map(|r| (r - 1.0).powi(2)).collect();
    m.insert("angle_error", sum(&angle_terms));
    m.insert("angle_error_mean", sum(&angle_terms) / n);
    m.insert("angle_error_median", quantile(&angle_terms, 0.5));
    m.insert("angle_error_p99", quantile(&angle_terms, 0.99));
    m.insert("angle_error_symmetric", sum(&angle_symmetric) / n);
    m.insert("angle_rms_degrees", (sum(&angle_squares) / n).sqrt() * 360.0 / TAU);
    m.insert("area_error", sum(&area_terms));
    m.insert("area_error_mean", sum(&area_terms) / n);
    m.insert("area_error_median", quantile(&area_terms, 0.5));
    m.insert("area_error_p99", quantile(&area_terms, 0.99));
    m.insert("area_error_best_scale", best_scale(&ratios));
    if !singular.is_empty() {
        m.insert("area_error_symmetric", sum(&area_symmetric) / area_symmetric.len() as f64);
        let total: f64 = singular.iter().map(|s| s.0).sum();
        let mean =
            |f: &dyn Fn(f64, f64) -> f64| singular.iter().map(|&(w, a, b)| w * f(a, b)).sum::<f64>() / total;
        let each: Vec<f64> = singular.iter().map(|&(_, a, b)| a / b).collect();
        let dirichlet = |a: f64, b: f64| (a * a + b * b + 1.0 / (a * a) + 1.0 / (b * b)) / 4.0;
        m.insert("symmetric_dirichlet", mean(&dirichlet));
        m.insert(
            "symmetric_dirichlet_max",
            singular.iter().map(|&(_, a, b)| dirichlet(a, b)).fold(0.0, f64::max),
        );
        m.insert("mips", mean(&|a, b| (a * a + b * b) / (2.0 * a * b)));
        m.insert("arap", mean(&|a, b| (a - 1.0).powi(2) + (b - 1.0).powi(2)));
        m.insert("singular_ratio_mean", mean(&|a, b| a / b));
        m.insert("singular_ratio_p99", quantile(&each, 0.99));
        m.insert("singular_ratio_max", each.iter().copied().fold(0.0, f64::max));
    }
    let total: f64 = inverse.iter().map(|s| s.0).sum();
    m.insert("stretch_l2", (inverse.iter().map(|&(w, s, _)| w * s).sum::<f64>() / total).sqrt());
    m.insert("stretch_linf", inverse.iter().map(|s| s.2).fold(0.0, f64::max));

    let bad = |face: usize, place: usize| {
        let c = ring(face)[place];
        turn(integer(c[0]), integer(c[1]), integer(c[2])) * mirror[island[face]] <= 0
    };
    let degree = |face: usize| polygons.corners(face).len();
    let negative = |face: usize| shoelace(face) * mirror[island[face]] <= 0;
    let folded = |face: usize| match degree(face) {
        3 => bad(face, 0),
        4 => (bad(face, 0) || bad(face, 2)) && (bad(face, 1) || bad(face, 3)),
        _ => negative(face),
    };
    let count = |test: &dyn Fn(usize) -> bool| (0..faces).filter(|&f| test(f)).count() as f64;
    m.insert("flipped_corners", corners.iter().filter(|c| c.4 <= 0).count() as f64);
    m.insert("flipped_faces", count(&|f| (0..degree(f)).any(|i| bad(f, i))));
    m.insert("folded_faces", count(&folded));
    m.insert("negative_faces", count(&negative));
    m.insert("islands", islands as f64);
    m.insert("mirrored_islands", mirror.iter().filter(|&&m| m < 0).count() as f64);
    m.insert("boundary_crossings", crossings(polygons, uv, &island) as f64);
    m
}

fn face_of(polygons: PolygonView<'_>, corner: usize) -> usize {
    (0..polygons.face_count())
        .find(|&f| polygons.corners(f).contains(&corner))
        .expect("a corner of some face")
}

/// The smallest Σ (r x − 1)² over x ≥ 0, by golden-section search: it is convex.
fn best_scale(ratios: &[f64]) -> f64 {
    let value = |x: f64| ratios.iter().map(|r| (r * x - 1.0).powi(2)).sum::<f64>();
    let largest = ratios.iter().map(|r| r.abs()).fold(0.0, f64::max);
    let (mut low, mut high) = (0.0, ratios.len() as f64 / largest);
    for _ in 0..200 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if value(a) < value(b) { high = b } else { low = a }
    }
    value(low).min(value(0.0))
}

type End = (u32, [i64; 2]);

/// The ends of each face's edges as points of the map.
fn face_edges(polygons: PolygonView<'_>, uv: &[Vec2], face: usize) -> Vec<[End; 2]> {
    let corners: Vec<usize> = polygons.corners(face).collect();
    let end = |c: usize| (polygons.corner_vertex[c], [uv[c].x as i64, uv[c].y as i64]);
    (0..corners.len()).map(|i| [end(corners[i]), end(corners[(i + 1) % corners.len()])]).collect()
}

fn undirected([a, b]: [End; 2]) -> [End; 2] {
    [a.min(b), a.max(b)]
}

/// Flood fill over all pairs of faces.
fn islands(polygons: PolygonView<'_>, uv: &[Vec2]) -> Vec<usize> {
    let faces = polygons.face_count();
    let edges: Vec<Vec<[End; 2]>> =
        (0..faces).map(|f| face_edges(polygons, uv, f).into_iter().map(undirected).collect()).collect();
    let mut island = vec![usize::MAX; faces];
    let mut next = 0;
    for seed in 0..faces {
        if island[seed] != usize::MAX {
            continue;
        }
        let mut stack = vec![seed];
        while let Some(face) = stack.pop() {
            island[face] = next;
            let touches = |other: usize| edges[other].iter().any(|e| edges[face].contains(e));
            stack.extend((0..faces).filter(|&other| island[other] == usize::MAX && touches(other)));
        }
        next += 1;
    }
    island
}

/// All pairs of boundary edges of one island that meet and share no point, in integers.
fn crossings(polygons: PolygonView<'_>, uv: &[Vec2], island: &[usize]) -> usize {
    let all: Vec<(usize, [End; 2])> = (0..polygons.face_count())
        .flat_map(|f| face_edges(polygons, uv, f).into_iter().map(move |e| (f, e)))
        .collect();
    let uses = |edge: [End; 2]| all.iter().filter(|(_, e)| undirected(*e) == undirected(edge)).count();
    let boundary: Vec<_> = all.iter().filter(|(_, edge)| uses(*edge) == 1).collect();
    let mut count = 0;
    for (i, (f, a)) in boundary.iter().enumerate() {
        for (g, b) in &boundary[i + 1..] {
            let share = a.iter().any(|end| b.contains(end));
            count +=
                usize::from(!share && island[*f] == island[*g] && meet([a[0].1, a[1].1], [b[0].1, b[1].1]));
        }
    }
    count
}

fn meet(a: [[i64; 2]; 2], b: [[i64; 2]; 2]) -> bool {
    let side = |s: [[i64; 2]; 2], p: [i64; 2]| {
        let (d, e) = ([s[1][0] - s[0][0], s[1][1] - s[0][1]], [p[0] - s[0][0], p[1] - s[0][1]]);
        (d[0] * e[1] - d[1] * e[0]).signum()
    };
    let on = |s: [[i64; 2]; 2], p: [i64; 2]| {
        side(s, p) == 0 && (0..2).all(|k| p[k] >= s[0][k].min(s[1][k]) && p[k] <= s[0][k].max(s[1][k]))
    };
    let proper = side(a, b[0]) * side(a, b[1]) < 0 && side(b, a[0]) * side(b, a[1]) < 0;
    proper || on(a, b[0]) || on(a, b[1]) || on(b, a[0]) || on(b, a[1])
}
