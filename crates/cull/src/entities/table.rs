//! The host's data of all drawable entities, laid out for culling: one slot for each entity, dense arrays by slot.
//!
//! A table is a snapshot. The graph's host nodes share it through an `Arc`; its owner (the built-in renderer's scene, or a host's) changes it between
//! frames, when no node holds it.

mod meshes;

use std::collections::HashMap;

use antumbra_scene::bounds::BoxArray;
use antumbra_scene::{Aabb, EntityKey};
use glam::{DAffine3, DVec3};

use super::class::{Alpha, PipelineClass};
use super::detail::MeshDetail;
use super::oriented::OrientedBox;
use super::part_table::PartTable;
use super::ranges::MeshRanges;
use super::scale::least_scale;
use super::slot_groups::SlotGroups;

/// What the instances of one instanced draw share: pipeline, texture, mesh. Sorts in drawing order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Batch {
    /// Decides the pipeline.
    pub class: PipelineClass,
    /// Index of the base-colour texture's bind group.
    pub texture: u32,
    /// Index of the mesh.
    pub mesh: u32,
}

/// The entity in a slot. Slots of removed entities are reused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Occupant {
    /// The entity.
    pub key: EntityKey,
    /// The epoch in which it was put into this slot. Query results of older epochs belong to an earlier occupant.
    pub added_epoch: u64,
}

/// An entity on its way into a slot.
/// [`SceneTable::occupy`] takes it.
#[derive(Debug, Clone, Copy)]
pub struct NewOccupant {
    /// The entity.
    pub key: EntityKey,
    /// World bounds.
    pub bounds: Aabb,
    /// World transform.
    pub world: DAffine3,
    /// What it is drawn with.
    pub batch: Batch,
    /// Whether visibility tests may cull it.
    pub tested: bool,
}

/// All drawable entities, by slot.
#[derive(Debug, Clone, Default)]
pub struct SceneTable {
    occupants: Vec<Option<Occupant>>,
    boxes: BoxArray,
    batch_of: Vec<u32>,
    untested: Vec<bool>,
    /// The least factor by which the world transform stretches a length.
    least_scales: Vec<f32>,
    /// By how many metres, at most, the proxy deviates from the mesh.
    deviations: Vec<f32>,
    oriented: Vec<OrientedBox>,
    groups: SlotGroups,
    /// Slots whose entities were added, removed or moved since `changed_since`.
    changed: Vec<u32>,
    changed_since: u64,
    batches: Vec<Batch>,
    meshes: Vec<MeshRanges>,
    parts: PartTable,
    epoch: u64,
    arrangement: u64,
    live: usize,
    transparent: usize,
}

impl SceneTable {
    /// Number of slots, free ones included. All slots are below it.
    pub fn slots(&self) -> u32 {
        self.occupants.len() as u32
    }

    /// Number of entities.
    pub fn live(&self) -> usize {
        self.live
    }

    /// Increases with each change. Query results carry the epoch in which their query was issued.
    pub fn epoch(&self) -> u64 {
        self.epoch
    }

    /// Increases when entities are added or removed, or batches renumbered: which slots there are, and what each is drawn with. Movement leaves it as it is.
    pub fn arrangement(&self) -> u64 {
        self.arrangement
    }

    /// The entity in a slot; `None` for a free slot.
    pub fn occupant(&self, slot: u32) -> Option<&Occupant> {
        self.occupants.get(slot as usize)?.as_ref()
    }

    /// Slots in use, ascending.
    pub fn live_slots(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.occupants
            .iter()
            .zip(0u32..)
            .filter_map(|(occupant, slot)| occupant.as_ref().map(|_| slot))
    }

    /// World bounds by slot, in metres. Those of free slots are stale and may pass a test: check [`Self::occupant`].
    pub fn boxes(&self) -> &BoxArray {
        &self.boxes
    }

    /// World bounds of a slot, in metres; the origin for a slot that does not exist.
    pub fn bounds(&self, slot: u32) -> Aabb {
        self.boxes.get(slot as usize).unwrap_or(Aabb {
            min: DVec3::ZERO,
            max: DVec3::ZERO,
        })
    }

