//! A linear system with two right-hand sides, as Tutte's embedding of a grid has it: factors against multigrid.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use qoptimize::qsolve::{Backend, DMatrix, SolveOptions, Structure, solve};
use qparam_benches::{grid_laplacian, sides};

fn laplace(c: &mut Criterion) {
    let mut group = c.benchmark_group("solve");
    group.sample_size(10);
    for side in sides() {
        let matrix = grid_laplacian(side);
        let rhs = DMatrix::from_fn(side * side, 2, |row, column| ((row * 7 + column * 3) % 11) as f64 - 5.0);
        group.throughput(Throughput::Elements((side * side) as u64));
        for backend in [Backend::Direct, Backend::Multigrid] {
            let options = SolveOptions { backend, ..SolveOptions::default() };
            group.bench_function(BenchmarkId::new(format!("{backend:?}"), side * side), |b| {
                b.iter(|| solve(&matrix, Structure::SymmetricPositiveDefinite, &rhs, &options));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, laplace);
criterion_main!(benches);
