//! `cargo xtask disks`: many hostile disks, each mapped by the method `direct`, certified, and checked by brute force.
//!
//! Every disk of quads has a map in which all quads are convex, those aside that share their opposite vertices, so every disk has to
//! end certified. The certificate is compared with an independent check, which shares no code with it: it cuts every face into
//! triangles and compares every two of them with integers of any length.

#[path = "../../crates/qoptimize/tests/common/exact.rs"]
mod exact;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use qparam_cli::qmesh::shapes::{Hostility, hostile_disk};
use qparam_cli::qmesh::{PolygonView, QuadMesh, Vec2};
use qparam_cli::qoptimize::{
    Certificate, Method, Options, StartMethod, certify, parameterize, round_to_single,
};
use rayon::prelude::*;

/// Where the table goes, in the workspace.
const FILE: &str = "docs/tables/disks.md";

/// Runs the task.
pub(crate) fn run(arguments: &[String]) -> Result<(), String> {
    let (mut count, mut seed) = (2000, 0);
    for pair in arguments.chunks(2) {
        let value = pair.get(1).and_then(|text| text.parse().ok());
        match (pair[0].as_str(), value) {
            ("--count", Some(value)) => count = value,
            ("--seed", Some(value)) => seed = value,
            _ => return Err("the arguments are: --count N, --seed S".to_owned()),
        }
    }
    let runs = runs(count, seed, &Options { method: Method::Direct, ..Options::default() });
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    let text = table(&runs, count, seed);
    fs::write(root.join(FILE), &text).map_err(|error| format!("{FILE}: {error}"))?;
    println!("{text}");
    let bad: Vec<String> = runs.iter().filter_map(Run::complaint).collect();
    if bad.is_empty() { Ok(()) } else { Err(format!("{} of {count} disks:\n{}", bad.len(), bad.join("\n"))) }
}

/// One disk and what became of it.
struct Run {
    hostility: Hostility,
    seed: u64,
    faces: usize,
    end: End,
}

enum End {
    /// The certificate holds.
    Certified { start: Option<StartMethod>, exempt: usize, single: Single },
    /// There is a map, and the certificate says what is wrong with it.
    Uncertified(String),
    /// There is no map, for this reason.
    Refused(String),
    /// The independent check says otherwise than the certificate.
    Wrong(String),
}

/// What is left of a certified map in single precision.
#[derive(Clone, Copy, PartialEq)]
enum Single {
    Holds,
    Mended,
    Lost,
}

/// The kinds take turns, each with seeds of its own.
fn runs(count: u64, seed: u64, options: &Options) -> Vec<Run> {
    let kinds = Hostility::ALL.len() as u64;
    (0..count)
        .into_par_iter()
        .map(|index| {
            let hostility = Hostility::ALL[(index % kinds) as usize];
            let seed = seed + index / kinds;
            let mesh = hostile_disk(hostility, seed);
            Run { hostility, seed, faces: mesh.face_count(), end: end(&mesh, options) }
        })
        .collect()
}

fn end(mesh: &QuadMesh, options: &Options) -> End {
    let map = match parameterize(mesh, options, &()) {
        Ok(map) => map,
        Err(error) => return End::Refused(error.to_string()),
    };
    if let Err(difference) = compared(mesh.view(), &map.uv, &map.certificate) {
        return End::Wrong(difference);
    }
    if !map.certificate.holds {
        return End::Uncertified(map.certificate.to_string());
    }
    let mut rounded = map.uv.to_vec();
    let rounding = round_to_single(mesh.view(), &mut rounded);
    let single = match certify(mesh.view(), &rounded, 0) {
        Ok(found) if compared(mesh.view(), &rounded, &found).is_err() => {
            return End::Wrong(format!("in single precision: {found}"));
        }
        Ok(found) if found.holds && rounding.moved_points > 0 => Single::Mended,
        Ok(found) if found.holds => Single::Holds,
        _ => Single::Lost,
    };
    let start = map.record.direct.as_ref().map(|direct| direct.start);
    End::Certified { start, exempt: map.certificate.exempt_faces.len(), single }
}

