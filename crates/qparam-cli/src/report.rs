//! Reports: the same figures for machines (JSON) and for people (a table).

use qoptimize::atlas::{Layout, SeamLength};
use qoptimize::qmesh::Repairs;
use qoptimize::qmesh::obj::UvWriteSummary;
use qoptimize::qsolve::SolveMethod;
use qoptimize::{
    BoundaryRepair, Certificate, DirectReport, Distortion, Island, Rounding, RunRecord, ScaffoldEnd,
    StartMethod, Stop, SymmetryReport,
};
use serde::Serialize;

use crate::info::connectivity::Edges;
use crate::input::Input;
use crate::islands::{Trade, island_table, layout_lines, repair_lines, stretch_hint, trade_text};
use crate::progress::StageTime;
use crate::table::{Table, counted, short};
use crate::worst::{self, WorstReport};

/// Changes when a field of the JSON reports is renamed, removed, or means something else.
pub const SCHEMA_VERSION: u32 = 2;

/// Violations of each kind that reports list.
pub(crate) const LISTED: usize = 20;

/// What every JSON report starts with.
#[derive(Debug, Serialize)]
pub(crate) struct Head {
    schema_version: u32,
    command: &'static str,
    version: &'static str,
}

impl Head {
    pub(crate) fn new(command: &'static str) -> Self {
        Self { schema_version: SCHEMA_VERSION, command, version: env!("CARGO_PKG_VERSION") }
    }
}

/// What went in.
#[derive(Debug, Serialize)]
pub(crate) struct InputReport {
    pub(crate) file: String,
    pub(crate) vertices: usize,
    pub(crate) unused_vertices: usize,
    pub(crate) edges: usize,
    pub(crate) boundary_edges: usize,
    pub(crate) faces: usize,
    pub(crate) triangles: usize,
    pub(crate) quads: usize,
    pub(crate) polygons: usize,
}

impl InputReport {
    pub(crate) fn new(input: &Input) -> Self {
        let view = input.document.view();
        let mut counts = [0; 3];
        for face in 0..view.face_count() {
            counts[view.face(face).len().clamp(3, 5) - 3] += 1;
        }
        let counted = Edges::count(view);
        Self {
            file: input.name.clone(),
            vertices: view.positions.len(),
            unused_vertices: counted.unused_vertices,
            edges: counted.edges,
            boundary_edges: counted.boundary_edges,
            faces: view.face_count(),
            triangles: counts[0],
            quads: counts[1],
            polygons: counts[2],
        }
    }

    /// Name and counts, in one line.
    pub(crate) fn line(&self) -> String {
        let faces = [(self.triangles, "triangle"), (self.quads, "quad"), (self.polygons, "polygon")]
            .into_iter()
            .filter(|&(count, _)| count > 0)
            .map(|(count, noun)| counted(count, noun))
            .collect::<Vec<_>>()
            .join(", ");
        format!("{}: {}, {faces}\n", self.file, counted(self.vertices, "vertex"))
    }
}

/// Seconds of wall time.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Timings {
    pub(crate) read: f64,
    pub(crate) build: f64,
    pub(crate) parameterize: f64,
    pub(crate) stages: Vec<StageTime>,
    pub(crate) write: f64,
    pub(crate) total: f64,
}

