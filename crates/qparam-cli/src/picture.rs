//! Pictures of UV maps: the surface in space with its map on it, drawn without a graphics card.
//!
//! ```
//! use qparam_cli::picture::{Canvas, Lines, Model, Paint, Projection, Rgba, Shot, UpAxis, View, render};
//! use qparam_cli::picture::color::Linear;
//! use qparam_cli::qmesh::shapes;
//!
//! let mesh = shapes::bump(8, 0.5);
//! let model = Model::new(mesh.view())?;
//! let shot = Shot {
//!     view: View::ThreeQuarter,
//!     up: UpAxis::Y,
//!     projection: Projection::Perspective(25.0),
//!     size: [80, 60],
//!     background: Rgba::CLEAR,
//!     relief: 1.0,
//! };
//! let picture: Canvas = render(&model, &Paint::Plain(Linear([0.8; 3])), &Lines::default(), &shot);
//! let mut file = Vec::new();
//! picture.write_png(&mut file)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Guaranteed: quads are shown as the bilinear surfaces that they are, neighbours leave no gap, nothing is mirrored, and the
//! picture is the same for any number of threads. Not guaranteed: the same last digit of a colour on every machine.

mod bins;
mod camera;
mod canvas;
pub mod color;
mod colormap;
mod heat;
mod layout;
mod legend;
pub mod materials;
mod model;
pub mod page;
mod paint;
mod raster;
mod render;
mod seams;
mod sheet;
pub mod text;
mod texture;
mod uv_area;

use thiserror::Error;

pub use camera::{Projection, UpAxis, View};
pub use canvas::Canvas;
pub use color::{Rgba, category};
pub use colormap::Colormap;
pub use heat::{FLIPPED, HeatScale, Measure};
pub use layout::Layout;
pub use legend::{Legend, letter_height, text_color};
pub use model::Model;
pub use paint::{Ink, Lines, Paint};
pub use render::{Shot, render};
pub use seams::Seams;
pub use sheet::sheet;
pub use texture::{Texture, TextureError};
pub(crate) use uv_area::uv_area;

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PictureError {
    /// All vertices are in one place.
    #[error("all vertices that faces use are in one place: there is nothing to see")]
    NoExtent,
    /// The page's data could not be packed, which only memory or a number that is none can cause.
    #[error("the data of the page could not be packed")]
    Packing,
}
