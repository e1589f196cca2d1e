//! A page to turn in the hand: one HTML file with the surface, its map, and every number, that needs no network.
//!
//! The page shows a series of maps of one surface; a slider goes through them. Scripts and styles are the files beside
//! this one, put into the page as they are.

mod align;
mod data;
mod encode;

use qoptimize::qmesh::{PolygonView, Vec2};
use qoptimize::worst::rank_faces;
use qoptimize::{Certificate, Distortion, FaceMeasures};
use serde::Serialize;

use super::canvas::Canvas;
use super::color::Linear;
use super::colormap::Colormap;
use super::heat::FLIPPED;
use super::model::Model;
use super::{PictureError, category};
use data::Shape;
use encode::{Packer, base64};

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/style.css");
/// In the order in which they need each other.
const SCRIPTS: [&str; 7] = [
    include_str!("page/data.js"),
    include_str!("page/shaders.js"),
    include_str!("page/scene.js"),
    include_str!("page/camera.js"),
    include_str!("page/plots.js"),
    include_str!("page/panel.js"),
    include_str!("page/main.js"),
];

/// More faces than this are shown as pictures only: the page would be too heavy for browsers.
pub const FACE_LIMIT: usize = 300_000;
/// How many of the worst faces are listed for each map.
pub const WORST: usize = 12;

/// One map of the series.
pub struct MapEntry<'a> {
    /// 1 angle-true, 0 area-true; `None` where the method does not ask.
    pub q: Option<f64>,
    /// One a corner.
    pub uv: &'a [Vec2],
    /// Measures of the whole.
    pub distortion: &'a Distortion,
    /// Whether it is proven injective.
    pub certificate: &'a Certificate,
    /// Measures of the faces.
    pub faces: &'a FaceMeasures,
    /// Of some faces (in numbers from 0) what forces their errors, in words: wanted for the [`WORST`].
    pub causes: &'a [(usize, String)],
}

/// Everything that a page says.
pub struct Page<'a> {
    /// What was mapped.
    pub title: &'a str,
    /// The surface.
    pub polygons: PolygonView<'a>,
    /// The line of the file that each face is in.
    pub face_line: &'a dyn Fn(usize) -> usize,
    /// The maps, `q` falling.
    pub maps: &'a [MapEntry<'a>],
    /// The map that was written to the file.
    pub chosen: usize,
    /// The `q` at the knee of the trade-off, or why there is none.
    pub knee: Result<f64, String>,
    /// What was done, a sentence each.
    pub notes: &'a [String],
    /// Every setting.
    pub settings: &'a serde_json::Value,
    /// For readers without WebGL and for surfaces of more than [`FACE_LIMIT`] faces: the surface, and its map.
    pub pictures: [&'a Canvas; 2],
}

#[derive(Serialize)]
struct Meta<'a> {
    title: &'a str,
    version: &'static str,
    shape: Option<Shape>,
    maps: Vec<MapMeta<'a>>,
    chosen: usize,
    knee: Option<f64>,
    no_knee: Option<&'a str>,
    notes: &'a [String],
    settings: &'a serde_json::Value,
    /// Colours as `#rrggbb`, in even steps.
    sequential: Vec<String>,
    diverging: Vec<String>,
    flipped: String,
    categories: Vec<String>,
}

#[derive(Serialize)]
struct MapMeta<'a> {
    q: Option<f64>,
    distortion: &'a Distortion,
    holds: bool,
    certificate: String,
    worst: Vec<Worst<'a>>,
}

/// A face that stands out, in the numbers of the file.
#[derive(Serialize)]
struct Worst<'a> {
    face: usize,
    line: usize,
    angle: f64,
    area: f64,
    /// s1/s2; nothing for a flipped face.
    ratio: Option<f64>,
    /// What forces it; empty where nobody said.
    cause: &'a str,
}

