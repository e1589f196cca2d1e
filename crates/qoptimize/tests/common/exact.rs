//! Injectivity by brute force, sharing nothing with the crate: every face is cut into triangles, and every two triangles are compared
//! with integers of any length. Slow, and easy to believe.

#![allow(dead_code, reason = "each user has its part")]

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// The first thing found wrong with a map, in words; nothing when it is injective, every quad convex (but those that no map can make
/// so), and no two boundaries touch.
///
/// Faces as lists of vertices; a UV per corner, face after face.
pub(crate) fn fault(faces: &[Vec<u32>], uv: &[[f64; 2]]) -> Option<String> {
    if let Some(corner) = uv.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return Some(format!("corner {corner} is not finite"));
    }
    let map = Map::new(faces, uv);
    let mut triangles = Vec::new();
    for face in 0..map.faces.len() {
        match map.triangles_of(face) {
            Some(found) => triangles.extend(found.into_iter().map(|triangle| (face, triangle))),
            None => return Some(format!("face {face} is not positive")),
        }
    }
    if let Some(point) = map.pinched_point() {
        return Some(format!("the faces around point {point} hang together there only"));
    }
    map.overlap(&triangles)
}

struct Map {
    /// Each face as points: a vertex at a place.
    faces: Vec<Vec<usize>>,
    places: Vec<[f64; 2]>,
    exact: Vec<[Integer; 2]>,
}

type Triangle = [usize; 3];

impl Map {
    fn new(faces: &[Vec<u32>], uv: &[[f64; 2]]) -> Self {
        let mut numbers = BTreeMap::new();
        let mut map = Self { faces: Vec::new(), places: Vec::new(), exact: Vec::new() };
        let mut corner = 0;
        for face in faces {
            let mut points = Vec::new();
            for &vertex in face {
                let place = uv[corner].map(|x| x + 0.0);
                let next = map.places.len();
                let point = *numbers.entry((vertex, place.map(f64::to_bits))).or_insert(next);
                if point == next {
                    map.places.push(place);
                }
                points.push(point);
                corner += 1;
            }
            map.faces.push(points);
        }
        let lowest = map.places.iter().flatten().filter(|&&x| x != 0.0).map(|&x| Integer::exponent(x)).min();
        map.exact = map.places.iter().map(|p| p.map(|x| Integer::new(x, lowest.unwrap_or(0)))).collect();
        map
    }

    /// Which way three points turn.
    fn turn(&self, [a, b, c]: Triangle) -> Ordering {
        let [p, q, r] = [a, b, c].map(|point| self.places[point]);
        let (left, right) = ((q[0] - p[0]) * (r[1] - p[1]), (q[1] - p[1]) * (r[0] - p[0]));
        let size = left.abs() + right.abs();
        if size.is_finite() && size > 1e-200 && (left - right).abs() > 1e-12 * size {
            return (left - right).total_cmp(&0.0);
        }
        let [p, q, r] = [a, b, c].map(|point| &self.exact[point]);
        let left = q[0].minus(&p[0]).times(&r[1].minus(&p[1]));
        let right = q[1].minus(&p[1]).times(&r[0].minus(&p[0]));
        left.minus(&right).sign()
    }

    fn is_left(&self, triangle: Triangle) -> bool {
        self.turn(triangle) == Ordering::Greater
    }

