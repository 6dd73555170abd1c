//! What one view remembers from frame to frame: who was visible, in the order of drawing, and who was occluded since when.
//!
//! The lists of Mansa et al. 2007, section 3.1: what was visible last starts what is visible next, what was occluded last is tested,
//! in parts. Each memory is of one entity, not of the slot it happens to lie in: an entity that is replaced takes its memory along.

use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::EntityKey;
use glam::DVec3;

use super::fraction::Fraction;
use antumbra_cull::order::by_nearest_corner;
use antumbra_cull::{Candidates, CountLayout, Queried};

/// What is known of an entity in a view.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Known {
    /// Nothing that holds for this frame.
    #[default]
    Nothing,
    /// It had a sample when it was last drawn or tested.
    Visible,
    /// It had none.
    Occluded,
}

#[derive(Debug, Clone, Copy, Default)]
struct Memo {
    of: Option<EntityKey>,
    known: Known,
    /// The frame of the last answer.
    answered: u64,
    /// The last frame it was in the frustum.
    inside: u64,
    /// The last frame it was put into the list of the visible.
    listed: u64,
    /// How many answers in a row said that it is occluded.
    streak: u8,
    /// For how many tests by the next eye it is asked about alone there.
    alone: u8,
    /// A test of its box made it visible, and no sample of its mesh has been seen since.
    by_box: bool,
    /// Motions of the camera for which it is drawn in vain: its box is visible and its mesh is not, which testing would only find again.
    in_vain: u8,
}

/// For how many motions of the camera something is drawn in vain before its box is asked again.
const IN_VAIN: u8 = 16;

/// For how many tests an eye asks about something alone after it was visible to that eye only.
const ALONE: u8 = 16;

/// After how many answers in a row an occluded entity may be asked about together with others.
const SETTLED: u8 = 2;

impl Memo {
    /// Its mesh was drawn, and a sample of it passed or none.
    fn was_drawn(&mut self, seen: bool) {
        if seen {
            self.known = Known::Visible;
            self.by_box = false;
            self.in_vain = 0;
        } else if self.by_box {
            // Its box would be found visible again, and so on: it stays, for a while.
            self.by_box = false;
            self.in_vain = IN_VAIN;
        } else if self.in_vain == 0 {
            self.known = Known::Occluded;
            self.streak = 0;
        }
    }

    /// Its box was tested, alone or together with others.
    fn was_tested(&mut self, seen: bool, alone: bool) {
        if seen {
            self.known = Known::Visible;
            // Of several that were tested together most are none the wiser: what is not seen once drawn goes back to be tested alone.
            self.by_box = alone;
            self.streak = 0;
        } else {
            self.known = Known::Occluded;
            self.streak = self.streak.saturating_add(1);
        }
    }
}

/// One view's memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    memos: Vec<Memo>,
    /// Slots of the visible, in the order they are drawn; what is blended is not among them.
    visible: Vec<u32>,
    /// Slots of the occluded in the frustum.
    occluded: Vec<u32>,
    /// Slots in the frustum of which nothing is known.
    unknown: Vec<u32>,
    /// Blended slots in the frustum that are not occluded.
    blended: Vec<u32>,
    sorted: Option<Sorted>,
    frame: u64,
    cuts: u64,
    pub fraction: Fraction,
}

/// When the visible were sorted last.
#[derive(Debug, Clone, Copy)]
struct Sorted {
    eye: DVec3,
    /// Metres to the nearest corner of the one in the middle of the list.
    middle: f64,
}

impl Memory {
    /// Takes the answers of a query pass in, asked in this frame or an earlier one; `drawn` when the queries enclosed the meshes as
    /// they were drawn. Answers about others than those who live in the slots now, and about another camera cut, are dropped. Returns how
    /// many questions about what was occluded were answered with a sample.
    pub fn take(
        &mut self,
        table: &SceneTable,
        cuts: u64,
        (asked, layout, bytes): (&Queried, CountLayout, &[u8]),
        drawn: bool,
    ) -> u32 {
        let mut appeared = 0;
        if asked.stamp.cuts != cuts {
            return appeared;
        }
        let mut last = None;
        for (slot, query, seen) in layout.answers(asked, bytes) {
            let Some(occupant) = table.occupant(slot) else {
                continue;
            };
            let Some(memo) = self.memos.get_mut(slot as usize) else {
                continue;
            };
            if occupant.added_epoch > asked.stamp.epoch || memo.of != Some(occupant.key) {
                continue;
            }
            if seen
                && memo.known == Known::Occluded
                && last.replace(query.number) != Some(query.number)
            {
                appeared += 1;
            }
            memo.answered = self.frame;
            match drawn {
                true => memo.was_drawn(seen),
                false => memo.was_tested(seen, query.slots == 1),
            }
        }
        appeared
    }

