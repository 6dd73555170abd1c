//! A growing GPU buffer of elements of one type. It never shrinks, and is copied into a larger buffer when it grows.

use std::marker::PhantomData;

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
    element: PhantomData<T>,
}

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
            element: PhantomData,
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

    /// Appends elements and returns the index of the first.
    ///
    /// # Errors
    /// [`DrawError::TooLarge`] where it would have to grow beyond the device's limits.
    pub fn append(&mut self, gpu: &Gpu, elements: &[T]) -> Result<u64, DrawError> {
        let first = self.len;
        self.reserve(gpu, first + elements.len() as u64)?;
        self.write(gpu, first, elements);
        Ok(first)
    }

    /// Grows to a capacity of at least `wanted` elements. The contents are kept.
    ///
    /// # Errors
    /// As for [`Self::append`].
    pub fn reserve(&mut self, gpu: &Gpu, wanted: u64) -> Result<(), DrawError> {
        if wanted <= self.capacity {
            return Ok(());
        }
        let most = gpu.device.limits().max_buffer_size / size_of::<T>() as u64;
        let capacity = wanted.next_power_of_two().min(most).max(wanted);
        let grown = create::<T>(gpu, self.label, self.usage, capacity)?;
        let bytes = bytes_of::<T>(self.len);
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

impl<T: Pod> Arena<T> {
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
