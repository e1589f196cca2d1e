//! The league as Markdown. It says nothing of the machine: times and memory are ratios.

use super::agreement::TOLERANCE;
use super::league::{Figures, League, MeshTable, Outcome, Row};
use super::numbers::{against, count_against, ratio, short};
use super::summary;

/// The column titles; the first two are left-aligned.
const COLUMNS: &[&str] = &[
    "method",
    "boundary",
    "valid",
    "angle error (Eq. 13)",
    "area error (Eq. 14)",
    "symmetric Dirichlet",
    "flipped corners",
    "folded faces",
    "boundary crossings",
    "torn quads",
    "islands",
    "solve",
    "process",
    "memory",
];

/// The whole document; `picture` is the file of the fronts.
pub(super) fn render(league: &League, picture: Option<&str>) -> String {
    let mut text = header(league);
    text += &summary::section(league);
    if let Some(name) = picture {
        text += &format!(
            "\n![Angle error against area error on each mesh]({name})\n\n\
             *Each dot of ours is one setting of `direct`; the star is its default.*\n"
        );
    }
    for mesh in &league.meshes {
        text += &section(mesh, &league.baseline);
    }
    if !league.absent.is_empty() {
        text += "\n## Not installed\n\n";
        for absent in &league.absent {
            text += &format!("- {}: {}\n", absent.tool, one_line(&absent.why));
        }
    }
    text
}

fn header(league: &League) -> String {
    format!(
        "# League table of UV maps on quad meshes\n\n\
         Written by `cargo xtask compare{}`; do not edit.\n\n\
         - Versions: {}\n\
         - Runs: {} of each method on each mesh, in alternating order, each in a process of its own, ended after {} s{}\n\
         - In brackets: how many times the figure of `{}` (bold), or how many more where that is 0. Less is better \
         in every column\n\n\
         Every tool gets the same quad mesh, triangulated as its users do it; its UVs are mapped back to the corners of \
         the quads. **Boundary**: left free, on a circle, or that of charts which the tool cuts itself. **Valid**: no corner \
         flipped, no face folded, no island's boundary crossing itself. **Flipped \
         corners**: of the four triangles that a quad's corners make, those of no positive area. **Folded faces**: quads \
         of which neither diagonal gives two positive triangles. **Torn quads**: quads whose two triangles went to \
         different places; they are measured as two triangles. Errors are sums; those of a map in many islands are small \
         because its cuts pay for them. **Solve** (the computation alone), **process** (with starting, reading and \
         writing) and **memory** (the largest resident set of the process) are medians over ours: the machine was shared with other \
         work, and a factor of two means nothing.\n\n\
         All results were measured by `qparam measure` and by an independent script; {}.\n",
        league.arguments,
        league.versions.join(", "),
        league.runs,
        league.timeout_seconds,
        if league.ours_again { "; ours were run again later, so times are not of one run" } else { "" },
        league.baseline,
        if league.meshes.iter().all(|mesh| mesh.disagreements.is_empty()) {
            format!("they agree within {TOLERANCE:e}")
        } else {
            "**they disagree, see below**".to_owned()
        },
    )
}

fn section(mesh: &MeshTable, baseline: &str) -> String {
    let about = &mesh.about;
    let mut text = format!(
        "\n## {}\n\n{} vertices, {} faces, {} of them quads",
        mesh.title(),
        about.vertices,
        about.faces,
        about.quads
    );
    if let Some(reason) = &about.not_a_disk {
        return text + &format!("\n\nRefused: not a disk ({reason}).\n");
    }
    let ours = mesh.rows.iter().find_map(|row| match &row.outcome {
        Outcome::Measured(figures) if row.name == baseline => Some(figures.as_ref()),
        _ => None,
    });
    text += ".\n\n";
    text += &line(COLUMNS.iter().map(|&title| title.to_owned()));
    text += &line(COLUMNS.iter().enumerate().map(|(i, _)| if i < 2 { "---" } else { "---:" }.to_owned()));
    for row in &mesh.rows {
        text += &line(cells(row, if row.name == baseline { None } else { ours }, row.name == baseline));
    }
    text += &notes(mesh);
    text += &summary::defaults_table(mesh, baseline);
    text += &summary::dominance_table(&mesh.dominance);
    text
}

