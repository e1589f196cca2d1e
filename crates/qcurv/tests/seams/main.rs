//! Automatic seams.
#![allow(clippy::unwrap_used, reason = "a failing unwrap fails the test")]

mod hubs;
mod interruptions;
mod openings;
