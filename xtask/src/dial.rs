//! `cargo xtask dial`: what the dial q does to the method `direct`, on every disk there is.
//!
//! Each map has to be certified, and from q = 1 to q = 0 the angle term has to rise and the area term to fall, within half a per
//! cent: the terms that are minimised, and with the angles of Eq. 13 the errors of Eqs. 13 and 14 themselves.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::Instant;

use qparam_cli::qmesh::QuadMesh;
use qparam_cli::qoptimize::{AngleTerm, Continuation, Options, Parameterization, parameterize_from};

use crate::sweep::{Mesh, disks};

/// Where the table goes, in the workspace.
const FILE: &str = "docs/tables/dial.md";
const DIALS: [f64; 5] = [1.0, 0.8, 0.5, 0.2, 0.0];
/// By how much a term may go the wrong way.
const TOLERANCE: f64 = 0.005;

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    let mut meshes = disks(&root.join("fixtures"))?;
    match std::env::var_os("QPARAM_MESHES") {
        Some(folder) => meshes.extend(disks(Path::new(&folder))?),
        None => println!("skipped the real meshes: QPARAM_MESHES is not set"),
    }
    if !arguments.is_empty() {
        meshes.retain(|mesh| arguments.contains(&mesh.name));
    }
    let mut rows = Vec::new();
    for mesh in &meshes {
        for angle_term in [AngleTerm::Log, AngleTerm::Paper] {
            rows.push(Series::new(mesh, angle_term));
            println!("{}", rows.last().map(Series::text).unwrap_or_default());
        }
    }
    let complaints: Vec<String> = rows.iter().flat_map(Series::complaints).collect();
    if arguments.is_empty() {
        fs::write(root.join(FILE), table(&rows)).map_err(|error| format!("{FILE}: {error}"))?;
    }
    if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n")) }
}

/// The maps of one disk over q.
struct Series {
    name: String,
    quads: usize,
    angle_term: AngleTerm,
    maps: Vec<Result<Entry, String>>,
}

/// One map.
struct Entry {
    holds: bool,
    /// The terms that are minimised: angle, area, shape.
    minimised: [f64; 3],
    /// Means of Eqs. 13 and 14 over the corners.
    printed: [f64; 2],
    dirichlet: f64,
    steps: usize,
    seconds: f64,
}

impl Series {
    fn new(mesh: &Mesh, angle_term: AngleTerm) -> Self {
        let mut continuation = Continuation::default();
        let maps = DIALS.iter().map(|&q| entry(&mut continuation, &mesh.mesh, q, angle_term)).collect();
        Self { name: mesh.name.clone(), quads: mesh.mesh.face_count(), angle_term, maps }
    }

    /// What is not as it has to be: maps without a certificate, and what goes against the dial.
    fn complaints(&self) -> Vec<String> {
        let complaint = |(q, map): (&f64, &Result<Entry, String>)| match map {
            Ok(entry) if entry.holds => None,
            Ok(_) => Some(format!("{}, q = {q}: not certified", self.name)),
            Err(error) => Some(format!("{}, q = {q}: {error}", self.name)),
        };
        let against = |wrong| format!("{}, {:?}: {wrong} against the dial", self.name, self.angle_term);
        let uncertified = DIALS.iter().zip(&self.maps).filter_map(complaint);
        uncertified.chain(self.exceptions().into_iter().map(against)).collect()
    }

    /// By how much the values that `pick` gives go down where they should go up, at worst; relative.
    fn against(&self, pick: impl Fn(&Entry) -> f64, rises: bool) -> f64 {
        let values: Vec<f64> = self.maps.iter().flatten().map(pick).collect();
        let wrong = |pair: &[f64]| {
            let [before, after] = if rises { [pair[1], pair[0]] } else { [pair[0], pair[1]] };
            (after - before) / before.max(1e-12)
        };
        values.windows(2).map(wrong).fold(0.0, f64::max)
    }

    /// The terms that go the wrong way, and by how much.
    fn exceptions(&self) -> Vec<String> {
        let minimised = [self.against(|e| e.minimised[0], true), self.against(|e| e.minimised[1], false)];
        let printed = [self.against(|e| e.printed[0], true), self.against(|e| e.printed[1], false)];
        let names = ["angle term", "area term", "Eq. 13", "Eq. 14"];
        let judged = if self.angle_term == AngleTerm::Paper { 4 } else { 2 };
        (minimised.iter().chain(&printed).zip(names).take(judged))
            .filter(|(wrong, _)| **wrong > TOLERANCE)
            .map(|(wrong, name)| format!("{name} {:.1} %", 100.0 * wrong))
            .collect()
    }

    /// The same in a cell of a table.
    fn exceptions_cell(&self) -> String {
        let found = self.exceptions();
        if found.is_empty() { "–".to_owned() } else { found.join(", ") }
    }

    /// Five numbers of one kind.
    fn cells(&self, pick: impl Fn(&Entry) -> String) -> String {
        let cell = |map: &Result<Entry, String>| map.as_ref().map_or("no map".to_owned(), &pick);
        self.maps.iter().map(cell).collect::<Vec<_>>().join(" · ")
    }

