//! Islands, repairs, seams and the layout, in words.

use qoptimize::Island;
use qoptimize::atlas::{Layout, SeamLength};
use qoptimize::qmesh::{Found, Repairs};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::Input;
use crate::table::{Table, counted, short};

/// Islands that the table for people shows; the largest ones.
const SHOWN: usize = 12;

/// What was mended, one line a kind, in the numbers of the file.
pub(crate) fn repair_lines(repairs: &Repairs) -> Vec<String> {
    let mut lines = Vec::new();
    let edge = |[a, b]: &[u32; 2]| format!("{}-{}", a + 1, b + 1);
    let number = |index: &u32| (index + 1).to_string();
    line(&mut lines, &repairs.nonmanifold_edges, "edge", "with more than two faces: cut", "vertices", edge);
    line(&mut lines, &repairs.nonmanifold_edges, "edge", "in more than two faces: cut", "vertices", edge);
    line(
        &mut lines,
        &repairs.nonmanifold_vertices,
        "vertex",
        "where fans of faces touch: split in the map",
        "vertex",
        number,
    );
    line(
        &mut lines,
        &repairs.flipped_faces,
        "face",
        "against the orientation around: turned over for the map",
        "face",
        number,
    );
    line(
        &mut lines,
        &repairs.one_sided_edges,
        "edge",
        "where the surface has one side only: cut",
        "vertices",
        edge,
    );
    line(
        &mut lines,
        &repairs.doubled_faces,
        "face",
        "on the vertices of another one: apart in the map",
        "face",
        number,
    );
    line(
        &mut lines,
        &repairs.repeated_corner_faces,
        "face",
        "with a vertex twice: apart in the map",
        "face",
        number,
    );
    lines
}

fn line<T>(
    lines: &mut Vec<String>,
    found: &Found<T>,
    noun: &str,
    what: &str,
    place: &str,
    name: impl Fn(&T) -> String,
) {
    if found.count > 0 {
        let mut places: Vec<String> = found.first.iter().map(name).collect();
        if found.count > places.len() {
            places.push("…".to_owned());
        }
        lines.push(format!("{} {what} ({place} {})", counted(found.count, noun), places.join(", ")));
    }
}

/// With `--strict`, a repair is an error.
pub(crate) fn refuse_repairs(repairs: &Repairs, input: &Input) -> Result<(), Failure> {
    if repairs.is_empty() {
        return Ok(());
    }
    let failure = Failure::new(Exit::Mesh, format!("{}: the mesh has to be mended", input.name));
    let failure = repair_lines(repairs).into_iter().fold(failure, Failure::note);
    Err(failure.help("mend it, or leave --strict out: the repairs are made for the UVs only"))
}

/// Seams and layout, in sentences.
pub(crate) fn layout_lines(seams: SeamLength, layout: Option<&Layout>, islands: &[Island]) -> Vec<String> {
    let mut lines = Vec::new();
    if seams.edges > 0 {
        lines.push(format!("seams: {}, length {}", counted(seams.edges, "edge"), short(seams.length)));
    }
    if let Some(layout) = layout {
        let mut text = if layout.fitted {
            format!(
                "layout: {} fill {:.1} % of the square",
                counted(islands.len(), "island"),
                100.0 * layout.filled
            )
        } else {
            format!(
                "layout: {} on {} × {}",
                counted(islands.len(), "island"),
                short(layout.width),
                short(layout.height)
            )
        };
        text += &format!(", margin {} texels", short(layout.margin));
        if let Some(density) = layout.texels_per_unit {
            text += &format!(", {} texels a unit of length", short(density));
        }
        lines.push(text);
    }
    let fallbacks = islands.iter().filter(|island| island.fallback.is_some()).count();
    if fallbacks > 0 {
        let why = islands.iter().find_map(|island| island.fallback.as_deref()).unwrap_or_default();
        lines.push(format!("{} mapped in another way than asked for: {why}", counted(fallbacks, "island")));
    }
    lines
}

/// The largest islands, one row each.
pub(crate) fn island_table(islands: &[Island]) -> Table {
    let head = ["faces", "loops", "area", "stretch", "sym. Dirichlet", "flipped", "crossings"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    let mut order: Vec<&Island> = islands.iter().collect();
    order.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.first_face.cmp(&b.first_face)));
    let title =
        if order.len() > SHOWN { format!("the {SHOWN} largest islands") } else { "islands".to_owned() };
    table.section(&title);
    for island in order.into_iter().take(SHOWN) {
        table.row(
            &format!("of face {}", island.first_face + 1),
            vec![
                island.faces.to_string(),
                island.boundary_loops.to_string(),
                short(island.area),
                short(island.stretch),
                short(island.symmetric_dirichlet),
                island.flipped_corners.to_string(),
                island.boundary_crossings.to_string(),
            ],
        );
    }
    table
}
