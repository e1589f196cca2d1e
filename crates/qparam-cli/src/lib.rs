//! The `qparam` command line: arguments, files, progress, reports. The only crate that prints.

pub use qoptimize::{self, qcurv, qembed, qmesh, qsimplify, qsolve};
