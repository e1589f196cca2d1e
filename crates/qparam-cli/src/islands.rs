//! Islands, repairs, seams and the layout, in words.

use qoptimize::Island;
use qoptimize::atlas::{Layout, RefinementEnd, SeamLength};
use qoptimize::qmesh::{Found, Repairs};
use serde::Serialize;

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

/// One step of the trade of seams for stretch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Trade {
    /// Cuts beyond those that every island needs.
    pub(crate) cuts: usize,
    /// Length of all seams in space.
    pub(crate) seam_length: f64,
    /// Of the island that is stretched most.
    pub(crate) stretch: f64,
}

/// What each further cut cost and brought, the most stretched island first; nothing when there were none.
pub(crate) fn trades(seams: SeamLength, islands: &[Island]) -> Vec<Trade> {
    let total: usize = islands.iter().filter_map(|island| Some(island.refinement.as_ref()?.cuts.len())).sum();
    if total == 0 {
        return Vec::new();
    }
    let added = islands.iter().filter_map(|island| island.refinement.as_ref()).flat_map(|found| &found.cuts);
    let mut seam_length = seams.length - added.map(|cut| cut.length).sum::<f64>();
    if seam_length < 1e-9 * seams.length {
        // What rounding leaves of a surface without seams before.
        seam_length = 0.0;
    }
    let mut done = vec![0; islands.len()];
    let now = |island: usize, done: usize| match (&islands[island].refinement, done) {
        (None, _) => islands[island].stretch,
        (Some(found), 0) => found.stretch,
        (Some(found), done) => found.cuts[done - 1].stretch,
    };
    let mut trades = Vec::new();
    for cuts in 0..=total {
        let worst = (0..islands.len()).map(|island| now(island, done[island])).fold(0.0, f64::max);
        trades.push(Trade { cuts, seam_length, stretch: worst });
        let left = |island: &usize| {
            islands[*island].refinement.as_ref().is_some_and(|found| done[*island] < found.cuts.len())
        };
        let next = (0..islands.len()).filter(left).reduce(|best, island| {
            if now(island, done[island]) > now(best, done[best]) { island } else { best }
        });
        if let Some(next) = next {
            seam_length +=
                islands[next].refinement.as_ref().map_or(0.0, |found| found.cuts[done[next]].length);
            done[next] += 1;
        }
    }
    trades
}

/// The trade as a table, and which islands stay above the bound and why.
pub(crate) fn trade_text(trades: &[Trade], islands: &[Island], color: bool) -> String {
    let mut text = String::new();
    if !trades.is_empty() {
        let mut table = Table::new(["seam length", "largest stretch"].map(str::to_owned).to_vec());
        table.section("further cuts");
        for trade in trades {
            table.row(&trade.cuts.to_string(), vec![short(trade.seam_length), short(trade.stretch)]);
        }
        text += &(table.render(color) + "\n");
    }
    for island in islands {
        let Some(found) = &island.refinement else { continue };
        let why = match found.end {
            RefinementEnd::Reached => continue,
            RefinementEnd::NothingGained => "further cuts gained nothing",
            RefinementEnd::NothingToCut => "there is nothing left to cut",
            RefinementEnd::OutOfTime => "the time limit ended it",
            _ => "it has as many cuts as an island may have",
        };
        text += &format!(
            "note: the island of face {} stays stretched by {}: {why}\n",
            island.first_face + 1,
            short(island.stretch)
        );
    }
    text
}

/// An island of more stretch than this is worth a word: a texel of one side there is one of four sides in the open.
const GROSS_STRETCH: f64 = 4.0;

/// The way out for islands that are stretched grossly; nothing when there are none.
pub(crate) fn stretch_hint(islands: &[Island]) -> String {
    let gross: Vec<&Island> = islands.iter().filter(|island| island.stretch > GROSS_STRETCH).collect();
    let Some(worst) = gross.iter().max_by(|a, b| a.stretch.total_cmp(&b.stretch)) else {
        return String::new();
    };
    let face = worst.first_face + 1;
    let which = match gross.len() {
        1 => format!("the island of face {face} is stretched"),
        several => format!("{several} islands are stretched, most the one of face {face}"),
    };
    format!(
        "hint: {which} by up to {} in 99 % of its area; --max-stretch 2 cuts it further (or 4, for fewer cuts), --seams says where\n\n",
        short(worst.stretch)
    )
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
