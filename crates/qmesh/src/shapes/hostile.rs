//! Disks that defeat parameterizations: folded, stretched, spiky, full of doublets.
//!
//! Every one is an oriented manifold disk of quads; what is wrong with it is its shape, or that some of its quads cannot all be
//! convex in any planar map.

use super::elementary::{SplitMix64, sin_cos};
use super::lattice::built;
use crate::{Polygons, QuadMesh, Vec3};

/// What is hostile about a disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Hostility {
    /// Every vertex off its place by up to half a cell, in all directions.
    Jittered,
    /// Vertices at random in a box: faces fold and cross in space.
    Folded,
    /// One direction a million times longer than the other.
    Stretched,
    /// Quads with an edge of a thousand-millionth of the others.
    Slivers,
    /// A vertex of valence 2 to 20.
    Pole,
    /// Pairs of quads that share two edges.
    Doublets,
    /// Quads that share their opposite vertices, with more quads between them, several levels deep.
    Bubbles,
    /// Long closed tubes on a plate.
    Fingers,
    /// Tubes that grow from the sides of tubes.
    SpikesOnSpikes,
    /// A bit of everything.
    Mixed,
}

impl Hostility {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Jittered,
        Self::Folded,
        Self::Stretched,
        Self::Slivers,
        Self::Pole,
        Self::Doublets,
        Self::Bubbles,
        Self::Fingers,
        Self::SpikesOnSpikes,
        Self::Mixed,
    ];
}

/// A disk of the given hostility; each seed gives another one, the same on every machine.
///
/// ```
/// use qmesh::shapes::{Hostility, hostile_disk};
///
/// assert!(hostile_disk(Hostility::Bubbles, 7).topology().is_disk());
/// ```
#[must_use]
pub fn hostile_disk(hostility: Hostility, seed: u64) -> QuadMesh {
    let mut disk = Disk::plate(seed);
    match hostility {
        Hostility::Jittered => disk.jitter(0.5),
        Hostility::Folded => disk.fold(),
        Hostility::Stretched => disk.stretch(1e6),
        Hostility::Slivers => disk.sliver(1e-9),
        Hostility::Pole => disk = Disk::pole(2 + (seed % 19) as usize, seed),
        Hostility::Doublets => disk.repeat(3, Disk::add_doublet),
        Hostility::Bubbles => disk.repeat(6, Disk::add_bubble),
        Hostility::Fingers => disk.repeat(2, |disk| disk.add_spike(30)),
        Hostility::SpikesOnSpikes => disk.spikes_on_spikes(4, 6),
        Hostility::Mixed => {
            disk.repeat(2, Disk::add_doublet);
            disk.repeat(2, Disk::add_bubble);
            disk.repeat(2, |disk| disk.add_spike(4));
            disk.jitter(0.2);
            disk.sliver(1e-6);
            disk.stretch(1e2);
        }
    }
    disk.build()
}

/// Quads in the making.
struct Disk {
    random: SplitMix64,
    positions: Vec<Vec3>,
    quads: Vec<[u32; 4]>,
}