    fn triangles_of(&self, face: usize) -> Option<Vec<Triangle>> {
        let points = &self.faces[face];
        let found = match points[..] {
            [a, b, c] => vec![[a, b, c]],
            [a, b, c, d] => {
                let corners = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]];
                let is_left = corners.map(|corner| self.is_left(corner));
                if is_left == [true; 4] || (is_left[0] && is_left[2] && self.is_shared(face, a, c)) {
                    vec![corners[0], corners[2]]
                } else if is_left[1] && is_left[3] && self.is_shared(face, b, d) {
                    vec![corners[1], corners[3]]
                } else {
                    return None;
                }
            }
            _ => self.ears(points)?,
        };
        found.iter().all(|&triangle| self.is_left(triangle)).then_some(found)
    }

    /// Whether another face has both points too, or they are the ends of an edge.
    fn is_shared(&self, face: usize, a: usize, b: usize) -> bool {
        (0..self.faces.len())
            .any(|other| other != face && self.faces[other].contains(&a) && self.faces[other].contains(&b))
    }

    /// Cuts off one triangle after the other that holds no other point.
    fn ears(&self, points: &[usize]) -> Option<Vec<Triangle>> {
        let mut rest = points.to_vec();
        let mut ears = Vec::new();
        while rest.len() > 3 {
            let n = rest.len();
            let ear = (0..n).map(|i| [rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]]).enumerate().find(
                |(_, [a, b, c])| {
                    let holds = |p: usize| {
                        [[*a, *b, p], [*b, *c, p], [*c, *a, p]]
                            .iter()
                            .all(|&t| self.turn(t) != Ordering::Less)
                    };
                    self.is_left([*a, *b, *c]) && rest.iter().all(|p| [a, b, c].contains(&p) || !holds(*p))
                },
            );
            let (place, ear) = ear?;
            ears.push(ear);
            rest.remove(place);
        }
        ears.push([rest[0], *rest.get(1)?, *rest.get(2)?]);
        Some(ears)
    }

    /// A point whose faces do not all hang together by edges at it.
    fn pinched_point(&self) -> Option<usize> {
        let mut around: BTreeMap<usize, Vec<BTreeSet<usize>>> = BTreeMap::new();
        for points in &self.faces {
            let n = points.len();
            for i in 0..n {
                let mut fan = BTreeSet::from([points[(i + n - 1) % n], points[(i + 1) % n]]);
                let fans = around.entry(points[i]).or_default();
                fans.retain(|other| {
                    let is_apart = other.is_disjoint(&fan);
                    if !is_apart {
                        fan.extend(other);
                    }
                    is_apart
                });
                fans.push(fan);
            }
        }
        around.into_iter().find(|(_, fans)| fans.len() > 1).map(|(point, _)| point)
    }

    /// Two triangles that have more in common than the points that they share and what lies between.
    fn overlap(&self, triangles: &[(usize, Triangle)]) -> Option<String> {
        let range = |triangle: Triangle, axis: usize| {
            let values = triangle.map(|point| self.places[point][axis]);
            (values.into_iter().fold(f64::MAX, f64::min), values.into_iter().fold(f64::MIN, f64::max))
        };
        let mut order: Vec<((f64, f64), usize)> =
            (0..triangles.len()).map(|i| (range(triangles[i].1, 0), i)).collect();
        order.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        for (place, &((_, high), i)) in order.iter().enumerate() {
            let (low_y, high_y) = range(triangles[i].1, 1);
            for &(_, j) in order[place + 1..].iter().take_while(|other| other.0.0 <= high) {
                let other = range(triangles[j].1, 1);
                if other.0 <= high_y && low_y <= other.1 && self.meet(triangles[i].1, triangles[j].1) {
                    return Some(format!("faces {} and {} overlap", triangles[i].0, triangles[j].0));
                }
            }
        }
        None
    }

    fn meet(&self, s: Triangle, t: Triangle) -> bool {
        let shared: Vec<usize> = s.into_iter().filter(|point| t.contains(point)).collect();
        let edges = |t: Triangle| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        match shared[..] {
            // Disjoint convex sets are parted by the line of one of their edges.
            [] => {
                let parts = |s: Triangle, t: Triangle| {
                    edges(s).iter().any(|&[a, b]| t.iter().all(|&p| self.turn([a, b, p]) == Ordering::Less))
                };
                !parts(s, t) && !parts(t, s)
            }
            // A second common point would lie on a ray from the first that both have.
            [p] => {
                let legs = |t: Triangle| {
                    let i = t.iter().position(|&q| q == p).unwrap_or(0);
                    [t[(i + 1) % 3], t[(i + 2) % 3]]
                };
                let ([a, b], [c, d]) = (legs(s), legs(t));
                let is_inside = |q: usize, [from, to]: [usize; 2]| {
                    self.turn([p, from, q]) != Ordering::Less && self.turn([p, q, to]) != Ordering::Less
                };
                is_inside(c, [a, b]) || is_inside(a, [c, d])
            }
            [p, q] => {
                let third = |t: Triangle| t.into_iter().find(|r| ![p, q].contains(r)).unwrap_or(p);
                let sides = [s, t].map(|t| self.turn([p, q, third(t)]));
                sides[0] == sides[1] || sides.contains(&Ordering::Equal)
            }
            _ => true,
        }
    }
}

