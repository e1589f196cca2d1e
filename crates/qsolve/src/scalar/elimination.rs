//! Incomplete Cholesky by sampling, for weights that differ so much from entry to entry that no coarser level can stand for them.
//!
//! Eliminating a row ties all its neighbours to each other. Of those ties only as many are kept as there are neighbours, less one: each
//! neighbour is tied to one heavier one, chosen at random, with the weight that makes the kept ties equal to all of them on average
//! [Kyng, Sachdeva 2016; Gao, Kyng, Spielman 2023]. Nothing fills in, whatever the weights.

use super::conjugate::Preconditioner;
use super::queue::Queue;
use super::sparse::Sparse;

/// Stands for the end of a list.
const END: u32 = u32::MAX;

/// `A ≈ L D Lᵀ`, rows in the order of their elimination; what holds the rows is one row more that is never eliminated.
#[derive(Debug)]
pub(super) struct Elimination {
    order: Vec<u32>,
    starts: Vec<u32>,
    neighbors: Vec<u32>,
    /// The part of its pivot that the tie to each neighbour makes up.
    shares: Vec<f32>,
    pivots: Vec<f64>,
}

impl Elimination {
    /// Positive entries beside the diagonal are left out, and what the diagonal lacks to dominance is added.
    pub(super) fn new(matrix: &Sparse<f64>) -> Self {
        let rows = matrix.rows();
        let mut ties = Ties::new(matrix);
        let mut queue = Queue::new(&ties.degrees[..rows]);
        let mut result = Self {
            order: Vec::with_capacity(rows),
            starts: vec![0],
            neighbors: Vec::with_capacity(matrix.columns.len()),
            shares: Vec::with_capacity(matrix.columns.len()),
            pivots: Vec::with_capacity(rows),
        };
        let mut star = Vec::new();
        let mut random = Random(0);
        while let Some(row) = queue.pop() {
            ties.collect(row, &mut star);
            let pivot: f64 = star.iter().map(|tie| f64::from(tie.weight)).sum();
            ties.sample(&star, pivot, &mut random);
            for tie in &star {
                result.neighbors.push(tie.target);
                result.shares.push((f64::from(tie.weight) / pivot) as f32);
                queue.change(tie.target, ties.degrees[tie.target as usize]);
            }
            result.order.push(row);
            result.starts.push(result.neighbors.len() as u32);
            result.pivots.push(pivot);
        }
        result
    }

    /// `y = (L D Lᵀ)⁻¹ y`, `y` with one row more than the matrix.
    fn solve<const K: usize>(&self, y: &mut [[f64; K]]) {
        for (step, &row) in self.order.iter().enumerate() {
            let value = y[row as usize];
            for (neighbor, share) in self.ties(step) {
                (0..K).for_each(|k| y[neighbor][k] += share * value[k]);
            }
        }
        if let Some(ground) = y.last_mut() {
            *ground = [0.0; K];
        }
        for (step, &row) in self.order.iter().enumerate().rev() {
            let pivot = self.pivots[step];
            // A row that nothing holds stays where it is.
            let mut value = if pivot > 0.0 { y[row as usize].map(|y| y / pivot) } else { [0.0; K] };
            for (neighbor, share) in self.ties(step) {
                (0..K).for_each(|k| value[k] += share * y[neighbor][k]);
            }
            y[row as usize] = value;
        }
    }

    fn ties(&self, step: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[step] as usize..self.starts[step + 1] as usize;
        let shares = self.shares[range.clone()].iter().map(|&share| f64::from(share));
        self.neighbors[range].iter().map(|&neighbor| neighbor as usize).zip(shares)
    }
}

/// Solves with the factors, and what that works in.
#[derive(Debug)]
pub(super) struct Eliminated<'a, const K: usize> {
    factors: &'a Elimination,
    y: Vec<[f64; K]>,
    z: Vec<[f32; K]>,
}

impl<'a, const K: usize> Eliminated<'a, K> {
    pub(super) fn new(factors: &'a Elimination) -> Self {
        let rows = factors.order.len();
        Self { factors, y: vec![[0.0; K]; rows + 1], z: vec![[0.0; K]; rows] }
    }
}

impl<const K: usize> Preconditioner<K> for Eliminated<'_, K> {
    fn apply(&mut self, r: &[[f64; K]]) {
        self.y[..r.len()].copy_from_slice(r);
        self.y[r.len()] = [0.0; K];
        self.factors.solve(&mut self.y);
        self.z.iter_mut().zip(&self.y).for_each(|(z, y)| *z = y.map(|y| y as f32));
    }

    fn z(&self) -> &[[f32; K]] {
        &self.z
    }
}

/// One end of a tie, in the list of the row at that end. A weight of zero: it is no more.
#[derive(Clone, Copy, Debug)]
struct Tie {
    target: u32,
    next: u32,
    twin: u32,
    weight: f32,
}

