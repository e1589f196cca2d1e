//! Reading and writing OBJ text.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qmesh::Vec2;
use qoptimize::qmesh::obj::{ObjDocument, write_obj};
use qparam_benches::{face_like, sides};

fn obj(c: &mut Criterion) {
    for side in sides() {
        let mesh = face_like(side);
        let mut text = Vec::new();
        write_obj(&mut text, mesh.view(), None).expect("memory takes every byte");
        let uv: Vec<Vec2> = mesh.corners().map(|corner| mesh.position(mesh.vertex(corner)).xy()).collect();
        let document = ObjDocument::parse(text.clone()).expect("our own text is an OBJ");

        let mut group = c.benchmark_group("obj");
        group.sample_size(10).throughput(Throughput::Bytes(text.len() as u64));
        group.bench_with_input(BenchmarkId::new("parse", side * side), &text, |b, text| {
            b.iter_batched(|| text.clone(), ObjDocument::parse, criterion::BatchSize::LargeInput);
        });
        group.bench_with_input(BenchmarkId::new("write", side * side), &document, |b, document| {
            b.iter(|| document.write_with_uv(&mut std::io::sink(), &uv));
        });
        group.finish();
    }
}

criterion_group!(benches, obj);
criterion_main!(benches);