    /// Begins a frame: forgets what left the frustum, was replaced or lies before a cut, and lists the rest. With `guesses` what was
    /// visible before a cut counts as visible still: for those who test all else in this same frame.
    pub fn begin(&mut self, table: &SceneTable, candidates: &Candidates, guesses: bool) {
        let cuts = candidates.stamp().cuts;
        let jumped = cuts != self.cuts;
        self.cuts = cuts;
        self.frame += 1;
        self.memos
            .resize_with(table.slots() as usize, Memo::default);
        self.occluded.clear();
        self.unknown.clear();
        self.blended.clear();
        let frame = self.frame;
        for slot in candidates.inside() {
            let (Some(memo), Some(occupant)) =
                (self.memos.get_mut(*slot as usize), table.occupant(*slot))
            else {
                continue;
            };
            if memo.of != Some(occupant.key) {
                *memo = Memo {
                    of: Some(occupant.key),
                    ..Memo::default()
                };
            }
            if memo.inside + 1 != frame || (jumped && !(guesses && memo.known == Known::Visible)) {
                memo.known = Known::Nothing;
                memo.streak = 0;
                memo.by_box = false;
                memo.in_vain = 0;
            }
            memo.inside = frame;
            let exempt = candidates.is_exempt(*slot);
            match memo.known {
                _ if exempt => {}
                Known::Nothing => self.unknown.push(*slot),
                Known::Occluded => self.occluded.push(*slot),
                Known::Visible if table.is_transparent(*slot) => self.blended.push(*slot),
                Known::Visible => {}
            }
        }
        let mut visible = std::mem::take(&mut self.visible);
        visible.retain(|slot| self.lists(table, candidates, *slot));
        self.visible = visible;
        for slot in candidates.inside() {
            if self.lists(table, candidates, *slot) {
                self.visible.push(*slot);
            }
        }
    }

    /// Whether a slot belongs into the list of the visible and is not in it yet; from now on it is.
    fn lists(&mut self, table: &SceneTable, candidates: &Candidates, slot: u32) -> bool {
        let frame = self.frame;
        let Some(memo) = self.memos.get_mut(slot as usize) else {
            return false;
        };
        let lists = memo.inside == frame
            && memo.listed != frame
            && memo.known == Known::Visible
            && table
                .occupant(slot)
                .is_some_and(|occupant| Some(occupant.key) == memo.of)
            && !table.is_transparent(slot)
            && !candidates.is_exempt(slot);
        if lists {
            memo.listed = frame;
        }
        lists
    }

    /// Sorts the visible by the nearest corner of their boxes, if the camera has moved by more than `threshold` of its distance to
    /// the one in the middle of the list since they were sorted last.
    pub fn sort(&mut self, table: &SceneTable, view: &ViewFrame, threshold: f64) {
        let eye = view.camera.position;
        let moved = self
            .sorted
            .is_none_or(|last| last.eye.distance(eye) > threshold * last.middle);
        if !moved {
            return;
        }
        by_nearest_corner(&mut self.visible, table, view);
        let middle = self.visible.get(self.visible.len() / 2);
        self.sorted = middle.map(|slot| Sorted {
            eye,
            middle: view.camera.nearest_corner_distance(&table.bounds(*slot)),
        });
        for memo in &mut self.memos {
            memo.in_vain = memo.in_vain.saturating_sub(1);
        }
    }

    /// Slots of the visible, in the order of drawing.
    pub fn visible(&self) -> &[u32] {
        &self.visible
    }

    /// Slots of the occluded, ascending.
    pub fn occluded(&self) -> &[u32] {
        &self.occluded
    }

    /// Slots that a test may judge and of which nothing is known; ascending.
    pub fn unknown(&self) -> &[u32] {
        &self.unknown
    }

    /// Blended slots that were visible; ascending.
    pub fn blended(&self) -> &[u32] {
        &self.blended
    }

    /// What is known of a slot.
    pub fn known(&self, slot: u32) -> Known {
        self.memos
            .get(slot as usize)
            .map_or(Known::Nothing, |memo| memo.known)
    }

    /// The frame of a slot's last answer.
    pub fn answered(&self, slot: u32) -> u64 {
        self.memos
            .get(slot as usize)
            .map_or(0, |memo| memo.answered)
    }

    /// Whether a slot has been occluded for long enough to be asked about together with others.
    pub fn settled(&self, slot: u32) -> bool {
        self.memos
            .get(slot as usize)
            .is_some_and(|memo| memo.known == Known::Occluded && memo.streak >= SETTLED)
    }

    /// Whether the next eye may ask about a slot together with others.
    pub fn settled_there(&self, slot: u32) -> bool {
        let memo = self.memos.get(slot as usize);
        self.settled(slot) && memo.is_some_and(|memo| memo.alone == 0)
    }

    /// Takes in what the next eye's test of a slot said.
    pub fn was_tested_there(&mut self, slot: u32, seen: bool) {
        if let Some(memo) = self.memos.get_mut(slot as usize) {
            memo.alone = if seen {
                ALONE
            } else {
                memo.alone.saturating_sub(1)
            };
        }
    }

    /// Has nothing known of a slot: what it was drawn for says nothing about this view.
    pub fn forget(&mut self, slot: u32) {
        if let Some(memo) = self.memos.get_mut(slot as usize) {
            memo.known = Known::Nothing;
        }
    }
}
