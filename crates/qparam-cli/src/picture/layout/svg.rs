//! The layout as SVG.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use qoptimize::qmesh::Vec2;

use super::super::color::{Linear, category};
use super::super::legend::{letter_height, text_color};
use super::super::seams::next_corners;
use super::frame::Frame;
use super::{DARK, FRAME, Layout};

pub(super) fn text(layout: &Layout<'_>, frame: &Frame) -> String {
    let [width, height] = layout.size;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
         <title>UV layout of {} faces</title>\n",
        layout.polygons.face_count()
    );
    if layout.background.0[3] > 0 {
        let opacity = f64::from(layout.background.0[3]) / 255.0;
        let color = layout.background.hex();
        let _ = writeln!(
            text,
            "<rect width=\"{width}\" height=\"{height}\" fill=\"{color}\" fill-opacity=\"{opacity:.3}\"/>"
        );
    }
    faces(&mut text, layout, frame);
    guides(&mut text, layout, frame);
    seams(&mut text, layout, frame);
    legend(&mut text, layout);
    text.push_str("</svg>\n");
    text
}

/// One path for each colour; what overlaps is darker, since no face is quite opaque.
fn faces(text: &mut String, layout: &Layout<'_>, frame: &Frame) {
    let mut paths: BTreeMap<[u8; 4], String> = BTreeMap::new();
    for face in 0..layout.polygons.face_count() {
        let outline: Vec<Vec2> = layout.polygons.corners(face).map(|c| frame.place(layout.uv[c])).collect();
        let path = paths.entry(layout.colors[face].to_rgba().0).or_default();
        push_path(path, &outline);
        path.push('z');
    }
    let stroke = if layout.edges {
        format!(
            "stroke=\"{}\" stroke-opacity=\"0.55\" stroke-width=\"{:.2}\"",
            DARK.hex(),
            layout.edge_width()
        )
    } else {
        String::new()
    };
    let _ = writeln!(text, "<g id=\"faces\" fill-opacity=\"0.85\" stroke-linejoin=\"round\" {stroke}>");
    for (color, path) in paths {
        let fill = super::Rgba(color).hex();
        let own =
            if layout.edges { String::new() } else { format!(" stroke=\"{fill}\" stroke-width=\"0.4\"") };
        let _ = writeln!(text, "<path fill=\"{fill}\"{own} d=\"{path}\"/>");
    }
    text.push_str("</g>\n");
}

fn guides(text: &mut String, layout: &Layout<'_>, frame: &Frame) {
    let mut group = |id: &str, width: f64, lines: Vec<[Vec2; 2]>| {
        let mut path = String::new();
        lines.iter().for_each(|line| push_path(&mut path, line));
        let color = FRAME.hex();
        let _ = writeln!(
            text,
            "<path id=\"{id}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" d=\"{path}\"/>"
        );
    };
    if let Some(step) = layout.grid_step(frame) {
        group("texels", 0.3, frame.grid(step));
    }
    group("unit-squares", 1.2, frame.tiles());
}

fn seams(text: &mut String, layout: &Layout<'_>, frame: &Frame) {
    let Some(seams) = layout.seams else { return };
    let next = next_corners(layout.polygons);
    let edge = |corner: u32| [corner, next[corner as usize]].map(|c| frame.place(layout.uv[c as usize]));
    let width = layout.seam_width();
    let _ = writeln!(text, "<g fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{width:.2}\">");
    let mut group = |title: &str, color: Linear, edges: &mut dyn Iterator<Item = u32>| {
        let mut path = String::new();
        edges.for_each(|corner| push_path(&mut path, &edge(corner)));
        if !path.is_empty() {
            let color = color.to_rgba().hex();
            let _ = writeln!(text, "<path stroke=\"{color}\" d=\"{path}\"><title>{title}</title></path>");
        }
    };
    group("boundary", Linear::from(DARK), &mut seams.boundary.iter().copied());
    let mut by_run: Vec<Vec<u32>> = vec![Vec::new(); seams.runs];
    for (cut, &run) in seams.cuts.iter().zip(&seams.run) {
        by_run[run as usize].extend(cut);
    }
    for (run, corners) in by_run.into_iter().enumerate() {
        let title = format!("seam {}: {} edges, each on two sides", run + 1, corners.len() / 2);
        group(&title, category(run), &mut corners.into_iter());
    }
    text.push_str("</g>\n");
}

fn legend(text: &mut String, layout: &Layout<'_>) {
    let Some(legend) = layout.legend else { return };
    let letters = letter_height(layout.size);
    let left = (layout.size[0] - legend.width(layout.size).min(layout.size[0])) as f64 + 2.0 * letters;
    let (top, bar) = (7.0 * letters, 1.6 * letters);
    let height = layout.size[1] as f64 - 10.0 * letters;
    let color = text_color(layout.background).to_rgba().hex();
    let font = 1.4 * letters;
    let _ = writeln!(
        text,
        "<g id=\"legend\" font-family=\"sans-serif\" font-size=\"{font:.1}\" fill=\"{color}\">"
    );
    for (line, words) in legend.words().enumerate() {
        let y = (3.0 + 1.9 * line as f64) * letters;
        let _ = writeln!(text, "<text x=\"{left:.1}\" y=\"{y:.1}\">{words}</text>");
    }
    let table = legend.scale.map.table(65);
    for (i, color) in table.iter().enumerate() {
        let y = top + height * (1.0 - (i + 1) as f64 / table.len() as f64);
        let step = height / table.len() as f64 + 0.5;
        let _ = writeln!(
            text,
            "<rect x=\"{left:.1}\" y=\"{y:.2}\" width=\"{bar:.1}\" height=\"{step:.2}\" fill=\"{}\"/>",
            color.to_rgba().hex()
        );
    }
    for (value, name) in legend.scale.ticks() {
        let y = top + height * (1.0 - legend.scale.place(value)) + letters / 2.0;
        let _ = writeln!(text, "<text x=\"{:.1}\" y=\"{y:.1}\">{name}</text>", left + bar + letters);
    }
    text.push_str("</g>\n");
}

/// `M` to the first point, `l` along the differences of the rounded points, so that no error piles up.
fn push_path(path: &mut String, points: &[Vec2]) {
    let hundredths = |p: &Vec2| [(p.x * 100.0).round() as i64, (p.y * 100.0).round() as i64];
    let mut before = [0, 0];
    for (i, here) in points.iter().map(hundredths).enumerate() {
        let (letter, dx, dy) = match i {
            0 => ("M", here[0], here[1]),
            1 => ("l", here[0] - before[0], here[1] - before[1]),
            _ => (" ", here[0] - before[0], here[1] - before[1]),
        };
        let _ = write!(path, "{letter}{} {}", dx as f64 / 100.0, dy as f64 / 100.0);
        before = here;
    }
}
