//! One face at a time: is it positively oriented, and does it cover each of its points once?

use std::collections::{HashMap, HashSet};

use qembed::qmesh::Vec2;
use rayon::prelude::*;

use super::Map;
use super::violation::ViolationKind;
use crate::plane::{Scope, Segment, find_crossings, orientation};

/// Whether a face is a positive cell, and whether it would be one in the mirror.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Verdict {
    pub(super) plain: bool,
    pub(super) mirrored: bool,
    /// It is so by the split of an exempt quad only.
    pub(super) exempt: bool,
}

/// Looks at every face.
pub(super) fn judge(map: &Map<'_>) -> Vec<Verdict> {
    let faces = map.polygons.face_count();
    let mut verdicts: Vec<Verdict> =
        (0..faces).into_par_iter().with_min_len(1024).map(|face| alone(map, face)).collect();
    let is_bad_quad = |face: usize| {
        !verdicts[face].plain && !verdicts[face].mirrored && map.polygons.corners(face).len() == 4
    };
    let bad: Vec<usize> = (0..faces).filter(|&face| is_bad_quad(face)).collect();
    for (face, diagonal) in shared_diagonals(map, &bad) {
        let turns = turns(map, face);
        let of_split = |sign: i32| turns[diagonal] == sign && turns[diagonal + 2] == sign;
        let verdict = &mut verdicts[face];
        verdict.plain |= of_split(1);
        verdict.mirrored |= of_split(-1);
        verdict.exempt = verdict.plain || verdict.mirrored;
    }
    verdicts
}

fn alone(map: &Map<'_>, face: usize) -> Verdict {
    let range = map.polygons.corners(face);
    let sign = match range.len() {
        0..3 => 0,
        _ if !range.clone().all(|corner| map.is_finite(corner)) => 0,
        3 | 4 => {
            let first = map.turn(range.start);
            if range.skip(1).all(|corner| map.turn(corner) == first) { first } else { 0 }
        }
        _ => outline_sign(&range.map(|corner| map.uv[corner]).collect::<Vec<_>>()),
    };
    Verdict { plain: sign > 0, mirrored: sign < 0, exempt: false }
}

fn turns(map: &Map<'_>, face: usize) -> Vec<i32> {
    map.polygons.corners(face).map(|corner| map.turn(corner)).collect()
}

/// What is wrong with a face that is no positive cell: kinds and corners.
pub(super) fn faults(map: &Map<'_>, face: usize) -> Vec<(ViolationKind, usize)> {
    let range = map.polygons.corners(face);
    let infinite = range.clone().filter(|&corner| !map.is_finite(corner));
    let infinite: Vec<_> = infinite.map(|corner| (ViolationKind::NotFinite, corner)).collect();
    if !infinite.is_empty() {
        return infinite;
    }
    if range.len() < 3 {
        return vec![(ViolationKind::TooFewCorners, range.start)];
    }
    if range.len() > 4 {
        let points: Vec<Vec2> = range.clone().map(|corner| map.uv[corner]).collect();
        let kind =
            if outline_sign(&points) == 0 { ViolationKind::NotSimple } else { ViolationKind::FlippedFace };
        return vec![(kind, range.start)];
    }
    let turns = turns(map, face);
    let is_split = |diagonal: usize| turns[diagonal] > 0 && turns[diagonal + 2] > 0;
    let right = if turns.len() == 4 && (is_split(0) || is_split(1)) {
        ViolationKind::ConcaveQuad
    } else {
        ViolationKind::FlippedCorner
    };
    let faults = range.zip(&turns).filter(|&(_, &turn)| turn <= 0);
    faults.map(|(corner, &turn)| (if turn < 0 { right } else { ViolationKind::FlatCorner }, corner)).collect()
}

