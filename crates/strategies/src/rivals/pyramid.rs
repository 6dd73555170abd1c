//! The depth pyramids of rivals: how large each level is, and what a texel of the first level is made of. Every further level is made by the same reduction.

use antumbra_cull::{CULL, FrameGraph, ViewNodes, rows_of};
use antumbra_graph::{Bind, Buffer, BufferDesc};
use antumbra_shaders::{Job, assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

/// Mirrors `Pyramid` of `shared/pyramid.wgsl`, with level 0 among the texels that are kept.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuPyramid {
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

assert_layout!(GpuPyramid, "rival_pyramid_one", "Pyramid", { width, height, samples, towards, count, padding_a, padding_b, padding_c, levels });

/// Levels of the largest image, 32,768 pixels a side.
const MOST_LEVELS: usize = 16;
/// One workgroup makes the first level of at most this many texels, and all after it.
const FEW_TEXELS: u32 = 4096;
/// Between the ranges of levels in their buffer: the coarsest alignment that a device may ask for.
const RANGE_STRIDE: u64 = 256;

/// How a pyramid is made.
#[derive(Debug, Clone, Copy)]
pub(super) struct PyramidRule {
    /// Width and height of level 0 for an image of so many pixels.
    first: fn([u32; 2]) -> [u32; 2],
    /// The entry point that makes level 0.
    entry: &'static str,
    /// A side of the next level.
    next: fn(u32) -> u32,
    /// How many levels there are; `None`: up to one of a single texel.
    most: Option<usize>,
}

impl PyramidRule {
    /// Bevy: half the next power of two, by gathers from an enlarged image; at most twelve levels.
    pub const ENLARGED: Self = Self {
        first: |size| size.map(|side| 1 << side.max(1).ilog2()),
        entry: "enlarged",
        next: |side| (side / 2).max(1),
        most: Some(12),
    };
    /// niagara: the largest power of two below the image's side, by one sample a texel.
    pub const SAMPLED: Self = Self {
        first: |size| size.map(|side| side.max(2).next_power_of_two() / 2),
        entry: "sampled",
        next: |side| (side / 2).max(1),
        most: None,
    };
    /// Helio: the image itself, and halves that are rounded down.
    pub const ROUNDED_DOWN: Self = Self {
        first: |size| size,
        entry: "copied",
        next: |side| (side / 2).max(1),
        most: None,
    };
    /// Unity: an eighth of the image, and halves that are rounded up; eight levels.
    pub const EIGHTHS: Self = Self {
        first: |size| size.map(|side| side.div_ceil(8).max(1)),
        entry: "in_eighths",
        next: |side| side.div_ceil(2),
        most: Some(8),
    };
    /// vk_lod_clusters: a square of a power of two that holds half the image.
    pub const SQUARE: Self = Self {
        first: |[width, height]| [(width.max(height) / 2).max(1).next_power_of_two(); 2],
        entry: "halved",
        next: |side| (side / 2).max(1),
        most: None,
    };

    fn layout(&self, [width, height]: [u32; 2], samples: u32) -> GpuPyramid {
        let mut levels = [[0; 4]; MOST_LEVELS];
        let (mut size, mut count, mut texels) = ((self.first)([width, height]), 0, 0);
        for place in levels.iter_mut().take(self.most.unwrap_or(MOST_LEVELS)) {
            let [wide, high] = size;
            *place = [texels, wide, high, 0];
            texels += wide * high;
            count += 1;
            if self.most.is_none() && size == [1, 1] {
                break;
            }
            size = size.map(self.next);
        }
        GpuPyramid {
            width,
            height,
            samples,
            towards: 1.0,
            count,
            padding_a: 0,
            padding_b: 0,
            padding_c: 0,
            levels,
        }
    }
}

impl GpuPyramid {
    fn level(&self, level: u32) -> [u32; 2] {
        let place = self.levels.get(level as usize).copied();
        place.map_or([0; 2], |[_, wide, high, _]| [wide, high])
    }

    /// The texels of all levels.
    fn desc(&self) -> BufferDesc {
        let areas = self
            .levels
            .iter()
            .map(|place| u64::from(place[1]) * u64::from(place[2]));
        BufferDesc::new(areas.sum::<u64>() * 4)
    }

    /// The levels after the first in the parts that a node makes: the first level of each and the one after its last.
    fn parts(&self) -> Vec<[u32; 2]> {
        let mut parts = Vec::new();
        let mut level = 1;
        while level < self.count {
            let [wide, high] = self.level(level);
            let end = if wide * high <= FEW_TEXELS {
                self.count
            } else {
                level + 1
            };
            parts.push([level, end]);
            level = end;
        }
        parts
    }
}

/// A rival's pyramid of a view, before it is made.
#[derive(Debug, Clone)]
pub(super) struct Pyramid {
    made: GpuPyramid,
    entry: &'static str,
    /// Where the levels lie, uploaded.
    pub layout: Buffer,
    /// The parts that nodes make, [`RANGE_STRIDE`] apart, uploaded.
    ranges: Buffer,
    /// The texels of this frame's finished depth, for the next frame.
    pub kept: Buffer,
}

impl Pyramid {
    pub fn new(g: &mut FrameGraph<'_>, view: &ViewNodes, rule: PyramidRule) -> Self {
        let made = rule.layout(view.size(), g.samples());
        let parts = made.parts();
        let graph = g.graph();
        let layout = BufferDesc::new(size_of::<GpuPyramid>() as u64);
        let layout = graph.buffer(view.named("pyramid: levels"), layout);
        let ranges = BufferDesc::new(RANGE_STRIDE * parts.len().max(1) as u64);
        let ranges = graph.buffer(view.named("pyramid: parts"), ranges);
        let kept = graph.buffer(view.named("kept pyramid"), made.desc());
        let mut node = graph.host_node(view.named("lay out pyramid"));
        node.group(CULL);
        let layout = node.upload(layout);
        let ranges = node.upload(ranges);
        node.run(move |ctx| {
            ctx.upload(layout, 0, bytemuck::bytes_of(&made))?;
            for (part, at) in parts.iter().zip((0..).step_by(RANGE_STRIDE as usize)) {
                ctx.upload(ranges, at, bytemuck::bytes_of(part))?;
            }
            Ok(())
        });
        Self {
            made,
            entry: rule.entry,
            layout,
            ranges,
            kept,
        }
    }

    /// Makes a pyramid of the view's depth so far, for this frame. Returns its texels.
    pub fn make(&self, g: &mut FrameGraph<'_>, view: &ViewNodes) -> Buffer {
        let texels = g.graph().buffer(view.named("pyramid"), self.made.desc());
        self.make_into(g, view, "this", texels)
    }

    /// Makes the pyramid that the next frame reads, of the view's depth so far.
    pub fn keep(&self, g: &mut FrameGraph<'_>, view: &ViewNodes) {
        self.make_into(g, view, "kept", self.kept);
    }

    fn make_into(
        &self,
        g: &mut FrameGraph<'_>,
        view: &ViewNodes,
        which: &str,
        into: Buffer,
    ) -> Buffer {
        let (layout, ranges, depth) = (self.layout, self.ranges, view.targets.depth);
        let job: &Job = match self.made.samples {
            1 => &jobs::rival_pyramid_one::JOB,
            _ => &jobs::rival_pyramid_many::JOB,
        };
        let pipeline = g.compute_pipeline(job, self.entry);
        let mut node = g
            .graph()
            .compute(view.named(&format!("{which} pyramid: first level")));
        node.group(CULL).storage_read(layout).sample(depth);
        let mut texels = node.storage_write(into);
        let groups = self.made.level(0).map(|side| side.div_ceil(8));
        node.run(move |ctx| {
            let binds = [
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
                Bind::Texture(7, depth),
            ];
            pipeline.dispatch(ctx, &binds, groups)
        });
        for (part, at) in self
            .made
            .parts()
            .into_iter()
            .zip((0..).step_by(RANGE_STRIDE as usize))
        {
            let [level, end] = part;
            let [wide, high] = self.made.level(level);
            let (entry, groups) = match end - level {
                1 => ("level", rows_of((wide * high).div_ceil(64))),
                _ => ("levels", [1, 1]),
            };
            let pipeline = g.compute_pipeline(&jobs::rival_pyramid_rest::JOB, entry);
            let mut node = g
                .graph()
                .compute(view.named(&format!("{which} pyramid: level {level}")));
            node.group(CULL).storage_read(layout).storage_read(ranges);
            let next = node.storage_write(texels);
            node.run(move |ctx| {
                let binds = [
                    Bind::BufferRange(0, ranges, at..at + 8),
                    Bind::Buffer(5, layout),
                    Bind::Buffer(6, next),
                ];
                pipeline.dispatch(ctx, &binds, groups)
            });
            texels = next;
        }
        texels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(rule: PyramidRule, size: [u32; 2]) -> Vec<[u32; 2]> {
        let made = rule.layout(size, 1);
        (0..made.count).map(|level| made.level(level)).collect()
    }

    #[test]
    fn first_levels_are_as_large_as_theirs() {
        let first = |rule, size| sizes(rule, size)[0];
        // Widths of the table in what was read of niagara and Bevy.
        for (width, niagara, bevy) in [
            (1024, 512, 1024),
            (1080, 1024, 1024),
            (1920, 1024, 1024),
            (3840, 2048, 2048),
        ] {
            assert_eq!(first(PyramidRule::SAMPLED, [width, 16])[0], niagara);
            assert_eq!(first(PyramidRule::ENLARGED, [width, 16])[0], bevy);
        }
        assert_eq!(first(PyramidRule::EIGHTHS, [1366, 768]), [171, 96]);
        assert_eq!(first(PyramidRule::SQUARE, [1920, 1080]), [1024, 1024]);
    }

    #[test]
    fn odd_levels_are_where_they_were_found() {
        let odd = |size: u32| {
            let levels = sizes(PyramidRule::ROUNDED_DOWN, [size, 1]);
            let odd = levels
                .iter()
                .zip(0..)
                .filter(|([side, _], _)| side % 2 == 1 && *side > 1);
            odd.map(|(_, level)| level).collect::<Vec<u32>>()
        };
        assert_eq!(odd(1920), [7, 8, 9]);
        assert_eq!(odd(1080), [3, 4, 5]);
        assert_eq!(odd(1440), [5, 7, 8]);
        assert_eq!(odd(1366), [1, 2, 4, 6, 8]);
        assert!(odd(1024).is_empty());
    }

    #[test]
    fn every_level_after_the_first_is_made_once() {
        for size in [[1, 1], [640, 480], [1281, 717], [8192, 8192]] {
            for rule in [
                PyramidRule::ENLARGED,
                PyramidRule::SAMPLED,
                PyramidRule::ROUNDED_DOWN,
                PyramidRule::EIGHTHS,
                PyramidRule::SQUARE,
            ] {
                let made = rule.layout(size, 1);
                let levels = made.parts().into_iter().flat_map(|[level, end]| level..end);
                assert!(levels.eq(1..made.count), "{size:?}");
            }
        }
    }
}
