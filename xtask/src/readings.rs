//! `cargo xtask readings`: the measurements behind `docs/paper.md`, as tables in `docs/tables/readings.md`.
//!
//! Each reading of the paper runs with the code of this workspace on meshes from formulas. The tables carry three
//! digits and no times, so every run writes the same bytes; `--check` compares them, `--times` prints ratios of times.

mod cells;
mod connectivity;
mod flatness;
mod inputs;
mod methods;
mod mixing;
mod overlaps;
mod random;
mod rules;
mod shapes;
mod sweep;
mod table;
mod times;
mod work;

use std::fs;
use std::path::Path;

/// Where the tables go, in the workspace.
const FILE: &str = "docs/tables/readings.md";

/// One section of the file.
type Section = fn() -> Result<String, String>;

const SECTIONS: &[(&str, Section)] = &[
    ("Voronoi cells (Eqs. 3 and 4)", cells::section),
    ("What deletion does to the graph (section 2.1)", connectivity::section),
    ("Rules of deletion compared (sections 2.1 to 2.3)", rules::section),
    ("The exponent of Eq. 5 (section 2.2)", rules::exponents),
    ("The oracle of flatness (section 2.3)", flatness::section),
    ("Mixing (Eq. 10)", mixing::section),
    ("Sweeps over q (Table 1)", sweep::section),
    ("Overlap removal (section 2.4)", overlaps::section),
    ("Validity on many disks", shapes::section),
    ("Boundaries that are not convex", shapes::non_convex),
    ("The paper's method and others", methods::section),
    ("Work", work::section),
];

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [] => write(),
        ["--check"] => check(),
        ["--times"] => times::print(),
        _ => Err("the arguments are: nothing, --check, or --times".to_owned()),
    }
}

fn write() -> Result<(), String> {
    let path = path()?;
    let folder = path.parent().ok_or("no folder")?;
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    fs::write(&path, text()?).map_err(|error| format!("{FILE}: {error}"))?;
    println!("{FILE}: {} tables", SECTIONS.len());
    Ok(())
}

fn check() -> Result<(), String> {
    let found = fs::read_to_string(path()?).map_err(|error| format!("{FILE}: {error}"))?;
    let measured = text()?;
    let differs = |(number, (found, measured)): (usize, (&str, &str))| {
        (found != measured)
            .then(|| format!("{FILE}:{}\n  stands   {found}\n  measured {measured}", number + 1))
    };
    let differences: Vec<String> =
        found.lines().zip(measured.lines()).enumerate().filter_map(differs).collect();
    if found == measured {
        println!("{FILE}: all {} tables are as measured", SECTIONS.len());
        return Ok(());
    }
    Err(format!(
        "the tables are not as measured\n{}\n`cargo xtask readings` writes them anew; docs/paper.md quotes them",
        differences.join("\n")
    ))
}

fn path() -> Result<std::path::PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace has no folder")?;
    Ok(root.join(FILE))
}

fn text() -> Result<String, String> {
    let mut text = format!(
        "# Readings of the paper, measured\n\n\
         Written by `cargo xtask readings`; [paper.md](../paper.md) says what follows from it.\n\n{}",
        inputs::legend()
    );
    for (title, section) in SECTIONS {
        text += &format!("\n## {title}\n\n{}", section().map_err(|error| format!("{title}: {error}"))?);
    }
    Ok(text)
}
