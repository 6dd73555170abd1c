//! A view's memory on the device: a state an instance, and masks of a bit an instance.

use super::Chosen;
use crate::device::Gpu;

/// A view's buffers, with room for a number of instances.
#[derive(Debug)]
pub(super) struct Masks {
    name: String,
    capacity: u32,
    /// What was found, a u32 an instance, as in `shared/judged.wgsl`.
    states: wgpu::Buffer,
    first: wgpu::Buffer,
    rest: wgpu::Buffer,
    hidden: wgpu::Buffer,
}

/// Bytes of a mask of so many instances.
pub(super) fn bytes(instances: u32) -> u64 {
    u64::from(instances.max(1).div_ceil(32)) * 4
}

impl Masks {
    /// Room for a few instances.
    pub fn new(gpu: &Gpu, name: &str) -> Self {
        Self::with_capacity(gpu, name, 64)
    }

    fn with_capacity(gpu: &Gpu, name: &str, capacity: u32) -> Self {
        let make = |what: &str, size: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&format!("{name}: {what}")),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let mask = bytes(capacity);
        Self {
            name: name.to_owned(),
            capacity,
            states: make("states", u64::from(capacity) * 4),
            first: make("first", mask),
            rest: make("rest", mask),
            hidden: make("hidden", mask),
        }
    }

    /// Makes room. What is known moves over, by the encoder: after its commands so far. Returns whether the buffers are others now.
    pub fn reserve(&mut self, gpu: &Gpu, count: u32, encoder: &mut wgpu::CommandEncoder) -> bool {
        if count <= self.capacity {
            return false;
        }
        let capacity = count.saturating_add(count / 8).next_multiple_of(64);
        let grown = Self::with_capacity(gpu, &self.name, capacity);
        // A mask that a frame does not write begins empty.
        encoder.copy_buffer_to_buffer(&self.states, 0, &grown.states, 0, self.states.size());
        *self = grown;
        true
    }

    /// Empties a mask, by an encoder.
    pub fn clear(&self, chosen: Chosen, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(self.of(chosen), 0, None);
    }

    pub fn states(&self) -> &wgpu::Buffer {
        &self.states
    }

    pub fn of(&self, chosen: Chosen) -> &wgpu::Buffer {
        match chosen {
            Chosen::First => &self.first,
            Chosen::Rest => &self.rest,
        }
    }

    pub fn hidden(&self) -> &wgpu::Buffer {
        &self.hidden
    }

    pub fn memory(&self) -> u64 {
        let buffers = [&self.states, &self.first, &self.rest, &self.hidden];
        buffers.map(wgpu::Buffer::size).iter().sum()
    }
}
