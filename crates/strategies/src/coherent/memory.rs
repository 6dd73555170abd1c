//! What one view remembers from frame to frame: the visible entities in drawing order, the occluded entities, and the age of each answer.
//!
//! These are the lists of Mansa et al. 2007, section 3.1: the entities visible in the last frame are drawn first in the next one, and those
//! occluded in the last frame are tested, a part of them a frame. A record belongs to an entity, not to its slot: the next entity in a slot starts without one.

use antumbra_cull::{Candidates, CountLayout, Queried, SceneTable, ViewFrame};
use antumbra_scene::EntityKey;
use glam::DVec3;

use super::fraction::AdaptiveFraction;
use antumbra_cull::order::by_nearest_corner;

/// What is known of an entity in a view.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Visibility {
    /// Nothing that holds for this frame.
    #[default]
    Unknown,
    /// A sample of it was visible when it was last drawn or tested.
    Visible,
    /// No sample of it was.
    Occluded,
}

/// What the queries of a list enclosed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum QuerySubject {
    /// The meshes, as they were drawn.
    DrawnMeshes,
    /// Test geometry, which is not shaded.
    Tests,
}

/// The answers of a list of queries.
#[derive(Clone, Copy)]
pub(crate) struct Answers<'a> {
    /// The slots and the frame of the queries.
    pub queried: &'a Queried,
    /// A u64 a query.
    pub bytes: &'a [u8],
    pub subject: QuerySubject,
}

/// What a memory keeps at a camera cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AfterCut {
    /// Nothing.
    Forget,
    /// Visible entities stay visible, as a first guess. Right for a view that tests all other entities in the same frame.
    KeepVisible,
}

#[derive(Debug, Clone, Copy, Default)]
struct EntityRecord {
    entity: Option<EntityKey>,
    visibility: Visibility,
    /// The frame of the last answer.
    answered: u64,
    /// The last frame in which it was in the frustum.
    last_inside: u64,
    /// The last frame in which it was put into the list of visible slots.
    last_listed: u64,
    /// Consecutive answers "occluded".
    occluded_streak: u8,
    /// Tests by the next view for which it shares no query there.
    alone_in_next_view: u8,
    /// A test of its box made it visible, and no sample of its mesh has been visible since.
    visible_by_box: bool,
    /// Camera motions for which it is drawn although its mesh is occluded. Its box is visible, so a test would only make it visible again.
    drawn_in_vain: u8,
}

/// Camera motions for which an entity is drawn in vain before its box is tested again.
const DRAWN_IN_VAIN: u8 = 16;

/// Tests for which an entity shares no query in the next view after it was visible in that view only.
const ALONE: u8 = 16;

/// Consecutive answers "occluded" after which an entity may share a query.
const SETTLED: u8 = 2;

impl EntityRecord {
    /// Takes the answer of a query around its drawn mesh.
    fn take_drawn(&mut self, seen: bool) {
        if seen {
            self.visibility = Visibility::Visible;
            self.visible_by_box = false;
            self.drawn_in_vain = 0;
        } else if self.visible_by_box {
            // A test of its box would make it visible again, and so on: it stays visible for a while.
            self.visible_by_box = false;
            self.drawn_in_vain = DRAWN_IN_VAIN;
        } else if self.drawn_in_vain == 0 {
            self.visibility = Visibility::Occluded;
            self.occluded_streak = 0;
        }
    }

    /// Takes the answer of a test. `entities`: the number of entities that shared the query.
    fn take_test(&mut self, seen: bool, entities: u32) {
        if seen {
            self.visibility = Visibility::Visible;
            // Of several entities that shared a query most are still occluded. One that turns out so when it is drawn is tested on its own next.
            self.visible_by_box = entities == 1;
            self.occluded_streak = 0;
        } else {
            self.visibility = Visibility::Occluded;
            self.occluded_streak = self.occluded_streak.saturating_add(1);
        }
    }
}

/// One view's memory.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    records: Vec<EntityRecord>,
    /// Visible opaque slots, in drawing order.
    visible: Vec<u32>,
    /// Occluded slots in the frustum.
    occluded: Vec<u32>,
    /// Slots in the frustum without a valid answer.
    unknown: Vec<u32>,
    /// Visible transparent slots in the frustum.
    transparent: Vec<u32>,
    sorted: Option<LastSort>,
    frame: u64,
    cuts: u64,
    pub fraction: AdaptiveFraction,
}

/// When the visible slots were last sorted.
#[derive(Debug, Clone, Copy)]
struct LastSort {
    eye: DVec3,
    /// Metres to the nearest corner of the middle entity of the list.
    middle: f64,
}

impl Memory {
    /// Takes the answers of queries of this frame or an earlier one. An answer about an entity that has left its slot, or from before a camera
    /// cut, is dropped. Returns the number of queries that found a sample of occluded entities. `cuts`: camera cuts of the view so far.
    pub fn take(&mut self, table: &SceneTable, cuts: u64, answers: Answers<'_>) -> u32 {
        let Answers {
            queried,
            bytes,
            subject,
        } = answers;
        let mut appeared = 0;
        if queried.stamp.cuts != cuts {
            return appeared;
        }
        let mut last = None;
        for (slot, query, seen) in CountLayout::ByQuery.answers(queried, bytes) {
            let Some(occupant) = table.occupant(slot) else {
                continue;
            };
            let Some(record) = self.records.get_mut(slot as usize) else {
                continue;
            };
            if occupant.added_epoch > queried.stamp.epoch || record.entity != Some(occupant.key) {
                continue;
            }
            if seen
                && record.visibility == Visibility::Occluded
                && last.replace(query.number) != Some(query.number)
            {
                appeared += 1;
            }
            record.answered = self.frame;
            match subject {
                QuerySubject::DrawnMeshes => record.take_drawn(seen),
                QuerySubject::Tests => record.take_test(seen, query.slots),
            }
        }
        appeared
    }