/// A line of a table.
pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    format!("| {} |\n", cells.into_iter().collect::<Vec<_>>().join(" | "))
}

fn cells(row: &Row, ours: Option<&Figures>, baseline: bool) -> Vec<String> {
    let name = if baseline { format!("**{}**", row.name) } else { row.name.clone() };
    match &row.outcome {
        Outcome::Failed { message } => {
            let mut cells = vec![name, row.boundary.clone(), format!("failed: {}", one_line(message))];
            cells.resize(COLUMNS.len(), String::new());
            cells
        }
        Outcome::Measured(figures) => {
            [name, row.boundary.clone()].into_iter().chain(figure_cells(figures, ours)).collect()
        }
    }
}

fn figure_cells(figures: &Figures, ours: Option<&Figures>) -> Vec<String> {
    let real = |value: &dyn Fn(&Figures) -> f64| against(value(figures), ours.map(value));
    let count = |value: &dyn Fn(&Figures) -> usize| count_against(value(figures), ours.map(value));
    let cost = |value: &dyn Fn(&Figures) -> f64| {
        ours.map_or_else(|| "1".to_owned(), |ours| ratio(value(figures) / value(ours)))
    };
    vec![
        yes(figures.measures.is_valid()),
        real(&|f| f.measures.angle_error),
        real(&|f| f.measures.area_error),
        figures.measures.symmetric_dirichlet.map_or_else(
            || "–".to_owned(),
            |stretch| {
                let theirs = ours.and_then(|ours| ours.measures.symmetric_dirichlet);
                theirs.map_or_else(|| short(stretch), |ours| against(stretch, Some(ours)))
            },
        ),
        count(&|f| f.measures.flipped_corners),
        count(&|f| f.measures.folded_faces),
        count(&|f| f.measures.boundary_crossings),
        count(&|f| f.torn_quads),
        count(&|f| f.measures.islands),
        cost(&|f| f.solve_seconds),
        cost(&|f| f.process_seconds),
        cost(&|f| f.peak_memory_bytes as f64),
    ]
}

pub(super) fn yes(holds: bool) -> String {
    if holds { "yes" } else { "no" }.to_owned()
}

fn notes(mesh: &MeshTable) -> String {
    let mut notes = Vec::new();
    let unsteady = |row: &&Row| matches!(&row.outcome, Outcome::Measured(figures) if !figures.repeatable);
    let names: Vec<String> = mesh.rows.iter().filter(unsteady).map(|row| row.name.clone()).collect();
    if !names.is_empty() {
        notes.push(format!("Not the same bytes in every run: {}.", names.join(", ")));
    }
    let mut inputs: Vec<(&str, Vec<&str>)> = Vec::new();
    for row in &mesh.rows {
        let tool = row.name.split('-').next().unwrap_or(&row.name);
        match inputs.iter_mut().find(|(input, _)| *input == row.input) {
            Some((_, tools)) if tools.contains(&tool) => {}
            Some((_, tools)) => tools.push(tool),
            None => inputs.push((&row.input, vec![tool])),
        }
    }
    let inputs: Vec<String> =
        inputs.iter().map(|(input, tools)| format!("{} ({})", input, tools.join(", "))).collect();
    notes.push(format!("Input: {}.", inputs.join("; ")));
    for text in &mesh.disagreements {
        notes.push(format!("**Disagreement** of the measurers: {}.", one_line(text)));
    }
    notes.iter().map(|note| format!("\n{note}\n")).collect()
}

/// Text that does not break a table.
fn one_line(text: &str) -> String {
    text.lines().next().unwrap_or("").replace('|', "\\|")
}
