//! What the fuzz targets do with bytes: plain functions that panic when a promise is broken.
//!
//! The fuzzer calls them with bytes that it invents; an ordinary test (`xtask/tests/corpus.rs`) with those of `corpus/`.

#![allow(dead_code, reason = "every target uses its own part")]

pub(crate) mod bytes;
#[path = "../../crates/qoptimize/tests/common/exact.rs"]
mod exact;
pub(crate) mod obj;
pub(crate) mod shape;
pub(crate) mod soup;
pub(crate) mod unwrap;
