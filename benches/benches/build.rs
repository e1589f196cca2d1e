//! Connectivity from polygons.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qmesh::QuadMesh;
use qparam_benches::{face_like, polygons, sides};

fn build(c: &mut Criterion) {
    let mut group = c.benchmark_group("build");
    for side in sides() {
        let polygons = polygons(&face_like(side));
        group.throughput(Throughput::Elements((side * side) as u64));
        group.bench_with_input(BenchmarkId::from_parameter(side * side), &polygons, |b, polygons| {
            b.iter_batched(|| polygons.clone(), QuadMesh::build, criterion::BatchSize::LargeInput);
        });
    }
    group.finish();
}

criterion_group!(benches, build);
criterion_main!(benches);