/// The report of `unwrap`.
#[derive(Debug, Serialize)]
pub(crate) struct UnwrapReport<'a> {
    #[serde(flatten)]
    pub(crate) head: Head,
    pub(crate) input: InputReport,
    pub(crate) output: String,
    /// What became of the `vt` lines.
    pub(crate) uv_lines: UvWriteSummary,
    pub(crate) valid: bool,
    /// Whether more time would have made another map.
    pub(crate) stopped_by_time: bool,
    pub(crate) certificate: Certificate,
    pub(crate) distortion: &'a Distortion,
    pub(crate) worst_faces: Vec<WorstReport>,
    pub(crate) options: serde_json::Value,
    /// How the map came about; nothing when there are several islands.
    pub(crate) record: Option<&'a RunRecord>,
    /// What rounding to single precision did, when it was asked for; faces in numbers from 0.
    pub(crate) rounding: Option<&'a Rounding>,
    /// What had to be mended, in numbers from 0.
    pub(crate) repairs: &'a Repairs,
    /// What was cut.
    pub(crate) seams: SeamLength,
    /// What each cut of `--max-stretch` cost and brought.
    pub(crate) trade: Vec<Trade>,
    /// Whether `--max-stretch` could be given, and is not.
    #[serde(skip)]
    pub(crate) may_be_cut: bool,
    /// How islands were laid out.
    pub(crate) layout: Option<Layout>,
    pub(crate) layout_options: serde_json::Value,
    /// By first face, in numbers from 0.
    pub(crate) islands: &'a [Island],
    pub(crate) timings_seconds: Timings,
    pub(crate) peak_memory_bytes: Option<u64>,
}

/// The table of `unwrap`.
pub(crate) fn unwrap_text(report: &UnwrapReport<'_>, method: &str, color: bool) -> String {
    let mut text = report.input.line();
    text += &format!("{method}\n");
    let (layout, islands) = (report.layout.as_ref(), report.islands);
    for line in done_lines(report.record, report.rounding, report.repairs, report.seams, layout, islands) {
        text += &format!("  {line}\n");
    }
    text += "\n";
    if report.islands.len() > 1 {
        text += &(island_table(report.islands).render(color) + "\n");
    }
    text += &trade_text(&report.trade, report.islands, color);
    if report.may_be_cut {
        text += &stretch_hint(report.islands);
    }
    text += &distortion_table(&[(String::new(), report.distortion)]).render(color);
    text += &worst::text(&report.worst_faces);
    text += &format!("\ncertificate: {}\n", report.certificate);
    let times = &report.timings_seconds;
    let stages: Vec<_> =
        times.stages.iter().map(|time| format!("{} {:.2}", time.stage, time.seconds)).collect();
    text += &format!(
        "time {:.2} s: read {:.2}, build {:.2}, parameterize {:.2} ({}), write {:.2}",
        times.total,
        times.read,
        times.build,
        times.parameterize,
        stages.join(", "),
        times.write
    );
    if let Some(bytes) = report.peak_memory_bytes {
        text += &format!("; memory {} MB", bytes.div_ceil(1 << 20));
    }
    text + "\n"
}

/// What was mended, what ran, and how it was laid out, in sentences.
pub(crate) fn done_lines(
    record: Option<&RunRecord>,
    rounding: Option<&Rounding>,
    repairs: &Repairs,
    seams: SeamLength,
    layout: Option<&Layout>,
    islands: &[Island],
) -> Vec<String> {
    let mut lines = repair_lines(repairs);
    lines.extend(record.map(record_lines).unwrap_or_default());
    lines.extend(rounding.map(rounding_line));
    lines.extend(layout_lines(seams, layout, islands));
    lines
}

/// What ran, in sentences.
fn record_lines(record: &RunRecord) -> Vec<String> {
    let mut lines = Vec::new();
    if record.removal_candidates > 0 || record.removed_vertices > 0 {
        lines.push(format!(
            "simplification: {} of {} interior vertices removed ({} candidates)",
            record.removed_vertices, record.interior_vertices, record.removal_candidates
        ));
    }
    if record.cut_off_vertices > 0 {
        lines.push(format!(
            "{} cut off from the boundary, placed by the local step",
            counted(record.cut_off_vertices, "vertex")
        ));
    }
    if record.negative_weights > 0 {
        lines.push(format!("{} met", counted(record.negative_weights, "negative weight")));
    }
    for solve in &record.solves {
        lines.push(format!(
            "{} system: {}, {}, relative residual {:.1e}",
            solve.stage,
            counted(solve.record.unknowns, "unknown"),
            solver_name(solve.record.method),
            solve.record.relative_residual
        ));
    }
    if let Some(overlaps) = &record.overlaps {
        let mut line = format!(
            "overlap removal: {} of no positive area before, {} after {}",
            counted(overlaps.before, "corner triangle"),
            overlaps.after,
            counted(overlaps.moves, "move")
        );
        if overlaps.hit_limit {
            line += " (the bound on the moves ended it)";
        }
        if overlaps.impossible > 0 {
            line += &format!(", {} in quads that cannot be convex in any map", overlaps.impossible);
        }
        if overlaps.stuck_on_boundary > 0 {
            line += &format!(", {} stuck on the boundary", overlaps.stuck_on_boundary);
        }
        lines.push(line);
    }
    if let Some(direct) = &record.direct {
        lines.extend(direct_lines(direct));
    }
    lines
}

