//! `depth-pyramid` beyond the kit: what the host does for it, and what it goes on with after a frame that failed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use antumbra_cull::{
    AuditOptions, DeclareError, FrameGraph, Stage, StageOptions, Strategy, Verdict, ViewInput,
    ViewNodes, VisibleSet,
};
use antumbra_draw::GpuScene;
use antumbra_graph::BodyError;
use antumbra_scene::Camera;
use antumbra_strategies::DepthPyramid;
use antumbra_testing::{balls, gpus, look_at, perspective, stage_with, views, vulkan};
use glam::DVec3;

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
        // Nobody waits for this one, so that its answer is still on its way.
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
