//! Entity ids, drawn and then counted by a histogram: each rectangle owns the samples that it was drawn into last.

use antumbra_shaders::jobs;

use super::bench::Bench;
use super::picture::{SIZE, owned, tested};
use super::raster::{Attachments, pass};
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::compute_pipeline::rows_of;
use crate::renderer::IDENTITY_FORMAT;

/// Records the trial.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene) -> Trial {
    let samples = bench.samples;
    let ids = bench.texture(SIZE, IDENTITY_FORMAT, samples);
    let ids = ids.create_view(&Default::default());
    let pipeline = scene.ids(bench);
    let into = Attachments {
        depth: &scene.scratch,
        clears: true,
        ids: Some(&ids),
        queries: None,
    };
    let mut pass = pass(&mut bench.encoder, &into);
    scene.tested.begin(bench.gpu, &mut pass, pipeline, None);
    scene.tested.draw(&mut pass);
    drop(pass);

    let job = match samples {
        1 => &jobs::histogram_one::JOB,
        _ => &jobs::histogram_many::JOB,
    };
    let histogram = bench.gpu.compute_pipeline(job, "count");
    let counts = bench.zeroes(scene.tested.count() as usize);
    let binds = [
        (0, wgpu::BindingResource::TextureView(&ids)),
        (1, counts.as_entire_binding()),
    ];
    let group = histogram.group_of(bench.gpu, &binds);
    let [width, height] = SIZE;
    // As in `FrameGraph::histogram`.
    let [wide, rows] = rows_of((width.div_ceil(16) * height).div_ceil(64));
    let mut pass = bench.encoder.begin_compute_pass(&Default::default());
    histogram.dispatch_in(&mut pass, &group, [wide, rows, samples]);
    drop(pass);

    let all = tested();
    let owned = owned(all.iter().map(|(rect, _)| rect));
    let expected = all.iter().zip(owned).map(|((_, place), pixels)| Expected {
        answer: Answer::Number(pixels * samples),
        place: format!("samples with the id of {place}"),
    });
    Trial {
        expected: expected.collect(),
        bytes: bench.reads(counts),
    }
}