/// A tie of the row that is being eliminated.
struct Spoke {
    target: u32,
    /// The end in the list of that row.
    end: u32,
    weight: f32,
}

/// The graph of what is not eliminated yet. It never has more ties than in the beginning, so their places are used again.
struct Ties {
    ties: Vec<Tie>,
    heads: Vec<u32>,
    degrees: Vec<u32>,
}

impl Ties {
    fn new(matrix: &Sparse<f64>) -> Self {
        let rows = matrix.rows();
        let largest = (0..rows).map(|row| matrix.diagonal(row)).fold(f64::MIN_POSITIVE, f64::max);
        let mut graph = Self {
            ties: Vec::with_capacity(matrix.columns.len() + rows),
            heads: vec![END; rows + 1],
            degrees: vec![0; rows + 1],
        };
        for row in 0..rows {
            let (columns, values) = matrix.row(row);
            let mut excess = matrix.diagonal(row) / largest;
            for (&column, value) in columns.iter().zip(values).filter(|(column, _)| **column as usize != row)
            {
                let weight = (-value / largest).max(0.0);
                excess -= weight;
                if column as usize > row {
                    graph.tie(row as u32, column, weight as f32);
                }
            }
            if excess > 0.0 {
                graph.tie(row as u32, rows as u32, excess as f32);
            }
        }
        graph
    }

    fn tie(&mut self, a: u32, b: u32, weight: f32) {
        if weight > 0.0 {
            let place = self.ties.len() as u32;
            for (here, there, twin) in [(a, b, place + 1), (b, a, place)] {
                self.ties.push(Tie { target: there, next: self.heads[here as usize], twin, weight });
                self.heads[here as usize] = self.ties.len() as u32 - 1;
                self.degrees[here as usize] += 1;
            }
        }
    }

    /// The ties of a row, those to the same neighbour as one; the lightest first.
    fn collect(&mut self, row: u32, star: &mut Vec<Spoke>) {
        star.clear();
        let mut at = std::mem::replace(&mut self.heads[row as usize], END);
        while at != END {
            let Tie { target, next, twin, weight } = self.ties[at as usize];
            if weight > 0.0 {
                star.push(Spoke { target, end: twin, weight });
            }
            at = next;
        }
        star.sort_unstable_by_key(|spoke| (spoke.target, spoke.end));
        star.dedup_by(|double, spoke| {
            let is_double = double.target == spoke.target;
            if is_double {
                spoke.weight += double.weight;
                self.cut(double.end);
            }
            is_double
        });
        star.sort_unstable_by(|a, b| a.weight.total_cmp(&b.weight).then(a.target.cmp(&b.target)));
    }

    /// Takes an end out of the list of the row that it belongs to.
    fn cut(&mut self, end: u32) {
        let row = self.ties[self.ties[end as usize].twin as usize].target;
        self.ties[end as usize].weight = 0.0;
        self.degrees[row as usize] -= 1;
    }

    /// Ties each neighbour but the heaviest to a heavier one: `k` with the probability `wₖ / Σ_{j>i} wⱼ`, by a tie of
    /// `wᵢ Σ_{j>i} wⱼ / Σ w`; on average that is `wᵢ wₖ / Σ w`, as eliminating calls for.
    fn sample(&mut self, star: &[Spoke], pivot: f64, random: &mut Random) {
        let Some((heaviest, lighter)) = star.split_last() else { return };
        // In place: what is left of the weights after each neighbour.
        let mut left = pivot;
        for (number, spoke) in lighter.iter().enumerate() {
            left = (left - f64::from(spoke.weight)).max(f64::from(heaviest.weight));
            let mut reach = random.next() * left;
            let mut chosen = heaviest;
            for other in &star[number + 1..] {
                reach -= f64::from(other.weight);
                if reach < 0.0 {
                    chosen = other;
                    break;
                }
            }
            let weight = (f64::from(spoke.weight) * left / pivot) as f32;
            self.turn(spoke, chosen.target, weight);
        }
        self.cut(heaviest.end);
    }

    /// Lets the tie of `spoke` lead to `target` instead of the row that is eliminated.
    fn turn(&mut self, spoke: &Spoke, target: u32, weight: f32) {
        let end = spoke.end as usize;
        let other = self.ties[end].twin;
        self.ties[end].target = target;
        self.ties[end].weight = weight;
        self.ties[other as usize] =
            Tie { target: spoke.target, next: self.heads[target as usize], twin: spoke.end, weight };
        self.heads[target as usize] = other;
        self.degrees[target as usize] += 1;
    }
}

/// The same numbers in `[0, 1)` every time [splitmix64: Steele, Lea, Flood 2014].
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
