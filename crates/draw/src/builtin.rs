//! The built-in renderer behind the contract of [`antumbra_cull`]: each pass it is asked for is one node of [`passes`], with pipelines that are made
//! once.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_cull::patches::PatchDraws;
use antumbra_cull::{
    DepthTest, DrawSource, Gpu, IdTargets, ListDraws, Pass, Renderer, ShadeTargets, StageOutput,
    TestRenderer,
};
use antumbra_graph::{Buffer, BufferDesc, Texture};

use crate::light::GpuLights;
use crate::passes::{self, PassSpec};
use crate::pipeline::{PassPipelines, PipelineKind};

/// Draws the frames of a [`GpuScene`](crate::GpuScene).
#[derive(Debug)]
pub struct BuiltinRenderer {
    gpu: Gpu,
    /// By kind and samples a pixel.
    pipelines: HashMap<(PipelineKind, u32), Arc<PassPipelines>>,
    /// The uploaded lights of each view of the plan that is being declared.
    lights: Vec<Buffer>,
}

impl BuiltinRenderer {
    /// A renderer without pipelines. It makes them for the classes that scenes have.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            pipelines: HashMap::new(),
            lights: Vec::new(),
        }
    }

    /// The kinds of pipelines that were made so far, in no order; a kind comes once for each number of samples.
    pub fn kinds(&self) -> impl Iterator<Item = PipelineKind> + '_ {
        self.pipelines.keys().map(|(kind, _)| *kind)
    }

    /// The name, group and pipelines of a node. What a scene has gained since the last plan is added to the pipelines.
    fn spec(&mut self, pass: &Pass<'_>, kind: PipelineKind) -> PassSpec {
        let (gpu, layout, samples) = (&self.gpu, pass.layout, pass.samples);
        let made = self
            .pipelines
            .entry((kind, samples))
            .or_insert_with(|| Arc::new(PassPipelines::new(gpu, kind, samples, layout.classes())));
        if layout.classes().any(|class| made.get(class).is_none()) {
            *made = Arc::new(made.with(gpu, layout.classes()));
        }
        PassSpec {
            name: pass.name.clone(),
            group: pass.group,
            pipelines: Arc::clone(made),
        }
    }
}

impl Renderer for BuiltinRenderer {
    fn begin_view(&mut self, mut pass: Pass<'_>) {
        // Handles of an earlier plan mean nothing in this one.
        self.lights.truncate(pass.view);
        self.lights.push(upload_lights(&mut pass));
    }

    fn shade(
        &mut self,
        mut pass: Pass<'_>,
        source: DrawSource,
        into: ShadeTargets,
    ) -> ShadeTargets {
        if pass.output == StageOutput::Answers {
            let identified = into.ids.is_some();
            let spec = self.spec(&pass, PipelineKind::Hide { identified });
            return passes::hide_pass(pass.graph, &spec, pass.inputs, source, into);
        }
        let lights = match self.lights.get(pass.view) {
            Some(lights) => *lights,
            // A caller that left `begin_view` out.
            None => upload_lights(&mut pass),
        };
        let kind = PipelineKind::Shaded {
            format: pass.colour_format,
            positional_lights: pass.layout.positional_lights,
            environment: pass.layout.environment,
            identified: into.ids.is_some(),
        };
        let spec = self.spec(&pass, kind);
        passes::shaded_pass(pass.graph, &spec, pass.inputs, lights, source, into)
    }

    fn tests(&mut self) -> &mut dyn TestRenderer {
        self
    }
}

impl TestRenderer for BuiltinRenderer {
    fn depth(&mut self, pass: Pass<'_>, source: ListDraws, depth: Texture) -> Texture {
        let spec = self.spec(&pass, PipelineKind::Depth);
        passes::depth_pass(pass.graph, &spec, pass.inputs, source, depth)
    }

    fn ids(&mut self, pass: Pass<'_>, source: ListDraws, targets: IdTargets) -> IdTargets {
        let spec = self.spec(&pass, PipelineKind::Identity);
        passes::identity_pass(pass.graph, &spec, pass.inputs, source, targets)
    }

    fn count(
        &mut self,
        pass: Pass<'_>,
        source: DrawSource,
        test: DepthTest,
        counts: Buffer,
    ) -> Buffer {
        let kind = match test {
            DepthTest::Early { .. } => PipelineKind::CountAtomic,
            DepthTest::InShader { .. } => PipelineKind::CountCompare,
        };
        let spec = self.spec(&pass, kind);
        passes::count_pass(pass.graph, &spec, pass.inputs, source, test, counts)
    }

    fn query(
        &mut self,
        pass: Pass<'_>,
        source: ListDraws,
        depth: Texture,
        results: Buffer,
    ) -> Buffer {
        let spec = self.spec(&pass, PipelineKind::Query);
        passes::query_pass(pass.graph, &spec, pass.inputs, source, depth, results)
    }

    fn mark_patches(
        &mut self,
        pass: Pass<'_>,
        source: PatchDraws,
        test: DepthTest,
        marks: Buffer,
    ) -> Buffer {
        let kind = match test {
            DepthTest::Early { .. } => PipelineKind::PatchEarly,
            DepthTest::InShader { .. } => PipelineKind::PatchCompare,
        };
        let spec = self.spec(&pass, kind);
        passes::patch_pass(pass.graph, &spec, pass.inputs, source, test, marks)
    }
}

/// Adds a node that uploads the lights, relative to the eye. Without a shading pass nothing reads them, and the plan has no such node.
fn upload_lights(pass: &mut Pass<'_>) -> Buffer {
    let inputs = pass.inputs;
    let lights = BufferDesc::new(size_of::<GpuLights>() as u64);
    let lights = pass.graph.buffer(pass.named("lights"), lights);
    let mut node = pass.graph.host_node(pass.named("upload lights"));
    node.group(pass.group).read(inputs.scene).read(inputs.view);
    let lights = node.upload(lights);
    node.run(move |ctx| {
        let (scene, view) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
        let around_eye =
            (passes::buffers_of(&scene)?.lights).relative_to(view.camera.position, view.axes());
        ctx.upload(lights, 0, bytemuck::bytes_of(&around_eye))?;
        Ok(())
    });
    lights
}
