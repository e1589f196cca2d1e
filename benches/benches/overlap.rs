//! Section 2.4 on a good map with spikes, in both orders.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qmesh::{QuadMesh, Vec2, VertexData};
use qoptimize::{MoveOrder, OverlapOptions, remove_overlaps};
use qparam_benches::{face_like, sides};

/// The mesh seen from above, with every 97th interior vertex moved four columns to the right.
fn spiked(mesh: &QuadMesh, side: usize) -> VertexData<Vec2> {
    let mut uv = mesh.vertex_data(|vertex| mesh.position(vertex).xy());
    let step = 4.0 * 2.0 / side as f64; // the mesh is two units wide
    for vertex in mesh.vertices().filter(|&vertex| !mesh.is_boundary(vertex)).step_by(97) {
        uv[vertex].x += step;
    }
    uv
}

fn overlaps(c: &mut Criterion) {
    let mut group = c.benchmark_group("overlap");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        let uv = spiked(&mesh, side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for order in [MoveOrder::WorstFirst, MoveOrder::FirstCome] {
            let options = OverlapOptions { order, ..OverlapOptions::default() };
            group.bench_with_input(BenchmarkId::new(format!("{order:?}"), side * side), &uv, |b, uv| {
                b.iter_batched_ref(
                    || uv.clone(),
                    |uv| remove_overlaps(&mesh, uv, &options, &()),
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

criterion_group!(benches, overlaps);
criterion_main!(benches);
