//! Draw lists: which entities to draw, grouped into as few instanced draws as their batches allow.
//!
//! A list is plain data: runs of instance slots, each run one instanced draw. Lists made by [`DrawList::fill`] are in canonical
//! order (batch, then slot). Two such lists with the same members draw in the same order, so entities of equal depth resolve the
//! same way in every strategy.

use std::ops::Range;

use crate::entities::{MeshDetail, SceneTable};

/// Consecutive instances of one batch: one instanced draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Index into [`SceneTable::batches`].
    pub batch: u32,
    /// Which geometry.
    pub detail: MeshDetail,
    /// First entry in [`DrawList::slots`].
    pub first: u32,
    /// Number of entries.
    pub count: u32,
}

/// Instance slots in drawing order.
#[derive(Debug, Clone, Default)]
pub struct DrawList {
    runs: Vec<Run>,
    slots: Vec<u32>,
    primitives: u64,
    starts: Vec<u32>,
    /// Where each query's entries end in `slots`; empty where each entry is a query of its own.
    query_ends: Vec<u32>,
}

impl DrawList {
    /// The draws.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The instance slots, run after run.
    pub fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Triangles (or lines, or points) that the list draws.
    pub fn primitives(&self) -> u64 {
        self.primitives
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Empties the list. The memory is kept.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.slots.clear();
        self.query_ends.clear();
        self.primitives = 0;
    }

    /// Number of hardware queries over the list: one an entry, unless they are [grouped](Self::group_queries).
    pub fn query_count(&self) -> u32 {
        match self.query_ends.len() {
            0 => self.slots.len() as u32,
            grouped => grouped as u32,
        }
    }

    /// The entries that a query covers: indices into [`Self::slots`].
    pub fn query_entries(&self, number: u32) -> Range<u32> {
        let at = number as usize;
        match self.query_ends.get(at) {
            Some(end) => {
                let start = at.checked_sub(1).and_then(|at| self.query_ends.get(at));
                start.copied().unwrap_or(0)..*end
            }
            None => number..number + 1,
        }
    }

    /// Where each query's entries end in [`Self::slots`]; empty where each entry is a query of its own.
    pub fn query_ends(&self) -> &[u32] {
        &self.query_ends
    }

    /// Makes one query of several neighbouring entries: a query up to each of these ends. The ends ascend; the last one is the
    /// length of the list.
    pub fn group_queries(&mut self, ends: impl Iterator<Item = u32>) {
        self.query_ends.clear();
        self.query_ends.extend(ends);
    }

    /// Fills the list with these slots in canonical order: a stable counting sort by batch, linear in slots and batches.
    /// The slots are iterated twice and must be live.
    pub fn fill<I>(&mut self, table: &SceneTable, slots: I, detail: MeshDetail)
    where
        I: Iterator<Item = u32> + Clone,
    {
        self.sort(table, slots.map(|slot| (slot, 0)), 1, |_| detail);
    }

    /// [`Self::fill`] with a level of detail for each slot, below `levels`. The order is batch, level, slot.
    pub fn fill_levels<I>(&mut self, table: &SceneTable, slots: I, levels: u8)
    where
        I: Iterator<Item = (u32, u8)> + Clone,
    {
        let levels = levels.max(1);
        let slots = slots.map(|(slot, level)| (slot, u32::from(level.min(levels - 1))));
        self.sort(table, slots, u32::from(levels), |part| {
            MeshDetail::Level(part as u8)
        });
    }

    /// [`Self::fill`] with an index into `details` for each slot. The order is batch, index, slot.
    pub fn fill_mixed<I>(&mut self, table: &SceneTable, slots: I, details: &[MeshDetail])
    where
        I: Iterator<Item = (u32, usize)> + Clone,
    {
        let last = details.len().saturating_sub(1);
        let slots = slots.map(|(slot, detail)| (slot, detail.min(last) as u32));
        self.sort(table, slots, details.len().max(1) as u32, |part| {
            let detail = details.get(part as usize);
            detail.copied().unwrap_or(MeshDetail::Level(0))
        });
    }

    /// Sorts by batch and, within a batch, by the second number of each item, below `parts`.
    fn sort<I>(
        &mut self,
        table: &SceneTable,
        slots: I,
        parts: u32,
        detail: impl Fn(u32) -> MeshDetail,
    ) where
        I: Iterator<Item = (u32, u32)> + Clone,
    {
        let place = |slot: u32, part: u32| (table.batch_of(slot) * parts + part) as usize;
        self.clear();
        self.starts.clear();
        self.starts
            .resize(table.batches().len() * parts as usize + 1, 0);
        for (slot, part) in slots.clone() {
            self.starts[place(slot, part) + 1] += 1;
        }
        let mut first = 0;
        for (batch, number) in table.batches().iter().zip(0u32..) {
            for part in 0..parts {
                let end = &mut self.starts[(number * parts + part) as usize + 1];
                let count = *end;
                *end += first;
                if count > 0 {
                    let detail = detail(part);
                    self.runs.push(Run {
                        batch: number,
                        detail,
                        first,
                        count,
                    });
                    self.primitives +=
                        u64::from(count) * u64::from(table.range(batch.mesh, detail).primitives());
                }
                first += count;
            }
        }
        self.slots.resize(first as usize, 0);
        for (slot, part) in slots {
            let start = &mut self.starts[place(slot, part)];
            self.slots[*start as usize] = slot;
            *start += 1;
        }
    }

    /// Appends one live slot. It extends the last run where batch and detail are the same. For lists whose order matters: front to
    /// back, back to front.
    pub fn push(&mut self, table: &SceneTable, slot: u32, detail: MeshDetail) {
        let batch = table.batch_of(slot);
        let first = self.slots.len() as u32;
        self.slots.push(slot);
        self.primitives += u64::from(
            table
                .range(table.batches()[batch as usize].mesh, detail)
                .primitives(),
        );
        match self.runs.last_mut() {
            Some(run) if run.batch == batch && run.detail == detail => run.count += 1,
            _ => self.runs.push(Run {
                batch,
                detail,
                first,
                count: 1,
            }),
        }
    }
}
