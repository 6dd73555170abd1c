//! Loading of a real assembly, and proxies for all of its meshes. `ANTUMBRA_ENGINE_GLB` names the file
//! (2CylinderEngine.glb, 1.8 MB); without it nothing is measured.
#![allow(clippy::unwrap_used, missing_docs)]

use antumbra_formats::{LoadOptions, load};
use antumbra_scene::ProxyOptions;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::path::PathBuf;

fn loading(c: &mut Criterion) {
    let Some(path) = std::env::var_os("ANTUMBRA_ENGINE_GLB").map(PathBuf::from) else {
        eprintln!("skipped: set ANTUMBRA_ENGINE_GLB to the path of 2CylinderEngine.glb");
        return;
    };
    let options = LoadOptions::default();
    c.bench_function("load the engine", |b| {
        b.iter(|| load(&path, &options).unwrap());
    });
    let scene = load(&path, &options).unwrap();
    c.bench_function("proxies of the engine", |b| {
        b.iter_batched_ref(
            || scene.clone(),
            |scene| scene.ensure_proxies(&ProxyOptions::default()),
            BatchSize::PerIteration,
        );
    });
}

criterion_group!(benches, loading);
criterion_main!(benches);
