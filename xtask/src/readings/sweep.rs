//! Table 1: errors over q, with each reading.

use qparam_cli::qembed::BoundaryShape;
use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qoptimize::Options;
use qparam_cli::qsimplify::RemovalRule;
use qparam_cli::sweep::TABLE_1_Q;

use super::inputs::{WEIGHTS, models, paper, run};
use super::table::{Table, series};
use crate::sweep::printed::{FACE, HEAD, Printed};

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(
        "mesh | rule, weights, boundary | E13 | E14 | most flips | E13 rises | E14 falls | least sum at q",
    );
    for Printed { letter, angle, area } in [&FACE, &HEAD] {
        let mut row = vec![format!("({letter})"), "Table 1 of the paper".to_owned()];
        row.extend(verdict(angle, area, None));
        table.row(&row);
    }
    let boundaries = [("circle", BoundaryShape::Circle), ("projection", BoundaryShape::Projection)];
    for (name, mesh) in models() {
        for (boundary_name, boundary) in &boundaries {
            for (reading, weights) in WEIGHTS {
                let base = Options { weights, boundary: boundary.clone(), ..paper(RemovalRule::All, 1.0) };
                table.row(&row(name, &format!("all, {reading}, {boundary_name}"), &mesh, &base)?);
            }
        }
        for (reading, weights) in WEIGHTS {
            for exponent in [0.0, 1.0] {
                let base = Options { weights, exponent, ..paper(RemovalRule::Guarded, 1.0) };
                table.row(&row(name, &format!("guarded, {reading}, circle, r = {exponent}"), &mesh, &base)?);
            }
        }
    }
    Ok(format!("E13 and E14 at q = 1, 0.8, 0.5, 0.2, 0.\n\n{}", table.text()))
}

fn row(name: &str, reading: &str, mesh: &QuadMesh, base: &Options) -> Result<Vec<String>, String> {
    let mut row = vec![name.to_owned(), reading.to_owned()];
    let (mut angle, mut area, mut flips) = ([0.0; 5], [0.0; 5], 0);
    for (k, q) in TABLE_1_Q.into_iter().enumerate() {
        match run(mesh, &Options { q, ..base.clone() }) {
            Ok(map) => {
                angle[k] = map.distortion.angle_error;
                area[k] = map.distortion.area_error;
                flips = flips.max(map.distortion.flipped_corners);
            }
            Err(reason) => {
                row.push(format!("refused: {reason}"));
                row.resize(8, "–".to_owned());
                return Ok(row);
            }
        }
    }
    row.extend(verdict(&angle, &area, Some(flips)));
    Ok(row)
}

/// The two rows of numbers, and which features of Table 1 they show.
fn verdict(angle: &[f64; 5], area: &[f64; 5], flips: Option<usize>) -> [String; 6] {
    let answer = |yes: bool| if yes { "yes" } else { "no" }.to_owned();
    let rises = angle.windows(2).all(|pair| pair[0] < pair[1]);
    let falls = area.windows(2).all(|pair| pair[0] > pair[1]);
    [
        series(*angle),
        series(*area),
        flips.map_or("–".to_owned(), |count| count.to_string()),
        answer(rises),
        answer(falls),
        TABLE_1_Q[least(angle, area)].to_string(),
    ]
}

/// Where the sum is least.
fn least(angle: &[f64; 5], area: &[f64; 5]) -> usize {
    let sum = |k: &usize| angle[*k] + area[*k];
    (0..TABLE_1_Q.len()).min_by(|a, b| sum(a).total_cmp(&sum(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the paper says of its Table 1: both trends, and the least sum at q = 0.5.
    #[test]
    fn table_1_has_its_three_features() {
        for Printed { angle, area, .. } in [&FACE, &HEAD] {
            assert_eq!(verdict(angle, area, None)[3..], ["yes", "yes", "0.5"]);
        }
    }
}
