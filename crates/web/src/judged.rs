//! The judge for renderers of others: boxes before and behind a wall that a depth texture is, in both kinds of phases.

use antumbra_cull::judge::{
    Chosen, DepthRange, DrawBuffers, DrawKind, DrawTemplate, Eye, HostDepth, InstanceDesc,
    Instances, Judge, JudgeDraws, JudgeError, JudgeOptions, JudgeView, Moved, Part, Phases,
};
use antumbra_cull::{Gpu, StageError, read_back};
use antumbra_scene::{Aabb, Camera};
use glam::{DAffine3, DVec3};

use crate::WebError;
use crate::report::Case;
use crate::scenes::{self, World};
use crate::scope::scoped;

/// Width and height of the view in pixels.
const SIZE: [u32; 2] = [161, 117];
/// Boxes along an edge of a cube of boxes, a metre apart.
const BOXES: i32 = 6;
/// The depth of the wall: it is five metres before the eye, whose near plane is at 0.1 m.
const WALL: f32 = 0.02;
/// All of them.
const BOXES_IN_ALL: u32 = (BOXES * BOXES * BOXES) as u32;

/// Judges in both kinds of phases, with one and with four samples a pixel.
pub(crate) async fn cases(gpu: &Gpu) -> Result<Vec<Case>, WebError> {
    let world = scenes::classes()?;
    let mut cases = Vec::new();
    for (phases, name) in [(Phases::Two, "two phases"), (Phases::Late, "a frame late")] {
        for samples in [1, 4] {
            let outcome = match play(gpu, &world, phases, samples).await {
                Ok(outcome) => outcome,
                Err(Fault::Refused(words)) => format!("refused: {words}"),
                Err(Fault::Judge(error)) => format!("not made: {error}"),
                Err(Fault::Device(error)) => return Err(error.into()),
            };
            let name = format!("judge: {name}, {samples} samples");
            cases.push(Case { name, outcome });
        }
    }
    Ok(cases)
}

enum Fault {
    Refused(String),
    Judge(JudgeError),
    Device(StageError),
}

impl From<JudgeError> for Fault {
    fn from(error: JudgeError) -> Self {
        Self::Judge(error)
    }
}

/// What is judged, and where the draws are written.
struct Judged {
    instances: Instances,
    judge: Judge,
    draws: JudgeDraws,
    written: wgpu::Buffer,
    kept: wgpu::Buffer,
    depth: wgpu::Texture,
}

impl Judged {
    fn new(gpu: &Gpu, phases: Phases, samples: u32) -> Result<Self, JudgeError> {
        let depth = HostDepth {
            samples,
            range: DepthRange::Reversed,
            ..HostDepth::default()
        };
        let mut instances = Instances::new(gpu);
        let along = || (0..BOXES).map(|at| f64::from(at) - f64::from(BOXES - 1) * 0.5);
        let places =
            along().flat_map(|x| along().flat_map(move |y| along().map(move |z| (x, y, z))));
        let boxes = places.map(|(x, y, z)| InstanceDesc {
            bounds: Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.3)),
            at: DAffine3::from_translation(DVec3::new(x, y, z)),
            part: Part::Both,
        });
        let boxes = instances.insert_all(&boxes.collect::<Vec<_>>())?;
        let template = DrawTemplate {
            elements: 36,
            first_element: 0,
            base_vertex: 0,
            members: boxes.iter().map(|id| id.index()).collect(),
        };
        let view = JudgeView::main(SIZE[0], SIZE[1], depth);
        let options = JudgeOptions {
            phases,
            ..JudgeOptions::default()
        };
        let buffer = |size: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("draws of a host"),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::INDIRECT
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("depth of a host"),
            size: wgpu::Extent3d {
                width: SIZE[0],
                height: SIZE[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format: depth.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        Ok(Self {
            instances,
            judge: Judge::new(gpu, vec![view], options)?,
            draws: JudgeDraws::new(gpu, DrawKind::Indexed, &[template])?,
            written: buffer(DrawKind::Indexed.bytes()),
            kept: buffer(u64::from(BOXES_IN_ALL) * 4),
            depth: texture,
        })
    }

    /// Records a frame, in which a box moves.
    fn record(
        &mut self,
        number: usize,
        camera: &Camera,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        if let Some(id) = self.instances.at(7) {
            let at = DAffine3::from_translation(DVec3::new(0.0, 0.0, 4.0 - number as f64));
            self.instances.move_all(&[Moved { id, at }])?;
        }
        let eye = Eye::of(camera, SIZE);
        self.judge.begin(&mut self.instances, &[eye], encoder)?;
        drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("a host's wall"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth.create_view(&Default::default()),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(WALL),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        }));
        self.judge.test(&[&self.depth], encoder)?;
        let into = DrawBuffers {
            draws: &self.written,
            kept: &self.kept,
        };
        self.judge
            .write_draws(0, Chosen::First, &self.draws, into, encoder)
    }
}

async fn play(gpu: &Gpu, world: &World, phases: Phases, samples: u32) -> Result<String, Fault> {
    let device = &gpu.device;
    let (judged, refused) = scoped(device, || Judged::new(gpu, phases, samples)).await;
    let mut judged = judged?;
    if let Some(words) = refused {
        return Err(Fault::Refused(words));
    }
    let mut frames = Vec::new();
    for (number, camera) in world.cameras.iter().enumerate() {
        let (recorded, refused) = scoped(device, || {
            let mut encoder = device.create_command_encoder(&Default::default());
            judged.record(number, camera, &mut encoder)?;
            gpu.queue.submit([encoder.finish()]);
            Ok::<(), JudgeError>(())
        })
        .await;
        recorded?;
        if let Some(words) = refused {
            return Err(Fault::Refused(format!("frame {number}: {words}")));
        }
        let drawn = words(gpu, &judged.written).await?;
        let mut counts = Vec::new();
        for chosen in [Chosen::First, Chosen::Rest] {
            let mask = judged.judge.mask(0, chosen);
            let bits = match mask {
                Some(mask) => words(gpu, mask).await?,
                None => Vec::new(),
            };
            counts.push(bits.iter().map(|word| word.count_ones()).sum::<u32>());
        }
        let [first, rest] = counts.as_slice() else {
            continue;
        };
        let written = drawn.get(1).copied().unwrap_or_default();
        frames.push(format!(
            "{first} first, {rest} besides, {written} in its draw"
        ));
    }
    Ok(frames.join("; "))
}

/// The words of a buffer.
async fn words(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u32>, Fault> {
    let bytes = read_back::buffer_async(gpu, buffer).await;
    let bytes = bytes.map_err(|error| Fault::Device(error.into()))?;
    let (words, _) = bytes.as_chunks::<4>();
    Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}
