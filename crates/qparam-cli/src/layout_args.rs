//! The options of `qparam unwrap` about seams and the layout of islands.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use qoptimize::pack::PackOptions;
use qoptimize::{AtlasOptions, Density, Options, UpAxis};

use crate::unwrap_args::{not_negative, positive};

// No doc comment: clap would make it the description of the command.
#[derive(Args, Clone, Debug)]
pub(crate) struct LayoutArgs {
    /// Where to cut: auto, none, uv, angle:DEG, group, material, or a file with lines `vertex vertex` (from 1); repeatable
    ///
    /// `uv` keeps the seams of the UVs in the file, `angle:DEG` cuts where faces bend by more, `group` and `material` between
    /// groups and materials. Several are united. Closed surfaces and handles that are left are cut open automatically, unless
    /// `none` is among them.
    #[arg(long, value_name = "WHERE", default_value = "auto", help_heading = "Seams and layout")]
    pub(crate) seams: Vec<SeamSource>,
    /// Cut further until no island is stretched more, but for 1 % of its area; 1 is an isometry
    #[arg(long, value_name = "X", value_parser = above_one, help_heading = "Seams and layout")]
    pub(crate) max_stretch: Option<f64>,
    /// Keep the UVs of this group, object or material as they are in the file, and map the rest to meet them; repeatable (direct,
    /// conformal)
    ///
    /// The island around the group is solved with these UVs held. Other islands are laid out above, at the same texel density; nothing is
    /// fitted to the unit square.
    #[arg(long, value_name = "GROUP", help_heading = "Seams and layout",
        conflicts_with_all = ["max_stretch", "density", "no_pack", "symmetric", "pin", "pins", "boundary", "report", "uv_precision"])]
    pub(crate) keep_uv: Vec<String>,
    /// Refuse a mesh that has to be mended: not manifold, faces turned over, one side only, faces twice
    #[arg(long, help_heading = "Seams and layout")]
    pub(crate) strict: bool,
    /// Texels for an area: equal for all islands, the same area for each island, or texels a unit of length
    #[arg(
        long,
        value_name = "equal|per-island|TEXELS",
        default_value = "equal",
        help_heading = "Seams and layout"
    )]
    pub(crate) density: DensityChoice,
    /// The axis that points up in the map (default: y for several islands; a single one stays as it is)
    #[arg(long, value_enum, help_heading = "Seams and layout")]
    pub(crate) up: Option<UpChoice>,
    /// Texels along a side of the texture
    #[arg(long, value_name = "N", default_value = "2048", value_parser = clap::value_parser!(u32).range(1..=1 << 20),
        help_heading = "Seams and layout")]
    pub(crate) resolution: u32,
    /// Texels between islands, at least
    #[arg(long, value_name = "TEXELS", default_value = "4", value_parser = not_negative, allow_negative_numbers = true,
        help_heading = "Seams and layout")]
    pub(crate) margin: f64,
    /// Leave islands in their true size, side by side, instead of fitting them into the unit square
    #[arg(long, help_heading = "Seams and layout")]
    pub(crate) no_pack: bool,
}

/// Where seams come from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SeamSource {
    Auto,
    None,
    Uv,
    Angle(f64),
    Group,
    Material,
    File(PathBuf),
}

impl SeamSource {
    /// The file that they are listed in.
    pub(crate) fn file(&self) -> Option<&PathBuf> {
        match self {
            Self::File(path) => Some(path),
            _ => None,
        }
    }
}

impl FromStr for SeamSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(match text {
            "auto" => Self::Auto,
            "none" => Self::None,
            "uv" => Self::Uv,
            "group" => Self::Group,
            "material" => Self::Material,
            _ => match text.strip_prefix("angle:") {
                Some(degrees) => match degrees.parse::<f64>() {
                    Ok(degrees) if (0.0..=180.0).contains(&degrees) => Self::Angle(degrees),
                    _ => return Err("expected degrees between 0 and 180 after `angle:`".to_owned()),
                },
                None => Self::File(PathBuf::from(text)),
            },
        })
    }
}

/// `equal`, `per-island`, or texels a unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DensityChoice(pub(crate) Density);

impl FromStr for DensityChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(Self(match text {
            "equal" => Density::Equal,
            "per-island" => Density::PerIsland,
            _ => Density::Texels(
                positive(text)
                    .map_err(|_| "expected `equal`, `per-island` or a number above 0".to_owned())?,
            ),
        }))
    }
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UpChoice {
    /// The x axis
    X,
    /// The y axis
    Y,
    /// The z axis
    Z,
}

fn above_one(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 1.0 && value.is_finite() => Ok(value),
        _ => Err("expected a number above 1".to_owned()),
    }
}

impl LayoutArgs {
    /// The library's options around those of the map.
    pub(crate) fn options(&self, map: Options) -> AtlasOptions {
        AtlasOptions {
            map,
            open: !self.seams.contains(&SeamSource::None),
            max_stretch: self.max_stretch,
            density: self.density.0,
            keep: Vec::new(),
            up: self.up.map(|up| match up {
                UpChoice::X => UpAxis::X,
                UpChoice::Y => UpAxis::Y,
                UpChoice::Z => UpAxis::Z,
            }),
            pack: PackOptions { resolution: self.resolution, margin: self.margin },
            true_scale: self.no_pack,
        }
    }
}
