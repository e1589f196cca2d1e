//! What the energy promises.

mod clear;
mod continuation;
mod derivatives;
mod ellipticity;
mod existence;
mod slow;
