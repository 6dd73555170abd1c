//! The judge's passes of one view: what is drawn first, and the test of the rest.

use antumbra_graph::{Bind, Buffer, BufferDesc, Graph, Host, Texture, TextureDesc};
use antumbra_shaders::jobs;

use super::depth::HostDepth;
use super::eye::GpuJudgedView;
use super::pyramid::{PyramidNodes, depth_pyramid};
use super::record::JudgedInstance;
use super::view::JudgeView;
use crate::compute_pipeline::rows_of;
use crate::device::Gpu;
use crate::frame_graph::CULL;

/// A view's imports in either plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Imports {
    pub view: Host<GpuJudgedView>,
    pub instances: Buffer,
    pub states: Buffer,
}

/// A view in the plan that says what is drawn first.
#[derive(Debug, Clone, Copy)]
pub(super) struct FirstNodes {
    pub imports: Imports,
    pub first: Buffer,
}

/// A view in the plan that tests.
#[derive(Debug, Clone, Copy)]
pub(super) struct TestNodes {
    pub imports: Imports,
    pub depth: Texture,
    pub rest: Buffer,
    pub hidden: Buffer,
    pub first: Buffer,
}

/// What a node's name begins with: nothing for a single view.
pub(super) fn prefix(view: &JudgeView, views: usize) -> String {
    match views > 1 {
        true => format!("{}: ", view.name),
        false => String::new(),
    }
}

fn imports(graph: &mut Graph, prefix: &str) -> (Imports, Buffer) {
    let record = BufferDesc::new(size_of::<JudgedInstance>() as u64);
    let view = graph.import_host::<GpuJudgedView>(format!("{prefix}eye"));
    let imports = Imports {
        view,
        instances: graph.import_buffer(format!("{prefix}instances"), record),
        states: graph.import_buffer(format!("{prefix}states"), BufferDesc::new(4)),
    };
    let uniform = BufferDesc::new(size_of::<GpuJudgedView>() as u64);
    let uniform = graph.buffer(format!("{prefix}view"), uniform);
    let mut node = graph.host_node(format!("{prefix}upload view"));
    node.group(CULL).read(view);
    let uniform = node.upload(uniform);
    node.run(move |ctx| {
        let view = ctx.get(view)?;
        Ok(ctx.upload(uniform, 0, bytemuck::bytes_of(&*view))?)
    });
    (imports, uniform)
}

/// Declares what a view draws first.
pub(super) fn first(graph: &mut Graph, gpu: &Gpu, prefix: &str) -> FirstNodes {
    let (imports, uniform) = imports(graph, prefix);
    let first = graph.import_buffer(format!("{prefix}first"), BufferDesc::new(4));
    let pipeline = gpu.compute_pipeline(&jobs::judge_first::JOB, "choose");
    let mut node = graph.compute(format!("{prefix}choose first"));
    node.group(CULL)
        .read(imports.view)
        .uniform(uniform)
        .storage_read(imports.instances)
        .storage_read(imports.states);
    let written = node.storage_write(first);
    node.run(move |ctx| {
        let groups = groups(&*ctx.get(imports.view)?);
        let binds = [
            Bind::Buffer(0, uniform),
            Bind::Buffer(1, imports.instances),
            Bind::Buffer(2, imports.states),
            Bind::Buffer(3, written),
        ];
        pipeline.dispatch(ctx, &binds, groups)
    });
    FirstNodes { imports, first }
}

/// What the test of a view is declared with.
#[derive(Debug, Clone, Copy)]
pub(super) struct TestDesc {
    pub depth: HostDepth,
    pub size: [u32; 2],
}

/// Declares the test of a view.
pub(super) fn test(
    graph: &mut Graph,
    gpu: &Gpu,
    prefix: &str,
    TestDesc { depth: host, size }: TestDesc,
) -> TestNodes {
    let (imports, uniform) = imports(graph, prefix);
    let [width, height] = size;
    let desc = TextureDesc::new(width, height, host.format).samples(host.samples);
    let depth = graph.import_texture(format!("{prefix}depth"), desc);
    let PyramidNodes { layout, texels } = depth_pyramid(graph, gpu, prefix, (depth, host), size);
    let mask = |graph: &mut Graph, what: &str| {
        graph.import_buffer(format!("{prefix}{what}"), BufferDesc::new(4))
    };
    let first = mask(graph, "first");
    let rest = mask(graph, "rest");
    let hidden = mask(graph, "hidden");
    let job = match host.samples {
        1 => &jobs::judge_one::JOB,
        _ => &jobs::judge_many::JOB,
    };
    let pipeline = gpu.compute_pipeline(job, "test");
    let mut node = graph.compute(format!("{prefix}test"));
    node.group(CULL)
        .read(imports.view)
        .uniform(uniform)
        .storage_read(imports.instances)
        .storage_read(layout)
        .storage_read(texels)
        .storage_read(first)
        .sample(depth);
    let states = node.storage_write(imports.states);
    let written = [rest, hidden].map(|mask| node.storage_write(mask));
    node.run(move |ctx| {
        let groups = groups(&*ctx.get(imports.view)?);
        let [rest, hidden] = written;
        let binds = [
            Bind::Buffer(0, uniform),
            Bind::Buffer(1, imports.instances),
            Bind::Buffer(2, states),
            Bind::Buffer(3, rest),
            Bind::Buffer(4, hidden),
            Bind::Buffer(5, layout),
            Bind::Buffer(6, texels),
            Bind::Texture(7, depth),
            Bind::Buffer(8, first),
        ];
        pipeline.dispatch(ctx, &binds, groups)
    });
    TestNodes {
        imports,
        depth,
        first,
        rest,
        hidden,
    }
}

/// The workgroups for all instances.
fn groups(view: &GpuJudgedView) -> [u32; 2] {
    rows_of(view.count.div_ceil(64))
}
