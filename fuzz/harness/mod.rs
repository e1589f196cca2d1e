//! What the fuzz targets do with bytes: plain functions that panic when a promise is broken.
//!
//! The fuzzer calls them with bytes that it invents; an ordinary test (`xtask/tests/corpus.rs`) with those of `corpus/`.

#![allow(clippy::panic, clippy::unwrap_used, reason = "a broken promise is to end the run")]
#![allow(dead_code, reason = "every target uses its own part")]

pub mod bytes;
#[path = "../../crates/qoptimize/tests/common/exact.rs"]
mod exact;
pub mod obj;
pub mod shape;
pub mod soup;
pub mod unwrap;
