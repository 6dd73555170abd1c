//! Brings changed records onto the device, by the host's encoder: as one block where they lie close together, as a few copies, or as one block that a compute
//! pass scatters.

use antumbra_shaders::jobs;

use super::record::JudgedInstance;
use super::submitted::Submitted;
use crate::compute_pipeline::{ComputePipeline, rows_of};
use crate::device::Gpu;

/// The records on the device.
#[derive(Debug)]
pub(super) struct Uploader {
    gpu: Gpu,
    buffer: wgpu::Buffer,
    belt: wgpu::util::StagingBelt,
    pipeline: ComputePipeline,
    scatter: Option<Scatter>,
    submitted: Submitted,
}

/// What a scatter is written to first.
#[derive(Debug)]
struct Scatter {
    places: wgpu::Buffer,
    moved: wgpu::Buffer,
    capacity: usize,
}

/// Bytes of a record.
const BYTES: u64 = size_of::<JudgedInstance>() as u64;
/// Bytes of a chunk of the staging belt: 4,096 records.
const BELT_CHUNK: u64 = 4096 * BYTES;
/// More copies than this are a scatter instead.
const MOST_COPIES: usize = 32;

impl Uploader {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            buffer: make(gpu, "judged instances", BYTES),
            belt: wgpu::util::StagingBelt::new(gpu.device.clone(), BELT_CHUNK),
            pipeline: ComputePipeline::new(gpu, &jobs::scatter_records::JOB, "scatter_records"),
            scatter: None,
            submitted: Submitted::default(),
        }
    }

    /// Bytes of device memory.
    pub fn memory(&self) -> u64 {
        let scatter = self.scatter.iter();
        let scatter = scatter.map(|scatter| scatter.places.size() + scatter.moved.size());
        self.buffer.size() + scatter.sum::<u64>()
    }

    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Writes the records at these indices, which are emptied.
    pub fn upload(
        &mut self,
        records: &[JudgedInstance],
        changed: &mut Vec<u32>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        if self.submitted.take_lost() {
            // What an encoder that was dropped would have written is not known any more.
            changed.clear();
            changed.extend(0..records.len() as u32);
        }
        if changed.is_empty() {
            return;
        }
        if !changed.is_sorted() {
            changed.sort_unstable();
        }
        if self.buffer.size() < records.len() as u64 * BYTES {
            // As many as there are at first; later some to spare, but not twice as much.
            let spare = match self.buffer.size() {
                0..=BYTES => 0,
                _ => records.len() / 8,
            };
            let capacity = (records.len() + spare) as u64;
            let limits = self.gpu.device.limits();
            let most = limits
                .max_buffer_size
                .min(limits.max_storage_buffer_binding_size);
            let size = (capacity * BYTES).min(most / BYTES * BYTES);
            self.buffer = filled(&self.gpu, "judged instances", size, records);
            changed.clear();
            return;
        }
        let runs = runs(changed);
        if runs.len() <= MOST_COPIES {
            for [first, end] in runs {
                let part = records
                    .get(first as usize..end as usize)
                    .unwrap_or_default();
                let (at, bytes) = (u64::from(first) * BYTES, bytemuck::cast_slice(part));
                write(&mut self.belt, encoder, &self.buffer, at, bytes);
            }
        } else {
            self.scatter(records, changed, encoder);
        }
        changed.clear();
        self.belt.finish_and_recall_on_submit(&*encoder);
        self.submitted.note(encoder);
    }

    fn scatter(
        &mut self,
        records: &[JudgedInstance],
        changed: &[u32],
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let gpu = &self.gpu;
        let fits = |scatter: &Scatter| scatter.capacity >= changed.len();
        let scatter = match self.scatter.take().filter(fits) {
            Some(scatter) => scatter,
            None => Scatter::new(gpu, changed.len().next_power_of_two().min(records.len())),
        };
        let mut places = Vec::with_capacity(changed.len() + 1);
        places.push(changed.len() as u32);
        places.extend_from_slice(changed);
        let moved: Vec<JudgedInstance> = changed
            .iter()
            .filter_map(|index| records.get(*index as usize).copied())
            .collect();
        write(
            &mut self.belt,
            encoder,
            &scatter.places,
            0,
            bytemuck::cast_slice(&places),
        );
        write(
            &mut self.belt,
            encoder,
            &scatter.moved,
            0,
            bytemuck::cast_slice(&moved),
        );
        let group = self
            .pipeline
            .group(gpu, &[&scatter.places, &scatter.moved, &self.buffer]);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("scatter judged instances"),
            timestamp_writes: None,
        });
        let [wide, rows] = rows_of((changed.len() as u32).div_ceil(64));
        self.pipeline
            .dispatch_in(&mut pass, &group, [wide, rows, 1]);
        drop(pass);
        self.scatter = Some(scatter);
    }
}

impl Scatter {
    fn new(gpu: &Gpu, capacity: usize) -> Self {
        Self {
            places: make(gpu, "indices of moved instances", capacity as u64 * 4 + 4),
            moved: make(gpu, "moved instances", capacity as u64 * BYTES),
            capacity,
        }
    }
}

fn make(gpu: &Gpu, label: &'static str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// A new buffer that begins with these records. No encoder knows it yet, so nothing has to be in order.
fn filled(gpu: &Gpu, label: &'static str, size: u64, records: &[JudgedInstance]) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: true,
    });
    let bytes: &[u8] = bytemuck::cast_slice(records);
    if let Ok(mut mapped) = buffer.get_mapped_range_mut(..bytes.len() as u64) {
        mapped.copy_from_slice(bytes);
    }
    buffer.unmap();
    buffer
}

fn write(
    belt: &mut wgpu::util::StagingBelt,
    encoder: &mut wgpu::CommandEncoder,
    buffer: &wgpu::Buffer,
    at: u64,
    bytes: &[u8],
) {
    // In pieces: the belt keeps a chunk for the largest write that there ever was.
    for (piece, number) in bytes.chunks(BELT_CHUNK as usize).zip(0u64..) {
        if let Some(length) = wgpu::BufferSize::new(piece.len() as u64) {
            belt.write_buffer(encoder, buffer, at + number * BELT_CHUNK, length)
                .copy_from_slice(piece);
        }
    }
}

/// Ascending indices as ranges from a first to an end. Records that have not changed are written with those around them while that costs less than another
/// copy.
fn runs(changed: &[u32]) -> Vec<[u32; 2]> {
    let mut runs: Vec<[u32; 2]> = Vec::new();
    for index in changed {
        match runs.last_mut() {
            Some([_, end]) if *index - *end <= GAP => *end = index + 1,
            _ => runs.push([*index, index + 1]),
        }
    }
    runs
}

/// The most records that lie unchanged between two changed ones of a run.
const GAP: u32 = 8;
