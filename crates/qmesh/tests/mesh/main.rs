//! Connectivity and topology, seen from outside.

mod charts;
mod halfedges;
mod poles;
mod refusals;
mod samples;
#[cfg(feature = "serde")]
mod serial;
mod soup;
mod topology;