    /// The batch of a live slot.
    pub fn batch_of(&self, slot: u32) -> u32 {
        self.batch_of[slot as usize]
    }

    /// The class of a live slot.
    pub fn class_of(&self, slot: u32) -> PipelineClass {
        self.batches[self.batch_of(slot) as usize].class
    }

    /// Whether a live slot's entity is blended.
    pub fn is_transparent(&self, slot: u32) -> bool {
        self.class_of(slot).alpha() == Alpha::Blend
    }

    /// Whether a live slot's entity may be an occluder ([`PipelineClass::occludes`]).
    pub fn is_occluder(&self, slot: u32) -> bool {
        self.class_of(slot).occludes()
    }

    /// Whether any entity is blended.
    pub fn has_transparent(&self) -> bool {
        self.transparent > 0
    }

    /// Batches in drawing order.
    pub fn batches(&self) -> &[Batch] {
        &self.batches
    }

    /// Triangles (or lines, or points) of a live slot's entity in some detail.
    pub fn primitives_of(&self, slot: u32, detail: MeshDetail) -> u32 {
        self.range(self.batches[self.batch_of(slot) as usize].mesh, detail)
            .primitives()
    }

    /// Levels of detail of a live slot's mesh, the full one included.
    pub fn levels_of(&self, slot: u32) -> u8 {
        self.batch_levels(self.batch_of(slot))
    }

    /// Levels of detail of a batch's mesh; 1 for a batch that does not exist.
    pub fn batch_levels(&self, batch: u32) -> u8 {
        let mesh = self.batches.get(batch as usize).map(|batch| batch.mesh);
        let ranges = mesh.and_then(|mesh| self.meshes.get(mesh as usize));
        ranges.map_or(1, |ranges| ranges.levels.len().clamp(1, 255)) as u8
    }

    /// By how many metres, at least, the box of [`MeshDetail::Box`] is wider than the full mesh on every side; 0 where the transform
    /// flattens.
    pub fn box_margin(&self, slot: u32) -> f64 {
        let at = slot as usize;
        let mesh = self
            .batch_of
            .get(at)
            .and_then(|batch| self.batches.get(*batch as usize))
            .and_then(|batch| self.meshes.get(batch.mesh as usize));
        let scale = self.least_scales.get(at).copied().unwrap_or(0.0);
        mesh.map_or(0.0, |mesh| mesh.box_margin * f64::from(scale))
    }

    /// By how many metres, at most, an entity's proxy deviates from its mesh; 0 where it has none.
    pub fn deviation(&self, slot: u32) -> f32 {
        self.deviations.get(slot as usize).copied().unwrap_or(0.0)
    }

    /// The bounding box of a slot's entity along the entity's own axes; a point for a slot that does not exist.
    pub fn oriented(&self, slot: u32) -> OrientedBox {
        let known = self.oriented.get(slot as usize).copied();
        known.unwrap_or_else(|| OrientedBox::aligned(&self.bounds(slot)))
    }

    /// The scene's hierarchy: the group of each slot.
    pub fn groups(&self) -> &SlotGroups {
        &self.groups
    }

    /// The slots whose entities were added, removed or moved since an epoch, with possible duplicates; `None` where the epoch is too long
    /// ago.
    pub fn changed_since(&self, epoch: u64) -> Option<&[u32]> {
        (epoch >= self.changed_since).then_some(&self.changed)
    }

    /// Whether visibility tests may cull an entity.
    pub fn is_tested(&self, slot: u32) -> bool {
        self.untested
            .get(slot as usize)
            .is_none_or(|untested| !untested)
    }

    /// The scene's hierarchy, to change it.
    pub fn groups_mut(&mut self) -> &mut SlotGroups {
        &mut self.groups
    }

    /// Clears the list of changed slots.
    pub fn clear_changes(&mut self) {
        self.changed.clear();
        self.changed_since = self.epoch;
    }

