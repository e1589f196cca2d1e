//! The league as Markdown.

use super::agreement::TOLERANCE;
use super::dominance::{self, Dominance};
use super::league::{Figures, League, MeshTable, Outcome, Row};
use super::numbers::{against, count_against, short};

/// The column titles; the first is left-aligned.
const COLUMNS: &[&str] = &[
    "method",
    "valid",
    "angle error (Eq. 13)",
    "area error (Eq. 14)",
    "symmetric Dirichlet",
    "flipped corners",
    "folded faces",
    "boundary crossings",
    "torn quads",
    "islands",
    "solve, s",
    "process, s",
    "memory, MB",
];

/// The whole document.
pub(super) fn render(league: &League) -> String {
    let mut text = header(league);
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
    let machine = &league.machine;
    let memory = machine.memory_gib.map_or_else(String::new, |gib| format!(", {gib} GiB"));
    format!(
        "# League table of UV maps on quad meshes\n\n\
         Made by `cargo xtask compare`; do not edit.\n\n\
         - Machine: {}, {} hardware threads{memory}, {}\n\
         - Versions: {}\n\
         - Runs: {} of each method on each mesh, in alternating order, each in a process of its own, ended after {} s; \
         times and memory are medians\n\
         - In brackets: how many times the figure of `{}` (bold), or how many more where that is 0. Less is better \
         in every column\n\n\
         Every tool gets the same quad mesh, triangulated as its users do it; its UVs are mapped back to the corners of \
         the quads. **Valid**: no corner flipped, no face folded, no island's boundary crossing itself. **Flipped \
         corners**: of the four triangles that a quad's corners make, those of no positive area. **Folded faces**: quads \
         of which neither diagonal gives two positive triangles. **Torn quads**: quads whose two triangles went to \
         different places; they are measured as two triangles. Errors are sums; those of a map in many islands are small \
         because its cuts pay for them. **Solve**: the computation alone. **Process**: with starting, reading and \
         writing. **Memory**: the largest resident set of the process.\n\n\
         All results were measured by `qparam measure` and by an independent script; {}.\n",
        machine.processor,
        machine.threads,
        machine.system,
        league.versions.join(", "),
        league.runs,
        league.timeout_seconds,
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
        mesh.name, about.vertices, about.faces, about.quads
    );
    if let Some(reason) = &about.not_a_disk {
        return text + &format!("\n\nRefused: not a disk ({reason}).\n");
    }
    let ours = mesh.rows.iter().find_map(|row| match &row.outcome {
        Outcome::Measured(figures) if row.name == baseline => Some(figures.as_ref()),
        _ => None,
    });
    text += "\n\n";
    text += &line(COLUMNS.iter().map(|&title| title.to_owned()));
    text += &line(COLUMNS.iter().enumerate().map(|(i, _)| if i == 0 { "---" } else { "---:" }.to_owned()));
    for row in &mesh.rows {
        text += &line(cells(row, if row.name == baseline { None } else { ours }, row.name == baseline));
    }
    text += &notes(mesh);
    text += &dominance_table(&mesh.dominance);
    text
}

/// Our best setting against each valid rival.
fn dominance_table(dominance: &[Dominance]) -> String {
    if dominance.is_empty() {
        return String::new();
    }
    let beaten = dominance.iter().filter(|found| found.worst() <= dominance::TOLERANCE).count();
    let mut text = format!(
        "\nOver the settings of `direct`, one is no worse than {beaten} of the {} valid rivals in one island in all three errors \
         at once (within 2 %). The nearest for each, ours over theirs:\n\n",
        dominance.len()
    );
    let titles = ["rival", "setting", "angle error", "area error", "symmetric Dirichlet", "worst"];
    text += &line(titles.map(str::to_owned));
    text += &line(["---", "---", "---:", "---:", "---:", "---:"].map(str::to_owned));
    for found in dominance {
        let ratios = found.ratios.map(short);
        let names = [found.rival.clone(), format!("`{}`", found.setting)];
        text += &line(names.into_iter().chain(ratios).chain([short(found.worst())]));
    }
    text
}

fn line(cells: impl IntoIterator<Item = String>) -> String {
    format!("| {} |\n", cells.into_iter().collect::<Vec<_>>().join(" | "))
}

fn cells(row: &Row, ours: Option<&Figures>, baseline: bool) -> Vec<String> {
    let name = if baseline { format!("**{}**", row.name) } else { row.name.clone() };
    match &row.outcome {
        Outcome::Failed { message } => {
            let mut cells = vec![name, format!("failed: {}", one_line(message))];
            cells.resize(COLUMNS.len(), String::new());
            cells
        }
        Outcome::Measured(figures) => [name].into_iter().chain(figure_cells(figures, ours)).collect(),
    }
}

fn figure_cells(figures: &Figures, ours: Option<&Figures>) -> Vec<String> {
    let real = |value: &dyn Fn(&Figures) -> f64| against(value(figures), ours.map(value));
    let count = |value: &dyn Fn(&Figures) -> usize| count_against(value(figures), ours.map(value));
    vec![
        if figures.measures.is_valid() { "yes" } else { "no" }.to_owned(),
        real(&|f| f.measures.angle_error),
        real(&|f| f.measures.area_error),
        real(&|f| f.measures.symmetric_dirichlet.unwrap_or(f64::NAN)),
        count(&|f| f.measures.flipped_corners),
        count(&|f| f.measures.folded_faces),
        count(&|f| f.measures.boundary_crossings),
        count(&|f| f.torn_quads),
        count(&|f| f.measures.islands),
        real(&|f| f.solve_seconds),
        real(&|f| f.process_seconds),
        real(&|f| f.peak_memory_bytes as f64 / 1e6),
    ]
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
