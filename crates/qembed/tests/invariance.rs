//! What may not change a map: the unit of length, where the mesh lies, how it is numbered, how many threads there are.

mod common;

use common::{largest_difference, map, moved, renumbered, rotated, simplified, wrinkled};
use qembed::qmesh::{QuadMesh, Vec2, VertexData};
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{BoundaryShape, Classic, EmbedOptions, Mixing, Weights, embed, embed_classic};

const CLASSICS: [Classic; 4] = [Classic::Uniform, Classic::MeanValue, Classic::Harmonic, Classic::Lscm];

/// All maps of a mesh, normalised to a bounding box of extent one, with their names.
fn maps(mesh: &QuadMesh) -> Vec<(String, VertexData<Vec2>)> {
    let mut maps = Vec::new();
    for boundary in [BoundaryShape::Circle, BoundaryShape::Square, BoundaryShape::Projection] {
        for rule in [RemovalRule::None, RemovalRule::All, RemovalRule::Guarded] {
            for weights in [Weights::Star4, Weights::Star1, Weights::Printed] {
                let options = EmbedOptions { weights, boundary: boundary.clone(), ..Default::default() };
                maps.push((format!("{boundary:?} {rule:?} {weights:?}"), map(mesh, rule, &options)));
            }
        }
    }
    for method in CLASSICS {
        let embedding = embed_classic(mesh, method, &BoundaryShape::Circle, &SolveOptions::default(), &())
            .expect("a disk");
        maps.push((method.name().to_owned(), embedding.uv));
    }
    maps.into_iter().map(|(name, uv)| (name, normalized(&uv))).collect()
}

fn normalized(uv: &VertexData<Vec2>) -> VertexData<Vec2> {
    let low = uv.iter().fold(Vec2::repeat(f64::INFINITY), |low, p| low.inf(p));
    let high = uv.iter().fold(Vec2::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
    VertexData::from_vec(uv.iter().map(|p| (p - low) / (high - low).amax()).collect())
}

fn assert_same(before: &[(String, VertexData<Vec2>)], after: &[(String, VertexData<Vec2>)]) {
    for ((name, a), (_, b)) in before.iter().zip(after) {
        let off = largest_difference(a, b);
        assert!(off < 1e-9, "{name}: {off:e}");
    }
}

#[test]
fn the_unit_of_length_changes_nothing() {
    let mesh = wrinkled(9, 7, 1);
    for scale in [1000.0, 1e-7] {
        assert_same(&maps(&mesh), &maps(&moved(&mesh, |p| scale * p)));
    }
}

/// But for raw mixing: conformal weights have no unit, authalic ones are one over an area.
#[test]
fn raw_mixing_depends_on_the_unit() {
    let mesh = wrinkled(9, 7, 1);
    let raw = |scale: f64, q| {
        let options = EmbedOptions { mixing: Mixing::Raw, q, ..Default::default() };
        map(&moved(&mesh, |p| scale * p), RemovalRule::All, &options)
    };
    assert!(largest_difference(&raw(1.0, 0.5), &raw(1000.0, 0.5)) > 1e-3);
    // In the limit the conformal energy is all that is left.
    assert!(largest_difference(&raw(1e6, 0.5), &raw(1.0, 1.0)) < 1e-9);
    assert!(largest_difference(&raw(1e-6, 0.5), &raw(1.0, 0.0)) < 1e-9);
}

#[test]
fn rotation_changes_nothing() {
    let mesh = wrinkled(9, 7, 2);
    assert_same(&maps(&mesh), &maps(&rotated(&mesh)));
}

#[test]
fn numbering_changes_nothing() {
    let mesh = wrinkled(9, 7, 3);
    let (other, new) = renumbered(&mesh);
    let back = |uv: &VertexData<Vec2>| mesh.vertex_data(|vertex| uv[new[vertex]]);
    let after: Vec<_> = maps(&other).into_iter().map(|(name, uv)| (name, back(&uv))).collect();
    assert_same(&maps(&mesh), &after);
}

/// The same bits for one thread and for two.
#[test]
fn threads_change_no_bit() {
    let mesh = wrinkled(60, 50, 4);
    let ring = simplified(&mesh, RemovalRule::Ring);
    let bits = |uv: &VertexData<Vec2>| uv.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect::<Vec<_>>();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let paper = embed(&mesh, &ring, &EmbedOptions::default(), &()).unwrap();
            let classics = CLASSICS.map(|method| {
                embed_classic(&mesh, method, &BoundaryShape::Circle, &SolveOptions::default(), &()).unwrap()
            });
            (bits(&paper.uv), classics.map(|classic| bits(&classic.uv)))
        })
    };
    assert!(run(1) == run(2));
}