impl Disk {
    /// A flat plate of 3 × 3 to 8 × 8 unit cells.
    fn plate(seed: u64) -> Self {
        let mut random = SplitMix64(seed);
        let [columns, rows] = [(); 2].map(|()| 3 + random.next() % 6);
        let positions =
            (0..=rows).flat_map(|y| (0..=columns).map(move |x| Vec3::new(x as f64, y as f64, 0.0)));
        let at = |x: u64, y: u64| (y * (columns + 1) + x) as u32;
        let quads = (0..rows).flat_map(|y| {
            (0..columns).map(move |x| [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)])
        });
        Self { random, positions: positions.collect(), quads: quads.collect() }
    }

    /// `valence` quads around one vertex; for valence 2 a doublet.
    fn pole(valence: usize, seed: u64) -> Self {
        let around = 2 * valence as u32;
        let mut positions = vec![Vec3::zeros()];
        positions.extend((0..around).map(|i| {
            let [sin, cos] = sin_cos(f64::from(i) / f64::from(around));
            Vec3::new(cos, sin, 0.0)
        }));
        let quads =
            (0..valence as u32).map(|i| [0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % around]).collect();
        let mut disk = Self { random: SplitMix64(seed), positions, quads };
        disk.jitter(0.1);
        disk
    }

    fn build(self) -> QuadMesh {
        let mut polygons = Polygons { positions: self.positions, ..Polygons::default() };
        for quad in &self.quads {
            polygons.push_face(quad);
        }
        built(polygons)
    }

    fn repeat(&mut self, times: usize, mut change: impl FnMut(&mut Self)) {
        for _ in 0..times {
            change(self);
        }
    }

    fn push(&mut self, position: Vec3) -> u32 {
        self.positions.push(position);
        (self.positions.len() - 1) as u32
    }

    fn take_quad(&mut self) -> [u32; 4] {
        let at = (self.random.next() % self.quads.len() as u64) as usize;
        self.quads.swap_remove(at)
    }

    fn corners(&self, quad: [u32; 4]) -> [Vec3; 4] {
        quad.map(|v| self.positions[v as usize])
    }

    fn offset(&mut self, amount: f64) -> Vec3 {
        Vec3::from_fn(|_, _| amount * self.random.signed())
    }

    fn jitter(&mut self, amount: f64) {
        for index in 0..self.positions.len() {
            let offset = self.offset(amount);
            self.positions[index] += offset;
        }
    }

    fn fold(&mut self) {
        for index in 0..self.positions.len() {
            self.positions[index] = self.offset(1.0);
        }
    }

    fn stretch(&mut self, factor: f64) {
        for position in &mut self.positions {
            position.x *= factor;
        }
    }

    /// Moves one vertex of some quads to within `gap` of the next.
    fn sliver(&mut self, gap: f64) {
        for _ in 0..3 {
            let quad = self.quads[(self.random.next() % self.quads.len() as u64) as usize];
            let [a, b, ..] = self.corners(quad);
            self.positions[quad[1] as usize] = a + (b - a) * gap;
        }
    }

    /// Splits a quad along a path over one new vertex between two opposite corners.
    fn add_doublet(&mut self) {
        let quad = self.take_quad();
        let [a, b, c, d] = quad;
        let [pa, _, pc, _] = self.corners(quad);
        let offset = self.offset(0.1);
        let middle = self.push((pa + pc) / 2.0 + offset);
        self.quads.extend([[a, b, c, middle], [a, middle, c, d]]);
    }

    /// Puts a quad between two opposite corners of a quad: three quads then share that pair.
    fn add_bubble(&mut self) {
        let quad = self.take_quad();
        let [a, b, c, d] = quad;
        let [pa, pb, pc, pd] = self.corners(quad);
        let middle = (pa + pc) / 2.0;
        let near = self.push(middle * 0.6 + pb * 0.4);
        let far = self.push(middle * 0.6 + pd * 0.4);
        self.quads.extend([[a, b, c, near], [a, near, c, far], [a, far, c, d]]);
    }

    /// Draws a quad out into a closed tube of `rings` rings; returns the walls' quads.
    fn add_spike(&mut self, rings: usize) {
        let quad = self.take_quad();
        self.draw_out(quad, rings);
    }

    fn draw_out(&mut self, quad: [u32; 4], rings: usize) -> Vec<[u32; 4]> {
        let [a, b, c, d] = self.corners(quad);
        let normal = (c - a).cross(&(d - b));
        let size = ((c - a).norm() * (d - b).norm()).sqrt();
        let axis = if normal.norm() > 0.0 { normal / normal.norm() } else { Vec3::z() } * (0.5 * size);
        let center = (a + b + c + d) / 4.0;
        let mut walls = Vec::new();
        let mut base = quad;
        for ring in 1..=rings {
            let top = [a, b, c, d].map(|p| self.push(center + (p - center) * 0.7 + axis * ring as f64));
            for i in 0..4 {
                let j = (i + 1) % 4;
                walls.push([base[i], base[j], top[j], top[i]]);
            }
            base = top;
        }
        self.quads.extend(&walls);
        self.quads.push(base);
        walls
    }

    fn spikes_on_spikes(&mut self, levels: usize, rings: usize) {
        let mut quad = self.take_quad();
        for _ in 0..levels {
            let walls = self.draw_out(quad, rings);
            quad = walls[(self.random.next() % walls.len() as u64) as usize];
            self.quads.retain(|&other| other != quad);
        }
        self.quads.push(quad);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever is hostile, it is a disk of quads, and the same one each time.
    #[test]
    fn hostile_disks_are_disks() {
        for hostility in Hostility::ALL {
            for seed in 0..40 {
                let mesh = hostile_disk(hostility, seed);
                assert!(mesh.topology().is_disk(), "{hostility:?} {seed}: {:?}", mesh.topology());
                assert_eq!(mesh.face_counts().quads, mesh.face_count(), "{hostility:?} {seed}");
                assert_eq!(mesh.positions(), hostile_disk(hostility, seed).positions());
            }
        }
    }
}
