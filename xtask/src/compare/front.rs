//! The angle/area front of each mesh with the rivals on it, as one picture.

use crate::chart::{Axis, Mark, Panel, Point, Series, Style, svg};

use super::dominance::errors;
use super::league::{League, MeshTable, Outcome, Row};

/// Logarithm of the ratio below which two errors are the same in the picture.
const NEAR: f64 = 0.02;

/// A panel a mesh that has our maps over the settings; nothing when none has.
pub(super) fn picture(league: &League) -> Option<String> {
    let meshes = league.meshes.iter().filter(|mesh| !mesh.grid.is_empty());
    let panels: Vec<Panel> = meshes.map(|mesh| panel(mesh, &league.baseline)).collect();
    let notes = [
        "Sums of Eq. 13 and Eq. 14 over all corners; less is better in both. Maps in one island only: cuts pay for small errors.",
        "Beyond the axes: maps with flips whose errors are larger than those of every valid one.",
    ];
    (!panels.is_empty()).then(|| svg(&panels, 2, &notes.map(str::to_owned)))
}

fn panel(mesh: &MeshTable, baseline: &str) -> Panel {
    let ours: Vec<[f64; 2]> = mesh.grid.iter().map(|spot| [spot.errors[0], spot.errors[1]]).collect();
    let front = front(&ours);
    let rivals = |valid: bool| -> Vec<Point> {
        let rows = mesh.rows.iter().filter(|row| !row.ours);
        gathered(rows.filter_map(|row| rival(row, valid)).collect())
    };
    let default = mesh.rows.iter().filter(|row| row.name == baseline).filter_map(place);
    let series = [
        (
            "direct over its settings (--q, --shape, --angle-term)",
            0,
            Style::Marks(Mark::Speck),
            points(&ours),
        ),
        ("direct: no other setting is better in both", 0, Style::Line, points(&front)),
        ("rivals, valid maps", 1, Style::Marks(Mark::Dot), rivals(true)),
        ("rivals, maps with flips or crossings", 1, Style::Marks(Mark::Ring), rivals(false)),
        ("direct at its defaults", 0, Style::Marks(Mark::Star), default.map(Point::bare).collect()),
    ];
    let held: Vec<[f64; 2]> = series
        .iter()
        .filter(|(_, color, style, _)| *color == 0 || *style == Style::Marks(Mark::Dot))
        .flat_map(|(.., points)| points.iter().map(|point| point.at))
        .collect();
    let axis = |label: &str, k: usize| Axis::holding(label, held.iter().map(|at| at[k]));
    Panel {
        title: mesh.title(),
        x: axis("angle error (Eq. 13)", 0),
        y: axis("area error (Eq. 14)", 1),
        series: series
            .into_iter()
            .map(|(name, color, style, points)| Series { name: name.to_owned(), color, style, points })
            .collect(),
    }
}

fn points(places: &[[f64; 2]]) -> Vec<Point> {
    places.iter().copied().map(Point::bare).collect()
}

/// Those that no other beats in both, from left to right.
fn front(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut least = f64::INFINITY;
    sorted.retain(|place| {
        let is_better = place[1] < least;
        least = least.min(place[1]);
        is_better
    });
    sorted
}

/// A rival's map in one island, if it is valid or not as asked.
fn rival(row: &Row, valid: bool) -> Option<Point> {
    let Outcome::Measured(figures) = &row.outcome else { return None };
    let counts = figures.measures.islands == 1 && figures.torn_quads == 0;
    let is_asked_for = counts && figures.measures.is_valid() == valid;
    is_asked_for.then_some(Point { at: place(row)?, label: row.name.replace("minimum-stretch", "stretch") })
}

/// Points that are as good as one are one, with their names as far as there is room.
fn gathered(points: Vec<Point>) -> Vec<Point> {
    let mut found: Vec<Point> = Vec::new();
    let mut names: Vec<Vec<String>> = Vec::new();
    for point in points {
        let is_near = |other: &Point| (0..2).all(|k| (point.at[k] / other.at[k]).ln().abs() < NEAR);
        match found.iter().position(is_near) {
            Some(index) => names[index].push(point.label),
            None => {
                names.push(vec![point.label.clone()]);
                found.push(point);
            }
        }
    }
    for (point, names) in found.iter_mut().zip(names) {
        point.label = match &names[..] {
            [first, _, rest @ ..] if !rest.is_empty() => format!("{first} and {} more", rest.len() + 1),
            names => names.join(", "),
        };
    }
    found
}

fn place(row: &Row) -> Option<[f64; 2]> {
    let Outcome::Measured(figures) = &row.outcome else { return None };
    let [angle, area, _] = errors(&figures.measures)?;
    Some([angle, area])
}

#[cfg(test)]
mod tests {
    use super::{Point, front, gathered};

    /// The front falls from left to right, and everything else is above it.
    #[test]
    fn the_front_is_what_nothing_beats() {
        let places = [[3.0, 1.0], [1.0, 4.0], [2.0, 4.0], [2.0, 2.0], [4.0, 1.0], [3.5, 3.0]];
        assert_eq!(front(&places), [[1.0, 4.0], [2.0, 2.0], [3.0, 1.0]]);
    }

    #[test]
    fn points_in_one_place_share_a_label() {
        let point = |label: &str, at| Point { at, label: label.to_owned() };
        let mut points = vec![point("a", [1.0, 9.0]), point("b", [2.0, 9.0]), point("c", [1.01, 9.1])];
        let labels = |points: &[Point]| -> Vec<String> {
            gathered(points.to_vec()).into_iter().map(|point| point.label).collect()
        };
        assert_eq!(labels(&points), ["a, c", "b"]);
        points.push(point("d", [1.0, 9.0]));
        assert_eq!(labels(&points), ["a and 2 more", "b"]);
    }
}
