//! Section 2.1, rule by rule.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qsimplify::{RemovalRule, SimplifyOptions, simplify};
use qparam_benches::{face_like, sides};

fn rules(c: &mut Criterion) {
    let mut group = c.benchmark_group("simplify");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for rule in [RemovalRule::Guarded, RemovalRule::Ring, RemovalRule::All] {
            let options = SimplifyOptions { rule, ..SimplifyOptions::default() };
            group.bench_with_input(BenchmarkId::new(format!("{rule:?}"), side * side), &mesh, |b, mesh| {
                b.iter(|| simplify(mesh, &options, &()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, rules);
criterion_main!(benches);
