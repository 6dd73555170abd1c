//! Recording a draw list into a pass: directly, an entity at a time, or from indirect draws.

use std::ops::Range as Slots;

use crate::list::{DrawList, Run};
use crate::pipeline::PassPipelines;
use crate::scene::SceneFrame;

/// Bytes of an indexed indirect draw.
pub const INDIRECT_DRAW_BYTES: u64 = 20;

/// Sets a pass up for drawing from a scene: index and vertex buffers, with `ids` as the instance slots.
pub fn begin(
    pass: &mut wgpu::RenderPass<'_>,
    scene: &SceneFrame,
    ids: &wgpu::Buffer,
    attributes: bool,
) {
    pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
    pass.set_vertex_buffer(0, scene.positions.slice(..));
    pass.set_vertex_buffer(1, ids.slice(..));
    if attributes {
        pass.set_vertex_buffer(2, scene.attributes.slice(..));
    }
}

/// What is bound, so that it is bound once.
#[derive(Debug)]
pub struct Recorder<'a> {
    scene: &'a SceneFrame,
    pipelines: &'a PassPipelines,
    pipeline: Option<usize>,
    texture: Option<u32>,
}

impl<'a> Recorder<'a> {
    /// A recorder that assumes nothing bound but groups 0 and 1, and 3 where the pass has one.
    pub fn new(scene: &'a SceneFrame, pipelines: &'a PassPipelines) -> Self {
        Self {
            scene,
            pipelines,
            pipeline: None,
            texture: None,
        }
    }

    /// Draws a whole list: an instanced draw a run.
    pub fn list(&mut self, pass: &mut wgpu::RenderPass<'_>, list: &DrawList) {
        for run in list.runs() {
            self.run(pass, run, run.first..run.first + run.count);
        }
    }

    /// Draws some of a run's instances.
    pub fn run(&mut self, pass: &mut wgpu::RenderPass<'_>, run: &Run, instances: Slots<u32>) {
        let Some(batch) = self.scene.table.batches().get(run.batch as usize) else {
            return;
        };
        let range = self.scene.table.range(batch.mesh, run.detail);
        if range.index_count > 0 && self.bind(pass, run) {
            pass.draw_indexed(
                range.first_index..range.first_index + range.index_count,
                range.base_vertex,
                instances,
            );
        }
    }

    /// Draws from indirect draws, from the `first` one on one for each run, as many at a time as share what is bound.
    pub fn indirect(
        &mut self,
        pass: &mut wgpu::RenderPass<'_>,
        runs: &[Run],
        draws: &wgpu::Buffer,
        first: usize,
    ) {
        let mut at = 0;
        while let Some(run) = runs.get(at) {
            let key = self.key(run);
            let alike = runs
                .iter()
                .skip(at)
                .take_while(|other| self.key(other) == key)
                .count();
            if self.bind(pass, run) {
                // Never with a count of 0, which would draw once under wgpu's indirect validation.
                pass.multi_draw_indexed_indirect(
                    draws,
                    (first + at) as u64 * INDIRECT_DRAW_BYTES,
                    alike as u32,
                );
            }
            at += alike.max(1);
        }
    }

    fn key(&self, run: &Run) -> Option<(usize, u32)> {
        let batch = self.scene.table.batches().get(run.batch as usize)?;
        Some((batch.class.for_detail(run.detail).index(), batch.texture))
    }

    /// Binds a run's pipeline and texture; false when the pass has no such pipeline.
    fn bind(&mut self, pass: &mut wgpu::RenderPass<'_>, run: &Run) -> bool {
        let Some(batch) = self.scene.table.batches().get(run.batch as usize) else {
            return false;
        };
        let class = batch.class.for_detail(run.detail);
        let Some(pipeline) = self.pipelines.get(class) else {
            return false;
        };
        if self.pipeline != Some(class.index()) {
            pass.set_pipeline(pipeline);
            self.pipeline = Some(class.index());
        }
        if self.pipelines.kind().textured(class) && self.texture != Some(batch.texture) {
            let Some(texture) = self.scene.textures.get(batch.texture as usize) else {
                return false;
            };
            pass.set_bind_group(2, texture, &[]);
            self.texture = Some(batch.texture);
        }
        true
    }
}
