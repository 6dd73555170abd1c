//! A host's indirect draws, written by the GPU from masks.

use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use super::error::JudgeError;
use crate::compute_pipeline::{ComputePipeline, rows_of};
use crate::device::Gpu;

/// What kind of draws a host makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DrawKind {
    /// Indexed: five words each, as `draw_indexed_indirect` takes them.
    Indexed,
    /// Of vertices: four words each, as `draw_indirect` takes them.
    Vertices,
}

impl DrawKind {
    /// Bytes of a draw.
    pub const fn bytes(self) -> u64 {
        match self {
            Self::Indexed => 20,
            Self::Vertices => 16,
        }
    }
}

/// A draw of several instances of one mesh, before it is known which of them are drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawTemplate {
    /// Indices, or vertices, of the mesh.
    pub elements: u32,
    /// The first index, or vertex.
    pub first_element: u32,
    /// Added to every index.
    pub base_vertex: i32,
    /// The [indices](super::InstanceId::index) of its instances.
    pub members: Vec<u32>,
}

/// Where a host's draws are written.
#[derive(Debug, Clone, Copy)]
pub struct DrawBuffers<'a> {
    /// The draws, one a template, in order. Usages `STORAGE` and `INDIRECT`.
    pub draws: &'a wgpu::Buffer,
    /// The indices of the instances that are drawn, a u32 each: those of a draw begin at its first instance. Usages `STORAGE` and what the host reads them as, mostly `VERTEX`.
    pub kept: &'a wgpu::Buffer,
}

/// Draw templates on the device.
#[derive(Debug)]
pub struct JudgeDraws {
    gpu: Gpu,
    kind: DrawKind,
    count: u32,
    members: u32,
    /// Members of the largest draw.
    largest: u32,
    few: ComputePipeline,
    many: ComputePipeline,
    settings: wgpu::Buffer,
    templates: wgpu::Buffer,
    indices: wgpu::Buffer,
}

/// Mirrors `DrawTemplate` of `judge_draws.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuTemplate {
    elements: u32,
    first_element: u32,
    base_vertex: i32,
    first_member: u32,
    members: u32,
}

/// Mirrors `Settings` of `judge_draws.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuDrawSettings {
    count: u32,
    words: u32,
    padding_a: u32,
    padding_b: u32,
}

assert_layout!(GpuTemplate, "judge_draws", "DrawTemplate", { elements, first_element, base_vertex, first_member, members });
assert_layout!(GpuDrawSettings, "judge_draws", "Settings", { count, words, padding_a, padding_b });

impl JudgeDraws {
    /// Uploads templates.
    ///
    /// # Errors
    /// [`JudgeError::Buffer`] where they do not fit the device's buffers, [`JudgeError::Device`] for several on a device without [`wgpu::Features::INDIRECT_FIRST_INSTANCE`]: all but the first
    /// would draw nothing.
    pub fn new(gpu: &Gpu, kind: DrawKind, templates: &[DrawTemplate]) -> Result<Self, JudgeError> {
        let job = &jobs::judge_draws::JOB;
        let mut made = Self {
            gpu: gpu.clone(),
            kind,
            count: 0,
            members: 0,
            largest: 0,
            few: ComputePipeline::new(gpu, job, "few"),
            many: ComputePipeline::new(gpu, job, "many"),
            settings: upload(gpu, "draw settings", &[]),
            templates: upload(gpu, "draw templates", &[]),
            indices: upload(gpu, "members of draws", &[]),
        };
        made.set(templates)?;
        Ok(made)
    }

