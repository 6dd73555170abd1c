//! The host time of a traversal, front to back, over trees of a thousand, ten thousand and a hundred thousand nodes: with every query answered
//! "hidden", with every query answered "visible", and for the late traversal once every node has an answer. Also the occupancy map
//! alone, and building and refitting a tree.
#![allow(clippy::unwrap_used, missing_docs)]

use std::hint::black_box;

use antumbra_cull::boxes::{BoxContents, BoxList};
use antumbra_cull::{AdapterChoice, Gpu, SceneTable, Tree, Verdicts, ViewFrame};
use antumbra_draw::GpuScene;
use antumbra_scene::hierarchy::HierarchyShape;
use antumbra_scene::{EntityKey, Scene};
use antumbra_strategies::occupancy::{BlockRect, OccupancyMap};
use antumbra_strategies::traversal::{
    LateTraversal, Traversal, TraversalContext, TraversalSettings, WaitingTraversal,
};
use antumbra_testing::{balls, look_at, perspective};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DAffine3, DVec3};

const SETTINGS: TraversalSettings = TraversalSettings::PAPER;

/// Spheres along an edge, for about a thousand, ten thousand and a hundred thousand nodes.
const SIDES: [u32; 3] = [9, 20, 42];

struct Prepared {
    scene: Scene,
    gpu: GpuScene,
    tree: Tree,
    view: ViewFrame,
}

fn prepare(gpu: &Gpu, per_side: u32) -> Prepared {
    let mut scene = balls(per_side);
    let gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let mut tree = Tree::default();
    tree.follow(gpu.table(), HierarchyShape::Bvh).unwrap();
    let eye = DVec3::new(0.4, 0.5, 1.0) * f64::from(per_side) * 1.6;
    let camera = look_at(eye, DVec3::ZERO, perspective(0.8, 0.1));
    let view = ViewFrame::new(camera, [800, 600], 0);
    Prepared {
        scene,
        gpu,
        tree,
        view,
    }
}

/// A whole frame's traversal. Returns the number of queries.
fn same_frame(
    traversal: &mut Traversal,
    context: &TraversalContext<'_>,
    verdicts: &mut Verdicts,
    visible: bool,
) -> u32 {
    let mut boxes = BoxList::default();
    verdicts.reset_outside(context.table);
    traversal.begin(context, &SETTINGS, 0, verdicts);
    loop {
        traversal.advance(context, &SETTINGS, verdicts, &mut boxes);
        traversal.found().clear();
        let answers = std::iter::repeat_n(visible, boxes.query_count() as usize);
        traversal.answer(context, &SETTINGS, verdicts, answers);
        if traversal.is_done() {
            return verdicts.tested();
        }
    }
}

/// A frame of the late traversal, with its answers.
fn frame_late(
    traversal: &mut LateTraversal,
    context: &TraversalContext<'_>,
    verdicts: &mut Verdicts,
) {
    let mut boxes = BoxList::default();
    verdicts.reset_outside(context.table);
    traversal.begin(context, 0);
    traversal.traverse(context, &SETTINGS, verdicts, &mut boxes);
    let queried = traversal.queried();
    // The far half of the scene is hidden.
    let hierarchy = context.tree.hierarchy();
    let visible = |node: &u32| {
        let node = hierarchy.node(*node);
        node.is_some_and(|node| node.bounds.max.z > 0.0)
    };
    let answers: Vec<bool> = queried.nodes.iter().map(visible).collect();
    traversal.take(context, &SETTINGS, &queried, answers.into_iter());
}

fn context<'a>(tree: &'a Tree, table: &'a SceneTable, view: &ViewFrame) -> TraversalContext<'a> {
    TraversalContext::new(table, tree, view, &SETTINGS, BoxContents::Triangles)
}

fn traversals(c: &mut Criterion) {
    let gpu = Gpu::open(&AdapterChoice::Cpu).unwrap();
    let mut group = c.benchmark_group("walk");
    for side in SIDES {
        let prepared = prepare(&gpu, side);
        let nodes = prepared.tree.hierarchy().nodes().len();
        group.throughput(Throughput::Elements(nodes as u64));
        let context = context(&prepared.tree, prepared.gpu.table(), &prepared.view);
        let mut verdicts = Verdicts::default();
        for (name, visible) in [("all hidden", false), ("all visible", true)] {
            let mut traversal = Traversal::default();
            group.bench_function(BenchmarkId::new(name, nodes), |b| {
                b.iter(|| black_box(same_frame(&mut traversal, &context, &mut verdicts, visible)));
            });
        }
        let mut settled = LateTraversal::default();
        for _ in 0..20 {
            frame_late(&mut settled, &context, &mut verdicts);
        }
        group.bench_function(BenchmarkId::new("late, settled", nodes), |b| {
            b.iter(|| frame_late(&mut settled, &context, &mut verdicts));
        });
    }
    group.finish();
}

fn trees(c: &mut Criterion) {
    let gpu = Gpu::open(&AdapterChoice::Cpu).unwrap();
    let mut group = c.benchmark_group("tree");
    for side in SIDES {
        let mut prepared = prepare(&gpu, side);
        let leaves = side.pow(3);
        group.bench_function(BenchmarkId::new("make", leaves), |b| {
            b.iter(|| {
                let mut tree = Tree::default();
                tree.follow(prepared.gpu.table(), HierarchyShape::Bvh)
                    .unwrap();
                black_box(tree)
            });
        });
        let entities: Vec<EntityKey> = prepared.scene.drawables().map(|(key, _)| key).collect();
        let mut refits = 0;
        group.bench_function(BenchmarkId::new("refit a hundredth", leaves), |b| {
            b.iter_custom(|times| {
                let mut spent = std::time::Duration::ZERO;
                for _ in 0..times {
                    refits += 1;
                    let moved =
                        DAffine3::from_translation(DVec3::X * f64::from(refits % 2 * 2 - 1) * 0.1);
                    for entity in entities.iter().skip(refits as usize % 100).step_by(100) {
                        let local = prepared.scene.local(*entity).unwrap();
                        prepared.scene.set_local(*entity, local * moved).unwrap();
                    }
                    prepared.gpu.sync(&mut prepared.scene).unwrap();
                    let started = std::time::Instant::now();
                    prepared
                        .tree
                        .follow(prepared.gpu.table(), HierarchyShape::Bvh)
                        .unwrap();
                    spent += started.elapsed();
                    // Buffer writes take memory until the next submission.
                    prepared.gpu.gpu().queue.submit([]);
                }
                spent
            });
        });
    }
    group.finish();
}

fn maps(c: &mut Criterion) {
    let mut group = c.benchmark_group("map of 200 x 150 blocks");
    let mut map = OccupancyMap::new(200, 150);
    map.take(BlockRect {
        left: 0,
        top: 0,
        right: 199,
        bottom: 148,
    });
    for (name, side) in [("4 x 4", 4), ("32 x 32", 32), ("148 x 148", 148)] {
        // All blocks are taken, so the test reads every one of them.
        let rect = BlockRect {
            left: 7,
            top: 0,
            right: 6 + side,
            bottom: side - 1,
        };
        group.bench_function(BenchmarkId::new("test", name), |b| {
            b.iter(|| black_box(map.has_free(black_box(rect))));
        });
        group.bench_function(BenchmarkId::new("take", name), |b| {
            b.iter(|| map.take(black_box(rect)));
        });
    }
    group.finish();
}

criterion_group!(benches, traversals, trees, maps);
criterion_main!(benches);