/// What rounding turned over, and what mended that.
fn rounding_line(rounding: &Rounding) -> String {
    let mut line = "rounded to single precision".to_owned();
    if rounding.broken_faces > 0 {
        line += &format!(
            ": {} turned over, {} moved to other floats to mend that",
            counted(rounding.broken_faces, "face"),
            counted(rounding.moved_points, "point")
        );
    }
    line
}

/// Start and descent, in sentences.
fn direct_lines(direct: &DirectReport) -> Vec<String> {
    let start = match direct.start {
        StartMethod::Tutte => "Tutte's embedding",
        StartMethod::Torsion => "Tutte's embedding with torsion weights",
        StartMethod::CoarseToFine => "from coarser meshes",
        _ => "untangled",
    };
    let descent = &direct.descent;
    let stop = match descent.stop {
        Stop::Converged => "converged",
        Stop::MaxSteps => "the bound on the steps ended it",
        Stop::Stalled => "no step helped any more",
        Stop::Cancelled => "the time limit ended it",
        _ => "stopped early",
    };
    let steps = counted(descent.steps, "step");
    let mut lines = vec![format!(
        "start: {start}; energy {:.4e} after {steps} from {:.4e}; {stop}",
        descent.energy, descent.energy_before
    )];
    lines.extend(direct.symmetry.as_ref().map(symmetry_line));
    lines.extend(direct.boundary_repair.as_ref().map(repair_line));
    if let Some(limit) = direct.elliptic_limit
        && direct.corners_beyond_elliptic > 0
    {
        lines.push(format!(
            "{} stretched beyond s1/s2 = {limit}, up to which the energy is sure to stay smooth on fine meshes; more --shape or less --q widens the range",
            counted(direct.corners_beyond_elliptic, "corner")
        ));
    }
    if !direct.exempt_faces.is_empty() {
        let shown: Vec<String> =
            direct.exempt_faces.iter().take(8).map(|face| (face.0 + 1).to_string()).collect();
        lines.push(format!(
            "{} cannot be convex in any map, because they share their opposite vertices: face {}{}",
            counted(direct.exempt_faces.len(), "quad"),
            shown.join(", "),
            if direct.exempt_faces.len() > shown.len() { ", …" } else { "" }
        ));
    }
    lines
}

/// The mirror, and how well it fits.
fn symmetry_line(symmetry: &SymmetryReport) -> String {
    let [x, y, z] = symmetry.normal.map(|component| format!("{:.3}", component + 0.0));
    format!(
        "symmetry: mirrored exactly; the plane has the normal ({x}, {y}, {z}), the surface is off by {} of its size, {} on the axis",
        short(symmetry.deviation),
        counted(symmetry.axis_vertices, "vertex")
    )
}

/// What it cost to keep the boundary clear of itself.
fn repair_line(repair: &BoundaryRepair) -> String {
    let end = match repair.end {
        ScaffoldEnd::Converged => "converged",
        ScaffoldEnd::MaxRounds => "the bound on the rounds ended it",
        ScaffoldEnd::Tight => "it came too close to itself, the last map before is kept",
        ScaffoldEnd::Cancelled => "the time limit ended it",
        _ => "stopped early",
    };
    format!(
        "boundary: left free it would meet itself ({}); kept clear by a scaffold of {}, {end}; energy {:.4e} instead of \
         {:.4e}, symmetric Dirichlet {} instead of {}",
        counted(repair.free_crossings, "crossing"),
        counted(repair.rounds, "round"),
        repair.energy,
        repair.free_energy,
        short(repair.symmetric_dirichlet),
        short(repair.free_symmetric_dirichlet)
    )
}

