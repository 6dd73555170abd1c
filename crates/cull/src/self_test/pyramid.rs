//! The depth pyramid, made twice into the same memory: of a near sheet over everything, and then of the picture. Every texel of every level is compared with the
//! farthest sample of its block, so that a level that was not written again, or that lies beside its place, is found.

use super::bench::Bench;
use super::picture::SIZE;
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::judge::{FIRST_KEPT, GpuPyramid, HostDepth, first_levels};
use antumbra_shaders::jobs;

/// A pyramid on the device.
pub(super) struct Pyramid {
    made: GpuPyramid,
    pub layout: wgpu::Buffer,
    pub texels: wgpu::Buffer,
}

/// The depth that the first, near picture has everywhere.
const NEAR: f32 = 0.9375;

/// Records the trial.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene) -> Trial {
    let Pyramid { made, texels, .. } = make(bench, scene);
    Trial {
        expected: expected(&made, bench.painted().farthest()),
        bytes: bench.reads(texels),
    }
}

/// Makes the pyramid of another picture, and then that of the scene's into the same memory.
pub(super) fn make(bench: &mut Bench<'_>, scene: &Scene) -> Pyramid {
    let host = HostDepth {
        samples: bench.samples,
        ..HostDepth::default()
    };
    let made = GpuPyramid::new(SIZE, host);
    let layout = bench.buffer(&[made], wgpu::BufferUsages::STORAGE);
    let texels = bench.zeroes(made.texels() as usize);
    let reduce = bench.gpu.compute_pipeline(first_levels(host), "reduce");
    let rest = bench.gpu.compute_pipeline(&jobs::pyramid_rest::JOB, "rest");
    let buffers = [
        (5, layout.as_entire_binding()),
        (6, texels.as_entire_binding()),
    ];
    let depth = (7, wgpu::BindingResource::TextureView(&scene.depth));
    let [levels, place] = buffers.clone();
    let first_group = reduce.group_of(bench.gpu, &[levels, place, depth]);
    let rest_group = rest.group_of(bench.gpu, &buffers);
    for is_picture in [false, true] {
        match is_picture {
            true => scene.draw(bench),
            false => scene.cover(bench, NEAR),
        }
        let [wide, rows] = SIZE.map(|side| side.div_ceil(32));
        for (pipeline, group, groups) in [
            (&reduce, &first_group, [wide, rows, 1]),
            (&rest, &rest_group, [1, 1, 1]),
        ] {
            let mut pass = bench.encoder.begin_compute_pass(&Default::default());
            pipeline.dispatch_in(&mut pass, group, groups);
        }
    }
    Pyramid {
        made,
        layout,
        texels,
    }
}

/// The texels of all levels that are kept, each level from the one below.
fn expected(made: &GpuPyramid, mut below: Vec<f32>) -> Vec<Expected> {
    let [mut wide, mut high] = SIZE.map(|side| side as usize);
    let mut all = Vec::new();
    for level in 1..made.count() {
        let (columns, rows) = (wide.div_ceil(2), high.div_ceil(2));
        let mut least = vec![f32::INFINITY; columns * rows];
        for (at, depth) in below.iter().enumerate() {
            if let Some(least) = least.get_mut(at / wide / 2 * columns + at % wide / 2) {
                *least = least.min(*depth);
            }
        }
        (below, wide, high) = (least, columns, rows);
        if level >= FIRST_KEPT {
            all.extend(below.iter().enumerate().map(|(at, depth)| Expected {
                answer: Answer::Depth(*depth),
                place: format!("level {level}, column {}, row {}", at % wide, at / wide),
            }));
        }
    }
    all
}
