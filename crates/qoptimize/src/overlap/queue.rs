//! Who moves next.

use std::collections::VecDeque;

use qembed::qmesh::{VertexData, VertexId};

use super::MoveOrder;

/// Vertices that wait for their move; each waits once.
pub(super) enum Queue {
    WorstFirst(Heap),
    FirstCome { line: VecDeque<VertexId>, waits: VertexData<bool> },
}

impl Queue {
    pub(super) fn new(order: MoveOrder, vertices: usize) -> Self {
        match order {
            MoveOrder::WorstFirst => Self::WorstFirst(Heap::new(vertices)),
            MoveOrder::FirstCome => {
                Self::FirstCome { line: VecDeque::new(), waits: VertexData::filled(vertices, false) }
            }
        }
    }

    /// Lets `vertex` wait, or gives it a new σ if it does so already.
    pub(super) fn push(&mut self, vertex: VertexId, sigma: f64) {
        match self {
            Self::WorstFirst(heap) => heap.set(vertex, sigma),
            Self::FirstCome { line, waits } => {
                if !std::mem::replace(&mut waits[vertex], true) {
                    line.push_back(vertex);
                }
            }
        }
    }

    pub(super) fn pop(&mut self) -> Option<VertexId> {
        match self {
            Self::WorstFirst(heap) => heap.pop(),
            Self::FirstCome { line, waits } => {
                let vertex = line.pop_front()?;
                waits[vertex] = false;
                Some(vertex)
            }
        }
    }
}

/// A binary heap that knows where each vertex is, so that a new σ replaces the old one: largest σ on top, the first
/// vertex of equals.
pub(super) struct Heap {
    entries: Vec<(f64, VertexId)>,
    /// Where each vertex is among the entries.
    place: VertexData<u32>,
}

/// The place of a vertex that does not wait.
const NOWHERE: u32 = u32::MAX;

impl Heap {
    fn new(vertices: usize) -> Self {
        Self { entries: Vec::new(), place: VertexData::filled(vertices, NOWHERE) }
    }

    fn set(&mut self, vertex: VertexId, sigma: f64) {
        let place = match self.place[vertex] {
            NOWHERE => {
                self.entries.push((sigma, vertex));
                self.entries.len() - 1
            }
            place => {
                self.entries[place as usize].0 = sigma;
                place as usize
            }
        };
        self.settle(place);
    }

    fn pop(&mut self) -> Option<VertexId> {
        let last = self.entries.len().checked_sub(1)?;
        self.entries.swap(0, last);
        let (_, vertex) = self.entries.pop()?;
        self.place[vertex] = NOWHERE;
        if last > 0 {
            self.settle(0);
        }
        Some(vertex)
    }

    /// Moves the entry at `place` up or down to where it belongs.
    fn settle(&mut self, mut place: usize) {
        while place > 0 && self.is_before(place, (place - 1) / 2) {
            self.exchange(place, (place - 1) / 2);
            place = (place - 1) / 2;
        }
        loop {
            let children = 2 * place + 1..(2 * place + 3).min(self.entries.len());
            let Some(first) = children.reduce(|a, b| if self.is_before(b, a) { b } else { a }) else { break };
            if !self.is_before(first, place) {
                break;
            }
            self.exchange(place, first);
            place = first;
        }
        self.place[self.entries[place].1] = place as u32;
    }

    fn is_before(&self, a: usize, b: usize) -> bool {
        let ((s, v), (t, w)) = (self.entries[a], self.entries[b]);
        s.total_cmp(&t).then(w.cmp(&v)).is_gt()
    }

    fn exchange(&mut self, a: usize, b: usize) {
        self.entries.swap(a, b);
        self.place[self.entries[a].1] = a as u32;
        self.place[self.entries[b].1] = b as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever is pushed, and pushed again with another σ, comes out by σ, then by index, each once.
    #[test]
    fn the_heap_sorts() {
        let count = 200;
        let mut queue = Queue::new(MoveOrder::WorstFirst, count);
        let sigma = |round: usize, i: usize| ((i * 37 + round * 11) % 23) as f64;
        for round in 0..3 {
            (0..count)
                .filter(|i| i % (round + 1) == 0)
                .for_each(|i| queue.push(VertexId(i as u32), sigma(round, i)));
        }
        let last = |i: usize| (0..3).rev().find(|round| i.is_multiple_of(round + 1)).unwrap();
        let mut expected: Vec<usize> = (0..count).collect();
        expected.sort_by(|&a, &b| sigma(last(b), b).total_cmp(&sigma(last(a), a)).then(a.cmp(&b)));
        let found: Vec<usize> = std::iter::from_fn(|| queue.pop()).map(VertexId::index).collect();
        assert_eq!(found, expected);
    }
}
