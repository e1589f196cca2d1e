//! The meshes that are measured on, and one run of the paper's method.

use qparam_cli::qembed::{BoundaryShape, Weights};
use qparam_cli::qmesh::{QuadMesh, VertexData, VertexId, shapes};
use qparam_cli::qoptimize::{Distortion, Method, Options, OverlapReport, Parameterization, parameterize};
use qparam_cli::qsimplify::{RemovalRule, SimplifyOptions, Threshold};

use super::random::Random;
use super::table::{MEANINGLESS, digits};

/// The face and the head of `fixtures/`.
pub(super) fn models() -> [(&'static str, QuadMesh); 2] {
    [("face", shapes::face(3)), ("head", shapes::head(2))]
}

/// What the columns mean.
pub(super) fn legend() -> String {
    let about =
        |mesh: &QuadMesh| format!("{} quads, {} interior vertices", mesh.face_count(), interior(mesh));
    let [(_, face), (_, head)] = models();
    format!(
        "*face* is `qmesh::shapes::face(3)` ({}), *head* is `head(2)` ({}): the meshes of `fixtures/`. E13 and E14 are the \
         sums of Eqs. 13 and 14 over all corners, signed areas, total areas made equal. *Flips* are corner triangles of no \
         positive area. Unless said: circle, r = 1, q = 0.5, `star4`, rows normalised, no overlap removal. As \
         divisors angles count at least 1e-9 and areas 1e-12 of the mean; sums beyond 1e15 only say that this happened. Where \
         rounding decides which corners flip they are not counted, and the cell says *rounding*.\n",
        about(&face),
        about(&head)
    )
}

pub(super) fn interior(mesh: &QuadMesh) -> usize {
    mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).count()
}

/// The paper's options with this rule and this fraction at q = 0.5, without section 2.4.
pub(super) fn paper(rule: RemovalRule, fraction: f64) -> Options {
    let simplify = SimplifyOptions { rule, threshold: Threshold::Fraction(fraction), ..Default::default() };
    Options { method: Method::Paper, q: 0.5, simplify, overlaps: None, ..Default::default() }
}

pub(super) fn run(mesh: &QuadMesh, options: &Options) -> Result<Parameterization, String> {
    parameterize(mesh, options, &()).map_err(|error| error.to_string())
}

/// A map before section 2.4, and what 2.4 did: E13, E14, flips; moves; flips, E13 and E14 after it.
pub(super) fn mended(mesh: &QuadMesh, options: &Options) -> Result<Vec<String>, String> {
    let before = run(mesh, &Options { overlaps: None, ..options.clone() })?.distortion;
    let after = run(mesh, &Options { overlaps: Some(Default::default()), ..options.clone() })?;
    let report = after.record.overlaps.ok_or("section 2.4 did not run")?;
    let mut cells = sums(&before).to_vec();
    let naive = options.simplify.rule == RemovalRule::Naive;
    if before.area_error > MEANINGLESS && (naive || before.flipped_corners > 0) {
        let flips = if after.distortion.flipped_corners > 0 { "some" } else { "0" };
        cells.extend(["rounding", "rounding", flips, "–", "–"].map(str::to_owned));
    } else {
        let flips = [before.flipped_corners, after.distortion.flipped_corners].map(|count| count.to_string());
        let [flips_before, flips_after] = flips;
        cells.extend([flips_before, moves(&report), flips_after]);
        cells.extend(sums(&after.distortion));
    }
    Ok(cells)
}

/// The columns of [`mended`].
pub(super) const MENDED: &str = "E13 | E14 | flips | moves of 2.4 | flips after | E13 after | E14 after";

/// How many moves, and whether their bound ended them.
pub(super) fn moves(report: &OverlapReport) -> String {
    format!("{}{}", report.moves, if report.hit_limit { " (limit)" } else { "" })
}

/// E13 and E14 as cells.
pub(super) fn sums(distortion: &Distortion) -> [String; 2] {
    [distortion.angle_error, distortion.area_error].map(digits)
}

/// E13, E14 and flips as cells.
pub(super) fn errors(distortion: &Distortion) -> [String; 3] {
    let [angle, area] = sums(distortion);
    [angle, area, distortion.flipped_corners.to_string()]
}

pub(super) const WEIGHTS: [(&str, Weights); 3] =
    [("star4", Weights::Star4), ("star1", Weights::Star1), ("printed", Weights::Printed)];

/// The boundary of a mesh in the plane, as it is.
pub(super) fn own_boundary(mesh: &QuadMesh) -> BoundaryShape {
    let boundary = mesh.vertices().filter(|&vertex| mesh.is_boundary(vertex));
    BoundaryShape::Fixed(boundary.map(|vertex| (vertex, mesh.position(vertex).xy())).collect())
}

/// A flat mesh, each interior vertex moved at random by at most `amount` of its shortest edge in `x` and in `y`.
pub(super) fn jittered(mesh: &QuadMesh, amount: f64, seed: u64) -> QuadMesh {
    let mut random = Random::new(seed);
    let positions: VertexData<_> = mesh.vertex_data(|vertex| {
        let mut position = mesh.position(vertex);
        if !mesh.is_boundary(vertex) {
            let reach = amount * shortest_edge(mesh, vertex);
            position.x += reach * random.signed();
            position.y += reach * random.signed();
        }
        position
    });
    mesh.clone().with_positions(positions)
}

fn shortest_edge(mesh: &QuadMesh, vertex: VertexId) -> f64 {
    let length = |other: VertexId| (mesh.position(other) - mesh.position(vertex)).norm();
    mesh.outgoing(vertex).map(|edge| length(mesh.target(edge))).fold(f64::INFINITY, f64::min)
}
