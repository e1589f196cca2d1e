//! What the energy promises.

mod clear;
mod derivatives;
mod ellipticity;
mod existence;
