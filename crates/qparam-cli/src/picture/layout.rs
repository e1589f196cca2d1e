//! The map itself, flat: islands, faces, seams in matching colours, heat, and the texels of an image.

mod frame;
mod svg;

use qoptimize::qmesh::{PolygonView, Polygons, Vec2, Vec3};

use super::PictureError;
use super::camera::Camera;
use super::canvas::Canvas;
use super::color::{Linear, Rgba, category};
use super::legend::Legend;
use super::model::Model;
use super::paint::{Ink, Lines, Paint};
use super::render::render_with;
use super::seams::Seams;
use frame::Frame;

/// Everything that a layout shows.
pub struct Layout<'a> {
    /// The faces.
    pub polygons: PolygonView<'a>,
    /// One a corner.
    pub uv: &'a [Vec2],
    /// One a face.
    pub colors: &'a [Linear],
    /// Where the map is cut; `None` draws neither seams nor outlines.
    pub seams: Option<&'a Seams>,
    /// Whether the edges of faces are drawn.
    pub edges: bool,
    /// Texels a unit of UV, for a grid of them.
    pub texels: Option<f64>,
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Behind everything.
    pub background: Rgba,
    /// The scale of a heat map.
    pub legend: Option<&'a Legend<'a>>,
}

/// Of edges and outlines.
const DARK: Rgba = Rgba([24, 30, 44, 255]);
/// Of the unit square, whatever is behind.
const FRAME: Rgba = Rgba([128, 128, 128, 255]);
/// Lines of a grid are at least so many pixels apart.
const LEAST_GRID: f64 = 6.0;

impl Layout<'_> {
    /// As pixels.
    ///
    /// # Errors
    /// [`PictureError::NoExtent`] when all UVs are in one place.
    pub fn canvas(&self) -> Result<Canvas, PictureError> {
        let frame = self.frame()?;
        let flat = Polygons {
            positions: self.uv.iter().map(|uv| Vec3::new(uv.x, uv.y, 0.0)).collect(),
            face_start: self.polygons.face_start.to_vec(),
            corner_vertex: (0..self.uv.len() as u32).collect(),
        };
        let model = Model::flat(flat.view());
        let camera = Camera::flat(frame.middle(), frame.scale, frame.center());
        let paint = Paint::Faces(self.colors);
        let mut canvas = render_with(&model, &paint, &self.lines(&frame), camera, self.size, self.background);
        let grey = Linear::from(FRAME);
        if let Some(step) = self.grid_step(&frame) {
            frame.grid(step).into_iter().for_each(|[a, b]| canvas.straight(a, b, 1.0, grey, 0.35));
        }
        for [a, b] in frame.tiles() {
            canvas.straight(a, b, 1.5, grey, 0.8);
        }
        if let Some(legend) = self.legend {
            legend.draw(&mut canvas, self.background);
        }
        Ok(canvas)
    }

    /// As vectors: an SVG with one group for the faces, one for each run of seams.
    ///
    /// # Errors
    /// As [`canvas`](Self::canvas).
    pub fn svg(&self) -> Result<String, PictureError> {
        Ok(svg::text(self, &self.frame()?))
    }

    fn frame(&self) -> Result<Frame, PictureError> {
        let legend = self.legend.map_or(0, |legend| legend.width(self.size)).min(self.size[0] / 2);
        Frame::around(self.uv, [self.size[0] - legend, self.size[1]])
    }

    /// In pixels, for a picture of 900 pixels and in proportion.
    fn unit(&self) -> f32 {
        self.size[0].min(self.size[1]) as f32 / 900.0
    }

    fn edge_width(&self) -> f32 {
        (1.0 * self.unit()).max(0.6)
    }

    fn seam_width(&self) -> f32 {
        (3.5 * self.unit()).max(1.5)
    }

    fn lines(&self, _: &Frame) -> Lines {
        let mut lines = Lines { inks: Vec::new(), of_corner: vec![0; self.uv.len()] };
        let dark = Linear::from(DARK);
        lines.inks.push(Ink { color: dark, strength: 0.55, width: self.edge_width(), fades: true });
        if self.edges {
            lines.of_corner.fill(1);
        }
        let Some(seams) = self.seams else { return lines };
        // A line along the outside is drawn on one face only, so it has twice the width of one between two faces.
        let width = 2.0 * self.seam_width();
        let ink = |color: Linear| Ink { color, strength: 1.0, width, fades: false };
        lines.inks.push(ink(dark));
        seams.boundary.iter().for_each(|&corner| lines.of_corner[corner as usize] = 2);
        lines.inks.extend((0..seams.runs).map(|run| ink(category(run))));
        for (cut, run) in seams.cuts.iter().zip(&seams.run) {
            cut.iter().for_each(|&corner| lines.of_corner[corner as usize] = 3 + run);
        }
        lines
    }

    /// The distance of grid lines in units of UV: a texel, or the fewest texels that leave lines apart.
    fn grid_step(&self, frame: &Frame) -> Option<f64> {
        let texel = 1.0 / self.texels?;
        let mut texels = 1.0;
        while texel * texels * frame.scale < LEAST_GRID {
            texels *= 2.0;
        }
        Some(texel * texels)
    }
}

#[cfg(test)]
mod tests {
    use qoptimize::qmesh::shapes;

    use super::*;

    /// Half of a square map in one colour, half in another: the pixels have just that, the right way up.
    #[test]
    fn colours_are_where_the_uvs_are() {
        let mesh = shapes::grid(4, 4);
        let uv: Vec<Vec2> = mesh.corners().map(|c| mesh.position(mesh.vertex(c)).xy() / 4.0).collect();
        let [red, blue] = [[200, 0, 0, 255], [0, 0, 200, 255]].map(|color| Linear::from(Rgba(color)));
        // Faces 8 to 15 are the upper half: v above 0.5.
        let colors: Vec<Linear> = (0..16).map(|face| if face < 8 { red } else { blue }).collect();
        let layout = Layout {
            polygons: mesh.view(),
            uv: &uv,
            colors: &colors,
            seams: None,
            edges: false,
            texels: None,
            size: [100, 100],
            background: Rgba([255; 4]),
            legend: None,
        };
        let bytes = layout.canvas().unwrap().bytes();
        let pixel = |x: usize, y: usize| &bytes[(y * 100 + x) * 4..][..3];
        assert_eq!(
            (pixel(50, 30), pixel(50, 70), pixel(1, 1)),
            (&[0, 0, 200][..], &[200, 0, 0][..], &[255; 3][..])
        );
        let text = layout.svg().unwrap();
        assert!(text.contains("fill=\"#c80000\"") && text.contains("fill=\"#0000c8\""), "{text}");
    }
}
