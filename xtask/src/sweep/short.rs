//! The short forms: what the project's README shows, and the overview over all tables.

use std::fmt::Write as _;

use super::mesh_report::MeshReport;

/// Face and head with the paper's rows beside, for README.md.
pub(super) fn table(reports: &[MeshReport]) -> String {
    let mut text = String::new();
    for report in reports {
        let Some(printed) = report.printed else { continue };
        let _ = writeln!(text, "`fixtures/{}.obj`:\n", report.name);
        text += &report.table_head();
        text += &report.printed_rows(printed);
        for (contender, result) in &report.swept {
            text += &report.error_rows(contender.name, result);
        }
        text += "\n";
        for (contender, result) in &report.swept {
            if let Ok(sweep) = result {
                let features = &sweep.features;
                let smallest =
                    features.smallest.map_or_else(String::new, |smallest| format!("q = {}", smallest.q));
                let _ = writeln!(
                    text,
                    "- **{}** ({}): {} of 3. Angle error falls as q → 1: {}. Area error falls as q → 0: {}. Smallest sum \
                     inside: {}, at {smallest}.",
                    contender.name,
                    contender.what,
                    features.held(),
                    features.angle.words(),
                    features.area.words(),
                    if features.smallest.is_some_and(|smallest| smallest.inside) { "yes" } else { "no" },
                );
            }
        }
        text += "\n";
    }
    text
}

/// One line a mesh and method: how many of the three features hold.
pub(super) fn overview(reports: &[MeshReport]) -> String {
    let mut text = String::from(
        "# Distortion tables\n\nWritten by `cargo xtask sweep`, checked by `cargo xtask sweep --check`. One file a mesh, in the form of the paper's \
         Table 1; here, which of its three\nfeatures hold: angle error (Eq. 13) falls as q → 1, area error (Eq. 14) falls as q → 0, \
         the smallest sum lies at neither end. [search.md](search.md)\nranks the readings of the paper's method by them.\n\n\
         | mesh | method | angle error falls | area error falls | smallest sum | knee |\n| --- | --- | --- | --- | --- | --- |\n",
    );
    for report in reports {
        for (contender, result) in &report.swept {
            let start = format!("| [{0}]({0}.md) | {1} |", report.name, contender.name);
            let _ = match result {
                Ok(sweep) => writeln!(
                    text,
                    "{start} {} | {} | {} | {} |",
                    sweep.features.angle.words(),
                    sweep.features.area.words(),
                    sweep.features.smallest.map_or_else(
                        || "–".to_owned(),
                        |s| format!("{} at q = {}", if s.inside { "inside," } else { "at an end," }, s.q)
                    ),
                    sweep.knee.as_ref().map_or_else(|_| "none".to_owned(), |knee| format!("q = {}", knee.q))
                ),
                Err(error) => writeln!(text, "{start} no map: {error} | | | |"),
            };
        }
    }
    text
}
