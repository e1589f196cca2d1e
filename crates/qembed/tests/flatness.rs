//! The oracle of flatness: a flat mesh with its own boundary is its own map, where the weights are linearly precise.

mod common;

use common::{largest_difference, map, own_boundary};
use proptest::prelude::*;
use qembed::qmesh::{QuadMesh, Vec2, Vec3, VertexData, shapes};
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{Classic, EmbedOptions, Mixing, Weights, embed, embed_classic};

fn itself(mesh: &QuadMesh) -> VertexData<Vec2> {
    VertexData::from_vec(mesh.positions().iter().map(Vec3::xy).collect())
}

fn star1(mesh: &QuadMesh, q: f64, mixing: Mixing) -> EmbedOptions {
    EmbedOptions { q, mixing, weights: Weights::Star1, boundary: own_boundary(mesh), ..Default::default() }
}

fn flat_meshes() -> Vec<QuadMesh> {
    vec![
        shapes::grid(8, 5),
        shapes::graded_grid(12, 9, 1.3),
        shapes::jittered_grid(12, 10, 0.1, 4),
        shapes::jittered_grid(30, 20, 0.12, 11),
        common::moved(&shapes::jittered_grid(10, 10, 0.1, 2), |p| 1000.0 * p),
    ]
}

/// Rule `all`, star angles with plain cotangents, rows normalised: the identity, for every q.
#[test]
fn a_flat_mesh_comes_back_as_itself() {
    for mesh in flat_meshes() {
        let size = mesh.positions().iter().map(Vec3::norm).fold(0.0, f64::max);
        let all = common::simplified(&mesh, RemovalRule::All);
        for q in [1.0, 0.5, 0.0] {
            for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                let embedding = embed(&mesh, &all, &star1(&mesh, q, mixing), &()).unwrap();
                assert_eq!(embedding.negative_weights, 0, "the oracle is about positive weights");
                let off = largest_difference(&embedding.uv, &itself(&mesh));
                assert!(off < 1e-9 * size, "q = {q}, {mixing:?}: off by {off:e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Linear precision does not need positive weights: also where a few are negative the mesh comes back.
    #[test]
    fn even_with_negative_weights(seed in 0_u64..500, q in 0.0..1.0) {
        let mesh = shapes::jittered_grid(8, 8, 0.24, seed);
        let uv = map(&mesh, RemovalRule::All, &star1(&mesh, q, Mixing::RowNormalized));
        prop_assert!(largest_difference(&uv, &itself(&mesh)) < 1e-7);
    }
}

/// The printed cotangents of parts of angles do not have this property; that is the price of positive weights.
#[test]
fn positive_weights_are_not_linearly_precise() {
    let mesh = shapes::jittered_grid(12, 10, 0.1, 4);
    for weights in [Weights::Star4, Weights::Printed] {
        let options = EmbedOptions { weights, ..star1(&mesh, 0.5, Mixing::RowNormalized) };
        let off = largest_difference(&map(&mesh, RemovalRule::All, &options), &itself(&mesh));
        assert!(off > 1e-3, "{weights:?}: {off:e}");
    }
}

/// Harmonic and mean value maps are linearly precise too.
#[test]
fn classic_maps_of_flat_meshes_are_the_identity() {
    for mesh in flat_meshes() {
        let size = mesh.positions().iter().map(Vec3::norm).fold(0.0, f64::max);
        let classic = |method| {
            embed_classic(&mesh, method, &own_boundary(&mesh), &SolveOptions::default(), &()).unwrap().uv
        };
        let off = largest_difference(&classic(Classic::Harmonic), &itself(&mesh));
        assert!(off < 1e-9 * size, "harmonic: {off:e}");
    }
    // Mean value weights use the star of immediate neighbours, whose triangles leave gaps nowhere.
    let mesh = shapes::jittered_grid(12, 10, 0.1, 4);
    let uv = embed_classic(&mesh, Classic::MeanValue, &own_boundary(&mesh), &SolveOptions::default(), &())
        .unwrap()
        .uv;
    let off = largest_difference(&uv, &itself(&mesh));
    assert!(off < 1e-9, "mean value: {off:e}");
}

/// Triangles among the quads change nothing about that.
#[test]
fn mixed_faces_come_back_as_themselves() {
    let quads = shapes::jittered_grid(9, 8, 0.1, 6);
    let positions: Vec<[f64; 3]> = quads.positions().iter().map(|&p| p.into()).collect();
    let faces = quads.faces().flat_map(|face| {
        let v: Vec<u32> = quads.face_vertices(face).map(|v| v.0).collect();
        match face.0 % 3 {
            0 => vec![vec![v[0], v[1], v[2]], vec![v[0], v[2], v[3]]],
            _ => vec![v],
        }
    });
    let mesh = QuadMesh::from_slices(&positions, faces).unwrap();
    for q in [0.0, 0.5, 1.0] {
        let uv = map(&mesh, RemovalRule::All, &star1(&mesh, q, Mixing::RowNormalized));
        assert!(largest_difference(&uv, &itself(&mesh)) < 1e-9, "q = {q}");
    }
    for method in [Classic::Harmonic, Classic::MeanValue] {
        let solve = SolveOptions::default();
        let uv = embed_classic(&mesh, method, &own_boundary(&mesh), &solve, &()).unwrap().uv;
        assert!(largest_difference(&uv, &itself(&mesh)) < 1e-9, "{method:?}");
    }
}

/// The least squares conformal map of a flat mesh is a similarity that keeps orientation: here even an isometry, since
/// the pins keep their distance.
#[test]
fn lscm_of_a_flat_mesh_is_an_isometry() {
    for mesh in flat_meshes() {
        let size = mesh.positions().iter().map(Vec3::norm).fold(0.0, f64::max);
        let options = SolveOptions::default();
        let uv = embed_classic(&mesh, Classic::Lscm, &Default::default(), &options, &()).unwrap().uv;
        for edge in mesh.edges() {
            let [a, b] = mesh.edge_vertices(edge);
            let error = (uv[b] - uv[a]).norm() - mesh.edge_length(edge);
            assert!(error.abs() < 1e-8 * size, "{error:e}");
        }
        assert!(common::smallest_corner(&mesh, &uv) > 0.0);
    }
}
