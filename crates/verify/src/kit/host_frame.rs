//! A host around a stage: its textures, its encoder and its submissions, where the setup asks for them; and what the stage's image or answers are.

use antumbra_cull::{
    DEPTH_FORMAT, Draws, Gpu, ImportedTargets, Stage, StageOptions, StageOutput, StageScene,
    ViewInput, read_back,
};
use antumbra_graph::Mode;

use super::failure::ViolationKind;
use super::setup::Setup;

/// A host's frames.
pub(super) struct HostFrame {
    setup: Setup,
    /// One a view, where the stage draws into the host's.
    targets: Vec<HostTargets>,
}

/// A host's textures for one view.
struct HostTargets {
    colour: wgpu::Texture,
    depth: wgpu::Texture,
    /// The colour with one sample a pixel, where it has several.
    resolved: Option<wgpu::Texture>,
}

impl HostFrame {
    /// For so many views of a size in pixels.
    pub fn new(gpu: &Gpu, setup: Setup, views: usize, size: [u32; 2]) -> Self {
        let drawn_into = setup.mode == Mode::Embedded && setup.output == StageOutput::Image;
        let views = if drawn_into { views } else { 0 };
        Self {
            setup,
            targets: (0..views)
                .map(|_| HostTargets::new(gpu, setup, size))
                .collect(),
        }
    }

    /// Runs a frame of the stage.
    pub fn play(
        &self,
        stage: &mut Stage,
        scene: &dyn StageScene,
        views: &[ViewInput<'_>],
    ) -> Result<(), ViolationKind> {
        if self.setup.mode == Mode::Owned {
            stage.frame(scene, views)?;
            return Ok(());
        }
        let gpu = scene.gpu();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for targets in &self.targets {
            targets.pass(&mut encoder, TargetOps::Clear);
        }
        let targets = self.targets.iter().map(|targets| ImportedTargets {
            colour: &targets.colour,
            depth: &targets.depth,
        });
        let targets = targets.map(Some).chain(std::iter::repeat(None));
        let views: Vec<ViewInput<'_>> = views
            .iter()
            .zip(targets)
            .map(|(view, targets)| ViewInput {
                targets,
                ..view.clone()
            })
            .collect();
        stage.record(scene, &views, &mut encoder)?;
        for targets in &self.targets {
            targets.pass(&mut encoder, TargetOps::Resolve);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        Ok(())
    }

    /// A view's image after the frame: four bytes a pixel, row by row.
    pub fn image(&self, gpu: &Gpu, stage: &Stage, view: usize) -> Result<Vec<u8>, ViolationKind> {
        let own = || stage.colour(view);
        let imported = self.targets.get(view);
        let texture = imported.map(|targets| targets.resolved.as_ref().unwrap_or(&targets.colour));
        let Some(texture) = texture.or_else(own) else {
            return Err(ViolationKind::Failed(format!("view {view} has no image")));
        };
        Ok(read_back::texture(gpu, texture)?)
    }
}

/// What a host does with its targets before the stage draws and after it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TargetOps {
    Clear,
    Resolve,
}

impl HostTargets {
    fn new(gpu: &Gpu, setup: Setup, [width, height]: [u32; 2]) -> Self {
        let texture = |format, samples, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("host's target"),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let format = StageOptions::default().colour_format;
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let read = drawn | wgpu::TextureUsages::COPY_SRC;
        let many = setup.samples > 1;
        // Strategies may read the depth, where the device can.
        let depth = match !many || gpu.reads_drawn_samples() {
            true => drawn | wgpu::TextureUsages::TEXTURE_BINDING,
            false => drawn,
        };
        Self {
            colour: texture(format, setup.samples, if many { drawn } else { read }),
            depth: texture(DEPTH_FORMAT, setup.samples, depth),
            resolved: many.then(|| texture(format, 1, read)),
        }
    }

    /// A pass that draws nothing.
    fn pass(&self, encoder: &mut wgpu::CommandEncoder, ops: TargetOps) {
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let (colour, depth) = (view(&self.colour), view(&self.depth));
        let resolved = self.resolved.as_ref().map(view);
        let clears = ops == TargetOps::Clear;
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &colour,
                depth_slice: None,
                resolve_target: resolved.as_ref().filter(|_| !clears),
                ops: wgpu::Operations {
                    load: match clears {
                        true => wgpu::LoadOp::Clear(StageOptions::default().background),
                        false => wgpu::LoadOp::Load,
                    },
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: match clears {
                        true => wgpu::LoadOp::Clear(0.0),
                        false => wgpu::LoadOp::Load,
                    },
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
    }
}

/// The slots that a view's answers draw, in order. An entity may be drawn twice: once as seen in the last frame, once as found in this.
pub(super) fn listed(gpu: &Gpu, stage: &Stage, view: usize) -> Result<Vec<u32>, ViolationKind> {
    let words = |buffer: &wgpu::Buffer| -> Result<Vec<u32>, ViolationKind> {
        let bytes = read_back::buffer(gpu, buffer)?;
        Ok(bytes
            .as_chunks::<4>()
            .0
            .iter()
            .map(|word| u32::from_le_bytes(*word))
            .collect())
    };
    let failed = |what: &str| ViolationKind::Failed(format!("view {view}: {what}"));
    let mut found = Vec::new();
    for draws in stage.draws(view) {
        match draws {
            Draws::List { list, slots } => {
                let on_device = words(slots)?;
                if on_device.get(..list.slots().len()) != Some(list.slots()) {
                    return Err(failed("a list's slots on the device are others"));
                }
                found.extend_from_slice(list.slots());
            }
            Draws::Indirect {
                layout,
                slots,
                draws,
            } => {
                let (slots, draws) = (words(slots)?, words(draws)?);
                for ([_, count, _, _, first], run) in
                    draws.as_chunks::<5>().0.iter().zip(layout.runs())
                {
                    let kept = *first as usize..(*first + *count) as usize;
                    let kept = slots
                        .get(kept)
                        .filter(|_| *count <= run.count && *first == run.first);
                    let Some(kept) = kept else {
                        return Err(failed("an indirect draw is not within its run"));
                    };
                    found.extend_from_slice(kept);
                }
            }
        }
    }
    Ok(found)
}
