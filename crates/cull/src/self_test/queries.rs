//! Hardware occlusion queries, around meshes and around boxes: before, behind, half behind and at the picture's own depth, and outside of the view.

use super::bench::Bench;
use super::picture::{Rect, tested};
use super::raster::{Attachments, DepthUse, QUAD_INDICES, RasterDesc, RasterPipeline, pass};
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::boxes::{BoxPipeline, BoxPurpose, GpuBox};

/// Bytes of a query's result.
const RESULT_BYTES: u64 = 8;
/// Depth of the boxes, from their near faces on.
const DEEP: f32 = 1.0 / 64.0;

/// Records the trial.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene) -> Trial {
    scene.draw(bench);
    let all = tested();
    let queried = all.len() as u32;
    let queries = bench
        .gpu
        .device
        .create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("self-test"),
            ty: wgpu::QueryType::Occlusion,
            count: queried * 2,
        });
    let meshes = RasterPipeline::new(
        bench.gpu,
        &RasterDesc::depth(DepthUse::Tests, bench.samples),
    );
    let boxes = bench.gpu.box_pipeline(bench.samples, BoxPurpose::Query);
    let solids: Vec<GpuBox> = all
        .iter()
        .map(|(rect, _)| {
            let [centre, half @ ..] = rect.solid(DEEP);
            GpuBox::new(centre, half)
        })
        .collect();
    let solids = bench.buffer(&solids, wgpu::BufferUsages::VERTEX);
    let view = boxes.group(bench.gpu, &scene.tested.view);
    let into = Attachments {
        depth: &scene.depth,
        clears: false,
        ids: None,
        queries: Some(&queries),
    };
    let mut pass = pass(&mut bench.encoder, &into);
    scene.tested.begin(bench.gpu, &mut pass, &meshes, None);
    for number in 0..queried {
        pass.begin_occlusion_query(number);
        pass.draw_indexed(0..QUAD_INDICES, 0, number..number + 1);
        pass.end_occlusion_query();
    }
    boxes.begin(&mut pass, &view, &solids);
    for number in 0..queried {
        pass.begin_occlusion_query(queried + number);
        pass.draw(0..BoxPipeline::VERTICES, number..number + 1);
        pass.end_occlusion_query();
    }
    drop(pass);
    let results = bench.gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("self-test"),
        size: u64::from(queried) * 2 * RESULT_BYTES,
        usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    bench
        .encoder
        .resolve_query_set(&queries, 0..queried * 2, &results, 0);
    let painted = bench.painted();
    let answer = |rect: &Rect| Answer::Samples(painted.visible(rect) > 0);
    let expected = ["mesh", "box"].into_iter().flat_map(|geometry| {
        all.iter()
            .map(move |(rect, place)| (rect, format!("a query around the {geometry} of {place}")))
    });
    Trial {
        expected: expected
            .map(|(rect, place)| Expected {
                answer: answer(rect),
                place,
            })
            .collect(),
        bytes: bench.reads(results),
    }
}
