//! A growing GPU buffer of elements of one type. It never shrinks, and is copied into a larger buffer when it grows.
//!
//! Each write takes a staging buffer of its own, which costs some KB however short it is, and stays until it was submitted and is done. So
//! few elements are gathered, and many are written at once, both in portions.

use bytemuck::Pod;

use crate::error::DrawError;
use antumbra_cull::Gpu;

/// A GPU buffer of `T` that grows by doubling. Offsets and lengths are in elements.
#[derive(Debug)]
pub struct Arena<T> {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: wgpu::Buffer,
    capacity: u64,
    len: u64,
    /// Appended elements that are not written yet: the last ones.
    pending: Vec<T>,
}

/// Bytes of a portion.
const PORTION: usize = 16 << 20;

impl<T: Pod> Arena<T> {
    /// An arena with room for `capacity` elements (at least one, since empty buffers cannot be bound).
    ///
    /// # Errors
    /// [`DrawError::TooLarge`] where the device cannot hold a buffer of that size.
    pub fn new(
        gpu: &Gpu,
        label: &'static str,
        usage: wgpu::BufferUsages,
        capacity: u64,
    ) -> Result<Self, DrawError> {
        let usage = usage | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let capacity = capacity.max(1);
        let buffer = create::<T>(gpu, label, usage, capacity)?;
        Ok(Self {
            label,
            usage,
            buffer,
            capacity,
            len: 0,
            pending: Vec::new(),
        })
    }

    /// The buffer. After the arena has grown it is another one.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Capacity in elements.
    pub fn capacity(&self) -> u64 {
        self.capacity
    }

    /// Appends elements and returns the index of the first. They reach the device with [`Self::flush`] at the latest.
    ///
    /// # Errors
    /// [`DrawError::TooLarge`] where it would have to grow beyond the device's limits.
    pub fn append(&mut self, gpu: &Gpu, elements: &[T]) -> Result<u64, DrawError> {
        let first = self.len;
        self.reserve(gpu, first + elements.len() as u64)?;
        if size_of_val(elements) >= PORTION {
            self.flush(gpu);
            for portion in elements.chunks(PORTION / size_of::<T>()) {
                self.write(gpu, self.len, portion);
                submit_portion(gpu);
            }
            return Ok(first);
        }
        self.pending.extend_from_slice(elements);
        self.len += elements.len() as u64;
        if size_of_val(self.pending.as_slice()) >= PORTION {
            self.flush(gpu);
            submit_portion(gpu);
        }
        Ok(first)
    }

    /// Writes what was appended, and frees the memory that it was gathered in.
    pub fn flush(&mut self, gpu: &Gpu) {
        let pending = std::mem::take(&mut self.pending);
        self.write(gpu, self.len - pending.len() as u64, &pending);
    }

    /// Grows to a capacity of at least `wanted` elements, by doubling. The contents are kept.
    ///
    /// # Errors
    /// As for [`Self::append`].
    pub fn reserve(&mut self, gpu: &Gpu, wanted: u64) -> Result<(), DrawError> {
        self.grow(gpu, wanted, wanted.next_power_of_two())
    }

    /// Grows so that so many elements can be appended: by doubling, or by so many where that is more.
    ///
    /// # Errors
    /// As for [`Self::append`].
    pub fn reserve_more(&mut self, gpu: &Gpu, more: u64) -> Result<(), DrawError> {
        let wanted = self.len.saturating_add(more);
        self.grow(gpu, wanted, wanted.max(self.capacity * 2))
    }

    /// Grows if `wanted` elements do not fit, to a capacity of `usual` where the device can hold that.
    fn grow(&mut self, gpu: &Gpu, wanted: u64, usual: u64) -> Result<(), DrawError> {
        if wanted <= self.capacity {
            return Ok(());
        }
        let most = gpu.device.limits().max_buffer_size / size_of::<T>() as u64;
        let capacity = usual.min(most).max(wanted);
        let grown = create::<T>(gpu, self.label, self.usage, capacity)?;
        let bytes = bytes_of::<T>(self.len - self.pending.len() as u64);
        if bytes > 0 {
            let mut encoder = gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                    label: Some(self.label),
                });
            encoder.copy_buffer_to_buffer(&self.buffer, 0, &grown, 0, bytes);
            gpu.queue.submit([encoder.finish()]);
        }
        self.buffer = grown;
        self.capacity = capacity;
        Ok(())
    }

    /// Overwrites elements from `first` on; they must lie within the capacity.
    pub fn write(&mut self, gpu: &Gpu, first: u64, elements: &[T]) {
        if !elements.is_empty() {
            gpu.queue.write_buffer(
                &self.buffer,
                first * size_of::<T>() as u64,
                bytemuck::cast_slice(elements),
            );
            self.len = self.len.max(first + elements.len() as u64);
        }
    }
}

/// How what changes reaches the device.
pub enum Upload<'a> {
    /// Before everything that is submitted from now on.
    AtOnce,
    /// By an encoder, through staging memory.
    Recorded {
        encoder: &'a mut wgpu::CommandEncoder,
        belt: &'a mut wgpu::util::StagingBelt,
    },
}

impl<T: Pod> Arena<T> {
    /// [`Self::write`] or [`Self::write_in`].
    pub fn write_by(&mut self, gpu: &Gpu, upload: &mut Upload<'_>, first: u64, elements: &[T]) {
        match upload {
            Upload::AtOnce => self.write(gpu, first, elements),
            Upload::Recorded { encoder, belt } => self.write_in(encoder, belt, first, elements),
        }
    }

    /// The same in an encoder: after its commands so far, and not before it is submitted. The size of `T` must be a multiple of four bytes.
    pub fn write_in(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        belt: &mut wgpu::util::StagingBelt,
        first: u64,
        elements: &[T],
    ) {
        let size = size_of::<T>() as u64;
        let bytes: &[u8] = bytemuck::cast_slice(elements);
        if let Some(length) = wgpu::BufferSize::new(bytes.len() as u64) {
            belt.write_buffer(encoder, &self.buffer, first * size, length)
                .copy_from_slice(bytes);
            self.len = self.len.max(first + elements.len() as u64);
        }
    }
}

/// Submits what was written, so that its staging memory is given back as soon as the device has it. Does not wait: a host may be in the middle
/// of a frame.
pub(crate) fn submit_portion(gpu: &Gpu) {
    gpu.queue.submit(None);
    // A lost device is found when the next frame is drawn.
    let _ = gpu.device.poll(wgpu::PollType::Poll);
}

/// Bytes of `len` elements, rounded up to the alignment of copies.
fn bytes_of<T>(len: u64) -> u64 {
    (len * size_of::<T>() as u64).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT)
}

fn create<T>(
    gpu: &Gpu,
    label: &'static str,
    usage: wgpu::BufferUsages,
    capacity: u64,
) -> Result<wgpu::Buffer, DrawError> {
    let size = capacity
        .saturating_mul(size_of::<T>() as u64)
        .next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
    let limits = gpu.device.limits();
    let most = if usage.contains(wgpu::BufferUsages::STORAGE) {
        limits
            .max_buffer_size
            .min(limits.max_storage_buffer_binding_size)
    } else {
        limits.max_buffer_size
    };
    if size > most {
        return Err(DrawError::TooLarge {
            what: label,
            bytes: size,
            most,
        });
    }
    Ok(gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    }))
}
