//! Draw lists: which entities to draw, grouped into as few draws as their batches allow.
//!
//! A list is plain data: runs of instance slots, each run one instanced draw. Lists made by [`DrawList::fill`] are in the
//! canonical order (batch, then slot), so that two lists with the same members draw in the same order and equal depths
//! fall to the same entity whichever strategy made them.

use crate::table::SceneTable;

/// Which of a mesh's geometries to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Detail {
    /// A level of detail: 0 is the full mesh. A mesh with fewer levels draws its coarsest.
    Level(u8),
    /// The stand-in for tests; the full mesh where it has none.
    Proxy,
    /// The bounding box of the mesh in its own space: twelve triangles.
    Box,
}

/// Consecutive instances of one batch: one instanced draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Index into [`SceneTable::batches`].
    pub batch: u32,
    /// Which geometry.
    pub detail: Detail,
    /// First entry in [`DrawList::ids`].
    pub first: u32,
    /// How many entries.
    pub count: u32,
}

/// Instance slots in drawing order.
#[derive(Debug, Clone, Default)]
pub struct DrawList {
    runs: Vec<Run>,
    ids: Vec<u32>,
    primitives: u64,
    starts: Vec<u32>,
    /// Where each question ends in `ids`; empty: each entry is one.
    questions: Vec<u32>,
}

impl DrawList {
    /// The draws.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The instance slots, run after run.
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }

    /// Triangles (or lines, or points) that the list draws.
    pub fn primitives(&self) -> u64 {
        self.primitives
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.ids.clear();
        self.questions.clear();
        self.primitives = 0;
    }

    /// How many hardware queries ask about the list: one an entry, unless [joined](Self::join).
    pub fn questions(&self) -> u32 {
        match self.questions.len() {
            0 => self.ids.len() as u32,
            joined => joined as u32,
        }
    }

    /// The entries that a question is about: indices into [`Self::ids`].
    pub fn question(&self, number: u32) -> std::ops::Range<u32> {
        let at = number as usize;
        match self.questions.get(at) {
            Some(end) => at.checked_sub(1).map_or(0, |before| self.questions[before])..*end,
            None => number..number + 1,
        }
    }

    /// Where each question ends in [`Self::ids`]; empty where each entry is one.
    pub fn question_ends(&self) -> &[u32] {
        &self.questions
    }

    /// Has the entries be asked about together, a question up to each of these ends: ascending, the last one the length of the list.
    pub fn join(&mut self, ends: impl Iterator<Item = u32>) {
        self.questions.clear();
        self.questions.extend(ends);
    }

    /// Makes the list of these slots in canonical order: a stable counting sort by batch, linear in slots and batches.
    /// The slots are walked twice and must be live.
    pub fn fill<I>(&mut self, table: &SceneTable, slots: I, detail: Detail)
    where
        I: Iterator<Item = u32> + Clone,
    {
        self.sort(table, slots.map(|slot| (slot, 0)), 1, |_| detail);
    }

    /// As [`Self::fill`], each slot at a level of detail of its own, below `levels`: in the order of batch, level, slot.
    pub fn fill_levels<I>(&mut self, table: &SceneTable, slots: I, levels: u8)
    where
        I: Iterator<Item = (u32, u8)> + Clone,
    {
        let levels = levels.max(1);
        let slots = slots.map(|(slot, level)| (slot, u32::from(level.min(levels - 1))));
        self.sort(table, slots, u32::from(levels), |part| {
            Detail::Level(part as u8)
        });
    }

    /// As [`Self::fill`], each slot in one of some details, by its number: in the order of batch, number, slot.
    pub fn fill_mixed<I>(&mut self, table: &SceneTable, slots: I, details: &[Detail])
    where
        I: Iterator<Item = (u32, usize)> + Clone,
    {
        let last = details.len().saturating_sub(1);
        let slots = slots.map(|(slot, detail)| (slot, detail.min(last) as u32));
        self.sort(table, slots, details.len().max(1) as u32, |part| {
            let detail = details.get(part as usize);
            detail.copied().unwrap_or(Detail::Level(0))
        });
    }

    /// Sorts by batch and, within it, by one of `parts`.
    fn sort<I>(&mut self, table: &SceneTable, slots: I, parts: u32, detail: impl Fn(u32) -> Detail)
    where
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
        self.ids.resize(first as usize, 0);
        for (slot, part) in slots {
            let start = &mut self.starts[place(slot, part)];
            self.ids[*start as usize] = slot;
            *start += 1;
        }
    }

    /// Adds one entity at the end; it joins the last run where batch and detail are the same. For lists whose order
    /// matters: front to back, back to front.
    pub fn push(&mut self, table: &SceneTable, slot: u32, detail: Detail) {
        let batch = table.batch_of(slot);
        let first = self.ids.len() as u32;
        self.ids.push(slot);
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
