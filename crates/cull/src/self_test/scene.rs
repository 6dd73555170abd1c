//! The picture on the device: its depth, and what is tested against it. Trials share its pipelines, which are made when the first of them needs one.

use std::cell::OnceCell;

use super::bench::Bench;
use super::picture::{Rect, SIZE, occluders, tested};
use super::raster::{Attachments, DepthUse, RasterDesc, RasterPipeline, Sheets, pass};
use crate::renderer::DEPTH_FORMAT;

/// The picture.
pub(super) struct Scene {
    /// The depth of the occluders, once they are [drawn](Self::draw).
    pub depth: wgpu::TextureView,
    /// Another depth of its size.
    pub scratch: wgpu::TextureView,
    /// What is counted and queried.
    pub tested: Sheets,
    draws: OnceCell<RasterPipeline>,
    /// What is drawn in all samples but the last.
    shutter: OnceCell<RasterPipeline>,
    ids: OnceCell<RasterPipeline>,
}

impl Scene {
    /// Makes textures and buffers.
    pub fn new(bench: &mut Bench<'_>) -> Self {
        let view = |bench: &Bench<'_>| {
            let texture = bench.texture(SIZE, DEPTH_FORMAT, bench.samples);
            texture.create_view(&Default::default())
        };
        let all = tested();
        Self {
            depth: view(bench),
            scratch: view(bench),
            tested: Sheets::new(bench, SIZE, all.iter().map(|(rect, _)| rect)),
            draws: OnceCell::new(),
            shutter: OnceCell::new(),
            ids: OnceCell::new(),
        }
    }

    /// What draws entity ids, with as many samples a pixel as the picture.
    pub fn ids(&self, bench: &Bench<'_>) -> &RasterPipeline {
        self.ids
            .get_or_init(|| RasterPipeline::new(bench.gpu, &RasterDesc::ids(bench.samples)))
    }

    fn draws(&self, bench: &Bench<'_>) -> &RasterPipeline {
        let desc = RasterDesc::depth(DepthUse::Writes, bench.samples);
        self.draws
            .get_or_init(|| RasterPipeline::new(bench.gpu, &desc))
    }

    fn shutter(&self, bench: &Bench<'_>) -> &RasterPipeline {
        let desc = RasterDesc {
            mask: !(1 << (bench.samples - 1)),
            ..RasterDesc::depth(DepthUse::Writes, bench.samples)
        };
        self.shutter
            .get_or_init(|| RasterPipeline::new(bench.gpu, &desc))
    }

    /// Clears the depth and draws the occluders into it.
    pub fn draw(&self, bench: &mut Bench<'_>) {
        let sheets = Sheets::new(bench, SIZE, occluders().iter());
        let shutter = bench.shutter().map(|rect| {
            let sheets = Sheets::new(bench, SIZE, std::iter::once(rect));
            (sheets, self.shutter(bench))
        });
        let pipeline = self.draws(bench);
        let mut pass = pass(&mut bench.encoder, &self.cleared());
        sheets.begin(bench.gpu, &mut pass, pipeline, None);
        sheets.draw(&mut pass);
        if let Some((sheets, pipeline)) = shutter {
            sheets.begin(bench.gpu, &mut pass, pipeline, None);
            sheets.draw(&mut pass);
        }
    }

    /// Draws more sheets into the depth.
    pub fn add(&self, bench: &mut Bench<'_>, sheets: &Sheets) {
        let pipeline = self.draws(bench);
        let into = Attachments {
            clears: false,
            ..self.cleared()
        };
        let mut pass = pass(&mut bench.encoder, &into);
        sheets.begin(bench.gpu, &mut pass, pipeline, None);
        sheets.draw(&mut pass);
    }

    /// Clears the depth and covers all of it with one sheet.
    pub fn cover(&self, bench: &mut Bench<'_>, at: f32) {
        let whole = Rect::new(0..SIZE[0], 0..SIZE[1], at);
        let sheets = Sheets::new(bench, SIZE, std::iter::once(&whole));
        let pipeline = self.draws(bench);
        let mut pass = pass(&mut bench.encoder, &self.cleared());
        sheets.begin(bench.gpu, &mut pass, pipeline, None);
        sheets.draw(&mut pass);
    }

    fn cleared(&self) -> Attachments<'_> {
        Attachments {
            depth: &self.depth,
            clears: true,
            ids: None,
            queries: None,
        }
    }
}
