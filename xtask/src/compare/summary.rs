//! What the league comes to: our defaults against the rivals', and our settings against each rival's map.

use super::defaults::{MORE_STRETCH, Ratios, Versus, versus};
use super::dominance::{Dominance, TOLERANCE};
use super::league::{League, MeshTable};
use super::markdown::{line, yes};
use super::numbers::short;

/// All meshes in a line each.
pub(super) fn section(league: &League) -> String {
    let table = table(league);
    if table.is_empty() {
        return String::new();
    }
    format!(
        "\n## In short\n\n{table}\n\
         Ours over theirs, so 1 or less is no worse; in brackets where their map is not valid. Angle error (13), area error (14) and symmetric Dirichlet \
         (SD) of `{}` without turning a dial, against the two rivals that minimise SD; *SD, least stretch* is that of the preset \
         `least-stretch` (`--shape 10`). *(13) + (14)* is against ABF and LSCM, the largest ratio. *Settings*: for how many of the \
         rivals' maps in one island some setting of `--q`, `--shape` and `--angle-term` is no worse in angle error, area error and SD at \
         once, within {:.0} %; and the worst of the three where it is worst.\n",
        league.baseline,
        100.0 * (TOLERANCE - 1.0),
    )
}

/// For README: a line a mesh, without the finer points.
pub(super) fn short_table(league: &League) -> String {
    let titles = [
        "mesh",
        "quads",
        "libigl SLIM: (13), (14), SD",
        "Blender minimum stretch: (13), (14), SD",
        "ABF, LSCM: (13) + (14)",
        "rivals' maps that a setting of ours matches",
        "worst",
    ];
    let mut text = line(titles.map(str::to_owned));
    text += &line(["---"].into_iter().chain(["---:"; 6]).map(str::to_owned));
    for mesh in &league.meshes {
        let Some(cells) = row(mesh, &league.baseline) else { continue };
        let [matched, worst] = matched(&mesh.dominance.iter().collect::<Vec<_>>());
        let kept = [0, 1, 2, 4, 6].map(|k: usize| cells[k].clone());
        text += &line(kept.into_iter().chain([matched, worst]));
    }
    text
}

/// The table alone; empty without meshes.
fn table(league: &League) -> String {
    let rows: Vec<Vec<String>> =
        league.meshes.iter().filter_map(|mesh| row(mesh, &league.baseline)).collect();
    if rows.is_empty() {
        return String::new();
    }
    let mut text = line(
        [
            "mesh",
            "quads",
            "SLIM: (13), (14), SD",
            "SD, least stretch",
            "minimum stretch: (13), (14), SD",
            "SD, least stretch",
            "ABF, LSCM: (13) + (14)",
            "settings, valid rivals",
            "worst",
            "rivals with flips",
            "worst",
        ]
        .map(str::to_owned),
    );
    text += &line(["---"].into_iter().chain(["---:"; 10]).map(str::to_owned));
    rows.into_iter().for_each(|cells| text += &line(cells));
    text
}

fn row(mesh: &MeshTable, baseline: &str) -> Option<Vec<String>> {
    let versus = versus(mesh, baseline);
    if versus.is_empty() {
        return None;
    }
    let mut cells = vec![mesh.title(), mesh.about.quads.to_string()];
    for rival in ["libigl-slim", "blender-minimum-stretch-50"] {
        cells.extend(stretch_cells(versus.iter().find(|found| found.rival == rival)));
    }
    let sums = versus.iter().filter(|found| found.islands == 1).filter_map(|found| match found.figures {
        Ratios::Conformal { sum } => Some(sum),
        Ratios::Stretch { .. } => None,
    });
    cells.push(sums.reduce(f64::max).map_or_else(|| "–".to_owned(), short));
    for valid in [true, false] {
        cells.extend(dominance_cells(mesh, valid));
    }
    Some(cells)
}

fn stretch_cells(found: Option<&Versus>) -> [String; 2] {
    let Some(Versus { figures: Ratios::Stretch { errors, least_stretch }, valid, .. }) = found else {
        return ["–".to_owned(), "–".to_owned()];
    };
    let cells = [errors.map(short).join(", "), least_stretch.map_or_else(|| "–".to_owned(), short)];
    if *valid { cells } else { cells.map(|text| format!("({text})")) }
}

fn dominance_cells(mesh: &MeshTable, valid: bool) -> [String; 2] {
    matched(&mesh.dominance.iter().filter(|found| found.valid == valid).collect::<Vec<_>>())
}

/// How many are beaten, and the worst ratio.
fn matched(found: &[&Dominance]) -> [String; 2] {
    let beaten = found.iter().filter(|found| found.worst() <= TOLERANCE).count();
    let worst = found.iter().map(|found| found.worst()).reduce(f64::max);
    [format!("{beaten} of {}", found.len()), worst.map_or_else(|| "–".to_owned(), short)]
}

