//! Plots as SVG text: panels with linear or logarithmic axes, lines, marks, labels that keep off each other, one legend.
//!
//! The same data give the same bytes: places are rounded to a tenth of a pixel.

mod axis;
mod labels;

use std::fmt::Write as _;

pub(crate) use axis::{Axis, Scale};
use labels::{Box2, Labels};

/// Width and height of a panel with its margins, in pixels.
const PANEL: [f64; 2] = [460.0, 360.0];
/// Left, top, right and bottom margins of the plot in its panel.
const MARGINS: [f64; 4] = [66.0, 34.0, 14.0, 48.0];
const LEGEND_LINE: f64 = 20.0;
/// Readable on white, and different from each other for most eyes (after Okabe and Ito).
const COLORS: [&str; 7] = ["#0059a8", "#c34a00", "#00795c", "#8f4a8b", "#5b5b5b", "#8a6d00", "#0b86b0"];

/// One plot.
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) series: Vec<Series>,
}

/// Points that belong together.
#[derive(Clone)]
pub(crate) struct Series {
    /// In the legend; series of one name in several panels share a line of it.
    pub(crate) name: String,
    /// Index of its colour.
    pub(crate) color: usize,
    pub(crate) style: Style,
    pub(crate) points: Vec<Point>,
}

/// How points are drawn.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Style {
    /// A line through the points, with dots.
    Line,
    /// A broken line through the points.
    Dashed,
    /// Marks without a line.
    Marks(Mark),
}

/// A mark.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mark {
    Dot,
    Ring,
    Speck,
    Star,
}

/// A place, perhaps with a name.
#[derive(Clone)]
pub(crate) struct Point {
    pub(crate) at: [f64; 2],
    pub(crate) label: String,
}

impl Point {
    pub(crate) fn bare(at: [f64; 2]) -> Self {
        Self { at, label: String::new() }
    }
}

/// Panels in rows of `columns`, the legend beneath, lines of text last.
pub(crate) fn svg(panels: &[Panel], columns: usize, notes: &[String]) -> String {
    let columns = columns.clamp(1, panels.len().max(1));
    let rows = panels.len().div_ceil(columns);
    let legend = legend(panels);
    let top = rows as f64 * PANEL[1];
    let [width, height] = [
        columns as f64 * PANEL[0],
        top + LEGEND_LINE * (legend.len().div_ceil(2) + notes.len()) as f64 + 16.0,
    ];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#1a1a1a\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (index, panel) in panels.iter().enumerate() {
        let corner = [(index % columns) as f64 * PANEL[0], (index / columns) as f64 * PANEL[1]];
        text += &panel.draw(corner);
    }
    for (index, series) in legend.iter().enumerate() {
        let place =
            [MARGINS[0] + (index % 2) as f64 * width / 2.0, top + LEGEND_LINE * (index / 2) as f64 + 10.0];
        text += &series.sample(place);
    }
    let base = top + LEGEND_LINE * legend.len().div_ceil(2) as f64 + 14.0;
    for (index, note) in notes.iter().enumerate() {
        text += &words([MARGINS[0] - 30.0, base + LEGEND_LINE * index as f64], "start", note);
    }
    text + "</svg>\n"
}

/// The series by name, each once.
fn legend(panels: &[Panel]) -> Vec<&Series> {
    let mut found: Vec<&Series> = Vec::new();
    for series in panels.iter().flat_map(|panel| &panel.series) {
        if !found.iter().any(|known| known.name == series.name) {
            found.push(series);
        }
    }
    found
}

/// The frame of a plot on the page.
struct Frame<'a> {
    low: [f64; 2],
    high: [f64; 2],
    panel: &'a Panel,
}

impl Frame<'_> {
    /// The pixel of a place; nothing where the axes do not reach.
    fn pixel(&self, at: [f64; 2]) -> Option<[f64; 2]> {
        let x = self.panel.x.fraction(at[0])?;
        let y = self.panel.y.fraction(at[1])?;
        Some([
            self.low[0] + x * (self.high[0] - self.low[0]),
            self.high[1] - y * (self.high[1] - self.low[1]),
        ])
    }
}

impl Panel {
    fn draw(&self, corner: [f64; 2]) -> String {
        let low = [corner[0] + MARGINS[0], corner[1] + MARGINS[1]];
        let high = [corner[0] + PANEL[0] - MARGINS[2], corner[1] + PANEL[1] - MARGINS[3]];
        let frame = Frame { low, high, panel: self };
        let mut text = self.grid(&frame);
        let mut labels = Labels::new(low, high);
        for point in self.series.iter().flat_map(|series| &series.points) {
            if let Some(pixel) = frame.pixel(point.at) {
                labels.avoid(Box2::around(pixel, 4.0));
            }
        }
        for series in &self.series {
            text += &series.draw(&frame);
        }
        for series in &self.series {
            for point in series.points.iter().filter(|point| !point.label.is_empty()) {
                let Some(pixel) = frame.pixel(point.at) else { continue };
                let (place, anchor) = labels.place(pixel, &point.label);
                // Writing to a string does not fail.
                if (place[1] - pixel[1]).abs() > 8.0 {
                    let _ = writeln!(
                        text,
                        "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"{}\" stroke-width=\"0.7\"/>",
                        pixel[0],
                        pixel[1],
                        place[0],
                        place[1] - 3.5,
                        series.ink()
                    );
                }
                let _ = writeln!(
                    text,
                    "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-size=\"10.5\" fill=\"{}\">{}</text>",
                    place[0],
                    place[1],
                    series.ink(),
                    escape(&point.label)
                );
            }
        }
        text
    }

