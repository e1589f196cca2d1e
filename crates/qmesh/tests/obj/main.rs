//! The lossless OBJ layer, seen from outside.

mod bad_texts;
mod independent;
mod mistakes;
mod reader;
mod real;
mod slow;
mod texts;
mod trimmings;
