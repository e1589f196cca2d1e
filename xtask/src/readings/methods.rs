//! The paper's method beside the ones it names.

use qparam_cli::qoptimize::{Method, Options};
use qparam_cli::qsimplify::RemovalRule;

use super::inputs::{errors, models, paper, run};
use super::table::{Table, digits};

fn contestants() -> Vec<(&'static str, Options)> {
    let with = |method: Method| Options { method, q: 0.5, ..Options::default() };
    let q = |q: f64, options: Options| Options { q, ..options };
    let overlaps = |options: Options| Options { overlaps: Some(Default::default()), ..options };
    vec![
        ("paper, guarded 0.5", with(Method::Paper)),
        ("paper, ring 0.7, with 2.4", overlaps(paper(RemovalRule::Ring, 0.7))),
        ("paper, all, q = 1", q(1.0, paper(RemovalRule::All, 1.0))),
        ("paper, all", paper(RemovalRule::All, 1.0)),
        ("paper, all, q = 0", q(0.0, paper(RemovalRule::All, 1.0))),
        ("paper, none, r = 0.5", Options { exponent: 0.5, ..paper(RemovalRule::None, 0.0) }),
        ("uniform (Tutte)", with(Method::Uniform)),
        ("mean value (Floater)", with(Method::MeanValue)),
        ("harmonic (Eck)", with(Method::Harmonic)),
        ("LSCM (Lévy)", with(Method::Lscm)),
    ]
}

pub(super) fn section() -> Result<String, String> {
    let mut table =
        Table::new("mesh | method | E13 | E14 | flips | symmetric Dirichlet | s1/s2, 99th percentile");
    for (name, mesh) in models() {
        for (method, options) in contestants() {
            let distortion = run(&mesh, &options)?.distortion;
            let mut row = vec![name.to_owned(), method.to_owned()];
            row.extend(errors(&distortion));
            let optional = |value: Option<f64>| value.map_or("–".to_owned(), digits);
            row.push(optional(distortion.symmetric_dirichlet));
            row.push(optional(distortion.singular_ratio_p99));
            table.row(&row);
        }
    }
    Ok(format!(
        "Circle, but for LSCM, whose boundary is free. Symmetric Dirichlet is 1 for an isometry.\n\n{}",
        table.text()
    ))
}
