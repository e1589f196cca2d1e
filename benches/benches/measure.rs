//! Every measure of a map.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::measure;
use qoptimize::qmesh::Vec2;
use qparam_benches::{face_like, sides};

fn distortion(c: &mut Criterion) {
    let mut group = c.benchmark_group("measure");
    for side in sides() {
        let mesh = face_like(side);
        let uv: Vec<Vec2> = mesh.corners().map(|corner| mesh.position(mesh.vertex(corner)).xy()).collect();
        group.throughput(Throughput::Elements((side * side) as u64));
        group.bench_with_input(BenchmarkId::from_parameter(side * side), &mesh, |b, mesh| {
            b.iter(|| measure(mesh.view(), &uv));
        });
    }
    group.finish();
}

criterion_group!(benches, distortion);
criterion_main!(benches);
