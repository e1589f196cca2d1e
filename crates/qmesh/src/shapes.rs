//! Meshes from formulas.
