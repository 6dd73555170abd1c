//! Frame-late read-back: a ring of staging buffers. Each result has the number of its frame and a tag.
//! Nothing here waits. A frame that finds no free slot continues without the read-back and counts it.

use std::any::Any;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::store::Store;

/// The result of a frame-late read-back.
#[derive(Debug)]
pub struct Late<'a, Tag> {
    /// The frame in which the bytes were written.
    pub frame: u64,
    /// The tag's final value of that frame.
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

/// A declared read-back. `make` knows the tag's type.
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
            make: |device, label, size, slots| {
                Box::new(ReadBackRing::<Tag>::new(device, label, size, slots))
            },
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

/// The copy of a read-back at the end of a frame.
pub(crate) struct CopyRequest<'a> {
    pub encoder: &'a mut wgpu::CommandEncoder,
    pub source: &'a wgpu::Buffer,
    /// Bytes, a multiple of 4, at most the ring's size.
    pub bytes: u64,
    pub frame: u64,
    pub store: &'a Store,
    pub tag_slot: u32,
}

/// The mapping of a slot failed because the device was lost.
pub(crate) struct MapLost;

/// A ring with any type of tag.
pub(crate) trait AnyRing: Send {
    fn as_any(&self) -> &dyn Any;
    /// Takes in results that have arrived, if they are of frames up to `newest` (`None`: of any frame), and offers the newest undelivered one during the frame.
    fn begin_frame(&mut self, newest: Option<u64>) -> Result<(), MapLost>;
    /// The frame of the result that was read during this frame.
    fn read_frame(&self) -> Option<u64>;
    /// Frees the slot of a delivered result.
    fn end_frame(&mut self);
    /// Copies this frame's bytes into a free slot. Returns false where no slot is free or the tag holds no value.
    fn record(&mut self, request: CopyRequest<'_>) -> bool;
    /// Drops all results, pending or arrived.
    fn discard(&mut self);
    /// Bytes of staging memory.
    fn memory(&self) -> u64;
}

const WAITING: u8 = 0;
const MAPPED: u8 = 1;
const DROPPED: u8 = 2;
const LOST: u8 = 3;

/// Owned by the map request. If the encoder is dropped without a submit, this is dropped too and the slot is freed.
struct Ticket(Arc<AtomicU8>);

impl Ticket {
    fn resolve(&self, result: Result<(), wgpu::BufferAsyncError>) {
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

impl<Tag> std::fmt::Debug for ReadBackRing<Tag> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ReadBackRing")
            .field("slots", &self.slots.len())
            .field("size", &self.size)
            .finish_non_exhaustive()
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

/// Reads a buffer back without waiting: a ring of staging buffers. A plan has one for each frame-late read-back; this is the same for commands outside of a plan, or for answers that are
/// wanted before the next frame is recorded.
pub struct ReadBackRing<Tag> {
    slots: Vec<Slot<Tag>>,
    size: u64,
    delivered: Cell<bool>,
    /// The frame of the newest delivered result. Older results that arrive later are stale.
    last: Option<u64>,
}

/// What a [`ReadBackRing`] is asked to read.
#[derive(Debug)]
pub struct ReadBackCopy<'a, Tag> {
    /// The buffer, from its start on. Usage `COPY_SRC`.
    pub source: &'a wgpu::Buffer,
    /// Bytes, a multiple of 4; at most the ring's size.
    pub bytes: u64,
    /// The frame that the bytes are of. Older results that arrive after newer ones are dropped.
    pub frame: u64,
    /// What comes back with the bytes.
    pub tag: Tag,
}

impl<Tag> ReadBackRing<Tag> {
    /// A ring of so many slots, at least one, of `size` bytes each.
    #[must_use]
    pub fn new(device: &wgpu::Device, label: &str, size: u64, slots: usize) -> Self {
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
        Self {
            slots,
            size,
            delivered: Cell::new(false),
            last: None,
        }
    }

    /// Bytes of a slot.
    #[must_use]
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Bytes of staging memory.
    #[must_use]
    pub fn memory(&self) -> u64 {
        self.size * self.slots.len() as u64
    }

