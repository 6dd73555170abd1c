//! Update of the transforms and boxes of a million entities: all of them, and one in a hundred, against a recursion
//! over a hash map without dirty flags.
#![allow(clippy::unwrap_used, missing_docs)]

use antumbra_scene::{Aabb, Drawable, EntityKey, Material, Mesh, Scene, icosphere};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DAffine3, DQuat, DVec3};
use std::collections::HashMap;
use std::hint::black_box;
use std::time::{Duration, Instant};

const ENTITIES: usize = 1_000_000;
/// Children per entity.
const BRANCHES: usize = 8;

fn local(i: usize) -> DAffine3 {
    let angle = i as f64 * 0.001;
    let place = DVec3::new((i % 17) as f64, (i % 13) as f64, (i % 11) as f64);
    DAffine3::from_rotation_translation(DQuat::from_rotation_y(angle), place)
}

fn tree() -> (Scene, Vec<EntityKey>) {
    let mut scene = Scene::new();
    let mesh = scene
        .add_mesh(Mesh::new("sphere", icosphere(0, 0.5)))
        .unwrap();
    let material = scene.add_material(Material::default());
    let mut entities: Vec<EntityKey> = Vec::with_capacity(ENTITIES);
    for i in 0..ENTITIES {
        let parent = (i > 0).then(|| entities[(i - 1) / BRANCHES]);
        let entity = scene.spawn(parent, local(i)).unwrap();
        scene
            .set_drawable(entity, Drawable { mesh, material })
            .unwrap();
        entities.push(entity);
    }
    scene.update();
    (scene, entities)
}

#[derive(Default)]
struct Naive {
    local: DAffine3,
    world: DAffine3,
    bounds: Option<Aabb>,
    children: Vec<usize>,
}

fn recurse(nodes: &mut HashMap<usize, Naive>, node: usize, above: DAffine3, own: &Aabb) -> Aabb {
    let entry = nodes.get_mut(&node).unwrap();
    entry.world = above * entry.local;
    let world = entry.world;
    let mut bounds = own.transformed(&world);
    for child in entry.children.clone() {
        bounds = bounds.union(&recurse(nodes, child, world, own));
    }
    nodes.get_mut(&node).unwrap().bounds = Some(bounds);
    bounds
}

/// Time of the updates alone, without the changes before them.
fn timed(scene: &mut Scene, times: u64, mut change: impl FnMut(&mut Scene)) -> Duration {
    let update = |_| {
        change(scene);
        let start = Instant::now();
        black_box(scene.update());
        start.elapsed()
    };
    (0..times).map(update).sum()
}

fn transforms(c: &mut Criterion) {
    let mut group = c.benchmark_group("transforms of 1 M entities");
    group.sample_size(10);
    let (mut scene, entities) = tree();
    let mut turn = 0;
    group.bench_function("all dirty", |b| {
        b.iter_custom(|times| {
            timed(&mut scene, times, |scene| {
                turn += 1;
                for (i, entity) in entities.iter().enumerate() {
                    scene.set_local(*entity, local(i + turn)).unwrap();
                }
            })
        });
    });
    group.bench_function("root dirty", |b| {
        b.iter(|| {
            turn += 1;
            scene.set_local(entities[0], local(turn)).unwrap();
            scene.update()
        });
    });
    group.bench_function("one in a hundred dirty", |b| {
        b.iter_custom(|times| {
            timed(&mut scene, times, |scene| {
                turn += 1;
                // Leaves and their parents change, as in a scene with moving objects and static buildings.
                let movers = (turn % 100..ENTITIES).step_by(100);
                for i in movers.filter(|i| *i > ENTITIES / 100) {
                    scene.set_local(entities[i], local(i + turn)).unwrap();
                }
            })
        });
    });
    group.bench_function("nothing dirty", |b| b.iter(|| scene.update()));
    drop(scene);
    let mut nodes: HashMap<usize, Naive> = HashMap::new();
    for i in 0..ENTITIES {
        let node = Naive {
            local: local(i),
            ..Naive::default()
        };
        nodes.insert(i, node);
        if i > 0 {
            nodes
                .get_mut(&((i - 1) / BRANCHES))
                .unwrap()
                .children
                .push(i);
        }
    }
    let own = Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5));
    group.bench_function("recursion over a hash map", |b| {
        b.iter(|| recurse(&mut nodes, 0, DAffine3::IDENTITY, &own));
    });
    group.finish();
}

criterion_group!(benches, transforms);
criterion_main!(benches);
