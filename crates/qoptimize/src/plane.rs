//! What the exact tests of planar maps share: signs, points, islands, boundary edges that meet.

mod buckets;
mod crossings;
mod islands;
mod outlines;
mod predicates;
mod tree;

pub use crossings::CROSSING_LIMIT;
pub(crate) use crossings::{Crossings, Scope, find_crossings};
pub(crate) use islands::{Islands, NONE, Outline};
pub(crate) use outlines::outline_flaws;
pub(crate) use predicates::orientation;
pub(crate) use tree::{Segment, Tree};
