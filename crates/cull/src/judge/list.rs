//! A view's answers on their way to the host, and the newest that have arrived.

use antumbra_graph::{ReadBackCopy, ReadBackRing};

use super::answers::{Answers, Asked};
use crate::device::Gpu;

/// Reads a view's masks back.
#[derive(Debug, Default)]
pub(super) struct List {
    ring: Option<ReadBackRing<Asked>>,
    newest: Answers,
}

/// Slots of the ring: engines have up to three frames in flight, one result is read and one is asked for. A frame that finds no free slot is not read back.
const SLOTS: usize = 3 + 2;

impl List {
    /// Asks for a mask of a frame. Returns whether there was a free slot. When the mask has grown, what is under way is lost; what has arrived stays.
    pub fn ask(
        &mut self,
        gpu: &Gpu,
        copy: ReadBackCopy<'_, Asked>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> bool {
        self.collect();
        let size = copy.source.size();
        let fits = |ring: &ReadBackRing<Asked>| ring.size() >= size;
        let ring = self.ring.take().filter(fits);
        let ring = ring.unwrap_or_else(|| ReadBackRing::new(&gpu.device, "answers", size, SLOTS));
        self.ring.insert(ring).ask(copy, encoder)
    }

    /// The newest answers that have arrived.
    pub fn newest(&mut self) -> &Answers {
        self.collect();
        &self.newest
    }

    /// Bytes of staging memory.
    pub fn memory(&self) -> u64 {
        self.ring.as_ref().map_or(0, ReadBackRing::memory)
    }

    fn collect(&mut self) {
        if let Some(ring) = &mut self.ring {
            ring.take_newest(|late| self.newest.take(&late));
        }
    }
}
