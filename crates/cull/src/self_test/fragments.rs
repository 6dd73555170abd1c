//! Fragments that count themselves, under a forced early depth test or by comparing depths: before, behind, half behind and at the picture's own depth, and on slopes, where a driver
//! may give a fragment another depth than the one that it has stored (seen with SwiftShader and several samples a pixel: it has the depth of the pixel's middle).

use antumbra_shaders::jobs;

use super::bench::Bench;
use super::picture::{SIZE, slopes, tested};
use super::raster::{Attachments, DepthUse, RasterDesc, RasterPipeline, Sheets, pass};
use super::scene::Scene;
use super::trial::{Answer, Expected, Trial};
use crate::counting::Counting;

/// Records the trial of one of the two ways.
pub(super) fn record(bench: &mut Bench<'_>, scene: &Scene, way: Counting) -> Trial {
    scene.draw(bench);
    let slopes = slopes();
    let sloping = Sheets::new(bench, SIZE, slopes.iter());
    scene.add(bench, &sloping);
    let many = bench.samples > 1;
    let early = way == Counting::Atomics;
    let desc = RasterDesc {
        job: match (early, many) {
            (true, _) => &jobs::count_atomic::JOB,
            (false, true) => &jobs::count_compare_many::JOB,
            (false, false) => &jobs::count_compare::JOB,
        },
        fragment: Some(if many {
            "fragment_of_samples"
        } else {
            "fragment"
        }),
        ..RasterDesc::depth(
            if early {
                DepthUse::Tests
            } else {
                DepthUse::Ignores
            },
            bench.samples,
        )
    };
    let pipeline = RasterPipeline::new(bench.gpu, &desc);
    let into = Attachments {
        depth: if early { &scene.depth } else { &scene.scratch },
        clears: !early,
        ids: None,
        queries: None,
    };
    let mut count = |sheets: &Sheets| {
        let counts = bench.zeroes(sheets.count() as usize);
        let counted = (0, counts.as_entire_binding());
        let depth = (1, wgpu::BindingResource::TextureView(&scene.depth));
        let group = match early {
            true => pipeline.group(bench.gpu, 1, &[counted]),
            false => pipeline.group(bench.gpu, 1, &[counted, depth]),
        };
        let mut pass = pass(&mut bench.encoder, &into);
        sheets.begin(bench.gpu, &mut pass, &pipeline, None);
        pass.set_bind_group(1, group.as_ref(), &[]);
        sheets.draw(&mut pass);
        drop(pass);
        bench.reads(counts)
    };
    let [first, last] = [count(&scene.tested), count(&sloping)];
    let painted = bench.painted();
    let flat = tested().into_iter().map(|(rect, place)| Expected {
        answer: Answer::Number(painted.visible(&rect)),
        place: format!("visible samples of {place}"),
    });
    let samples = bench.samples;
    let sloped = slopes.iter().enumerate().map(|(number, rect)| Expected {
        answer: Answer::Number(rect.area() * samples),
        place: format!("visible samples of slope {number}, at its own depth"),
    });
    Trial {
        expected: flat.chain(sloped).collect(),
        bytes: first.start..last.end,
    }
}