    /// Title, frame, ticks and the names of the axes.
    fn grid(&self, frame: &Frame<'_>) -> String {
        let ([left, top], [right, bottom]) = (frame.low, frame.high);
        let middle = [f64::midpoint(left, right), f64::midpoint(top, bottom)];
        let mut text = format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"14\" font-weight=\"bold\">{}</text>\n",
            middle[0],
            top - 12.0,
            escape(&self.title)
        );
        let mut line = |from: [f64; 2], to: [f64; 2]| {
            let _ = writeln!(
                text,
                "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#dedede\" stroke-width=\"1\"/>",
                from[0], from[1], to[0], to[1]
            );
        };
        let mut ticks = String::new();
        for (value, name) in self.x.ticks() {
            let Some(fraction) = self.x.fraction(value) else { continue };
            let x = left + fraction * (right - left);
            line([x, top], [x, bottom]);
            ticks += &words([x, bottom + 16.0], "middle", &name);
        }
        for (value, name) in self.y.ticks() {
            let Some(fraction) = self.y.fraction(value) else { continue };
            let y = bottom - fraction * (bottom - top);
            line([left, y], [right, y]);
            ticks += &words([left - 6.0, y + 4.0], "end", &name);
        }
        text += &ticks;
        let _ = writeln!(
            text,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#333333\"/>",
            right - left,
            bottom - top
        );
        text += &words([middle[0], bottom + 36.0], "middle", &self.x.label);
        let (x, y) = (left - 50.0, middle[1]);
        let _ = writeln!(
            text,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 {x:.1} {y:.1})\">{}</text>",
            escape(&self.y.label)
        );
        text
    }
}

impl Series {
    fn ink(&self) -> &'static str {
        COLORS[self.color % COLORS.len()]
    }

    fn draw(&self, frame: &Frame<'_>) -> String {
        let pixels: Vec<[f64; 2]> = self.points.iter().filter_map(|point| frame.pixel(point.at)).collect();
        let mut text = String::new();
        if !matches!(self.style, Style::Marks(_)) && pixels.len() > 1 {
            text += &self.line(&pixels);
        }
        for &pixel in &pixels {
            text += &self.mark(pixel);
        }
        text
    }

    fn line(&self, pixels: &[[f64; 2]]) -> String {
        let path: Vec<String> = pixels.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        let dashes = if self.style == Style::Dashed { " stroke-dasharray=\"6 4\"" } else { "" };
        format!(
            "<path d=\"M{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{dashes}/>\n",
            path.join("L"),
            self.ink()
        )
    }

    fn mark(&self, [x, y]: [f64; 2]) -> String {
        let ink = self.ink();
        match self.style {
            Style::Line | Style::Dashed | Style::Marks(Mark::Dot) => {
                format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{ink}\"/>\n")
            }
            Style::Marks(Mark::Ring) => format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#ffffff\" stroke=\"{ink}\" stroke-width=\"1.5\"/>\n"
            ),
            Style::Marks(Mark::Speck) => {
                format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2\" fill=\"{ink}\" fill-opacity=\"0.45\"/>\n"
                )
            }
            Style::Marks(Mark::Star) => {
                let points: Vec<String> = (0..10)
                    .map(|k| {
                        let radius = if k % 2 == 0 { 8.0 } else { 3.4 };
                        let (sin, cos) = (f64::from(k) * std::f64::consts::PI / 5.0).sin_cos();
                        format!("{:.1},{:.1}", x + radius * sin, y - radius * cos)
                    })
                    .collect();
                format!("<polygon points=\"{}\" fill=\"{ink}\" stroke=\"#ffffff\"/>\n", points.join(" "))
            }
        }
    }

    /// Its line of the legend.
    fn sample(&self, [x, y]: [f64; 2]) -> String {
        let mut text = String::new();
        if !matches!(self.style, Style::Marks(_)) {
            text += &self.line(&[[x - 14.0, y], [x + 14.0, y]]);
        }
        text += &self.mark([x, y]);
        text + &words([x + 22.0, y + 4.0], "start", &self.name)
    }
}

fn words([x, y]: [f64; 2], anchor: &str, text: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>\n", escape(text))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests;
