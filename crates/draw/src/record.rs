//! Records a draw list into a render pass: whole, a part of a run at a time, or from indirect draws.

use std::ops::Range;

use antumbra_cull::{DrawList, INDIRECT_DRAW_BYTES, Run, SceneFrame};

use crate::pipeline::PassPipelines;
use crate::scene::SceneBuffers;

/// Sets the index buffer and the vertex buffers of a pass that draws a scene with these pipelines. `slots` holds a u32 instance slot
/// for each instance.
pub fn begin(
    pass: &mut wgpu::RenderPass<'_>,
    scene: &SceneBuffers,
    pipelines: &PassPipelines,
    slots: &wgpu::Buffer,
) {
    pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
    pass.set_vertex_buffer(0, scene.positions.slice(..));
    pass.set_vertex_buffer(1, slots.slice(..));
    if pipelines.kind().has_materials() {
        pass.set_vertex_buffer(2, scene.attributes.slice(..));
    }
}

/// Records draws, and remembers what is bound so that nothing is bound twice in a row.
#[derive(Debug)]
pub struct Recorder<'a> {
    scene: &'a SceneFrame,
    buffers: &'a SceneBuffers,
    pipelines: &'a PassPipelines,
    pipeline: Option<usize>,
    texture: Option<u32>,
}

impl<'a> Recorder<'a> {
    /// A recorder for a pass that has [begun](begin). It binds pipelines and group 2; all other groups are the caller's.
    pub fn new(
        scene: &'a SceneFrame,
        buffers: &'a SceneBuffers,
        pipelines: &'a PassPipelines,
    ) -> Self {
        Self {
            scene,
            buffers,
            pipelines,
            pipeline: None,
            texture: None,
        }
    }

    /// Draws a whole list: one instanced draw for each run.
    pub fn list(&mut self, pass: &mut wgpu::RenderPass<'_>, list: &DrawList) {
        for run in list.runs() {
            self.run(pass, run, run.first..run.first + run.count);
        }
    }

    /// Draws some of a run's instances: a range of entries of the list.
    pub fn run(&mut self, pass: &mut wgpu::RenderPass<'_>, run: &Run, instances: Range<u32>) {
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

    /// Draws one indirect draw for each run, starting at the indirect draw `first`. Neighbours that share pipeline and texture go
    /// into one multi-draw.
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
                // The count is never 0: with 0, wgpu's indirect validation would draw once.
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
            let Some(texture) = self.buffers.textures.get(batch.texture as usize) else {
                return false;
            };
            pass.set_bind_group(2, texture, &[]);
            self.texture = Some(batch.texture);
        }
        true
    }
}
