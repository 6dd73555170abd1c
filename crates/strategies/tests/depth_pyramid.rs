//! `depth-pyramid` beyond the kit: what the host does for it, what it goes on with after a frame that failed, and what its finer tests save.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use antumbra_cull::{
    AuditOptions, DeclareError, FrameGraph, Stage, StageOptions, Strategy, TestShape, Verdict,
    ViewInput, ViewNodes, VisibleSet,
};
use antumbra_draw::GpuScene;
use antumbra_graph::BodyError;
use antumbra_scene::{Aabb, Camera, Drawable, Geometry, Material, Mesh, Scene};
use antumbra_strategies::DepthPyramid;
use antumbra_testing::{balls, frame, gpus, look_at, perspective, stage_with, views, vulkan};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [96, 72];

fn camera() -> Camera {
    look_at(
        DVec3::new(4.0, 2.0, 6.0),
        DVec3::ZERO,
        perspective(1.0, 0.1),
    )
}

fn host_nodes(options: StageOptions) -> Vec<String> {
    let scene = GpuScene::new(vulkan(), &mut balls(3)).unwrap();
    let strategy = Box::new(DepthPyramid::default());
    let stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
    let passes = stage.plan().passes();
    passes.iter().map(|pass| pass.name.to_owned()).collect()
}

/// The nodes that go through all candidates on the host are there for an audit alone.
#[test]
fn the_host_lists_no_candidates_unless_it_audits() {
    let by_entity = ["frustum", "list queried slots"];
    let has = |nodes: &[String], name: &str| nodes.iter().any(|node| node == name);
    let alone = host_nodes(StageOptions::default());
    assert!(has(&alone, "upload scene"), "{alone:?}");
    assert!(!by_entity.iter().any(|name| has(&alone, name)), "{alone:?}");
    let audited = host_nodes(StageOptions {
        audit: Some(AuditOptions::default()),
        ..StageOptions::default()
    });
    assert!(
        by_entity.iter().all(|name| has(&audited, name)),
        "{audited:?}"
    );
}

/// The strategy with a node of the host's that fails when it is told to.
struct Failing {
    inner: DepthPyramid,
    fails: Arc<AtomicBool>,
}

impl Strategy for Failing {
    fn name(&self) -> &str {
        "failing"
    }

    fn summary(&self) -> &str {
        "depth-pyramid with a node that fails"
    }

    fn conservative(&self) -> bool {
        self.inner.conservative()
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let set = self.inner.declare(g, view)?;
        let fails = Arc::clone(&self.fails);
        let told = g.graph().host::<bool>("told to fail");
        let mut node = g.graph().host_node("fail when told to");
        let told = node.write(told);
        node.run(move |_| match fails.swap(false, Ordering::Relaxed) {
            true => Err(BodyError::msg("told to fail")),
            false => Ok(()),
        });
        g.graph().output(told);
        Ok(set)
    }
}

fn visible(stage: &mut Stage, scene: &GpuScene) -> Vec<u32> {
    stage.frame(scene, &[ViewInput::new(camera())]).unwrap();
    scene.gpu().wait().unwrap();
    let verdicts = stage.verdicts(0, scene).unwrap();
    verdicts.of_kind(Verdict::Visible).collect()
}

/// A frame that fails drops what lies on the device. Answers of earlier frames, which say that the scene is there, come in afterwards.
#[test]
fn after_a_frame_that_failed_the_scene_is_uploaded_again() {
    for gpu in gpus() {
        let scene = GpuScene::new(gpu, &mut balls(4)).unwrap();
        let fails = Arc::new(AtomicBool::new(false));
        let strategy = Box::new(Failing {
            inner: DepthPyramid::default(),
            fails: Arc::clone(&fails),
        });
        let options = StageOptions::default();
        let mut stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
        let mut settled = Vec::new();
        for _ in 0..6 {
            settled = visible(&mut stage, &scene);
        }
        assert!(settled.len() > 8, "{settled:?}");
        // No wait follows this one, so that its answer is still on its way.
        stage.frame(&scene, &[ViewInput::new(camera())]).unwrap();
        fails.store(true, Ordering::Relaxed);
        let failed = stage.frame(&scene, &[ViewInput::new(camera())]);
        assert!(failed.is_err());
        gpu.wait().unwrap();
        for _ in 0..3 {
            let again = visible(&mut stage, &scene);
            let missing = settled.iter().filter(|slot| !again.contains(slot));
            assert_eq!(missing.count(), 0, "{again:?} of {settled:?}");
        }
    }
}

/// Boxes as one mesh, each four times over, so that it has parts.
fn mesh_of(boxes: &[(DVec3, f64)]) -> Mesh {
    let mut made = Geometry::default();
    for (middle, half) in boxes.iter().cycle().take(boxes.len() * 4) {
        let first = made.positions.len() as u32;
        let part = Geometry::from_box(&Aabb::from_centre(*middle, DVec3::splat(*half)));
        made.positions.extend(&part.positions);
        made.indices
            .extend(part.indices.iter().map(|index| first + index));
    }
    Mesh::new("boxes", made)
}

/// A high wall on the left, a low one on the right, and a thing behind both: its parts are hidden, while its box looks over the low wall.
#[test]
fn a_thing_whose_parts_are_hidden_is_culled_though_its_box_shows() {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let mut put = |mesh: Mesh, at: DVec3| {
        let mesh = scene.add_mesh(mesh).unwrap();
        let entity = scene.spawn(None, DAffine3::from_translation(at)).unwrap();
        scene
            .set_drawable(entity, Drawable { mesh, material })
            .unwrap();
        entity
    };
    put(mesh_of(&[(DVec3::ZERO, 5.0)]), DVec3::new(-5.0, 0.0, -5.0));
    put(mesh_of(&[(DVec3::ZERO, 5.0)]), DVec3::new(5.0, -5.0, -5.0));
    let above_left = DVec3::new(-0.5, 0.5, 0.0);
    let thing = put(
        mesh_of(&[(above_left, 0.25), (-above_left, 0.25)]),
        DVec3::new(0.0, 0.0, -12.0),
    );
    let camera = look_at(DVec3::Z * 10.0, DVec3::ZERO, perspective(1.0, 0.1));
    for gpu in gpus() {
        let scene = GpuScene::new(gpu, &mut scene).unwrap();
        let slot = scene.slot(thing).unwrap();
        let drawn = [TestShape::Parts, TestShape::Ellipsoid].map(|shape| {
            let strategy = Box::new(DepthPyramid {
                shape,
                ..DepthPyramid::default()
            });
            let options = StageOptions::default();
            let mut stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
            let verdicts = (0..3).map(|_| frame(&mut stage, &scene, &[camera]).remove(0));
            verdicts.last().unwrap().get(slot).draws()
        });
        assert_eq!(drawn, [false, true], "{}", gpu.title());
    }
}

/// What the first frame has found is tested against all that it drew, so that the second draws no more than those after it.
#[test]
fn the_second_frame_after_a_cut_draws_no_more_than_the_next() {
    for gpu in gpus() {
        let scene = GpuScene::new(gpu, &mut balls(12)).unwrap();
        let strategy = Box::new(DepthPyramid::default());
        let options = StageOptions::default();
        let mut stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
        let camera = look_at(
            DVec3::new(14.0, 9.0, 24.0),
            DVec3::ZERO,
            perspective(1.0, 0.1),
        );
        let drawn = [(); 4].map(|()| frame(&mut stage, &scene, &[camera])[0].drawn().count());
        assert!(drawn[0] > drawn[1], "{drawn:?}");
        assert_eq!(drawn[1], drawn[3], "{drawn:?}");
    }
}