impl Page<'_> {
    /// The file.
    ///
    /// # Errors
    /// [`PictureError`] when there is nothing to see, or a picture could not be packed.
    pub fn html(&self) -> Result<String, PictureError> {
        let mut packer = Packer::default();
        let shape =
            if self.polygons.face_count() <= FACE_LIMIT { Some(self.pack(&mut packer)?) } else { None };
        let packed = packer.text().map_err(|_| PictureError::Packing)?;
        let hex = |color: Linear| color.to_rgba().hex();
        let meta = Meta {
            title: self.title,
            version: env!("CARGO_PKG_VERSION"),
            shape,
            maps: self.maps.iter().map(|map| self.map_meta(map)).collect(),
            chosen: self.chosen,
            knee: self.knee.as_ref().ok().copied(),
            no_knee: self.knee.as_ref().err().map(String::as_str),
            notes: self.notes,
            settings: self.settings,
            sequential: Colormap::Sequential.table(64).into_iter().map(hex).collect(),
            diverging: Colormap::Diverging.table(65).into_iter().map(hex).collect(),
            flipped: FLIPPED.hex(),
            categories: (0..48).map(|n| hex(category(n))).collect(),
        };
        // What could end the script element, or begin a comment, is escaped; JSON means the same.
        let meta = serde_json::to_string(&meta).map_err(|_| PictureError::Packing)?.replace('<', "\\u003c");
        let [surface, map] = [0, 1].map(|i| picture(self.pictures[i]));
        let parts = [
            ("TITLE", escaped(self.title)),
            ("STYLE", STYLE.to_owned()),
            ("SURFACE", surface?),
            ("MAP", map?),
            ("META", meta),
            ("PACKED", packed),
            ("SCRIPT", SCRIPTS.concat()),
        ];
        Ok(filled(PAGE, &parts))
    }

    fn pack(&self, packer: &mut Packer) -> Result<Shape, PictureError> {
        let model = Model::new(self.polygons)?;
        let mut maps: Vec<Vec<Vec2>> = self.maps.iter().map(|map| map.uv.to_vec()).collect();
        align::align(self.polygons, &mut maps);
        let measures: Vec<FaceMeasures> = self.maps.iter().map(|map| map.faces.clone()).collect();
        Ok(data::pack(&model, &maps, &measures, packer))
    }

    fn map_meta<'b>(&self, map: &'b MapEntry<'b>) -> MapMeta<'b> {
        let faces = map.faces;
        let cause =
            |face: usize| map.causes.iter().find(|known| known.0 == face).map_or("", |known| &known.1);
        let worst = rank_faces(faces, WORST).into_iter().map(|face| Worst {
            face: face + 1,
            line: (self.face_line)(face),
            angle: faces.angle_degrees[face],
            area: faces.area_ratio[face],
            ratio: Some(faces.singular_ratio[face]).filter(|ratio| ratio.is_finite()),
            cause: cause(face),
        });
        MapMeta {
            q: map.q,
            distortion: map.distortion,
            holds: map.certificate.holds,
            certificate: map.certificate.to_string(),
            worst: worst.collect(),
        }
    }
}

fn picture(canvas: &Canvas) -> Result<String, PictureError> {
    let mut file = Vec::new();
    canvas.write_png(&mut file).map_err(|_| PictureError::Packing)?;
    Ok(format!("data:image/png;base64,{}", base64(&file)))
}

/// The template with each `{{NAME}}` replaced, once: what is put in is not looked through again.
fn filled(template: &str, parts: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut pieces = template.split("{{");
    text.push_str(pieces.next().unwrap_or_default());
    for piece in pieces {
        let known = piece.split_once("}}").and_then(|(name, rest)| {
            let (_, part) = parts.iter().find(|(known, _)| *known == name)?;
            Some((part, rest))
        });
        match known {
            Some((part, rest)) => text.extend([part.as_str(), rest]),
            None => text.extend(["{{", piece]),
        }
    }
    text
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is put into the page is never taken for a place of the template.
    #[test]
    fn templates_are_filled_once() {
        let parts = [("A", "{{B}}".to_owned()), ("B", "b".to_owned())];
        assert_eq!(filled("x{{A}}y{{B}}z{{C}}", &parts), "x{{B}}yb z{{C}}".replace(' ', ""));
        assert_eq!(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    }

    /// The scripts ask for nothing from outside, and nothing in them ends the element that they stand in.
    #[test]
    fn the_page_is_closed() {
        let all = SCRIPTS.concat() + PAGE + STYLE;
        for word in ["http:", "//cdn", "fetch(", "XMLHttpRequest", "import(", "@import", "url(", "src=\"/"] {
            assert!(!all.contains(word), "{word}");
        }
        assert!(!SCRIPTS.concat().contains("</script"));
    }
}
