//! Frame-late read-back: a ring of mapped staging buffers, each answer with its frame's number and tag.
//! Nothing here ever waits; a frame that finds no free slot goes on and is counted.

use std::any::Any;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::store::Store;

/// An answer of a frame-late read-back.
#[derive(Debug)]
pub struct Late<'a, Tag> {
    /// The frame the bytes were written in.
    pub frame: u64,
    /// What was read back along with it: the tag's final value of that frame.
    pub tag: &'a Tag,
    /// The buffer's final contents of that frame.
    pub bytes: &'a [u8],
}

impl<Tag> Clone for Late<'_, Tag> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Tag> Copy for Late<'_, Tag> {}

/// A read-back as declared; remembers the tag's type.
pub(crate) struct RingDecl {
    pub pass: usize,
    pub buffer: usize,
    pub tag: usize,
    make: fn(&wgpu::Device, &str, u64, usize) -> Box<dyn AnyRing>,
}

impl RingDecl {
    pub fn new<Tag: Clone + Send + 'static>(pass: usize, buffer: usize, tag: usize) -> Self {
        Self {
            pass,
            buffer,
            tag,
            make: Ring::<Tag>::boxed,
        }
    }

    pub fn make(
        &self,
        device: &wgpu::Device,
        label: &str,
        size: u64,
        slots: usize,
    ) -> Box<dyn AnyRing> {
        (self.make)(device, label, size, slots)
    }
}

/// What the copy at the end of a frame needs.
pub(crate) struct Shot<'a> {
    pub encoder: &'a mut wgpu::CommandEncoder,
    pub source: &'a wgpu::Buffer,
    /// Bytes, a multiple of 4, at most the ring's size.
    pub bytes: u64,
    pub frame: u64,
    pub store: &'a Store,
    pub tag_slot: u32,
}

/// The mapping of a slot failed: the device is gone.
pub(crate) struct MapLost;

/// A ring of any tag.
pub(crate) trait AnyRing: Send {
    fn as_any(&self) -> &dyn Any;
    /// Takes in what has arrived; the newest undelivered answer is offered during the frame.
    fn begin_frame(&mut self) -> Result<(), MapLost>;
    /// Lets go of what was delivered.
    fn end_frame(&mut self);
    /// Copies this frame's bytes into a free slot; false: none was free, or the tag held nothing.
    fn record(&mut self, shot: Shot<'_>) -> bool;
    /// Drops all answers, under way or arrived.
    fn forget(&mut self);
    /// Bytes of staging memory.
    fn memory(&self) -> u64;
}

const WAITING: u8 = 0;
const MAPPED: u8 = 1;
const DROPPED: u8 = 2;
const LOST: u8 = 3;

/// Travels with the map request. If the encoder is dropped unsubmitted, so is this, and the slot is freed.
struct Ticket(Arc<AtomicU8>);

impl Ticket {
    fn answer(&self, result: Result<(), wgpu::BufferAsyncError>) {
        let status = if result.is_ok() { MAPPED } else { LOST };
        self.0.store(status, Ordering::Release);
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        let _ = self
            .0
            .compare_exchange(WAITING, DROPPED, Ordering::AcqRel, Ordering::Acquire);
    }
}

enum State<Tag> {
    Free,
    Pending {
        frame: u64,
        tag: Tag,
        bytes: u64,
        wanted: bool,
        status: Arc<AtomicU8>,
    },
    Offered {
        frame: u64,
        tag: Tag,
        view: Option<wgpu::BufferView>,
    },
}

struct Slot<Tag> {
    staging: wgpu::Buffer,
    state: State<Tag>,
}

impl<Tag> Slot<Tag> {
    fn free(&mut self) {
        let old = std::mem::replace(&mut self.state, State::Free);
        if let State::Offered { view, .. } = old {
            let mapped = view.is_some();
            drop(view);
            if mapped {
                self.staging.unmap();
            }
        }
    }
}

pub(crate) struct Ring<Tag> {
    slots: Vec<Slot<Tag>>,
    size: u64,
    delivered: Cell<bool>,
    /// The frame of the newest answer that was delivered: older ones that arrive after it are stale.
    last: Option<u64>,
}

impl<Tag: Clone + Send + 'static> Ring<Tag> {
    fn boxed(device: &wgpu::Device, label: &str, size: u64, slots: usize) -> Box<dyn AnyRing> {
        let slots = (0..slots.max(1))
            .map(|_| Slot {
                staging: device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                }),
                state: State::Free,
            })
            .collect();
        Box::new(Self {
            slots,
            size,
            delivered: Cell::new(false),
            last: None,
        })
    }

    /// The offered answer, if any; it is let go at the end of the frame.
    pub fn answer(&self) -> Option<Late<'_, Tag>> {
        let found = self.slots.iter().find_map(|slot| match &slot.state {
            State::Offered { frame, tag, view } => Some(Late {
                frame: *frame,
                tag,
                bytes: view.as_deref().unwrap_or(&[]),
            }),
            _ => None,
        });
        if found.is_some() {
            self.delivered.set(true);
        }
        found
    }
}

