//! Same-frame read-back: the staging buffers of a plan's sync points.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

use web_time::Instant;

use crate::handle::Raw;

/// The staging buffer of one buffer that one host node reads back within the frame.
pub(crate) struct Staging {
    pub pass: usize,
    pub raw: Raw,
    buffer: wgpu::Buffer,
    size: u64,
    status: Arc<AtomicU8>,
    requested: u64,
    view: Option<wgpu::BufferView>,
}

/// How long a map callback may take after the wait for the GPU is over. Another thread that polls the device may run the callback, and
/// calls it as soon as it is scheduled. Browsers have no such threads and must not wait.
const CALLBACK_DELAY: Duration = if cfg!(target_family = "wasm") {
    Duration::ZERO
} else {
    Duration::from_secs(10)
};

const NONE: u8 = 0;
const MAPPED: u8 = 1;
const LOST: u8 = 2;

/// The state of a read-back after the wait.
pub(crate) enum Arrival {
    /// The bytes are there.
    Here,
    /// The wait returned without the bytes: the backend does not block.
    NotYet,
    /// The device was lost.
    Lost,
}

impl Staging {
    pub fn new(device: &wgpu::Device, label: &str, pass: usize, raw: Raw, size: u64) -> Self {
        Self {
            pass,
            raw,
            size,
            buffer: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            status: Arc::new(AtomicU8::new(NONE)),
            requested: 0,
            view: None,
        }
    }

    /// Records a copy of `bytes` (a multiple of 4) of `source`, and maps them on submit.
    pub fn request(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        source: &wgpu::Buffer,
        bytes: u64,
    ) {
        self.requested = bytes.min(self.size);
        self.status.store(NONE, Ordering::Release);
        if self.requested == 0 {
            self.status.store(MAPPED, Ordering::Release);
            return;
        }
        encoder.copy_buffer_to_buffer(source, 0, &self.buffer, 0, self.requested);
        let status = Arc::clone(&self.status);
        encoder.map_buffer_on_submit(
            &self.buffer,
            wgpu::MapMode::Read,
            ..self.requested,
            move |result| {
                let arrived = if result.is_ok() { MAPPED } else { LOST };
                status.store(arrived, Ordering::Release);
            },
        );
    }

    /// Bytes of staging memory.
    pub fn memory(&self) -> u64 {
        self.size
    }

    /// Whether it belongs to this read-back.
    pub fn serves(&self, pass: usize, raw: Raw) -> bool {
        self.pass == pass
            && self.raw.index == raw.index
            && self.raw.is_previous() == raw.is_previous()
    }

    /// Opens the bytes, after the wait.
    pub fn open(&mut self) -> Arrival {
        match self.arrived() {
            MAPPED => {}
            NONE => return Arrival::NotYet,
            _ => return Arrival::Lost,
        }
        if self.requested == 0 {
            return Arrival::Here;
        }
        match self.buffer.slice(..self.requested).get_mapped_range() {
            Ok(view) => {
                self.view = Some(view);
                Arrival::Here
            }
            Err(_) => Arrival::Lost,
        }
    }

    /// The status, once it is known or the delay is over.
    fn arrived(&self) -> u8 {
        let status = || self.status.load(Ordering::Acquire);
        if status() == NONE && !CALLBACK_DELAY.is_zero() {
            let started = Instant::now();
            while status() == NONE && started.elapsed() < CALLBACK_DELAY {
                std::thread::yield_now();
            }
        }
        status()
    }

    /// The bytes, between `open` and `close`.
    pub fn bytes(&self) -> &[u8] {
        self.view.as_deref().unwrap_or(&[])
    }

    /// Unmaps the staging buffer. After a failed wait the request may still be pending; unmapping cancels it.
    pub fn close(&mut self) {
        let open = self.view.take().is_some();
        if open || self.requested > 0 {
            self.buffer.unmap();
        }
        self.requested = 0;
    }
}