    /// Starts a frame: forgets the entities that have left the frustum or their slot, and sorts the other slots into the lists.
    pub fn begin(&mut self, table: &SceneTable, candidates: &Candidates, after_cut: AfterCut) {
        let cuts = candidates.stamp().cuts;
        let cut = cuts != self.cuts;
        self.cuts = cuts;
        self.frame += 1;
        self.records
            .resize_with(table.slots() as usize, EntityRecord::default);
        self.occluded.clear();
        self.unknown.clear();
        self.transparent.clear();
        let frame = self.frame;
        for slot in candidates.inside() {
            let (Some(record), Some(occupant)) =
                (self.records.get_mut(*slot as usize), table.occupant(*slot))
            else {
                continue;
            };
            if record.entity != Some(occupant.key) {
                *record = EntityRecord {
                    entity: Some(occupant.key),
                    ..EntityRecord::default()
                };
            }
            let kept =
                after_cut == AfterCut::KeepVisible && record.visibility == Visibility::Visible;
            if record.last_inside + 1 != frame || (cut && !kept) {
                record.visibility = Visibility::Unknown;
                record.occluded_streak = 0;
                record.visible_by_box = false;
                record.drawn_in_vain = 0;
            }
            record.last_inside = frame;
            match record.visibility {
                _ if candidates.is_exempt(*slot) => {}
                Visibility::Unknown => self.unknown.push(*slot),
                Visibility::Occluded => self.occluded.push(*slot),
                Visibility::Visible if table.is_transparent(*slot) => self.transparent.push(*slot),
                Visibility::Visible => {}
            }
        }
        // Slots that were listed before keep their order; new ones follow.
        let mut visible = std::mem::take(&mut self.visible);
        visible.retain(|slot| self.lists(table, candidates, *slot));
        self.visible = visible;
        for slot in candidates.inside() {
            if self.lists(table, candidates, *slot) {
                self.visible.push(*slot);
            }
        }
    }

    /// Whether a slot belongs into the list of visible slots and is not in it yet. If so, it counts as listed from now on.
    fn lists(&mut self, table: &SceneTable, candidates: &Candidates, slot: u32) -> bool {
        let frame = self.frame;
        let Some(record) = self.records.get_mut(slot as usize) else {
            return false;
        };
        let lists = record.last_inside == frame
            && record.last_listed != frame
            && record.visibility == Visibility::Visible
            && table
                .occupant(slot)
                .is_some_and(|occupant| Some(occupant.key) == record.entity)
            && !table.is_transparent(slot)
            && !candidates.is_exempt(slot);
        if lists {
            record.last_listed = frame;
        }
        lists
    }

    /// Sorts the visible slots by the nearest corner of their boxes, if the camera has moved since the last sort by more than `threshold` of its
    /// distance to the middle entity of the list.
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
        self.sorted = middle.map(|slot| LastSort {
            eye,
            middle: view.camera.nearest_corner_distance(&table.bounds(*slot)),
        });
        for record in &mut self.records {
            record.drawn_in_vain = record.drawn_in_vain.saturating_sub(1);
        }
    }

    /// The visible opaque slots, in drawing order.
    pub fn visible(&self) -> &[u32] {
        &self.visible
    }

    /// The occluded slots, ascending.
    pub fn occluded(&self) -> &[u32] {
        &self.occluded
    }

    /// The slots that a test may cull and that have no valid answer, ascending.
    pub fn unknown(&self) -> &[u32] {
        &self.unknown
    }

    /// The visible transparent slots, ascending.
    pub fn transparent(&self) -> &[u32] {
        &self.transparent
    }

    /// What is known of a slot's entity.
    pub fn visibility(&self, slot: u32) -> Visibility {
        let record = self.records.get(slot as usize);
        record.map_or(Visibility::Unknown, |record| record.visibility)
    }

    /// The frames since a slot's last answer.
    pub fn age(&self, slot: u32) -> u64 {
        self.frame.saturating_sub(self.answered(slot))
    }

    /// The frame of a slot's last answer.
    pub fn answered(&self, slot: u32) -> u64 {
        let record = self.records.get(slot as usize);
        record.map_or(0, |record| record.answered)
    }

    /// Whether a slot has been occluded for long enough to share a query.
    pub fn may_share_query(&self, slot: u32) -> bool {
        let record = self.records.get(slot as usize);
        record.is_some_and(|record| {
            record.visibility == Visibility::Occluded && record.occluded_streak >= SETTLED
        })
    }

    /// Whether a slot may share a query of the next view.
    pub fn may_share_query_of_next_view(&self, slot: u32) -> bool {
        let record = self.records.get(slot as usize);
        self.may_share_query(slot) && record.is_some_and(|record| record.alone_in_next_view == 0)
    }

    /// Takes the answer of the next view's test of a slot.
    pub fn take_next_view_test(&mut self, slot: u32, seen: bool) {
        if let Some(record) = self.records.get_mut(slot as usize) {
            record.alone_in_next_view = match seen {
                true => ALONE,
                false => record.alone_in_next_view.saturating_sub(1),
            };
        }
    }

    /// Drops what is known of a slot.
    pub fn forget(&mut self, slot: u32) {
        if let Some(record) = self.records.get_mut(slot as usize) {
            record.visibility = Visibility::Unknown;
        }
    }
}
