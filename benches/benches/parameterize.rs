//! The whole way from mesh to measured UVs.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::{Method, Options, parameterize};
use qparam_benches::{face_like, sides};

fn whole_way(c: &mut Criterion) {
    let mut group = c.benchmark_group("parameterize");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for method in [Method::Paper, Method::MeanValue, Method::Lscm] {
            let options = Options { method, ..Options::default() };
            group.bench_with_input(BenchmarkId::new(format!("{method:?}"), side * side), &mesh, |b, mesh| {
                b.iter(|| parameterize(mesh, &options, &()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, whole_way);
criterion_main!(benches);
