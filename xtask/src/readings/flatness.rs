//! The oracle of flatness: a flat mesh with its own boundary should come back as itself.

use qparam_cli::qembed::{EmbedOptions, Weights, embed};
use qparam_cli::qmesh::{QuadMesh, shapes};
use qparam_cli::qsimplify::{RemovalRule, SimplifyOptions, simplify};

use super::inputs::{WEIGHTS, interior, jittered, own_boundary};
use super::table::{Table, digits};

const Q: [f64; 3] = [1.0, 0.5, 0.0];

fn meshes() -> [(&'static str, QuadMesh); 3] {
    [
        ("jittered disk", jittered(&shapes::disk(8), 0.25, 1)),
        ("jittered rectangle", shapes::jittered_grid(24, 16, 0.2, 1)),
        ("graded rectangle", shapes::graded_grid(24, 16, 1.1)),
    ]
}

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new("mesh | weights | q = 1 | q = 0.5 | q = 0 | negative weights");
    for (name, mesh) in meshes() {
        for (reading, weights) in WEIGHTS {
            let mut row = vec![name.to_owned(), reading.to_owned()];
            let mut negative = 0;
            for q in Q {
                let (distance, met) = distance(&mesh, weights, q)?;
                row.push(digits(distance));
                negative = negative.max(met);
            }
            row.push(negative.to_string());
            table.row(&row);
        }
    }
    Ok(format!(
        "Rule `all`, the mesh's own outline as boundary: root mean square distance of the interior vertices from where \
         they were, in mean edge lengths.\n\n{}",
        table.text()
    ))
}

/// How far the interior vertices are from where they were, and how many weights were negative.
fn distance(mesh: &QuadMesh, weights: Weights, q: f64) -> Result<(f64, usize), String> {
    let all = SimplifyOptions { rule: RemovalRule::All, ..Default::default() };
    let simplified = simplify(mesh, &all, &()).map_err(|error| error.to_string())?;
    let options = EmbedOptions { q, weights, boundary: own_boundary(mesh), ..Default::default() };
    let embedding = embed(mesh, &simplified, &options, &()).map_err(|error| error.to_string())?;
    let squares: f64 =
        mesh.vertices().map(|v| (embedding.uv[v] - mesh.position(v).xy()).norm_squared()).sum();
    let mean_edge = mesh.edges().map(|edge| mesh.edge_length(edge)).sum::<f64>() / mesh.edge_count() as f64;
    Ok(((squares / interior(mesh) as f64).sqrt() / mean_edge, embedding.negative_weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plain cotangents of star angles are the only reading with linear precision.
    #[test]
    fn only_star1_is_linearly_precise() {
        let mesh = shapes::jittered_grid(8, 6, 0.2, 1);
        let off = |weights| distance(&mesh, weights, 0.5).unwrap().0;
        assert!(off(Weights::Star1) < 1e-9);
        assert!(off(Weights::Star4) > 1e-3 && off(Weights::Printed) > 1e-3);
    }
}