/// Whether brute force says the same as the certificate.
fn compared(polygons: PolygonView<'_>, uv: &[Vec2], certificate: &Certificate) -> Result<(), String> {
    let faces: Vec<Vec<u32>> = (0..polygons.face_count()).map(|face| polygons.face(face).to_vec()).collect();
    let places: Vec<[f64; 2]> = uv.iter().map(|&p| p.into()).collect();
    let fault = exact::fault(&faces, &places);
    if certificate.holds == fault.is_none() {
        return Ok(());
    }
    Err(format!("certificate {certificate}, brute force: {}", fault.as_deref().unwrap_or("no fault")))
}

impl Run {
    /// What must not be.
    fn complaint(&self) -> Option<String> {
        let what = match &self.end {
            End::Certified { .. } => return None,
            End::Uncertified(text) => format!("not certified: {text}"),
            End::Refused(text) => format!("refused: {text}"),
            End::Wrong(text) => format!("WRONG: {text}"),
        };
        Some(format!("{:?}, seed {}: {what}", self.hostility, self.seed))
    }
}

fn table(runs: &[Run], count: u64, seed: u64) -> String {
    let mut text = format!(
        "# Hostile disks\n\nWritten by `cargo xtask disks --count {count} --seed {seed}`: disks of quads that defeat parameterizations, \
         mapped by the method `direct`.\nA map counts as certified when its certificate holds; *wrong* are those of which a slow \
         independent check says otherwise than the\ncertificate. Exempt quads share their opposite vertices with another face, \
         so that no map can make them convex.\n\n\
         | disks | number | quads | certified | from Tutte | torsion | untangled | exempt quads | f32: as rounded | mended | lost | \
         not certified | refused | wrong |\n|---|{}\n",
        " ---: |".repeat(13)
    );
    for hostility in Hostility::ALL {
        let of_kind: Vec<&Run> = runs.iter().filter(|run| run.hostility == hostility).collect();
        row(&mut text, &name(hostility), &of_kind);
    }
    row(&mut text, "all", &runs.iter().collect::<Vec<_>>());
    text
}

/// `SpikesOnSpikes` in words.
fn name(hostility: Hostility) -> String {
    let mut words = String::new();
    for letter in format!("{hostility:?}").chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.push(letter.to_ascii_lowercase());
    }
    words
}

fn row(text: &mut String, label: &str, runs: &[&Run]) {
    let ends = |is: &dyn Fn(&End) -> bool| runs.iter().filter(|run| is(&run.end)).count();
    let started = |method: StartMethod| {
        ends(&|end| matches!(end, End::Certified { start: Some(start), .. } if *start == method))
    };
    let in_single =
        |wanted: Single| ends(&|end| matches!(end, End::Certified { single, .. } if *single == wanted));
    let exempt: usize =
        runs.iter().map(|run| if let End::Certified { exempt, .. } = run.end { exempt } else { 0 }).sum();
    let cells = [
        runs.len(),
        runs.iter().map(|run| run.faces).sum(),
        ends(&|end| matches!(end, End::Certified { .. })),
        started(StartMethod::Tutte),
        started(StartMethod::Torsion),
        started(StartMethod::Untangled),
        exempt,
        in_single(Single::Holds),
        in_single(Single::Mended),
        in_single(Single::Lost),
        ends(&|end| matches!(end, End::Uncertified(_))),
        ends(&|end| matches!(end, End::Refused(_))),
        ends(&|end| matches!(end, End::Wrong(_))),
    ];
    // Writing to a string does not fail.
    let _ = write!(text, "| {label} |");
    for cell in cells {
        let _ = write!(text, " {cell} |");
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use qparam_cli::qoptimize::DirectOptions;
    use qparam_cli::qoptimize::direct::DescentOptions;

    use super::*;

    /// Two hundred disks of all kinds, each with a descent of a few steps: every one is certified, and brute force agrees each time.
    #[test]
    fn hostile_disks_end_certified() {
        let descent = DescentOptions { max_steps: 12, ..DescentOptions::default() };
        let direct = DirectOptions { descent, ..DirectOptions::default() };
        let options = Options { method: Method::Direct, direct, ..Options::default() };
        let runs = runs(200, 100, &options);
        let bad: Vec<String> = runs.iter().filter_map(Run::complaint).collect();
        assert_eq!(bad, Vec::<String>::new());
        let text = table(&runs, 200, 100);
        assert_eq!(text.lines().filter(|line| line.starts_with("| ")).count(), 1 + Hostility::ALL.len() + 1);
    }
}
