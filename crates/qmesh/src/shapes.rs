//! Meshes from formulas: flat, bent and closed ones to test with, and a face and a head to look at.
//!
//! Every shape is an oriented [`QuadMesh`](crate::QuadMesh) of quads alone, counter-clockwise seen from outside (or
//! from above, for flat ones and height fields). Resolutions out of range are clamped, as each shape says; no
//! argument panics. The same arguments give the same bits on every machine: only `+ − × / √` are used.
//!
//! ```
//! let head = qmesh::shapes::head(2);
//! assert!(head.topology().is_disk(), "its only boundary is the neck");
//! ```

mod anatomy;
mod bent;
mod cage;
mod elementary;
mod face;
mod front;
mod grid;
mod head;
mod heights;
mod hostile;
mod implicit;
mod lattice;
mod ramp;
mod round;
mod union;

pub use bent::{cylinder, cylinder_strip, torus};
pub use face::face;
pub use grid::{graded_grid, grid, jittered_grid};
pub use head::head;
pub use heights::{bump, nose, saddle};
pub use hostile::{Hostility, hostile_disk};
pub use ramp::{horseshoe, ramp};
pub use round::{cap, disk, finger, sphere};
pub use union::disjoint_union;

#[cfg(test)]
mod tests;
