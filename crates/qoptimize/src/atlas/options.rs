//! What can be chosen, and what can go wrong.

use qembed::BoundaryShape;
use qembed::qmesh::{BuildError, Chart, Vec2, Vec3};

use crate::certificate::Certificate;
use crate::distortion::MeasureError;
use crate::error::ParameterizeError;
use crate::pack::PackOptions;
use crate::parameterize::Options;

/// How large islands are beside each other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Density {
    /// All have as many texels for an area in space.
    #[default]
    Equal,
    /// All have the same area in the plane: small parts of a mesh get more texels.
    PerIsland,
    /// This many texels for a unit of length in space. What does not fit into the unit square then continues above it.
    Texels(f64),
}

/// Which direction in space points up in the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum UpAxis {
    /// The x axis.
    X,
    /// The y axis.
    #[default]
    Y,
    /// The z axis.
    Z,
}

impl UpAxis {
    /// Up, and what takes its place where the surface is level: the axis that leads away from a viewer in front.
    pub(super) fn directions(self) -> [Vec3; 2] {
        match self {
            Self::X => [Vec3::x(), -Vec3::z()],
            Self::Y => [Vec3::y(), -Vec3::z()],
            Self::Z => [Vec3::z(), Vec3::y()],
        }
    }
}

/// How polygons are unwrapped.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct AtlasOptions {
    /// How each island is mapped. A fixed boundary, pins and symmetry are for meshes of one island.
    pub map: Options,
    /// Whether closed surfaces and handles are cut open by automatic seams. Default true; otherwise they are refused.
    pub open: bool,
    /// Cut islands further until 99 % of the area of each stays below this stretch; more than 1. Default `None`.
    pub max_stretch: Option<f64>,
    /// Default `Equal`.
    pub density: Density,
    /// Turn islands so that this axis points up. `None`, the default: y where there are several islands, none where there is
    /// one.
    pub up: Option<UpAxis>,
    /// For each corner of the polygons the UV that it keeps; empty, the default, when none does, which is the same as `None` for each. Faces with such corners have them all.
    /// The rest of their island is mapped to meet them, by a method that can hold pins; other islands are laid out above theirs, at
    /// their mean density. Charts have to be cut at [`kept_seams`](super::kept_seams).
    #[cfg_attr(feature = "serde", serde(skip))]
    pub keep: Vec<Option<Vec2>>,
    /// How islands are packed.
    pub pack: PackOptions,
    /// Leave the islands in their size in space, beside each other, instead of fitting them into the unit square. Default
    /// false.
    pub true_scale: bool,
}

impl Default for AtlasOptions {
    fn default() -> Self {
        Self {
            map: Options::default(),
            open: true,
            max_stretch: None,
            density: Density::Equal,
            up: None,
            keep: Vec::new(),
            pack: PackOptions::default(),
            true_scale: false,
        }
    }
}

/// Why there are no UVs.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AtlasError {
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// The observer said that time was up before the only island had a map.
    #[error("time was up before there was a map")]
    OutOfTime,
    /// No charts can be made of the polygons.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// An option of the layout is out of range.
    #[error("{option} is {value}, but must be {expected}")]
    BadOption {
        /// Which one.
        option: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        expected: &'static str,
    },
    /// An option of the map is out of range.
    #[error(transparent)]
    Options(ParameterizeError),
    /// A UV would lie beyond [`COORDINATE_LIMIT`](qembed::qmesh::COORDINATE_LIMIT).
    #[error(
        "the layout would reach beyond 1e60: ask for a smaller density, or have it fitted into the unit square"
    )]
    OutOfRange,
    /// Islands that are to be cut further have no vertices yet whose places could be given.
    #[error("further cuts exclude {0}")]
    CutsExclude(&'static str),
    /// Not one entry of what is kept per corner.
    #[error(
        "there are {found} kept UVs, or places for them, for {expected} corners: one per corner is needed"
    )]
    KeptCount {
        /// Corners of the polygons.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// A face that is to keep its UVs is turned over there, or has no area.
    #[error("face {face} cannot keep its UVs: it is turned over in the plane, or has no area there")]
    KeptFaceFlipped {
        /// The face.
        face: u32,
    },
    /// The only island has no map, or an island is closed and may not be cut open.
    #[error("the island of face {} has no map: {error}", .chart.faces.first().copied().unwrap_or(0))]
    Island {
        /// The island, whose vertices, faces and corners `error` names.
        chart: Box<Chart>,
        /// Why.
        error: ParameterizeError,
    },
    /// The whole is proven free of overlaps, but not after rounding to single precision, and could not be mended; the certificate of
    /// the rounded map names the places, in the numbers of the polygons.
    #[error("in single precision the map would overlap itself: its certificate {0}")]
    Rounding(Box<Certificate>),
    /// The map could not be measured.
    #[error(transparent)]
    Measure(#[from] MeasureError),
}

impl AtlasError {
    /// An error about the whole, whose numbers are those of the polygons.
    pub(super) fn of_the_whole(error: ParameterizeError) -> Self {
        match error {
            ParameterizeError::Rounding(certificate) => Self::Rounding(certificate),
            ParameterizeError::Measure(error) => Self::Measure(error),
            other => Self::Options(other),
        }
    }
}

impl AtlasOptions {
    /// Whether any corner keeps its UV.
    pub(super) fn keeps_any(&self) -> bool {
        self.keep.iter().any(Option::is_some)
    }

    /// Whether they are in range, for polygons with so many corners.
    pub(super) fn check(&self, corner_count: usize) -> Result<(), AtlasError> {
        self.map.check().map_err(AtlasError::Options)?;
        if !self.keep.is_empty() && self.keep.len() != corner_count {
            return Err(AtlasError::KeptCount { expected: corner_count, found: self.keep.len() });
        }
        let refuse = |option, value, expected| Err(AtlasError::BadOption { option, value, expected });
        if let Some(bound) = self.max_stretch
            && !(bound > 1.0 && bound.is_finite())
        {
            return refuse("the largest stretch", bound, "a number above 1");
        }
        if self.keeps_any() && !self.map.method.minimizes() {
            return Err(AtlasError::Options(ParameterizeError::OtherMethod("kept UVs")));
        }
        let given = [
            (!self.map.pins.is_empty(), "pins"),
            (self.map.symmetric, "symmetric maps"),
            (matches!(self.map.boundary, BoundaryShape::Fixed(_)), "a fixed boundary"),
            (self.keeps_any(), "kept UVs"),
        ];
        if let Some((_, what)) = given.into_iter().find(|(is_given, _)| *is_given)
            && self.max_stretch.is_some()
        {
            return Err(AtlasError::CutsExclude(what));
        }
        if let Density::Texels(texels) = self.density
            && !(texels > 0.0 && texels.is_finite())
        {
            return refuse("the density", texels, "a number above 0");
        }
        if !(self.pack.margin >= 0.0 && self.pack.margin.is_finite()) {
            return refuse("the margin", self.pack.margin, "a number of at least 0");
        }
        if self.pack.resolution == 0 {
            return refuse("the resolution", 0.0, "at least 1");
        }
        Ok(())
    }
}
