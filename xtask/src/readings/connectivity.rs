//! What deletion does to the graph.

use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qsimplify::{Connectivity, RemovalRule, Simplified, SimplifyOptions, Threshold, simplify};

use super::inputs::{interior, models};
use super::table::{Table, digits};

const RULES: [(&str, RemovalRule); 3] =
    [("naive", RemovalRule::Naive), ("guarded", RemovalRule::Guarded), ("ring", RemovalRule::Ring)];

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(
        "mesh | rule | fraction asked | fraction removed | kept inside | isolated | one spring | two springs | cut off",
    );
    for (name, mesh) in models() {
        for (rule_name, rule) in RULES {
            for asked in [0.1, 0.3, 0.5, 0.6, 1.0] {
                // Naive deletion of everything leaves no graph to look at.
                if rule == RemovalRule::Naive && asked == 1.0 {
                    continue;
                }
                let simplified = simplified(&mesh, rule, asked)?;
                let Connectivity { interior: kept, isolated, degree_1, degree_2, cut_off } =
                    simplified.connectivity(&mesh);
                let removed = simplified.removed.len() as f64 / interior(&mesh) as f64;
                let counts = [kept, isolated, degree_1, degree_2, cut_off].map(|count| count.to_string());
                let mut row = vec![name.to_owned(), rule_name.to_owned(), asked.to_string(), digits(removed)];
                row.extend(counts);
                table.row(&row);
            }
        }
    }
    Ok(format!(
        "Kept interior vertices and the edges that are left to them. What is *cut off* from the boundary has no position \
         in Eq. 5; one spring puts a vertex on its neighbour, two put it on a straight line.\n\n{}",
        table.text()
    ))
}

fn simplified(mesh: &QuadMesh, rule: RemovalRule, fraction: f64) -> Result<Simplified, String> {
    let options = SimplifyOptions { rule, threshold: Threshold::Fraction(fraction), ..Default::default() };
    simplify(mesh, &options, &()).map_err(|error| error.to_string())
}