    /// Takes other templates, when an index has got an instance of another mesh. What encoders have recorded so far keeps the ones before. A member that is removed need not be taken
    /// out: its bit is not set.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn set(&mut self, templates: &[DrawTemplate]) -> Result<(), JudgeError> {
        let device = &self.gpu.device;
        let needs = wgpu::Features::INDIRECT_FIRST_INSTANCE;
        if templates.len() > 1 && !device.features().contains(needs) {
            return Err(JudgeError::Device(
                "INDIRECT_FIRST_INSTANCE, without which all draws but the first draw nothing: enable the feature, or give each draw a `JudgeDraws` of its own",
            ));
        }
        let members = templates.iter().map(|template| template.members.len());
        let [members, largest] = [members.clone().sum(), members.max().unwrap_or(0)];
        let bytes = (members as u64 * 4).max(templates.len() as u64 * TEMPLATE_BYTES);
        let most = device.limits().max_storage_buffer_binding_size;
        if bytes > most.min(u64::from(u32::MAX)) {
            return Err(JudgeError::Buffer {
                buffer: "draw templates",
                why: format!(
                    "would need {bytes} bytes, and this device binds {most} at most: split the draws"
                ),
            });
        }
        let mut indices = Vec::with_capacity(members);
        let on_gpu: Vec<GpuTemplate> = templates
            .iter()
            .map(|template| {
                let first_member = indices.len() as u32;
                indices.extend_from_slice(&template.members);
                GpuTemplate {
                    elements: template.elements,
                    first_element: template.first_element,
                    base_vertex: template.base_vertex,
                    first_member,
                    members: template.members.len() as u32,
                }
            })
            .collect();
        let settings = GpuDrawSettings {
            count: templates.len() as u32,
            words: (self.kind.bytes() / 4) as u32,
            padding_a: 0,
            padding_b: 0,
        };
        self.count = settings.count;
        (self.members, self.largest) = (members as u32, largest as u32);
        let gpu = &self.gpu;
        self.settings = upload(gpu, "draw settings", bytemuck::bytes_of(&settings));
        self.templates = upload(gpu, "draw templates", bytemuck::cast_slice(&on_gpu));
        self.indices = upload(gpu, "members of draws", bytemuck::cast_slice(&indices));
        Ok(())
    }

    /// Number of draws.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Bytes that [`DrawBuffers::draws`] needs.
    pub fn draw_bytes(&self) -> u64 {
        u64::from(self.count.max(1)) * self.kind.bytes()
    }

    /// Bytes that [`DrawBuffers::kept`] needs.
    pub fn kept_bytes(&self) -> u64 {
        u64::from(self.members.max(1)) * 4
    }

    pub(super) fn write(
        &self,
        mask: &wgpu::Buffer,
        into: DrawBuffers<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        let most = self.gpu.device.limits().max_storage_buffer_binding_size;
        let storage = wgpu::BufferUsages::STORAGE;
        let indirect = storage | wgpu::BufferUsages::INDIRECT;
        check("draws", into.draws, self.draw_bytes()..=most, indirect)?;
        check("kept", into.kept, self.kept_bytes()..=most, storage)?;
        if into.draws == into.kept {
            return Err(JudgeError::Buffer {
                buffer: "kept",
                why: "is that of the draws: give two".to_owned(),
            });
        }
        if self.count == 0 {
            return Ok(());
        }
        // A thread a draw, or, where one has many members, a workgroup.
        let (pipeline, groups) = match self.largest {
            0..64 => (&self.few, self.count.div_ceil(64)),
            _ => (&self.many, self.count),
        };
        let group = pipeline.group(
            &self.gpu,
            &[
                &self.settings,
                &self.templates,
                &self.indices,
                mask,
                into.draws,
                into.kept,
            ],
        );
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("write draws"),
            timestamp_writes: None,
        });
        let [wide, rows] = rows_of(groups);
        pipeline.dispatch_in(&mut pass, &group, [wide, rows, 1]);
        Ok(())
    }
}

/// Bytes of a template on the device.
const TEMPLATE_BYTES: u64 = size_of::<GpuTemplate>() as u64;

/// Refuses a buffer of the host's that is too small, too large to be bound, or that lacks a usage.
fn check(
    name: &'static str,
    buffer: &wgpu::Buffer,
    bytes: std::ops::RangeInclusive<u64>,
    usages: wgpu::BufferUsages,
) -> Result<(), JudgeError> {
    let fault = |why: String| Err(JudgeError::Buffer { buffer: name, why });
    if buffer.size() < *bytes.start() {
        return fault(format!(
            "has {} bytes, and {} are written: make it larger",
            buffer.size(),
            bytes.start()
        ));
    }
    if buffer.size() > *bytes.end() {
        return fault(format!(
            "has {} bytes, and this device binds {} at most: ask the device for more, or split the draws",
            buffer.size(),
            bytes.end()
        ));
    }
    let missing = usages - buffer.usage();
    if !missing.is_empty() {
        return fault(format!("lacks the usage {missing:?}: create it with it"));
    }
    Ok(())
}

/// A storage buffer with these contents; never empty, since empty buffers cannot be bound.
fn upload(gpu: &Gpu, label: &'static str, contents: &[u8]) -> wgpu::Buffer {
    use wgpu::util::DeviceExt as _;
    let empty = [0; 32];
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents: if contents.is_empty() {
                &empty
            } else {
                contents
            },
            usage: wgpu::BufferUsages::STORAGE,
        })
}