impl<Tag: Clone + Send + 'static> AnyRing for Ring<Tag> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn begin_frame(&mut self) -> Result<(), MapLost> {
        self.delivered.set(false);
        let mut lost = false;
        for slot in &mut self.slots {
            let State::Pending { status, wanted, .. } = &slot.state else {
                continue;
            };
            let (status, wanted) = (status.load(Ordering::Acquire), *wanted);
            match status {
                WAITING => continue,
                MAPPED => {}
                _ => {
                    lost |= status == LOST;
                    slot.state = State::Free;
                    continue;
                }
            }
            let State::Pending {
                frame, tag, bytes, ..
            } = std::mem::replace(&mut slot.state, State::Free)
            else {
                continue;
            };
            if !wanted {
                if bytes > 0 {
                    slot.staging.unmap();
                }
                continue;
            }
            let view = if bytes > 0 {
                match slot.staging.slice(..bytes).get_mapped_range() {
                    Ok(view) => Some(view),
                    Err(_) => {
                        lost = true;
                        continue;
                    }
                }
            } else {
                None
            };
            slot.state = State::Offered { frame, tag, view };
        }
        self.keep_newest();
        if lost { Err(MapLost) } else { Ok(()) }
    }

    fn end_frame(&mut self) {
        if self.delivered.replace(false) {
            for slot in &mut self.slots {
                if let State::Offered { frame, .. } = slot.state {
                    self.last = self.last.max(Some(frame));
                    slot.free();
                }
            }
        }
    }

    fn record(&mut self, shot: Shot<'_>) -> bool {
        let Ok(tag) = shot.store.get::<Tag>(shot.tag_slot) else {
            return false;
        };
        let Some(slot) = self
            .slots
            .iter_mut()
            .find(|slot| matches!(slot.state, State::Free))
        else {
            return false;
        };
        let bytes = shot.bytes.min(self.size);
        let status = Arc::new(AtomicU8::new(WAITING));
        if bytes > 0 {
            shot.encoder
                .copy_buffer_to_buffer(shot.source, 0, &slot.staging, 0, bytes);
            let ticket = Ticket(Arc::clone(&status));
            shot.encoder.map_buffer_on_submit(
                &slot.staging,
                wgpu::MapMode::Read,
                ..bytes,
                move |result| ticket.answer(result),
            );
        } else {
            status.store(MAPPED, Ordering::Release);
        }
        slot.state = State::Pending {
            frame: shot.frame,
            tag: tag.clone(),
            bytes,
            wanted: true,
            status,
        };
        true
    }

    fn forget(&mut self) {
        for slot in &mut self.slots {
            match &mut slot.state {
                State::Free => {}
                State::Pending { wanted, .. } => *wanted = false,
                State::Offered { .. } => slot.free(),
            }
        }
    }

    fn memory(&self) -> u64 {
        self.size * self.slots.len() as u64
    }
}

impl<Tag> Ring<Tag> {
    /// Of several answers only the newest is worth having, and only if it is newer than what was had before: submissions need not finish in the
    /// order of the frames.
    fn keep_newest(&mut self) {
        let newest = self
            .slots
            .iter()
            .filter_map(|slot| match slot.state {
                State::Offered { frame, .. } => Some(frame),
                _ => None,
            })
            .max()
            .filter(|newest| self.last.is_none_or(|last| *newest > last));
        for slot in &mut self.slots {
            if matches!(slot.state, State::Offered { frame, .. } if Some(frame) != newest) {
                slot.free();
            }
        }
    }
}
