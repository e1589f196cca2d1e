//! Good maps: overlap removal, measures, the whole way in one call.

pub mod distortion;
mod error;
pub mod overlap;
pub mod parameterize;

pub use distortion::{Benchmark, Distortion, MeasureError, measure};
pub use error::ParameterizeError;
pub use overlap::{MoveOrder, OverlapOptions, OverlapReport, remove_overlaps};
pub use parameterize::{Method, Options, Parameterization, RunRecord, parameterize};
pub use qembed::{self, qcurv, qmesh, qsimplify, qsolve};
