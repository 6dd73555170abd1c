//! The depth pyramid of a view: for each block of 2^level x 2^level pixels, the nearness of its farthest sample. Two dispatches make it, at any size.
//!
//! A texel stands for its block exactly. (Greene, Kass, Miller, *Hierarchical Z-Buffer Visibility*, 1993.)

#[cfg(test)]
mod exactness;

use antumbra_graph::{Bind, Buffer, BufferDesc, Graph, Texture};
use antumbra_shaders::{Job, assert_layout, jobs};
use bytemuck::{Pod, Zeroable};
use std::sync::Arc;

use super::depth::HostDepth;
use crate::compute_pipeline::ComputePipeline;
use crate::device::Gpu;
use crate::frame_graph::CULL;

/// Mirrors `Pyramid` of `shared/pyramid.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct GpuPyramid {
    width: u32,
    height: u32,
    samples: u32,
    towards: f32,
    count: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
    levels: [[u32; 4]; MOST_LEVELS],
}

assert_layout!(GpuPyramid, "pyramid_one", "Pyramid", { width, height, samples, towards, count, padding_a, padding_b, padding_c, levels });

/// Levels of the largest image, 32,768 pixels a side.
const MOST_LEVELS: usize = 16;
/// The levels below this are not kept.
pub(crate) const FIRST_KEPT: u32 = 2;

impl GpuPyramid {
    /// Where the levels of an image of this size lie.
    pub fn new([width, height]: [u32; 2], depth: HostDepth) -> Self {
        let mut levels = [[0; 4]; MOST_LEVELS];
        let mut count = 0;
        let mut texels = 0;
        for (place, level) in levels.iter_mut().zip(0u32..) {
            let side = |pixels: u32| pixels.div_ceil(1 << level);
            let (wide, high) = (side(width), side(height));
            *place = [texels, wide, high, 0];
            if level >= FIRST_KEPT {
                texels += wide * high;
            }
            count = level + 1;
            if wide * high <= 1 && level >= FIRST_KEPT {
                break;
            }
        }
        Self {
            width,
            height,
            samples: depth.samples,
            towards: depth.range.towards(),
            count,
            padding_a: 0,
            padding_b: 0,
            padding_c: 0,
            levels,
        }
    }

    /// Number of levels, those that are not kept included.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Number of texels of all levels that are kept.
    pub fn texels(&self) -> u64 {
        let kept = self.levels.iter().skip(FIRST_KEPT as usize);
        kept.map(|[_, wide, high, _]| u64::from(*wide) * u64::from(*high))
            .sum()
    }
}

/// A pyramid in the graph.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PyramidNodes {
    /// [`GpuPyramid`], uploaded.
    pub layout: Buffer,
    /// The texels.
    pub texels: Buffer,
}

/// Adds the nodes that make the pyramid of a depth.
pub(crate) fn depth_pyramid(
    graph: &mut Graph,
    gpu: &Gpu,
    prefix: &str,
    depth: (Texture, HostDepth),
    size: [u32; 2],
) -> PyramidNodes {
    let declared = declare_pyramid(graph, prefix, depth.1, size);
    fill_pyramid(graph, gpu, prefix, depth, size, declared)
}

/// Adds the node that lays a pyramid out. Its texels are not written yet; those of the last frame can be read.
pub(crate) fn declare_pyramid(
    graph: &mut Graph,
    prefix: &str,
    host: HostDepth,
    size: [u32; 2],
) -> PyramidNodes {
    let made = GpuPyramid::new(size, host);
    let layout = BufferDesc::new(size_of::<GpuPyramid>() as u64);
    let layout = graph.buffer(format!("{prefix}pyramid: levels"), layout);
    let mut node = graph.host_node(format!("{prefix}lay out pyramid"));
    node.group(CULL);
    let layout = node.upload(layout);
    node.run(move |ctx| Ok(ctx.upload(layout, 0, bytemuck::bytes_of(&made))?));

    let texels = graph.buffer(
        format!("{prefix}pyramid"),
        BufferDesc::new(made.texels() * 4),
    );
    PyramidNodes { layout, texels }
}

/// Adds the nodes that make a declared pyramid of a depth.
pub(crate) fn fill_pyramid(
    graph: &mut Graph,
    gpu: &Gpu,
    prefix: &str,
    (texture, host): (Texture, HostDepth),
    size: [u32; 2],
    PyramidNodes { layout, texels }: PyramidNodes,
) -> PyramidNodes {
    let made = GpuPyramid::new(size, host);
    let reduce = gpu.compute_pipeline(first_levels(host), "reduce");
    let mut node = graph.compute(format!("{prefix}first levels"));
    node.group(CULL).storage_read(layout).sample(texture);
    let texels = node.storage_write(texels);
    let groups = size.map(|side| side.div_ceil(32));
    node.run(move |ctx| {
        let binds = [
            Bind::Buffer(5, layout),
            Bind::Buffer(6, texels),
            Bind::Texture(7, texture),
        ];
        reduce.dispatch(ctx, &binds, groups)
    });
    if made.count <= 6 {
        return PyramidNodes { layout, texels };
    }
    let texels = rest(
        graph,
        gpu.compute_pipeline(&jobs::pyramid_rest::JOB, "rest"),
        prefix,
        layout,
        texels,
    );
    PyramidNodes { layout, texels }
}

/// Adds the node that makes the levels from 6 on.
fn rest(
    graph: &mut Graph,
    pipeline: Arc<ComputePipeline>,
    prefix: &str,
    layout: Buffer,
    texels: Buffer,
) -> Buffer {
    let mut node = graph.compute(format!("{prefix}last levels"));
    node.group(CULL).storage_read(layout);
    let texels = node.storage_write(texels);
    node.run(move |ctx| {
        let binds = [Bind::Buffer(5, layout), Bind::Buffer(6, texels)];
        pipeline.dispatch(ctx, &binds, [1, 1])
    });
    texels
}

/// The shader that makes the first levels.
pub(crate) fn first_levels(depth: HostDepth) -> &'static Job {
    match depth.samples {
        1 => &jobs::pyramid_one::JOB,
        _ => &jobs::pyramid_many::JOB,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_has_its_place_and_the_last_is_one_texel() {
        let sides = [
            1, 2, 3, 4, 5, 7, 31, 32, 33, 100, 1080, 1280, 4095, 4096, 8191, 32_768,
        ];
        for (width, height) in sides.iter().flat_map(|w| sides.map(|h| (*w, h))) {
            let made = GpuPyramid::new([width, height], HostDepth::default());
            let count = made.count as usize;
            let mut next = 0;
            for (level, [first, wide, high, _]) in
                (0u32..).zip(made.levels.iter().take(count).copied())
            {
                assert_eq!(
                    [wide, high],
                    [width, height].map(|side| side.div_ceil(1 << level))
                );
                if level >= FIRST_KEPT {
                    assert_eq!(first, next, "{width} x {height}, level {level}");
                    next += wide * high;
                }
            }
            assert_eq!(u64::from(next), made.texels());
            assert_eq!(made.levels[count - 1][1..3], [1, 1], "{width} x {height}");
        }
    }
}