/// The bad quads whose opposite points also occur, without an edge between, in another face, or are joined by an edge of the map:
/// no map makes all faces concerned convex. With the place of the diagonal: 0 for the first and third corner, 1 for the others.
fn shared_diagonals(map: &Map<'_>, bad: &[usize]) -> Vec<(usize, usize)> {
    if bad.is_empty() {
        return Vec::new();
    }
    let diagonal = |face: usize, place: usize| {
        let start = map.polygons.corners(face).start + place;
        key(map.point(start), map.point(start + 2))
    };
    let wanted = Wanted::new(bad.iter().flat_map(|&face| [diagonal(face, 0), diagonal(face, 1)]));
    // How many faces hold the pair as a diagonal; an edge between its points counts for two.
    let mut times: HashMap<(u32, u32), usize> = HashMap::new();
    let mut place: HashMap<u32, usize> = HashMap::new();
    for face in 0..map.polygons.face_count() {
        let range = map.polygons.corners(face);
        if !range.clone().any(|corner| wanted.partners.contains_key(&map.point(corner))) {
            continue;
        }
        place.clear();
        place.extend(range.clone().map(|corner| (map.point(corner), corner - range.start)));
        for pair in wanted.candidates(&place).filter(|&pair| wanted.has(pair)) {
            let (Some(&at), Some(&to)) = (place.get(&pair.0), place.get(&pair.1)) else { continue };
            let apart = at.abs_diff(to);
            let is_edge = apart == 1 || apart + 1 == range.len();
            *times.entry(pair).or_default() += if is_edge { 2 } else { 1 };
        }
    }
    let is_shared = |pair: (u32, u32)| times.get(&pair).is_some_and(|&times| times > 1);
    let diagonals = bad.iter().flat_map(|&face| [(face, 0), (face, 1)]);
    diagonals.filter(|&(face, place)| is_shared(diagonal(face, place))).collect()
}

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Pairs of points to look for in faces.
struct Wanted {
    /// The higher points, by the lower.
    partners: HashMap<u32, HashSet<u32>>,
}

impl Wanted {
    /// Each of `pairs` has its lower point first.
    fn new(pairs: impl Iterator<Item = (u32, u32)>) -> Self {
        let mut partners: HashMap<u32, HashSet<u32>> = HashMap::new();
        for (lower, higher) in pairs {
            partners.entry(lower).or_default().insert(higher);
        }
        Self { partners }
    }

    fn has(&self, (lower, higher): (u32, u32)) -> bool {
        self.partners.get(&lower).is_some_and(|partners| partners.contains(&higher))
    }

    /// What may be among the pairs and between points of the face `place`: of each point its partners or the face's other points, which
    /// there are fewer of. A pole has a partner in each face around it, but each face has few points.
    fn candidates<'a>(&'a self, place: &'a HashMap<u32, usize>) -> impl Iterator<Item = (u32, u32)> + 'a {
        let of_point = |&point: &u32| self.partners.get(&point).map(|partners| (point, partners));
        place.keys().filter_map(of_point).flat_map(move |(point, partners)| {
            let are_few = partners.len() < place.len();
            let few = are_few.then_some(partners).into_iter().flatten();
            let others = (!are_few).then(|| place.keys()).into_iter().flatten();
            few.chain(others).map(move |&other| (point, other))
        })
    }
}

