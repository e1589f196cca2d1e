//! Tutte's theorem: a strictly convex boundary and positive weights on a 3-connected graph leave every corner positive.

mod common;

use common::{disks, map, simplified, smallest_corner, wrinkled};
use proptest::prelude::*;
use qembed::qsimplify::RemovalRule;
use qembed::qsolve::SolveOptions;
use qembed::{BoundaryShape, Classic, EmbedOptions, Mixing, Weights, embed, embed_classic};

/// Nothing removed (Eq. 5 alone) and everything removed (Eq. 10 alone), circle and square where it fits.
#[test]
fn positive_weights_flip_no_corner() {
    for (name, mesh) in disks() {
        for rule in [RemovalRule::None, RemovalRule::All] {
            for weights in [Weights::Star4, Weights::Printed] {
                for mixing in [Mixing::RowNormalized, Mixing::Raw] {
                    let options = EmbedOptions { weights, mixing, ..Default::default() };
                    let smallest = smallest_corner(&mesh, &map(&mesh, rule, &options));
                    assert!(smallest > 0.0, "{name} {rule:?} {weights:?} {mixing:?}: {smallest:e}");
                }
            }
        }
        for method in [Classic::Uniform, Classic::MeanValue] {
            let circle = BoundaryShape::Circle;
            let embedding = embed_classic(&mesh, method, &circle, &SolveOptions::default(), &()).unwrap();
            assert!(smallest_corner(&mesh, &embedding.uv) > 0.0, "{name} {method:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// With guarded removal the kept graph is a subdivision of a 3-connected one: no corner is negative. (Corners at kept
    /// vertices of degree two may be of no area.)
    #[test]
    fn guarded_removal_leaves_no_negative_corner(seed in 0_u64..500, q in 0.0..1.0, r in 0.0..2.0) {
        let mesh = wrinkled(9, 8, seed);
        let options = EmbedOptions { q, exponent: r, ..Default::default() };
        prop_assert!(smallest_corner(&mesh, &map(&mesh, RemovalRule::Guarded, &options)) > -1e-12);
    }

    /// The same for the square: its sides are straight, but its corners are the vertices with a single face.
    #[test]
    fn a_square_boundary_flips_no_corner(seed in 0_u64..500, q in 0.0..1.0) {
        let mesh = wrinkled(7, 9, seed);
        let options = EmbedOptions { q, boundary: BoundaryShape::Square, ..Default::default() };
        prop_assert!(smallest_corner(&mesh, &map(&mesh, RemovalRule::All, &options)) > 0.0);
    }
}

/// What the naive rule cuts off from the boundary has no place in Eq. 5; the local step places it, and counts it.
#[test]
fn what_is_cut_off_is_placed_by_the_local_step() {
    let mesh = wrinkled(20, 18, 1);
    let naive = simplified(&mesh, RemovalRule::Naive);
    let embedding = embed(&mesh, &naive, &EmbedOptions::default(), &()).unwrap();
    assert!(embedding.cut_off > 0, "half of the vertices removed at random leave islands");
    assert!(embedding.uv.iter().all(|p| p.norm() < 1.0 + 1e-9), "positive weights: inside the circle's hull");
    let unknowns: usize = embedding.solves.iter().map(|solve| solve.record.unknowns).sum();
    let interior = mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).count();
    assert_eq!(unknowns, interior, "every interior vertex is placed once");
    let local = embedding.solves.iter().find(|solve| solve.stage == "local").unwrap();
    assert_eq!(local.record.unknowns, naive.removed.len() + embedding.cut_off);
}

/// Rule `carrier`: the kept vertices lie where Eq. 5 on the full graph puts them.
#[test]
fn carried_vertices_lie_where_the_full_graph_puts_them() {
    let mesh = wrinkled(12, 10, 2);
    let carrier = simplified(&mesh, RemovalRule::Carrier);
    let carried = embed(&mesh, &carrier, &EmbedOptions::default(), &()).unwrap().uv;
    let full = map(&mesh, RemovalRule::None, &EmbedOptions::default());
    assert!(!carrier.removed.is_empty());
    for vertex in mesh.vertices() {
        let off = (carried[vertex] - full[vertex]).norm();
        assert_eq!(off < 1e-12, carrier.kept[vertex], "{vertex}: {off:e}");
    }
}

/// With nothing removed q has no effect; with everything removed r has none.
#[test]
fn each_dial_acts_on_its_step() {
    let mesh = wrinkled(8, 8, 3);
    let with = |rule, q, exponent| map(&mesh, rule, &EmbedOptions { q, exponent, ..Default::default() });
    assert!(with(RemovalRule::None, 0.1, 1.0) == with(RemovalRule::None, 0.9, 1.0));
    assert!(with(RemovalRule::All, 0.5, 0.0) == with(RemovalRule::All, 0.5, 2.0));
    assert!(
        common::largest_difference(&with(RemovalRule::None, 0.5, 0.0), &with(RemovalRule::None, 0.5, 2.0))
            > 1e-3
    );
    assert!(
        common::largest_difference(&with(RemovalRule::All, 0.0, 1.0), &with(RemovalRule::All, 1.0, 1.0))
            > 1e-3
    );
    let (tutte, spring) = (
        embed_classic(&mesh, Classic::Uniform, &BoundaryShape::Circle, &SolveOptions::default(), &())
            .unwrap(),
        with(RemovalRule::None, 0.5, 0.0),
    );
    assert!(common::largest_difference(&tutte.uv, &spring) < 1e-12, "r = 0 is Tutte's map");
}
