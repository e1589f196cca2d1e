//! Several views on one picture, with their names beneath and one legend for all.

use super::camera::View;
use super::canvas::Canvas;
use super::legend::{Legend, letter_height, text_color};
use super::model::Model;
use super::paint::{Lines, Paint};
use super::render::{Shot, render};
use super::text;

/// A picture of `size` pixels with one frame for each view. `shot` says the rest; its own view and size are not read.
/// Without a view there is only the background, and the legend.
#[must_use]
pub fn sheet(
    model: &Model<'_>,
    paint: &Paint<'_>,
    lines: &Lines,
    shot: &Shot,
    views: &[View],
    legend: Option<&Legend<'_>>,
) -> Canvas {
    let mut canvas = Canvas::new(shot.size[0], shot.size[1], shot.background);
    let letters = letter_height(shot.size);
    let width = shot.size[0] - legend.map_or(0, |legend| legend.width(shot.size)).min(shot.size[0] / 2);
    let label = if views.len() > 1 { (3.0 * letters) as usize } else { 0 };
    let (columns, cell) = grid(views.len(), [width, shot.size[1]], label);
    for (i, &view) in views.iter().enumerate() {
        let corner = [i % columns * cell[0], i / columns * cell[1]];
        let size = [cell[0].max(1), cell[1].saturating_sub(label).max(1)];
        let part = render(model, paint, lines, &Shot { view, size, ..shot.clone() });
        // The background is there already; a translucent one must not be laid over itself.
        canvas.put(&part, corner);
        if label > 0 {
            let name = view.to_string();
            let x = corner[0] as f64 + (cell[0] as f64 - text::width(&name, letters)) / 2.0;
            let y = (corner[1] + size[1]) as f64 + 1.6 * letters;
            text::write(&mut canvas, &name, [x, y], letters, text_color(shot.background));
        }
    }
    if let Some(legend) = legend {
        legend.draw(&mut canvas, shot.background);
    }
    canvas
}

/// How many columns, and the size of a cell, so that frames are as large as possible.
fn grid(count: usize, [width, height]: [usize; 2], label: usize) -> (usize, [usize; 2]) {
    let cells = |columns: usize| [width / columns, height / count.div_ceil(columns).max(1)];
    let side = |columns: &usize| {
        let [width, height] = cells(*columns);
        // Of equally large frames the fewest columns: `max_by_key` takes the last.
        (width.min(height.saturating_sub(label)), usize::MAX - columns)
    };
    let columns = (1..=count.max(1)).max_by_key(side).unwrap_or(1);
    (columns, cells(columns))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_as_large_as_they_can_be() {
        assert_eq!(grid(1, [400, 300], 0), (1, [400, 300]));
        assert_eq!(grid(4, [400, 300], 10), (2, [200, 150]));
        assert_eq!(grid(3, [900, 300], 10), (3, [300, 300]));
        assert_eq!(grid(3, [100, 600], 10), (1, [100, 200]));
        assert_eq!(grid(0, [10, 10], 0), (1, [10, 10]));
    }
}