/// A whole number: whether it is negative, and its digits to base 2³², the lowest first, without zeros at the end.
#[derive(Clone, Debug)]
struct Integer {
    is_negative: bool,
    digits: Vec<u32>,
}

impl Integer {
    /// The exponent of the unit in the last place.
    fn exponent(x: f64) -> i32 {
        ((x.to_bits() >> 52 & 0x7ff) as i32).max(1)
    }

    /// `x` in units of `2^lowest`, exponents as above.
    fn new(x: f64, lowest: i32) -> Self {
        let fraction = x.to_bits() & ((1 << 52) - 1);
        let mantissa = if x.to_bits() >> 52 & 0x7ff == 0 { fraction } else { fraction | 1 << 52 };
        let shift = if x == 0.0 { 0 } else { (Self::exponent(x) - lowest) as usize };
        let mut digits = vec![0; shift / 32];
        let shifted = u128::from(mantissa) << (shift % 32);
        digits.extend([shifted as u32, (shifted >> 32) as u32, (shifted >> 64) as u32]);
        Self { is_negative: x < 0.0, digits }.trimmed()
    }

    fn trimmed(mut self) -> Self {
        while self.digits.last() == Some(&0) {
            self.digits.pop();
        }
        self
    }

    fn sign(&self) -> Ordering {
        match (self.digits.is_empty(), self.is_negative) {
            (true, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            _ => Ordering::Greater,
        }
    }

    fn minus(&self, other: &Self) -> Self {
        let negated = !other.is_negative;
        if self.is_negative == negated {
            return Self { is_negative: negated, digits: added(&self.digits, &other.digits) };
        }
        let is_smaller = self
            .digits
            .len()
            .cmp(&other.digits.len())
            .then_with(|| self.digits.iter().rev().cmp(other.digits.iter().rev()))
            == Ordering::Less;
        if is_smaller {
            Self { is_negative: negated, digits: subtracted(&other.digits, &self.digits) }.trimmed()
        } else {
            Self { is_negative: self.is_negative, digits: subtracted(&self.digits, &other.digits) }.trimmed()
        }
    }

    fn times(&self, other: &Self) -> Self {
        let mut digits = vec![0_u32; self.digits.len() + other.digits.len()];
        for (i, &a) in self.digits.iter().enumerate() {
            let mut carry = 0_u64;
            for (j, &b) in other.digits.iter().enumerate() {
                let sum = u64::from(digits[i + j]) + u64::from(a) * u64::from(b) + carry;
                (digits[i + j], carry) = (sum as u32, sum >> 32);
            }
            digits[i + other.digits.len()] = carry as u32;
        }
        Self { is_negative: self.is_negative != other.is_negative, digits }.trimmed()
    }
}

fn added(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut carry = 0_u64;
    let digit = |d: &[u32], i: usize| u64::from(d.get(i).copied().unwrap_or(0));
    let mut sum: Vec<u32> = (0..a.len().max(b.len()))
        .map(|i| {
            let total = digit(a, i) + digit(b, i) + carry;
            carry = total >> 32;
            total as u32
        })
        .collect();
    if carry > 0 {
        sum.push(carry as u32);
    }
    sum
}

/// `a − b` for `a ≥ b`.
fn subtracted(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut borrow = 0_i64;
    a.iter()
        .enumerate()
        .map(|(i, &digit)| {
            let mut rest = i64::from(digit) - i64::from(b.get(i).copied().unwrap_or(0)) - borrow;
            borrow = i64::from(rest < 0);
            rest += borrow << 32;
            rest as u32
        })
        .collect()
}
