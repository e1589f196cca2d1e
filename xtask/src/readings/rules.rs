//! Sections 2.1 to 2.3 with each rule of deletion.

use qparam_cli::qoptimize::Options;
use qparam_cli::qsimplify::{RemovalRule, RemovedSide};

use super::inputs::{MENDED, errors, interior, mended, models, paper, run};
use super::table::{Table, digits};

fn variants() -> Vec<(String, Options)> {
    let mut variants = vec![
        ("all: nothing kept but the boundary".to_owned(), paper(RemovalRule::All, 1.0)),
        ("none: Eq. 5 alone".to_owned(), paper(RemovalRule::None, 0.0)),
    ];
    for (name, rule, fractions) in [
        ("guarded", RemovalRule::Guarded, &[0.1, 1.0][..]),
        ("ring", RemovalRule::Ring, &[0.1, 0.3, 0.7]),
        ("carrier", RemovalRule::Carrier, &[0.1, 0.3, 0.7]),
        ("naive", RemovalRule::Naive, &[0.1, 0.3]),
    ] {
        variants.extend(
            fractions.iter().map(|&fraction| (format!("{name}, {fraction} asked"), paper(rule, fraction))),
        );
    }
    for (name, rule) in [("ring", RemovalRule::Ring), ("carrier", RemovalRule::Carrier)] {
        for fraction in [0.3, 0.7] {
            let mut high = paper(rule, fraction);
            high.simplify.side = RemovedSide::High;
            variants.push((format!("{name}, {fraction} asked, high curvature removed"), high));
        }
    }
    variants
}

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(&format!("mesh | rule | removed | {MENDED}"));
    for (name, mesh) in models() {
        for (variant, options) in variants() {
            let removed = run(&mesh, &options)?.record.removed_vertices as f64 / interior(&mesh) as f64;
            let mut row = vec![name.to_owned(), variant, digits(removed)];
            row.extend(mended(&mesh, &options)?);
            table.row(&row);
        }
    }
    Ok(format!("Before and after overlap removal with λ1 = 0.6, λ2 = 0.3, worst first.\n\n{}", table.text()))
}

/// Eq. 5 alone with each exponent.
pub(super) fn exponents() -> Result<String, String> {
    let mut table = Table::new("mesh | r | E13 | E14 | flips");
    for (name, mesh) in models() {
        for exponent in [0.0, 0.5, 1.0, 2.0] {
            let options = Options { exponent, ..paper(RemovalRule::None, 0.0) };
            let mut row = vec![name.to_owned(), exponent.to_string()];
            row.extend(errors(&run(&mesh, &options)?.distortion));
            table.row(&row);
        }
    }
    Ok(format!("Nothing removed, circle.\n\n{}", table.text()))
}
