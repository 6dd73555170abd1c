//! The cost of finding horizons for each vertex and direction, and of finding the visible groups of a field in a frame.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;

use antumbra_demo_scenes::terrain::FractalOptions;
use antumbra_terrain::{
    AzimuthRange, Field, GroupHierarchy, GroupOptions, Horizons, Method, Observer, RasterDetail,
    Scope, Sectors,
};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

fn field(vertices: usize) -> Field {
    let raster = FractalOptions::default().raster().unwrap();
    Field::from_raster(&raster, RasterDetail::Vertices(vertices)).unwrap()
}

fn finding(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a vertex and direction");
    group.sample_size(10);
    let sectors = Sectors::new(16, 1).unwrap();
    for vertices in [10_000, 100_000] {
        let field = field(vertices);
        let queries = field.points().len() as u64 * u64::from(sectors.count() * sectors.parts());
        group.throughput(Throughput::Elements(queries));
        for method in Method::ALL {
            group.bench_with_input(
                BenchmarkId::new(method.to_string(), vertices),
                &field,
                |b, field| {
                    b.iter(|| Horizons::find(field, sectors, method, Scope::Vertices, &|| ()));
                },
            );
        }
    }
    group.finish();
}

fn traversing(criterion: &mut Criterion) {
    let field = field(20_000);
    let sectors = Sectors::default();
    let horizons = Horizons::find(&field, sectors, Method::Sound, Scope::Surface, &|| ());
    let mut group = criterion.benchmark_group("a frame");
    for seeds in [100, 600, 2000] {
        let options = GroupOptions {
            min_triangles: 1,
            ..GroupOptions::of_seeds(seeds)
        };
        let groups = GroupHierarchy::build(&field, &horizons, &options).unwrap();
        let crystals = groups
            .groups()
            .iter()
            .filter(|group| group.is_leaf())
            .count();
        let middle = field.points().iter().copied().sum::<DVec3>() / field.points().len() as f64;
        let eye = middle + DVec3::Z * 100.0;
        group.bench_function(BenchmarkId::from_parameter(crystals), |b| {
            b.iter(|| {
                let mut seen = 0;
                Observer::new(&groups, black_box(eye), AzimuthRange::ALL)
                    .each_visible(|_| seen += 1);
                seen
            });
        });
    }
    group.finish();
}

criterion_group!(benches, finding, traversing);
criterion_main!(benches);