    /// Copies bytes into a free slot, and has it mapped once the encoder has been submitted and has run. Returns false where no slot is free. The slot of an encoder that is dropped is free again.
    pub fn ask(&mut self, copy: ReadBackCopy<'_, Tag>, encoder: &mut wgpu::CommandEncoder) -> bool {
        let free = |slot: &&mut Slot<Tag>| matches!(slot.state, State::Free);
        let Some(slot) = self.slots.iter_mut().find(free) else {
            return false;
        };
        let bytes = copy.bytes.min(self.size);
        let status = Arc::new(AtomicU8::new(WAITING));
        if bytes > 0 {
            encoder.copy_buffer_to_buffer(copy.source, 0, &slot.staging, 0, bytes);
            let ticket = Ticket(Arc::clone(&status));
            encoder.map_buffer_on_submit(
                &slot.staging,
                wgpu::MapMode::Read,
                ..bytes,
                move |result| ticket.resolve(result),
            );
        } else {
            status.store(MAPPED, Ordering::Release);
        }
        slot.state = State::Pending {
            frame: copy.frame,
            tag: copy.tag,
            bytes,
            wanted: true,
            status,
        };
        true
    }

    /// Gives `read` the newest result that has arrived, if it was not given before. Never waits. What a lost device would have answered never arrives.
    pub fn take_newest(&mut self, read: impl FnOnce(Late<'_, Tag>)) {
        // The slots that a lost device leaves are free again; its loss is for others to report.
        let _ = self.collect(None);
        if let Some(late) = self.offered() {
            read(late);
        }
        self.release();
    }

    /// The offered result, if there is one. Its slot is freed at the end of the frame.
    pub fn offered(&self) -> Option<Late<'_, Tag>> {
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

impl<Tag: Clone + Send + 'static> AnyRing for ReadBackRing<Tag> {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn begin_frame(&mut self, newest: Option<u64>) -> Result<(), MapLost> {
        self.collect(newest)
    }

    fn read_frame(&self) -> Option<u64> {
        if !self.delivered.get() {
            return None;
        }
        self.slots.iter().find_map(|slot| match slot.state {
            State::Offered { frame, .. } => Some(frame),
            _ => None,
        })
    }

    fn end_frame(&mut self) {
        self.release();
    }

    fn record(&mut self, request: CopyRequest<'_>) -> bool {
        let Ok(tag) = request.store.get::<Tag>(request.tag_slot) else {
            return false;
        };
        let copy = ReadBackCopy {
            source: request.source,
            bytes: request.bytes,
            frame: request.frame,
            tag: tag.clone(),
        };
        self.ask(copy, request.encoder)
    }

    fn discard(&mut self) {
        for slot in &mut self.slots {
            match &mut slot.state {
                State::Free => {}
                State::Pending { wanted, .. } => *wanted = false,
                State::Offered { .. } => slot.free(),
            }
        }
    }

    fn memory(&self) -> u64 {
        self.memory()
    }
}

impl<Tag> ReadBackRing<Tag> {
    /// Takes in what has arrived of frames up to `newest`, and offers the newest of it.
    fn collect(&mut self, newest: Option<u64>) -> Result<(), MapLost> {
        self.delivered.set(false);
        let mut lost = false;
        for slot in &mut self.slots {
            let State::Pending {
                frame,
                status,
                wanted,
                ..
            } = &slot.state
            else {
                continue;
            };
            if *wanted && newest.is_some_and(|newest| *frame > newest) {
                continue;
            }
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

    /// Frees the slot of a result that was read.
    fn release(&mut self) {
        if self.delivered.replace(false) {
            for slot in &mut self.slots {
                if let State::Offered { frame, .. } = slot.state {
                    self.last = self.last.max(Some(frame));
                    slot.free();
                }
            }
        }
    }

    /// Keeps only the newest result, and only if it is newer than the last delivered one. Submissions need not finish in the order of the
    /// frames.
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
