//! Who moves next.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use qembed::qmesh::{VertexData, VertexId};

use super::MoveOrder;

/// Vertices that wait for their move; each waits once.
pub(super) enum Queue {
    /// By σ, largest first; then by index. An entry counts only while its stamp is the vertex's newest.
    WorstFirst {
        heap: BinaryHeap<(Sigma, Reverse<VertexId>, u32)>,
        stamp: VertexData<u32>,
    },
    FirstCome {
        line: VecDeque<VertexId>,
        waits: VertexData<bool>,
    },
}

impl Queue {
    pub(super) fn new(order: MoveOrder, vertices: usize) -> Self {
        match order {
            MoveOrder::WorstFirst => {
                Self::WorstFirst { heap: BinaryHeap::new(), stamp: VertexData::filled(vertices, 0) }
            }
            MoveOrder::FirstCome => {
                Self::FirstCome { line: VecDeque::new(), waits: VertexData::filled(vertices, false) }
            }
        }
    }

    /// Lets `vertex` wait, or gives it a new σ if it does so already.
    pub(super) fn push(&mut self, vertex: VertexId, sigma: f64) {
        match self {
            Self::WorstFirst { heap, stamp } => {
                stamp[vertex] = stamp[vertex].wrapping_add(1);
                heap.push((Sigma(sigma), Reverse(vertex), stamp[vertex]));
            }
            Self::FirstCome { line, waits } => {
                if !std::mem::replace(&mut waits[vertex], true) {
                    line.push_back(vertex);
                }
            }
        }
    }

    pub(super) fn pop(&mut self) -> Option<VertexId> {
        match self {
            Self::WorstFirst { heap, stamp } => loop {
                let (_, Reverse(vertex), pushed) = heap.pop()?;
                if stamp[vertex] == pushed {
                    stamp[vertex] = pushed.wrapping_add(1);
                    return Some(vertex);
                }
            },
            Self::FirstCome { line, waits } => {
                let vertex = line.pop_front()?;
                waits[vertex] = false;
                Some(vertex)
            }
        }
    }
}

/// A length as a priority.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sigma(f64);

impl PartialEq for Sigma {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Sigma {}
impl PartialOrd for Sigma {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Sigma {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
