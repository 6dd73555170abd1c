//! Reads a view's answers back without waiting: a ring of staging buffers, each of which is mapped once its encoder has been submitted and has run.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use super::answers::{Answers, Asked};
use crate::device::Gpu;

/// A view's answers on their way to the host, and the newest that have arrived.
#[derive(Debug, Default)]
pub(super) struct List {
    slots: Vec<Slot>,
    newest: Answers,
}

#[derive(Debug)]
struct Slot {
    staging: wgpu::Buffer,
    /// What is under way; `None` where the slot is free.
    pending: Option<(Asked, Arc<AtomicU8>)>,
}

/// Frames that may be under way. A frame that finds no free slot is not read back.
const SLOTS: usize = 4;

const WAITING: u8 = 0;
const MAPPED: u8 = 1;
const GONE: u8 = 2;

/// Owned by the map request. An encoder that is dropped unsubmitted drops it, and the slot is free again.
struct Ticket(Arc<AtomicU8>);

impl Drop for Ticket {
    fn drop(&mut self) {
        let (set, fetch) = (Ordering::AcqRel, Ordering::Acquire);
        // It fails where an answer has come, and is meant to.
        let _ = self.0.compare_exchange(WAITING, GONE, set, fetch);
    }
}

impl List {
    /// Copies a mask, and asks for it. Returns whether there was a free slot.
    pub fn ask(
        &mut self,
        gpu: &Gpu,
        mask: &wgpu::Buffer,
        asked: Asked,
        encoder: &mut wgpu::CommandEncoder,
    ) -> bool {
        self.collect();
        let bytes = asked.bytes.min(mask.size());
        let free = self.slots.iter().position(|slot| slot.pending.is_none());
        let at = match free {
            Some(at) => at,
            None if self.slots.len() < SLOTS => {
                self.slots.push(Slot::new(gpu, bytes));
                self.slots.len() - 1
            }
            None => return false,
        };
        let Some(slot) = self.slots.get_mut(at) else {
            return false;
        };
        if slot.staging.size() < bytes {
            *slot = Slot::new(gpu, mask.size());
        }
        encoder.copy_buffer_to_buffer(mask, 0, &slot.staging, 0, bytes);
        let status = Arc::new(AtomicU8::new(WAITING));
        let ticket = Ticket(Arc::clone(&status));
        let map = wgpu::MapMode::Read;
        encoder.map_buffer_on_submit(&slot.staging, map, ..bytes, move |result| {
            let outcome = if result.is_ok() { MAPPED } else { GONE };
            ticket.0.store(outcome, Ordering::Release);
        });
        slot.pending = Some((asked, status));
        true
    }

    /// The newest answers that have arrived.
    pub fn newest(&mut self) -> &Answers {
        self.collect();
        &self.newest
    }

    /// Bytes of staging memory.
    pub fn memory(&self) -> u64 {
        self.slots.iter().map(|slot| slot.staging.size()).sum()
    }

    /// Takes in what has arrived. Encoders need not be submitted in order: what is older than the newest is dropped.
    fn collect(&mut self) {
        for slot in &mut self.slots {
            let Some((asked, status)) = &slot.pending else {
                continue;
            };
            match status.load(Ordering::Acquire) {
                WAITING => continue,
                MAPPED => {
                    let range = slot.staging.slice(..asked.bytes).get_mapped_range();
                    if let Ok(bytes) = range
                        && self.newest.is_older_than(asked)
                    {
                        self.newest.take(asked, &bytes);
                    }
                    slot.staging.unmap();
                }
                _ => {}
            }
            slot.pending = None;
        }
    }
}

impl Slot {
    fn new(gpu: &Gpu, bytes: u64) -> Self {
        Self {
            staging: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("answers"),
                size: bytes.max(4),
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            pending: None,
        }
    }
}