fn solver_name(method: SolveMethod) -> &'static str {
    match method {
        SolveMethod::Cholesky => "Cholesky",
        SolveMethod::Lu => "LU",
        SolveMethod::BiCgStab => "BiCGStab",
        SolveMethod::ConjugateGradient => "conjugate gradients",
        SolveMethod::Multigrid => "multigrid",
    }
}

/// A label and the cell under a map.
type Row<'a> = (&'a str, &'a dyn Fn(&Distortion) -> String);

/// Every measure; one column a map.
pub(crate) fn distortion_table(maps: &[(String, &Distortion)]) -> Table {
    let mut table = Table::new(maps.iter().map(|(name, _)| name.clone()).collect());
    let mut section = |title: &str, rows: &[Row<'_>]| {
        table.section(title);
        for (label, value) in rows {
            table.row(label, maps.iter().map(|(_, distortion)| value(distortion)).collect());
        }
    };
    section(
        "map",
        &[
            ("faces", &|d| d.faces.to_string()),
            ("islands", &|d| d.islands.to_string()),
            ("mirrored islands", &|d| d.mirrored_islands.to_string()),
            ("flipped corners", &|d| d.flipped_corners.to_string()),
            ("flipped faces", &|d| d.flipped_faces.to_string()),
            ("folded faces", &|d| d.folded_faces.to_string()),
            ("boundary crossings", &|d| d.boundary_crossings.to_string()),
        ],
    );
    section(
        "angles",
        &[
            ("angle error (Eq. 13)", &|d| short(d.angle_error)),
            ("mean", &|d| short(d.angle_error_mean)),
            ("root mean square, degrees", &|d| short(d.angle_rms_degrees)),
            ("MIPS (1 where conformal)", &|d| short(d.mips)),
            ("s1/s2 mean", &|d| short(d.singular_ratio_mean)),
            ("s1/s2 99th percentile", &|d| short(d.singular_ratio_p99)),
            ("s1/s2 largest", &|d| short(d.singular_ratio_max)),
        ],
    );
    section(
        "areas",
        &[
            ("area error (Eq. 14)", &|d| short(d.area_error)),
            ("mean", &|d| short(d.area_error_mean)),
            ("sum at the best scale", &|d| short(d.area_error_best_scale)),
        ],
    );
    section(
        "both",
        &[
            ("symmetric Dirichlet (1 for an isometry)", &|d| short(d.symmetric_dirichlet)),
            ("largest", &|d| short(d.symmetric_dirichlet_max)),
            ("stretch L2", &|d| short(d.stretch_l2)),
            ("stretch L∞", &|d| short(d.stretch_linf)),
        ],
    );
    section(
        "benchmark of Shay, Solomon and Stein",
        &[
            ("max area distortion", &|d| short(d.benchmark.max_area_distortion)),
            ("average area discrepancy", &|d| short(d.benchmark.average_area_discrepancy)),
            ("max angle distortion", &|d| short(d.benchmark.max_angle_distortion)),
            ("average angle discrepancy", &|d| short(d.benchmark.average_angle_discrepancy)),
            ("min singular value", &|d| short(d.benchmark.min_singular_value)),
            ("max singular value", &|d| short(d.benchmark.max_singular_value)),
            ("proportion flipped triangles", &|d| short(d.benchmark.proportion_flipped_triangles)),
            ("resolution", &|d| short(d.benchmark.resolution)),
            ("symmetric Dirichlet energy (2 for an isometry)", &|d| {
                short(d.benchmark.symmetric_dirichlet_energy)
            }),
        ],
    );
    table
}

/// The largest memory that this process has held so far, where the system tells.
pub(crate) fn peak_memory_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes << 10)
}
