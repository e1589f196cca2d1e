//! Sections 2.2 and 2.3, and the classic methods: mostly the time of the sparse solvers.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qembed::{BoundaryShape, Classic, EmbedOptions, embed, embed_classic};
use qoptimize::qsimplify::{RemovalRule, SimplifyOptions, simplify};
use qoptimize::qsolve::SolveOptions;
use qparam_benches::{face_like, sides};

fn paper(c: &mut Criterion) {
    let mut group = c.benchmark_group("embed/paper");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for rule in [RemovalRule::Guarded, RemovalRule::All] {
            let options = SimplifyOptions { rule, ..SimplifyOptions::default() };
            let simplified = simplify(&mesh, &options, &()).expect("the options are in range");
            group.bench_function(BenchmarkId::new(format!("{rule:?}"), side * side), |b| {
                b.iter(|| embed(&mesh, &simplified, &EmbedOptions::default(), &()));
            });
        }
    }
    group.finish();
}

fn classic(c: &mut Criterion) {
    let mut group = c.benchmark_group("embed/classic");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for method in [Classic::Uniform, Classic::MeanValue, Classic::Harmonic, Classic::Lscm] {
            group.bench_with_input(BenchmarkId::new(format!("{method:?}"), side * side), &mesh, |b, mesh| {
                b.iter(|| embed_classic(mesh, method, &BoundaryShape::Circle, &SolveOptions::default(), &()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, paper, classic);
criterion_main!(benches);