/// 1 for a simple polygon that runs counter-clockwise, −1 for a simple one that runs clockwise, 0 for one that is not simple:
/// edges that are no neighbours meet, neighbours fold back onto each other, or an edge has no length.
pub(crate) fn outline_sign(points: &[Vec2]) -> i32 {
    let n = points.len();
    let turn = |i: usize| orientation(points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
    let first = turn(0);
    if first != 0 && (1..n).all(|i| turn(i) == first) {
        return if winds_once(points) { first } else { 0 };
    }
    let is_bad = |i: usize| folds_back(points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
    if (0..n).any(is_bad) || crosses_itself(points) {
        return 0;
    }
    // The outermost corner of a simple polygon is strictly convex.
    (0..n).min_by(|&i, &j| lexical(points[i], points[j])).map_or(0, turn)
}

/// Whether b → c runs back along a → b, exactly; also when an edge has no length.
pub(super) fn folds_back(a: Vec2, b: Vec2, c: Vec2) -> bool {
    a == b
        || b == c
        || (orientation(a, b, c) == 0 && {
            let axis = usize::from(a.x == b.x);
            (a[axis] < b[axis]) == (c[axis] < b[axis])
        })
}

/// By x, then by y.
pub(super) fn lexical(a: Vec2, b: Vec2) -> std::cmp::Ordering {
    // `+ 0.0` turns −0 into 0.
    (a.x + 0.0).total_cmp(&(b.x + 0.0)).then((a.y + 0.0).total_cmp(&(b.y + 0.0)))
}

/// Whether a polygon that turns the same way at every corner does so through one full turn: it passes from pointing down to
/// pointing up once.
fn winds_once(points: &[Vec2]) -> bool {
    let n = points.len();
    let up: Vec<bool> = (0..n).map(|i| points_up(points[i], points[(i + 1) % n])).collect();
    (0..n).filter(|&i| !up[i] && up[(i + 1) % n]).count() == 1
}

/// Whether the direction from `a` to `b` is in the half-open upper half-plane.
pub(super) fn points_up(a: Vec2, b: Vec2) -> bool {
    b.y > a.y || (b.y == a.y && b.x > a.x)
}

fn crosses_itself(points: &[Vec2]) -> bool {
    let n = points.len();
    let segments = (0..n)
        .map(|i| {
            let j = (i + 1) % n;
            Segment { ends: [points[i], points[j]], points: [i as u32, j as u32], island: 0, id: i as u32 }
        })
        .collect();
    let found = find_crossings(segments, Scope::Everything, 0);
    found.count > 0 || !found.complete
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Around a pole each quad has a pair of its own there: looking for all pairs takes a few looks in each, not as many as there are pairs.
    #[test]
    fn a_pole_takes_a_few_looks_in_each_face() {
        let count = 1000;
        let wanted = Wanted::new((0..count).map(|k| (0, 1 + k)));
        let mut looks = 0;
        for k in 0..count {
            let place = [0, count + 1 + k, 1 + k, count + 1 + (k + 1) % count];
            let place: HashMap<u32, usize> =
                place.iter().zip(0..).map(|(&point, place)| (point, place)).collect();
            looks += wanted.candidates(&place).count();
            let found: Vec<_> = wanted.candidates(&place).filter(|&pair| wanted.has(pair)).collect();
            assert_eq!(found, [(0, 1 + k)]);
        }
        assert!(looks <= 4 * count as usize, "{looks} looks");
        let all: HashMap<u32, usize> = (0..=2 * count).zip(0..).collect();
        assert_eq!(wanted.candidates(&all).filter(|&pair| wanted.has(pair)).count(), count as usize);
    }

    fn sign(points: &[[i32; 2]]) -> i32 {
        let points: Vec<Vec2> = points.iter().map(|p| Vec2::new(f64::from(p[0]), f64::from(p[1]))).collect();
        let mirrored: Vec<Vec2> = points.iter().rev().copied().collect();
        let sign = outline_sign(&points);
        assert_eq!(outline_sign(&mirrored), -sign, "the other way round");
        sign
    }

    /// Concave polygons are simple; touching, folding back, edges without length and winding twice are not.
    #[test]
    fn simple_polygons_have_a_sign() {
        assert_eq!(sign(&[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]), 1, "concave");
        assert_eq!(sign(&[[0, 0], [2, 0], [4, 0], [4, 4], [0, 4]]), 1, "a straight corner");
        assert_eq!(sign(&[[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]]), 0, "a corner on an edge");
        assert_eq!(sign(&[[0, 0], [4, 0], [4, 4], [2, -1], [0, 4]]), 0, "a corner beyond an edge");
        assert_eq!(sign(&[[0, 0], [4, 0], [6, 0], [4, 0], [4, 4]]), 0, "a spike");
        assert_eq!(sign(&[[0, 0], [4, 0], [4, 0], [4, 4], [0, 4]]), 0, "an edge without length");
        assert_eq!(sign(&[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0], [4, 0], [4, 4], [0, 4]]), 0, "twice round");
        assert_eq!(sign(&[[0, 9], [-6, -8], [9, 3], [-9, 3], [6, -8]]), 0, "a pentagram");
        assert_eq!(sign(&[[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]]), 0, "flat");
    }
}
