//! The `qparam` command.
fn main() {}
