//! What trials are recorded with: a command encoder, buffers, and the answers that are read back in one go.

use std::ops::Range;

use wgpu::util::DeviceExt;

use super::picture::{Painted, Rect, SHUTTER};
use super::report::Failure;
use crate::device::{DeviceError, Gpu};
use crate::read_back;

/// Where trials are recorded.
pub(super) struct Bench<'a> {
    pub gpu: &'a Gpu,
    /// Samples a pixel.
    pub samples: u32,
    pub encoder: wgpu::CommandEncoder,
    recorded: Vec<wgpu::CommandBuffer>,
    answers: Vec<wgpu::Buffer>,
    bytes: usize,
}

impl<'a> Bench<'a> {
    pub fn new(gpu: &'a Gpu, samples: u32) -> Self {
        Self {
            gpu,
            samples,
            encoder: encoder(gpu),
            recorded: Vec::new(),
            answers: Vec::new(),
            bytes: 0,
        }
    }

    /// What differs between the samples of a pixel. With one there is no such thing, and wgpu's OpenGL backend leaves sample masks out.
    pub fn shutter(&self) -> Option<&'static Rect> {
        (self.samples > 1 && self.gpu.info.backend != wgpu::Backend::Gl).then_some(&SHUTTER)
    }

    /// What the picture looks like.
    pub fn painted(&self) -> Painted {
        Painted::new(self.samples, self.shutter())
    }

    /// A buffer with these contents.
    pub fn buffer<T: bytemuck::NoUninit>(
        &self,
        contents: &[T],
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        let contents = bytemuck::cast_slice(contents);
        let device = &self.gpu.device;
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("self-test"),
            contents,
            usage,
        })
    }

    /// A buffer of zeroes that shaders write and that is read back.
    pub fn zeroes(&self, words: usize) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        self.buffer(&vec![0u32; words], usage)
    }

    /// A texture of one mip and layer.
    pub fn texture(
        &self,
        size: [u32; 2],
        format: wgpu::TextureFormat,
        samples: u32,
    ) -> wgpu::Texture {
        let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        if samples == 1 || self.gpu.reads_drawn_samples() {
            usage |= wgpu::TextureUsages::TEXTURE_BINDING;
        }
        if samples == 1 && !format.is_depth_stencil_format() {
            usage |= wgpu::TextureUsages::COPY_SRC;
        }
        self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("self-test"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// Reads a buffer back; where its bytes will be.
    pub fn reads(&mut self, buffer: wgpu::Buffer) -> Range<usize> {
        let start = self.bytes;
        self.bytes += buffer.size() as usize;
        self.answers.push(buffer);
        start..self.bytes
    }

    /// Records with an encoder of its own. Where the device refuses a command, all of them are dropped, and the failure says what it reported.
    pub async fn attempt<T>(&mut self, record: impl FnOnce(&mut Self) -> T) -> Result<T, Failure> {
        let device = &self.gpu.device;
        let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let (answers, bytes) = (self.answers.len(), self.bytes);
        let made = record(self);
        let recorded = std::mem::replace(&mut self.encoder, encoder(self.gpu)).finish();
        let (validation, internal) = (validation.pop(), internal.pop());
        let refused = validation.await;
        let refused = refused.or(internal.await);
        let Some(error) = refused else {
            self.recorded.push(recorded);
            return Ok(made);
        };
        self.answers.truncate(answers);
        self.bytes = bytes;
        Err(Failure {
            place: "its commands".to_owned(),
            expected: "a device that takes them".to_owned(),
            found: error.to_string(),
            wrong: 1,
            answers: 1,
        })
    }

    /// Submits what was recorded, waits, and returns all answers.
    pub async fn finish(mut self) -> Result<Vec<u8>, DeviceError> {
        let all = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("self-test: answers"),
            size: (self.bytes as u64).max(4),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut at = 0;
        for answer in &self.answers {
            self.encoder
                .copy_buffer_to_buffer(answer, 0, &all, at, answer.size());
            at += answer.size();
        }
        self.recorded.push(self.encoder.finish());
        self.gpu.queue.submit(self.recorded);
        read_back::mapped(self.gpu, &all).await
    }
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    let label = Some("self-test");
    gpu.device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor { label })
}
