//! Small meshes of every kind, from bytes: lattices closed in all ways, cubes, soups; then edited until the bytes are used up.

use super::bytes::Bytes;

/// Faces as lists of vertices, from 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape {
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) faces: Vec<Vec<usize>>,
}

/// More faces than this are not made: the point is kinds, not sizes.
const MOST_FACES: usize = 60;

impl Shape {
    pub(crate) fn new(bytes: &mut Bytes<'_>) -> Self {
        let mut shape = Self::default();
        for place in 0..1 + bytes.below(8).saturating_sub(5) {
            let mut part = match bytes.below(8) {
                0..5 => lattice(bytes),
                5 => cube(),
                6 => fan(bytes),
                _ => soup(bytes),
            };
            part.positions.iter_mut().for_each(|p| p[0] += 20.0 * place as f64);
            shape.add(part);
        }
        for _ in 0..bytes.below(12) {
            shape.edit(bytes);
        }
        shape.faces.truncate(MOST_FACES);
        shape
    }

    fn add(&mut self, part: Self) {
        let before = self.positions.len();
        self.positions.extend(part.positions);
        self.faces.extend(part.faces.into_iter().map(|face| face.into_iter().map(|v| v + before).collect()));
    }

    fn edit(&mut self, bytes: &mut Bytes<'_>) {
        if self.faces.is_empty() || self.positions.is_empty() {
            return;
        }
        let face = bytes.below(self.faces.len());
        let vertex = bytes.below(self.positions.len());
        match bytes.below(12) {
            0 => self.faces[face].reverse(),
            1 => drop(self.faces.remove(face)),
            2 => self.faces.push(self.faces[face].clone()),
            3 => {
                let to = bytes.below(self.positions.len());
                self.faces.iter_mut().flatten().filter(|v| **v == vertex).for_each(|v| *v = to);
            }
            4 => self.positions[vertex] = self.positions[bytes.below(self.positions.len())],
            5 => self.positions[vertex] = [(); 3].map(|()| bytes.coordinate()),
            6 => {
                let factor = bytes.coordinate();
                self.positions.iter_mut().flatten().for_each(|x| *x *= factor);
            }
            7 => {
                let axis = bytes.below(3);
                self.positions.iter_mut().for_each(|p| p[axis] = 0.0);
            }
            8 => {
                // A quad in two triangles, or an n-gon in smaller ones.
                let corners = self.faces[face].clone();
                if corners.len() > 3 {
                    self.faces[face] = vec![corners[0], corners[1], corners[2]];
                    self.faces.push([&corners[..1], &corners[2..]].concat());
                }
            }
            9 => {
                // A new vertex in an edge, of one face only: a T-junction, or a doublet where both sides have it.
                let at = bytes.below(self.faces[face].len());
                self.faces[face].insert(at, vertex);
            }
            10 => self.positions.push([bytes.coordinate(), 0.0, 0.0]),
            _ => {
                let at = bytes.below(self.faces[face].len());
                if self.faces[face].len() > 3 {
                    self.faces[face].remove(at);
                }
            }
        }
    }

    /// As an OBJ file.
    pub(crate) fn text(&self, group_every: usize) -> String {
        let mut text = String::new();
        for [x, y, z] in &self.positions {
            text += &format!("v {x:e} {y:e} {z:e}\n");
        }
        for (index, face) in self.faces.iter().enumerate() {
            if group_every > 0 && index % group_every == 0 {
                text += &format!("g part{}\nusemtl m{}\n", index / group_every, index % 2);
            }
            text += "f";
            for vertex in face {
                text += &format!(" {}", vertex + 1);
            }
            text += "\n";
        }
        text
    }
}

/// Up to 6 × 6 cells, open, or closed in one or two directions, straight or twisted.
fn lattice(bytes: &mut Bytes<'_>) -> Shape {
    let (columns, rows) = (1 + bytes.below(6), 1 + bytes.below(6));
    let [across, along] = [(); 2].map(|()| ["open", "open", "closed", "twisted"][bytes.below(4)]);
    let bend = bytes.coordinate();
    let jitter = f64::from(bytes.byte()) / 512.0;
    let width = columns + usize::from(across == "open");
    let height = rows + usize::from(along == "open");
    let positions = (0..width * height)
        .map(|v| {
            let (i, j) = ((v % width) as f64, (v / width) as f64);
            let (angle, tilt) =
                (std::f64::consts::TAU * i / columns as f64, std::f64::consts::TAU * j / rows as f64);
            let noise = jitter * (7.0 * i + 13.0 * j).sin();
            match (across, along) {
                ("open", "open") => [i + noise, j - noise, bend * (0.3 * i).sin() * (0.4 * j).cos()],
                (_, "open") => [angle.cos() + noise, j, angle.sin()],
                ("open", _) => [i, tilt.cos() + noise, tilt.sin()],
                _ => [angle.cos() * (3.0 + tilt.cos()), tilt.sin() + noise, angle.sin() * (3.0 + tilt.cos())],
            }
        })
        .collect();
    let at = |i: usize, j: usize| {
        let (mut i, mut j) = (i, j);
        if i == width && across != "open" {
            (i, j) = (0, if across == "twisted" { height - 1 - j.min(height - 1) } else { j });
        }
        if j == height && along != "open" {
            (i, j) = (if along == "twisted" { width - 1 - i.min(width - 1) } else { i }, 0);
        }
        j.min(height - 1) * width + i.min(width - 1)
    };
    let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let faces = cells.map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect();
    Shape { positions, faces }
}

fn cube() -> Shape {
    let positions =
        (0..8).map(|v| [f64::from(v & 1), f64::from(v >> 1 & 1), f64::from(v >> 2 & 1)]).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Shape { positions, faces: faces.iter().map(|face| face.to_vec()).collect() }
}

/// Quads or triangles around one vertex, perhaps not all the way.
fn fan(bytes: &mut Bytes<'_>) -> Shape {
    let count = 3 + bytes.below(14);
    let used = count - bytes.below(3);
    let rim = |i: usize, radius: f64| {
        let angle = std::f64::consts::TAU * i as f64 / count as f64;
        [radius * angle.cos(), radius * angle.sin(), 0.1 * (i % 3) as f64]
    };
    let mut positions = vec![[0.0, 0.0, f64::from(bytes.byte()) / 32.0]];
    positions.extend((0..count).flat_map(|i| [rim(2 * i, 1.0), rim(2 * i + 1, 1.5)]));
    let is_quads = bytes.byte().is_multiple_of(2);
    let corner = |i: usize| 1 + 2 * (i % count);
    let faces = (0..used).map(|i| {
        if is_quads {
            vec![0, corner(i), corner(i) + 1, corner(i + 1)]
        } else {
            vec![0, corner(i), corner(i + 1)]
        }
    });
    Shape { faces: faces.collect(), positions }
}

/// Any faces on a few vertices.
fn soup(bytes: &mut Bytes<'_>) -> Shape {
    let count = 4 + bytes.below(12);
    let positions =
        (0..count).map(|v| [(2.4 * v as f64).cos(), (2.4 * v as f64).sin(), 0.3 * v as f64]).collect();
    let faces = (0..1 + bytes.below(14)).map(|_| {
        let degree = [4, 4, 4, 3, 5][bytes.below(5)];
        (0..degree).map(|_| bytes.below(count)).collect()
    });
    Shape { faces: faces.collect(), positions }
}
