//! The rows that the paper prints in its Table 1, for comparison of trends: its meshes are not available.

use qparam_cli::sweep::{Errors, TABLE_1_Q};

/// The rows of one model.
#[derive(Debug)]
pub(crate) struct Printed {
    /// The letter in the table.
    pub(crate) letter: &'static str,
    /// The sums of Eq. 13 in the order of `TABLE_1_Q`.
    pub(crate) angle: [f64; 5],
    /// Those of Eq. 14.
    pub(crate) area: [f64; 5],
}

/// The paper's face.
pub(crate) const FACE: Printed = Printed {
    letter: "a",
    angle: [8.74, 10.98, 14.20, 17.41, 20.01],
    area: [30.93, 26.44, 22.58, 20.27, 19.63],
};
/// The paper's head.
pub(crate) const HEAD: Printed = Printed {
    letter: "e",
    angle: [12.56, 15.42, 18.95, 25.83, 29.57],
    area: [44.81, 39.87, 31.25, 28.21, 25.42],
};

/// What the paper prints for a model like the fixture `name`.
pub(super) fn of(name: &str) -> Option<&'static Printed> {
    match name {
        "face" => Some(&FACE),
        "head" => Some(&HEAD),
        _ => None,
    }
}

impl Printed {
    /// The errors at `q`, if the paper prints them.
    pub(super) fn at(&self, q: f64) -> Option<Errors> {
        let column = TABLE_1_Q.iter().position(|known| *known == q)?;
        Some(Errors { q, angle: self.angle[column], area: self.area[column] })
    }
}
