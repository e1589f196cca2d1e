//! Small meshes of all kinds through the whole of `qparam unwrap`.

#![no_main]

#[path = "../harness/mod.rs"]
mod harness;

libfuzzer_sys::fuzz_target!(|data: &[u8]| harness::unwrap::run(data));