    /// Begins a new epoch.
    pub fn next_epoch(&mut self) {
        self.epoch += 1;
    }

    /// Makes room for more slots and meshes.
    pub fn reserve(&mut self, slots: usize, meshes: usize) {
        self.occupants.reserve(slots);
        self.boxes.reserve(slots);
        self.batch_of.reserve(slots);
        self.untested.reserve(slots);
        self.least_scales.reserve(slots);
        self.deviations.reserve(slots);
        self.oriented.reserve(slots);
        self.changed.reserve(slots);
        self.meshes.reserve(meshes);
        self.parts.reserve(meshes);
    }

    /// Puts an entity into a slot: the next new one, or a free one. Its batch index is provisional until [`Self::sort_batches`].
    pub fn occupy(&mut self, slot: u32, entity: NewOccupant, index: &mut HashMap<Batch, u32>) {
        let NewOccupant {
            key,
            bounds,
            world,
            batch,
            tested,
        } = entity;
        let occupant = Some(Occupant {
            key,
            added_epoch: self.epoch,
        });
        let number = *index.entry(batch).or_insert_with(|| {
            self.batches.push(batch);
            self.batches.len() as u32 - 1
        });
        let at = slot as usize;
        self.changed.push(slot);
        self.arrangement += 1;
        let oriented = self.orient(batch.mesh, bounds, &world);
        let deviation = self.deviates(batch.mesh, &world);
        if at == self.occupants.len() {
            self.occupants.push(occupant);
            self.boxes.push(bounds);
            self.batch_of.push(number);
            self.untested.push(!tested);
            self.least_scales.push(least_scale(&world));
            self.deviations.push(deviation);
            self.oriented.push(oriented);
        } else {
            self.occupants[at] = occupant;
            self.boxes.set(at, bounds);
            self.batch_of[at] = number;
            self.untested[at] = !tested;
            self.least_scales[at] = least_scale(&world);
            self.deviations[at] = deviation;
            self.oriented[at] = oriented;
        }
        self.live += 1;
        self.count(batch.class, 1);
    }

    /// Frees a slot.
    pub fn vacate(&mut self, slot: u32) {
        let Some(place) = self.occupants.get_mut(slot as usize) else {
            return;
        };
        if place.take().is_some() {
            self.live -= 1;
            self.changed.push(slot);
            self.arrangement += 1;
            self.count(
                self.batches[self.batch_of[slot as usize] as usize].class,
                -1,
            );
        }
    }

    /// Moves the entity in a slot.
    pub fn move_to(&mut self, slot: u32, bounds: Aabb, world: &DAffine3) {
        self.boxes.set(slot as usize, bounds);
        self.changed.push(slot);
        let mesh = self.batches[self.batch_of(slot) as usize].mesh;
        let oriented = self.orient(mesh, bounds, world);
        if let Some(place) = self.oriented.get_mut(slot as usize) {
            *place = oriented;
        }
        if let Some(scale) = self.least_scales.get_mut(slot as usize) {
            *scale = least_scale(world);
        }
        let deviation = self.deviates(mesh, world);
        if let Some(place) = self.deviations.get_mut(slot as usize) {
            *place = deviation;
        }
    }

    /// Sorts the batches into drawing order and renumbers the slots' batches.
    pub fn sort_batches(&mut self, index: &mut HashMap<Batch, u32>) {
        if self.batches.is_sorted() {
            return;
        }
        self.arrangement += 1;
        let before = self.batches.clone();
        self.batches.sort_unstable();
        for (batch, number) in self.batches.iter().zip(0u32..) {
            index.insert(*batch, number);
        }
        for number in &mut self.batch_of {
            if let Some(new) = before
                .get(*number as usize)
                .and_then(|batch| index.get(batch))
            {
                *number = *new;
            }
        }
    }

    /// Counts a transparent entity in or out.
    fn count(&mut self, class: PipelineClass, by: isize) {
        if class.alpha() == Alpha::Blend {
            self.transparent = self.transparent.saturating_add_signed(by);
        }
    }
}
