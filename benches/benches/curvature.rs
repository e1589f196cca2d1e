//! Eqs. 1-4 on every vertex.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qcurv::{VertexArea, gaussian_curvature};
use qparam_benches::{face_like, sides};

fn curvature(c: &mut Criterion) {
    let mut group = c.benchmark_group("curvature");
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for area in [VertexArea::Voronoi, VertexArea::FaceSum] {
            group.bench_with_input(BenchmarkId::new(format!("{area:?}"), side * side), &mesh, |b, mesh| {
                b.iter(|| gaussian_curvature(mesh, area));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, curvature);
criterion_main!(benches);