/// Our defaults against the rivals that they are to match, one mesh.
pub(super) fn defaults_table(mesh: &MeshTable, baseline: &str) -> String {
    let versus = versus(mesh, baseline);
    if versus.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "\nAt our defaults, ours over theirs. Held: against the methods that minimise stretch, both errors no larger and symmetric Dirichlet within \
         {:.0} % (within {:.0} % with the preset for least stretch); against the conformal ones, a smaller sum of both errors.\n\n",
        100.0 * (MORE_STRETCH[0] - 1.0),
        100.0 * (MORE_STRETCH[1] - 1.0),
    );
    let titles = [
        "rival",
        "valid",
        "islands",
        "angle error",
        "area error",
        "symmetric Dirichlet",
        "with `least-stretch`",
        "sum of errors",
        "held",
    ];
    text += &line(titles.map(str::to_owned));
    text += &line(["---"].into_iter().chain(["---:"; 8]).map(str::to_owned));
    for found in &versus {
        let mut cells = vec![found.rival.clone(), yes(found.valid), found.islands.to_string()];
        match &found.figures {
            Ratios::Stretch { errors, least_stretch } => {
                cells.extend(errors.map(short));
                cells.extend([least_stretch.map_or_else(String::new, short), String::new()]);
            }
            Ratios::Conformal { sum } => {
                cells.extend([const { String::new() }; 4]);
                cells.push(short(*sum));
            }
        }
        cells.push(yes(found.holds()));
        text += &line(cells);
    }
    text + &not_held(&versus, &mesh.dominance)
}

/// Where the defaults do not hold what is claimed, and the setting that does, where there is one.
fn not_held(versus: &[Versus], dominance: &[Dominance]) -> String {
    let left = versus.iter().filter(|found| !found.holds());
    let sentences = left.map(|found| {
        let matching =
            dominance.iter().find(|other| other.rival == found.rival && other.worst() <= TOLERANCE);
        let instead = matching.map_or_else(
            || "no setting that was tried is".to_owned(),
            |other| format!("`{}` is", other.setting),
        );
        format!(" {}: the defaults weigh the errors otherwise; {instead} no worse in all three.", found.rival)
    });
    let text: String = sentences.collect();
    if text.is_empty() { text } else { format!("\nNot held:{text}\n") }
}

/// Our best setting against each rival's map in one island.
pub(super) fn dominance_table(dominance: &[Dominance]) -> String {
    if dominance.is_empty() {
        return String::new();
    }
    let count = |valid: bool, beaten: bool| {
        let counts = |found: &&Dominance| found.valid == valid && (!beaten || found.worst() <= TOLERANCE);
        dominance.iter().filter(counts).count()
    };
    let mut text = format!(
        "\nOver the settings of `direct`, one is no worse than {} of the {} valid maps in one island, and than {} of the {} that are not valid, in all \
         three errors at once (within {:.0} %). The nearest for each, ours over theirs:\n\n",
        count(true, true),
        count(true, false),
        count(false, true),
        count(false, false),
        100.0 * (TOLERANCE - 1.0),
    );
    let titles = ["rival", "valid", "setting", "angle error", "area error", "symmetric Dirichlet", "worst"];
    text += &line(titles.map(str::to_owned));
    text += &line(["---", "---", "---", "---:", "---:", "---:", "---:"].map(str::to_owned));
    for found in dominance {
        let names = [found.rival.clone(), yes(found.valid), format!("`{}`", found.setting)];
        text += &line(names.into_iter().chain(found.ratios.map(short)).chain([short(found.worst())]));
    }
    text + &not_matched(dominance)
}

/// Which maps no setting matches, and why, where the reason is plain.
fn not_matched(dominance: &[Dominance]) -> String {
    let left: Vec<&Dominance> = dominance.iter().filter(|found| found.worst() > TOLERANCE).collect();
    if left.is_empty() {
        return String::new();
    }
    let is_end = |found: &&Dominance| {
        found.setting.starts_with("--q 0.9999 --shape 0.001") && found.ratios[1].max(found.ratios[2]) <= 1.0
    };
    let (ends, others): (Vec<&Dominance>, Vec<&Dominance>) = left.into_iter().partition(is_end);
    let names = |found: &[&Dominance]| {
        found
            .iter()
            .map(|found| format!("{} ({})", found.rival, short(found.worst())))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut text = String::from("\nNot matched:");
    if !ends.is_empty() {
        text += &format!(
            " {}, whose angles are better than ours by that much where both dials are at their ends: `--q` acts up to 0.9999, `--shape` down to \
             0.001, so that the minimum exists; areas and stretch are smaller there all the same.",
            names(&ends)
        );
    }
    if !others.is_empty() {
        text += &format!(" {}: no setting that was tried is nearer.", names(&others));
    }
    text + "\n"
}