    fn text(&self) -> String {
        let steps = self.cells(|e| e.steps.to_string());
        let seconds = self.cells(|e| format!("{:.1}", e.seconds));
        let certified = self.maps.iter().flatten().filter(|entry| entry.holds).count();
        format!(
            "{} {:?}: {certified} of {} certified; steps {steps}; seconds {seconds}; exceptions {}",
            self.name,
            self.angle_term,
            DIALS.len(),
            self.exceptions_cell()
        )
    }
}

fn entry(
    continuation: &mut Continuation,
    mesh: &QuadMesh,
    q: f64,
    angle_term: AngleTerm,
) -> Result<Entry, String> {
    let mut options = Options { q, ..Options::default() };
    options.direct.angle_term = angle_term;
    let begun = Instant::now();
    let Parameterization { distortion, certificate, record, .. } =
        parameterize_from(continuation, mesh, &options, &()).map_err(|error| error.to_string())?;
    let direct = record.direct.ok_or("no record of the descent")?;
    Ok(Entry {
        holds: certificate.holds,
        minimised: [direct.terms.angle, direct.terms.area, direct.terms.shape],
        printed: [distortion.angle_error_mean, distortion.area_error_mean],
        dirichlet: distortion.symmetric_dirichlet.unwrap_or(f64::NAN),
        steps: direct.descent.steps,
        seconds: begun.elapsed().as_secs_f64(),
    })
}

fn table(rows: &[Series]) -> String {
    let dials = DIALS.map(|q| q.to_string()).join(" · ");
    let mut text = format!(
        "# The dial q\n\nWritten by `cargo xtask dial`: every disk of `fixtures` and of the folder `QPARAM_MESHES`, mapped by the \
         method `direct` at its defaults\nand with `--angle-term paper`, for q = {dials}; each map starts from the one before. \
         *Certified* counts maps whose certificate holds.\nThe terms are those that are minimised: of the angles, of the areas. \
         *Against the dial* names what goes the wrong way by more than half a\nper cent from one q to the next: the angle term \
         and Eq. 13 have to rise, the area term and Eq. 14 to fall. Errors are means over the corners.\n\n\
         | mesh | quads | angles | certified | angle term | area term | Eq. 13 | Eq. 14 | symmetric Dirichlet | steps | against \
         the dial |\n|---|---: |---|---: |---|---|---|---|---|---|---|\n"
    );
    for row in rows {
        let certified = row.maps.iter().flatten().filter(|entry| entry.holds).count();
        let number = |value: f64| format!("{value:.3e}");
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {certified} of {} | {} | {} | {} | {} | {} | {} | {} |",
            row.name,
            row.quads,
            if row.angle_term == AngleTerm::Log { "log" } else { "paper" },
            DIALS.len(),
            row.cells(|e| number(e.minimised[0])),
            row.cells(|e| number(e.minimised[1])),
            row.cells(|e| number(e.printed[0])),
            row.cells(|e| number(e.printed[1])),
            row.cells(|e| format!("{:.3}", e.dirichlet)),
            row.cells(|e| e.steps.to_string()),
            row.exceptions_cell()
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use qparam_cli::qmesh::shapes;

    use super::*;

    /// Disks by formula: every map is certified, and every term heeds the dial.
    #[test]
    fn disks_heed_the_dial() {
        for (name, mesh) in
            [("bump", shapes::bump(12, 0.8)), ("face", shapes::face(1)), ("finger", shapes::finger(6, 10))]
        {
            let mesh = Mesh { name: name.to_owned(), mesh };
            for angle_term in [AngleTerm::Log, AngleTerm::Paper] {
                let series = Series::new(&mesh, angle_term);
                assert_eq!(series.complaints(), Vec::<String>::new());
                assert_eq!(series.exceptions_cell(), "–", "{}", series.text());
            }
        }
    }

    /// A term that goes the wrong way is named, and the task complains of it as of a map without a certificate.
    #[test]
    fn what_goes_against_the_dial_is_a_complaint() {
        let entry_that = |holds, angle, area| {
            Ok(Entry {
                holds,
                minimised: [angle, area, 0.0],
                printed: [angle, area],
                dirichlet: 1.0,
                steps: 1,
                seconds: 0.0,
            })
        };
        let entry = |angle, area| entry_that(true, angle, area);
        let series = |maps| Series { name: "m".to_owned(), quads: 1, angle_term: AngleTerm::Log, maps };
        let heeds = series(vec![entry(1.0, 2.0), entry(1.1, 1.5)]);
        assert_eq!((heeds.exceptions_cell(), heeds.complaints()), ("–".to_owned(), Vec::new()));
        let against = series(vec![entry(1.0, 2.0), entry(0.9, 2.002)]);
        assert_eq!(against.exceptions_cell(), "angle term 11.1 %");
        assert_eq!(against.complaints(), ["m, Log: angle term 11.1 % against the dial"]);
        let uncertified = series(vec![entry_that(false, 1.0, 2.0), Err("no start".to_owned())]);
        assert_eq!(uncertified.complaints(), ["m, q = 1: not certified", "m, q = 0.8: no start"]);
    }
}
