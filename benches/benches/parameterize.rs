//! The whole way from mesh to measured and certified UVs, and from OBJ to OBJ.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qmesh::QuadMesh;
use qoptimize::qmesh::obj::{ObjDocument, write_obj};
use qoptimize::{Continuation, Method, Options, parameterize, parameterize_from};
use qparam_benches::{face_like, sides};

fn whole_way(c: &mut Criterion) {
    let mut group = c.benchmark_group("parameterize");
    group.sample_size(10);
    for side in sides() {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        for method in [Method::Direct, Method::Paper, Method::MeanValue, Method::Lscm] {
            let options = Options { method, ..Options::default() };
            group.bench_with_input(BenchmarkId::new(format!("{method:?}"), side * side), &mesh, |b, mesh| {
                b.iter(|| parameterize(mesh, &options, &()));
            });
        }
    }
    group.finish();
}

/// Nine values of q, each map from the one before: to be compared with nine times `Direct`. Not for the largest mesh: ten samples
/// of nine maps would take most of an hour.
fn sweep(c: &mut Criterion) {
    let mut group = c.benchmark_group("parameterize");
    group.sample_size(10);
    for side in sides().into_iter().filter(|&side| side < 1000) {
        let mesh = face_like(side);
        group.throughput(Throughput::Elements((side * side) as u64));
        group.bench_with_input(BenchmarkId::new("DirectNineQ", side * side), &mesh, |b, mesh| {
            b.iter(|| {
                let mut continuation = Continuation::default();
                // As sweeps do: from the middle up, then down.
                for step in [5, 6, 7, 8, 4, 3, 2, 1, 0] {
                    let options = Options { q: f64::from(step) / 8.0, ..Options::default() };
                    let map = parameterize_from(&mut continuation, mesh, &options, &());
                    assert!(map.is_ok_and(|map| map.certificate.holds));
                }
            });
        });
    }
    group.finish();
}

/// What `qparam unwrap` does with its defaults but for the files: parse, build, map, measure, certify, write.
fn from_text_to_text(c: &mut Criterion) {
    let mut group = c.benchmark_group("whole");
    group.sample_size(10);
    for side in sides() {
        let mut text = Vec::new();
        write_obj(&mut text, face_like(side).view(), None).expect("memory takes every byte");
        group.throughput(Throughput::Elements((side * side) as u64));
        group.bench_with_input(BenchmarkId::new("Direct", side * side), &text, |b, text| {
            b.iter(|| {
                let document = ObjDocument::parse(text.clone()).expect("our own text is an OBJ");
                let mesh = QuadMesh::build(document.polygons()).expect("and a mesh");
                let map = parameterize(&mesh, &Options::default(), &()).expect("which is a disk");
                document.write_with_uv(&mut std::io::sink(), &map.uv)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, whole_way, sweep, from_text_to_text);
criterion_main!(benches);
