//! What the energy promises.

mod derivatives;
mod ellipticity;
mod existence;
