//! Overlap removal: worst first against first come, from maps that were spoilt.

use std::f64::consts::TAU;

use qparam_cli::qembed::embed;
use qparam_cli::qmesh::{QuadMesh, Vec2, VertexData, VertexId};
use qparam_cli::qoptimize::{MoveOrder, OverlapOptions, OverlapReport, measure, remove_overlaps};
use qparam_cli::qsimplify::{RemovalRule, SimplifyOptions, Threshold, simplify};

use super::inputs::{models, moves};
use super::random::Random;
use super::table::{Table, digits};

/// λ1 and λ2.
const LAMBDAS: [[f64; 2]; 3] = [[0.9, 0.0], [0.6, 0.3], [0.3, 0.6]];
const MOVES_PER_VERTEX: f64 = 30.0;
/// How far the middle is twisted.
const TURNS: f64 = 1.0;

pub(super) fn section() -> Result<String, String> {
    let mut table = Table::new(
        "mesh, start | flips | λ1, λ2 | moves, worst first | moves, first come | ratio | left | E13, worst first | E13, first come | E14, worst first | E14, first come",
    );
    for (name, mesh) in models() {
        for (start, uv) in starts(&mesh)? {
            for [lambda1, lambda2] in LAMBDAS {
                let mut results = Vec::new();
                for order in [MoveOrder::WorstFirst, MoveOrder::FirstCome] {
                    results.push(remove(&mesh, uv.clone(), [lambda1, lambda2], order)?);
                }
                let [worst, first] = &results[..] else { return Err("two orders".to_owned()) };
                let finished = !(worst.report.hit_limit || first.report.hit_limit);
                let ratio = first.report.moves as f64 / worst.report.moves as f64;
                table.row(&[
                    format!("{name}, {start}"),
                    worst.report.before.to_string(),
                    format!("{lambda1}, {lambda2}"),
                    moves(&worst.report),
                    moves(&first.report),
                    if finished { digits(ratio) } else { "–".to_owned() },
                    format!("{}, {}", worst.report.after, first.report.after),
                    digits(worst.angle),
                    digits(first.angle),
                    digits(worst.area),
                    digits(first.area),
                ]);
            }
        }
    }
    Ok(format!(
        "A valid map (rule `all`, circle) spoilt: every interior vertex moved at random by up to half or three times the \
         mean edge in each direction (*noise*), 20 vertices thrown anywhere into the disk (*spikes*), every point at distance ρ from the \
         centre turned by 1 − ρ turns (*twist*); and the maps that rules `ring` (70 % removed) and `naive` (10 %) give. *Ratio* is the moves of first come over those of worst first, *left* \
         are flips at the end, for both orders. Overlaps are tested after every move; at most 30 moves a \
         vertex.\n\n{}",
        table.text()
    ))
}

struct Outcome {
    report: OverlapReport,
    angle: f64,
    area: f64,
}

fn remove(
    mesh: &QuadMesh,
    mut uv: VertexData<Vec2>,
    [lambda1, lambda2]: [f64; 2],
    order: MoveOrder,
) -> Result<Outcome, String> {
    let options = OverlapOptions { lambda1, lambda2, order, max_moves_per_vertex: MOVES_PER_VERTEX };
    let report = remove_overlaps(mesh, &mut uv, &options, &()).map_err(|error| error.to_string())?;
    let distortion = measure(mesh.view(), &mesh.to_corners(&uv)).map_err(|error| error.to_string())?;
    Ok(Outcome { report, angle: distortion.angle_error, area: distortion.area_error })
}

fn starts(mesh: &QuadMesh) -> Result<Vec<(&'static str, VertexData<Vec2>)>, String> {
    let valid = map(mesh, RemovalRule::All, 1.0)?;
    Ok(vec![
        ("noise 0.5", noise(mesh, &valid, 0.5)),
        ("noise 3", noise(mesh, &valid, 3.0)),
        ("20 spikes", spikes(mesh, &valid)),
        ("twist", twist(mesh, &valid)),
        ("ring 0.7", map(mesh, RemovalRule::Ring, 0.7)?),
        ("naive 0.1", map(mesh, RemovalRule::Naive, 0.1)?),
    ])
}

/// Sections 2.1 to 2.3.
fn map(mesh: &QuadMesh, rule: RemovalRule, fraction: f64) -> Result<VertexData<Vec2>, String> {
    let options = SimplifyOptions { rule, threshold: Threshold::Fraction(fraction), ..Default::default() };
    let simplified = simplify(mesh, &options, &()).map_err(|error| error.to_string())?;
    let embedding = embed(mesh, &simplified, &Default::default(), &()).map_err(|error| error.to_string())?;
    Ok(mesh.vertex_data(|vertex| rounded(embedding.uv[vertex])))
}

/// To 1e-9, so that the last digits of a solver or of a sine decide no order of moves.
fn rounded(uv: Vec2) -> Vec2 {
    uv.map(|x| (x * 1e9).round() / 1e9)
}

fn noise(mesh: &QuadMesh, uv: &VertexData<Vec2>, amount: f64) -> VertexData<Vec2> {
    let length = |[a, b]: [VertexId; 2]| (uv[b] - uv[a]).norm();
    let mean =
        mesh.edges().map(|edge| length(mesh.edge_vertices(edge))).sum::<f64>() / mesh.edge_count() as f64;
    let mut random = Random::new(3);
    mesh.vertex_data(|vertex| {
        let shift = Vec2::new(random.signed(), random.signed()) * (amount * mean);
        if mesh.is_boundary(vertex) { uv[vertex] } else { uv[vertex] + shift }
    })
}

fn spikes(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> VertexData<Vec2> {
    let inside: Vec<VertexId> = mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).collect();
    let mut random = Random::new(5);
    let mut spoilt = uv.clone();
    for _ in 0..20 {
        // In the square inside the unit circle.
        let anywhere = Vec2::new(random.signed(), random.signed()) * 0.7;
        spoilt[inside[random.below(inside.len())]] = anywhere;
    }
    spoilt
}

fn twist(mesh: &QuadMesh, uv: &VertexData<Vec2>) -> VertexData<Vec2> {
    mesh.vertex_data(|vertex| {
        let p = uv[vertex];
        let (sine, cosine) = (TAU * TURNS * (1.0 - p.norm())).sin_cos();
        rounded(Vec2::new(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y))
    })
}
