//! Whether maps are valid: on disks of many shapes, and on boundaries that are not convex.

use std::f64::consts::TAU;

use qparam_cli::qembed::BoundaryShape;
use qparam_cli::qmesh::{QuadMesh, Vec3, shapes};
use qparam_cli::qoptimize::Options;
use qparam_cli::qsimplify::RemovalRule;

use super::inputs::{MENDED, WEIGHTS, jittered, mended, own_boundary, paper};
use super::table::Table;

fn disks() -> [(&'static str, QuadMesh); 9] {
    [
        ("face(3)", shapes::face(3)),
        ("head(2)", shapes::head(2)),
        ("bump(20, 0.5)", shapes::bump(20, 0.5)),
        ("nose(24)", shapes::nose(24)),
        ("saddle(16)", shapes::saddle(16)),
        ("cap(5, 2.6)", shapes::cap(5, 2.6)),
        ("cylinder_strip(24, 12, 4.5)", shapes::cylinder_strip(24, 12, 4.5)),
        ("finger(2, 8)", shapes::finger(2, 8)),
        ("finger(2, 30)", shapes::finger(2, 30)),
    ]
}

const RULES: [(&str, RemovalRule, f64); 4] = [
    ("guarded", RemovalRule::Guarded, 0.5),
    ("naive", RemovalRule::Naive, 0.1),
    ("ring", RemovalRule::Ring, 0.7),
    ("all", RemovalRule::All, 1.0),
];

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(&format!("mesh | rule | boundary | {MENDED}"));
    let boundaries = [("circle", BoundaryShape::Circle), ("projection", BoundaryShape::Projection)];
    for (name, mesh) in disks() {
        for (rule_name, rule, fraction) in RULES {
            for (boundary_name, boundary) in &boundaries {
                let options = Options { boundary: boundary.clone(), ..paper(rule, fraction) };
                let mut row = vec![name.to_owned(), rule_name.to_owned(), (*boundary_name).to_owned()];
                row.extend(outcome(&mesh, &options));
                table.row(&row);
            }
        }
    }
    Ok(format!(
        "`guarded` with half of the vertices asked, `naive` with 10 %, `ring` with 70 %; overlap removal with \
         λ1 = 0.6, λ2 = 0.3, at most 20 moves a vertex.\n\n{}",
        table.text()
    ))
}

pub(super) fn non_convex() -> Result<String, String> {
    let mut table = Table::new(&format!("mesh | rule | weights | {MENDED}"));
    for (name, mesh) in [("horseshoe", horseshoe()), ("wave", wave())] {
        for (rule_name, rule) in [("all", RemovalRule::All), ("guarded", RemovalRule::Guarded)] {
            for (weights_name, weights) in WEIGHTS {
                let options = Options { weights, boundary: own_boundary(&mesh), ..paper(rule, 0.5) };
                let mut row = vec![name.to_owned(), rule_name.to_owned(), weights_name.to_owned()];
                row.extend(outcome(&mesh, &options));
                table.row(&row);
            }
        }
    }
    Ok(format!(
        "Flat meshes with their own outline as boundary: the identity would be a map without any error.\n\n{}",
        table.text()
    ))
}

/// The cells of [`mended`], or why there are none.
fn outcome(mesh: &QuadMesh, options: &Options) -> Vec<String> {
    mended(mesh, options).unwrap_or_else(|reason| {
        let mut cells = vec![format!("refused: {reason}")];
        cells.resize(MENDED.split('|').count(), "–".to_owned());
        cells
    })
}

/// A rectangle bent in its plane by 300 degrees.
fn horseshoe() -> QuadMesh {
    let mesh = jittered(&shapes::grid(40, 10), 0.15, 2);
    let bent = mesh.vertex_data(|vertex| {
        let p = mesh.position(vertex);
        let (sine, cosine) = (TAU * (5.0 / 6.0) * (0.5 - p.x / 40.0)).sin_cos();
        let radius = 4.0 + 0.8 * p.y;
        Vec3::new(radius * cosine, radius * sine, 0.0)
    });
    oriented(&mesh.with_positions(bent))
}

/// A rectangle sheared up and down twice.
fn wave() -> QuadMesh {
    let mesh = jittered(&shapes::grid(40, 10), 0.15, 2);
    let sheared = mesh.vertex_data(|vertex| {
        let p = mesh.position(vertex);
        Vec3::new(p.x, p.y + 6.0 * (TAU * p.x / 20.0).sin(), 0.0)
    });
    mesh.with_positions(sheared)
}

/// The mesh, mirrored if it is seen from below: a boundary has to run counter-clockwise.
fn oriented(mesh: &QuadMesh) -> QuadMesh {
    let area: f64 = mesh
        .corners()
        .map(|corner| {
            let [a, b] = [corner, mesh.next_corner(corner)].map(|c| mesh.position(mesh.vertex(c)).xy());
            a.perp(&b)
        })
        .sum();
    let mirror = if area < 0.0 { -1.0 } else { 1.0 };
    mesh.clone().with_positions(mesh.vertex_data(|vertex| {
        let p = mesh.position(vertex);
        Vec3::new(p.x, mirror * p.y, p.z)
    }))
}
