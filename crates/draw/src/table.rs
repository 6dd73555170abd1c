//! What the host knows of everything drawable, laid out for culling: one slot an entity, dense arrays by slot.
//!
//! A table is a snapshot shared with the graph's host nodes through an `Arc`; the scene's owner changes it between
//! frames, when nobody else holds it.

use std::collections::HashMap;

use antumbra_scene::bounds::BoxArray;
use antumbra_scene::{Aabb, EntityKey};
use glam::{DAffine3, DVec3};

use crate::class::{Alpha, PipelineClass};
use crate::detail::MeshDetail;
use crate::oriented::OrientedBox;
use crate::ranges::{IndexRange, MeshRanges};
use crate::scale::{greatest_scale, least_scale};
use crate::slot_groups::SlotGroups;

/// What can be drawn in one instanced draw: same pipeline, same texture, same mesh. Sorts in drawing order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Batch {
    /// Decides the pipeline.
    pub class: PipelineClass,
    /// Index of the base-colour texture's bind group.
    pub texture: u32,
    /// Index of the mesh.
    pub mesh: u32,
}

/// What a slot holds. Slots of removed entities are reused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Occupant {
    /// The entity.
    pub key: EntityKey,
    /// The epoch in which it came into this slot: answers of older epochs are not about it.
    pub added_epoch: u64,
}

/// Everything drawable, by slot.
#[derive(Debug, Clone, Default)]
pub struct SceneTable {
    occupants: Vec<Option<Occupant>>,
    boxes: BoxArray,
    batch_of: Vec<u32>,
    untested: Vec<bool>,
    /// The least that a length in the entity's own space grows by on its way into the world.
    least_scales: Vec<f32>,
    /// By how many metres, at most, the stand-in deviates from the mesh.
    deviations: Vec<f32>,
    oriented: Vec<OrientedBox>,
    groups: SlotGroups,
    /// Slots that somebody came into, left, or moved in since `changed_since`.
    changed: Vec<u32>,
    changed_since: u64,
    batches: Vec<Batch>,
    meshes: Vec<MeshRanges>,
    epoch: u64,
    live: usize,
    transparent: usize,
}

impl SceneTable {
    /// Number of slots, free ones included. Slots are below this.
    pub fn slots(&self) -> u32 {
        self.occupants.len() as u32
    }

    /// Number of entities.
    pub fn live(&self) -> usize {
        self.live
    }

    /// Counts the changes; every answer is stamped with the epoch it was asked in.
    pub fn epoch(&self) -> u64 {
        self.epoch
    }

    /// Who is in a slot; `None` for a free one.
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

    /// World bounds by slot, for culling. Those of free slots are empty, yet may pass a test: see [`Self::occupant`].
    pub fn boxes(&self) -> &BoxArray {
        &self.boxes
    }

    /// World bounds of a slot; of one that does not exist, the origin.
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

    /// Whether a live slot's entity may hide others ([`PipelineClass::occludes`]).
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

    /// Where a mesh's geometry lies; an empty range for a mesh that does not exist.
    pub fn range(&self, mesh: u32, detail: MeshDetail) -> IndexRange {
        let ranges = self.meshes.get(mesh as usize);
        ranges
            .map(|ranges| ranges.range(detail))
            .unwrap_or_default()
    }

    /// Triangles (or lines, or points) of an entity in some detail.
    pub fn primitives_of(&self, slot: u32, detail: MeshDetail) -> u32 {
        self.range(self.batches[self.batch_of(slot) as usize].mesh, detail)
            .primitives()
    }

    /// Levels of detail of an entity's mesh, the full one included.
    pub fn levels_of(&self, slot: u32) -> u8 {
        self.batch_levels(self.batch_of(slot))
    }

    /// Levels of detail of a batch's mesh; 1 for a batch that does not exist.
    pub fn batch_levels(&self, batch: u32) -> u8 {
        let mesh = self.batches.get(batch as usize).map(|batch| batch.mesh);
        let ranges = mesh.and_then(|mesh| self.meshes.get(mesh as usize));
        ranges.map_or(1, |ranges| ranges.levels.len().clamp(1, 255)) as u8
    }

    /// By how many metres, at least, the box of [`MeshDetail::Box`] is wider than the full mesh on every side; 0 where a transform is flat.
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

