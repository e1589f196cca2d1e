//! The curves of Table 1: both errors over q, as a picture.

use qparam_cli::sweep::{Errors, Sweep, digits};

use crate::chart::{Axis, Panel, Point, Scale, Series, Style, svg};

use super::mesh_report::MeshReport;

/// Methods that are drawn, with the index of their colour; the others would only widen the axes.
const DRAWN: [(&str, usize); 4] =
    [("paper, all", 5), ("paper, best", 1), ("direct", 0), ("direct, shape 0.1", 2)];
/// An error and where it is found.
type Error = (&'static str, fn(&Errors) -> f64);
const ERRORS: [Error; 2] = [("angle error (Eq. 13)", |e| e.angle), ("area error (Eq. 14)", |e| e.area)];

/// Two panels for each mesh that the paper has a table of.
pub(super) fn picture(reports: &[MeshReport]) -> String {
    let models = reports.iter().filter(|report| report.printed.is_some());
    let panels: Vec<Panel> = models.flat_map(|report| ERRORS.map(|error| panel(report, error))).collect();
    let note = "Angle errors are to fall to the left, area errors to the right. The paper's models are others: its trends can be compared, \
                its sizes cannot.";
    svg(&panels, 2, &[note.to_owned()])
}

fn panel(report: &MeshReport, (label, value): Error) -> Panel {
    let mut series = Vec::new();
    if let Some(printed) = report.printed {
        let at = |q: &f64| printed.at(*q).map(|errors| [*q, value(&errors)]);
        series.push(Series {
            name: "printed in the paper's Table 1".to_owned(),
            color: 4,
            style: Style::Dashed,
            points: report.q.iter().filter_map(at).map(Point::bare).collect(),
        });
    }
    for (name, color) in DRAWN {
        let found = report.swept.iter().find(|(contender, _)| contender.name == name);
        let Some((_, Ok(sweep))) = found else { continue };
        series.push(Series {
            name: name.to_owned(),
            color,
            style: Style::Line,
            points: points(sweep, value),
        });
    }
    let values = series.iter().flat_map(|series| series.points.iter().map(|point| point.at[1]));
    let y = Axis::holding(label, values);
    let x = Axis {
        label: "q (1: angles first, 0: areas first)".to_owned(),
        scale: Scale::Linear,
        bounds: [1.04, -0.04],
        marked: report.q.clone(),
    };
    let quantity = label.split(" (").next().unwrap_or(label);
    Panel { title: format!("{}: {quantity}", report.name), x, y, series }
}

/// As the tables show them, so that machines which round sums differently draw the same picture.
fn points(sweep: &Sweep, value: fn(&Errors) -> f64) -> Vec<Point> {
    let errors = sweep.columns.iter().filter_map(super::Column::errors);
    errors.map(|errors| Point::bare([errors.q, digits(value(&errors)).parse().unwrap_or(0.0)])).collect()
}