    /// By how many metres, at most, an entity's stand-in deviates from its mesh; 0 where it has none.
    pub fn deviation(&self, slot: u32) -> f32 {
        self.deviations.get(slot as usize).copied().unwrap_or(0.0)
    }

    /// The box of a live slot's entity along its own axes; of one that does not exist, a point.
    pub fn oriented(&self, slot: u32) -> OrientedBox {
        let known = self.oriented.get(slot as usize).copied();
        known.unwrap_or_else(|| OrientedBox::aligned(&self.bounds(slot)))
    }

    /// The scene's tree: what lies in which group.
    pub fn groups(&self) -> &SlotGroups {
        &self.groups
    }

    /// The slots that entities came into, left, or moved in since an epoch, some perhaps twice; `None` where that is too long ago.
    pub fn changed_since(&self, epoch: u64) -> Option<&[u32]> {
        (epoch >= self.changed_since).then_some(&self.changed)
    }

    /// Whether a test of its visibility may cull an entity.
    pub fn is_tested(&self, slot: u32) -> bool {
        self.untested
            .get(slot as usize)
            .is_none_or(|untested| !untested)
    }

    pub(crate) fn groups_mut(&mut self) -> &mut SlotGroups {
        &mut self.groups
    }

    /// From now on changes are remembered; those before are not.
    pub(crate) fn forget_changes(&mut self) {
        self.changed.clear();
        self.changed_since = self.epoch;
    }

    pub(crate) fn next_epoch(&mut self) {
        self.epoch += 1;
    }

    pub(crate) fn add_mesh(&mut self, ranges: MeshRanges) -> u32 {
        self.meshes.push(ranges);
        self.meshes.len() as u32 - 1
    }

    /// Puts an entity into a slot (the next new one, or a free one). Its batch index is provisional until [`Self::sort_batches`].
    pub(crate) fn occupy(
        &mut self,
        slot: u32,
        key: EntityKey,
        (bounds, world): (Aabb, &DAffine3),
        batch: Batch,
        tested: bool,
        index: &mut HashMap<Batch, u32>,
    ) {
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
        let oriented = self.orient(batch.mesh, bounds, world);
        let deviation = self.deviates(batch.mesh, world);
        if at == self.occupants.len() {
            self.occupants.push(occupant);
            self.boxes.push(bounds);
            self.batch_of.push(number);
            self.untested.push(!tested);
            self.least_scales.push(least_scale(world));
            self.deviations.push(deviation);
            self.oriented.push(oriented);
        } else {
            self.occupants[at] = occupant;
            self.boxes.set(at, bounds);
            self.batch_of[at] = number;
            self.untested[at] = !tested;
            self.least_scales[at] = least_scale(world);
            self.deviations[at] = deviation;
            self.oriented[at] = oriented;
        }
        self.live += 1;
        self.count(batch.class, 1);
    }

    pub(crate) fn vacate(&mut self, slot: u32) {
        let Some(place) = self.occupants.get_mut(slot as usize) else {
            return;
        };
        if place.take().is_some() {
            self.live -= 1;
            self.changed.push(slot);
            self.count(
                self.batches[self.batch_of[slot as usize] as usize].class,
                -1,
            );
        }
    }

    pub(crate) fn move_to(&mut self, slot: u32, bounds: Aabb, world: &DAffine3) {
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

    fn deviates(&self, mesh: u32, world: &DAffine3) -> f32 {
        let own = self
            .meshes
            .get(mesh as usize)
            .map_or(0.0, |mesh| mesh.deviation);
        (own * greatest_scale(world)) as f32
    }

    fn orient(&self, mesh: u32, bounds: Aabb, world: &DAffine3) -> OrientedBox {
        match self.meshes.get(mesh as usize) {
            Some(mesh) if !mesh.bounds.is_empty() => OrientedBox::new(&mesh.bounds, world, &bounds),
            _ => OrientedBox::aligned(&bounds),
        }
    }

    /// Brings the batches into drawing order and renumbers the slots' batches.
    pub(crate) fn sort_batches(&mut self, index: &mut HashMap<Batch, u32>) {
        if self.batches.is_sorted() {
            return;
        }
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

    fn count(&mut self, class: PipelineClass, by: isize) {
        if class.alpha() == Alpha::Blend {
            self.transparent = self.transparent.saturating_add_signed(by);
        }
    }
}
