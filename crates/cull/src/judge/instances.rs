//! The instances of a host: boxes by stable index, which come, move and go.

use antumbra_scene::{Aabb, BoxArray};
use glam::DAffine3;

use super::error::JudgeError;
use super::record::{JudgedInstance, Part};
use super::upload::Uploader;
use crate::device::Gpu;
use crate::stage_scene::next_scene_number;

/// Names an instance. Its index is stable while the instance exists, below [`Instances::slots`], and used again later by another one with another generation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstanceId {
    index: u32,
    generation: u32,
}

impl InstanceId {
    /// The place of its bit in masks, and of its verdict.
    pub const fn index(self) -> u32 {
        self.index
    }

    /// How many owners the index had before, and 1.
    pub const fn generation(self) -> u32 {
        self.generation
    }
}

/// A new instance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InstanceDesc {
    /// Bounds in its own space. With [`DAffine3::IDENTITY`] as transform: in the world.
    pub bounds: Aabb,
    /// From its own space to the world, in metres.
    pub at: DAffine3,
    /// What it is in tests.
    pub part: Part,
}

/// An instance's new place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// The instance.
    pub id: InstanceId,
    /// From its own space to the world.
    pub at: DAffine3,
}

/// The instances that a [`Judge`](super::Judge) judges. Several judges may share them.
#[derive(Debug)]
pub struct Instances {
    gpu: Gpu,
    /// No other set of this process has it.
    number: u64,
    source: Source,
    /// Increases with each change that has reached the device.
    epoch: u64,
}

#[derive(Debug)]
enum Source {
    Ours(Box<Kept>),
    /// A buffer that the GPU alone reads.
    Theirs {
        buffer: wgpu::Buffer,
        count: u32,
    },
}

/// What is kept on the host, by index.
#[derive(Debug)]
struct Kept {
    records: Vec<JudgedInstance>,
    owners: Vec<Owner>,
    free: Vec<u32>,
    /// Indices whose records have changed since the last upload, each once.
    changed: Vec<u32>,
    uploader: Uploader,
    /// Memory for moves.
    moved: Vec<JudgedInstance>,
    /// Bounds in the world, once they have been asked for.
    world: Option<World>,
}

/// What the device does not know of an instance. One cache line.
#[derive(Debug)]
struct Owner {
    /// Bounds in its own space.
    local: Aabb,
    /// The epoch in which it came.
    added: u64,
    /// Bits of its record's traits: how round it is.
    round: u32,
    part: Part,
    /// Whether it is among the changed.
    is_changed: bool,
    /// Whether it is among those whose bounds in the world are stale.
    is_stale: bool,
}

/// Bounds in the world.
#[derive(Debug, Default)]
struct World {
    boxes: BoxArray,
    /// Indices whose boxes are older than their records.
    stale: Vec<u32>,
}

impl Instances {
    /// No instances yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            number: next_scene_number(),
            source: Source::Ours(Box::new(Kept {
                records: Vec::new(),
                owners: Vec::new(),
                free: Vec::new(),
                changed: Vec::new(),
                uploader: Uploader::new(gpu),
                moved: Vec::new(),
                world: None,
            })),
            epoch: 0,
        }
    }

    /// Instances that exist on the GPU alone: `count` [`JudgedInstance`]s in a buffer of the host's, whose passes write them. The buffer needs the usage
    /// `STORAGE`. There is no list for them, but masks and draws.
    ///
    /// # Errors
    /// [`JudgeError::Buffer`] for a buffer that is too small or lacks the usage.
    pub fn on_gpu(gpu: &Gpu, buffer: wgpu::Buffer, count: u32) -> Result<Self, JudgeError> {
        let needed = u64::from(count) * BYTES;
        let fault = |why: String| {
            Err(JudgeError::Buffer {
                buffer: "instances",
                why,
            })
        };
        if buffer.size() < needed.max(BYTES) {
            return fault(format!(
                "has {} bytes, and {count} instances need {needed}: make it larger",
                buffer.size()
            ));
        }
        if !buffer.usage().contains(wgpu::BufferUsages::STORAGE) {
            return fault("lacks the usage STORAGE: create it with it".to_owned());
        }
        let most = gpu.device.limits().max_storage_buffer_binding_size;
        if buffer.size() > most {
            return fault(format!(
                "has {} bytes, and this device binds {most} at most: ask the device for more, or split it",
                buffer.size()
            ));
        }
        Ok(Self {
            gpu: gpu.clone(),
            number: next_scene_number(),
            source: Source::Theirs { buffer, count },
            epoch: 0,
        })
    }

    /// Number of indices, free ones included. All indices are below it.
    pub fn slots(&self) -> u32 {
        match &self.source {
            Source::Ours(kept) => kept.records.len() as u32,
            Source::Theirs { count, .. } => *count,
        }
    }

    /// Number of instances; of a buffer on the GPU, as many as were named.
    pub fn len(&self) -> usize {
        match &self.source {
            Source::Ours(kept) => kept.records.len() - kept.free.len(),
            Source::Theirs { count, .. } => *count as usize,
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The instance that has an index now.
    pub fn at(&self, index: u32) -> Option<InstanceId> {
        let record = self.kept()?.records.get(index as usize)?;
        (record.traits & JudgedInstance::LIVE != 0).then_some(InstanceId {
            index,
            generation: record.traits >> 8,
        })
    }

    /// Adds an instance.
    ///
    /// # Errors
    /// [`JudgeError::Instance`] for bounds or a transform that are empty, not finite or too large for f32; [`JudgeError::TooMany`].
    pub fn insert(&mut self, new: InstanceDesc) -> Result<InstanceId, JudgeError> {
        let ids = self.insert_all(&[new])?;
        ids.first().copied().ok_or(NOTHING)
    }

    /// Adds several; all or, on an error, none.
    ///
    /// # Errors
    /// As [`Self::insert`].
    pub fn insert_all(&mut self, new: &[InstanceDesc]) -> Result<Vec<InstanceId>, JudgeError> {
        let epoch = self.epoch + 1;
        let most = most_instances(&self.gpu);
        let kept = self.kept_mut()?;
        let fresh = new.len().saturating_sub(kept.free.len());
        let instances = (kept.records.len() + fresh) as u64;
        if instances > most.min(u64::from(u32::MAX)) {
            return Err(JudgeError::TooMany {
                instances,
                bytes: instances * BYTES,
                most: most * BYTES,
            });
        }
        let fault = |index: u32, why: &str| JudgeError::Instance {
            index,
            why: why.to_owned(),
        };
        for (desc, number) in new.iter().zip(0u32..) {
            check_bounds(&desc.bounds).map_err(|why| fault(number, why))?;
            record(&desc.bounds, &desc.at, desc.part, 0).map_err(|why| fault(number, why))?;
        }
        kept.records.reserve(fresh);
        kept.owners.reserve(fresh);
        Ok(new.iter().map(|desc| kept.insert(desc, epoch)).collect())
    }

    /// Moves an instance.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`], and [`JudgeError::Instance`] for a transform that is not finite or too large for f32.
    pub fn move_to(&mut self, id: InstanceId, at: DAffine3) -> Result<(), JudgeError> {
        self.move_all(&[Moved { id, at }])
    }

    /// Moves several; all or, on an error, none.
    ///
    /// # Errors
    /// As [`Self::move_to`], and [`JudgeError::Twice`].
    pub fn move_all(&mut self, moved: &[Moved]) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids(moved.iter().map(|moved| moved.id))?;
        let mut records = std::mem::take(&mut kept.moved);
        records.clear();
        let outcome = kept.place_all(moved, &mut records);
        if outcome.is_ok() {
            for (moved, record) in moved.iter().zip(&records) {
                kept.put(moved.id, *record);
            }
        }
        kept.moved = records;
        outcome
    }

    /// Gives an instance other bounds, in its own space, and a place: one that grows or bends. What is known of it is kept, but for its roundness: it may fill its box.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`], and [`JudgeError::Instance`] as for [`Self::insert`].
    pub fn set_bounds(
        &mut self,
        id: InstanceId,
        bounds: Aabb,
        at: DAffine3,
    ) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids([id].into_iter())?;
        let Some(owner) = kept.owners.get_mut(id.index as usize) else {
            return Ok(());
        };
        let fault = |why: &str| JudgeError::Instance {
            index: id.index,
            why: why.to_owned(),
        };
        check_bounds(&bounds).map_err(fault)?;
        let record = record(&bounds, &at, owner.part, id.generation).map_err(fault)?;
        owner.local = bounds;
        owner.round = 0;
        kept.put(id, record);
        Ok(())
    }

    /// Says how round an instance's contents are: they lie in the ellipsoid whose half axes are the half edges of its bounds times this. 1 is a ball, what is at or above the root of 3 may fill its box, as without this call.
    /// What is round is found hidden more often.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`].
    pub fn set_roundness(&mut self, id: InstanceId, roundness: f32) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids([id].into_iter())?;
        let index = id.index as usize;
        let (owner, record) = (kept.owners.get_mut(index), kept.records.get_mut(index));
        if let (Some(owner), Some(record)) = (owner, record) {
            owner.round = JudgedInstance::round_bits(roundness);
            record.traits = record.traits & !JudgedInstance::ROUND | owner.round;
        }
        kept.note(id.index);
        Ok(())
    }

    /// Gives an instance another part in tests.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`].
    pub fn set_part(&mut self, id: InstanceId, part: Part) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids([id].into_iter())?;
        let index = id.index as usize;
        let (owner, record) = (kept.owners.get_mut(index), kept.records.get_mut(index));
        if let (Some(owner), Some(record)) = (owner, record) {
            owner.part = part;
            record.traits = JudgedInstance::traits(part, id.generation) | owner.round;
        }
        kept.note(id.index);
        Ok(())
    }

    /// Removes an instance.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`].
    pub fn remove(&mut self, id: InstanceId) -> Result<(), JudgeError> {
        self.remove_all(&[id])
    }

    /// Removes several; all or, on an error, none.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`] and [`JudgeError::Twice`].
    pub fn remove_all(&mut self, ids: &[InstanceId]) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids(ids.iter().copied())?;
        for id in ids {
            if let Some(record) = kept.records.get_mut(id.index as usize) {
                record.traits &= !JudgedInstance::LIVE;
            }
            kept.free.push(id.index);
            kept.note(id.index);
        }
        Ok(())
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Brings what has changed onto the device, by an encoder: after its commands so far. [`Judge::begin`](super::Judge::begin) does it too.
    pub fn sync(&mut self, encoder: &mut wgpu::CommandEncoder) {
        self.upload(encoder);
    }

    /// As [`Self::sync`]. Returns the buffer of the records.
    pub(super) fn upload(&mut self, encoder: &mut wgpu::CommandEncoder) -> wgpu::Buffer {
        match &mut self.source {
            Source::Theirs { buffer, .. } => buffer.clone(),
            Source::Ours(kept) => {
                if !kept.changed.is_empty() {
                    self.epoch += 1;
                }
                let kept = &mut **kept;
                for index in &kept.changed {
                    if let Some(owner) = kept.owners.get_mut(*index as usize) {
                        owner.is_changed = false;
                    }
                }
                kept.uploader
                    .upload(&kept.records, &mut kept.changed, encoder);
                kept.uploader.buffer().clone()
            }
        }
    }

    /// Bytes of device memory that the records take, with what moves them there; 0 for a buffer of the host's.
    pub fn memory(&self) -> u64 {
        self.kept().map_or(0, |kept| kept.uploader.memory())
    }

    /// Tells sets apart.
    pub(super) fn number(&self) -> u64 {
        self.number
    }

    /// Increases with each change that has reached the device.
    pub(super) fn epoch(&self) -> u64 {
        self.epoch
    }

    /// World bounds by index; `None` where the host has none. Free indices have stale ones.
    pub(super) fn world(&mut self) -> Option<&BoxArray> {
        let kept = self.kept_mut().ok()?;
        let all = 0..kept.records.len() as u32;
        let world = kept.world.get_or_insert_with(|| World {
            boxes: BoxArray::new(),
            stale: all.collect(),
        });
        for index in world.stale.drain(..) {
            let (record, owner) = (
                kept.records.get(index as usize),
                kept.owners.get_mut(index as usize),
            );
            let (Some(record), Some(owner)) = (record, owner) else {
                continue;
            };
            owner.is_stale = false;
            while world.boxes.len() <= index as usize {
                world.boxes.push(Aabb::EMPTY);
            }
            world.boxes.set(index as usize, record.bounds());
        }
        Some(&world.boxes)
    }

    /// World bounds of an index.
    pub(super) fn bounds(&self, index: u32) -> Option<Aabb> {
        Some(self.kept()?.records.get(index as usize)?.bounds())
    }

    /// The part and the epoch of the arrival of the instance that has an index now.
    pub(super) fn part(&self, index: u32) -> Option<(Part, u64)> {
        self.at(index)?;
        let owner = self.kept()?.owners.get(index as usize)?;
        Some((owner.part, owner.added))
    }

    fn kept(&self) -> Option<&Kept> {
        match &self.source {
            Source::Ours(kept) => Some(kept),
            Source::Theirs { .. } => None,
        }
    }

    fn kept_mut(&mut self) -> Result<&mut Kept, JudgeError> {
        match &mut self.source {
            Source::Ours(kept) => Ok(kept),
            Source::Theirs { .. } => Err(JudgeError::Order(
                "these instances are on the GPU alone: change them there",
            )),
        }
    }
}

/// Bytes of a record.
const BYTES: u64 = size_of::<JudgedInstance>() as u64;

const NOTHING: JudgeError = JudgeError::Order("no instance was given");

/// The most instances that a buffer of this device holds.
fn most_instances(gpu: &Gpu) -> u64 {
    let limits = gpu.device.limits();
    limits
        .max_buffer_size
        .min(limits.max_storage_buffer_binding_size)
        / BYTES
}

/// Refuses boxes without a place.
fn check_bounds(bounds: &Aabb) -> Result<(), &'static str> {
    match bounds.is_empty() || !bounds.is_finite() {
        true => Err("its bounds are empty or not finite: give two corners of a box"),
        false => Ok(()),
    }
}

/// The record of a box after a transform; the error says why it has no place.
fn record(
    bounds: &Aabb,
    at: &DAffine3,
    part: Part,
    generation: u32,
) -> Result<JudgedInstance, &'static str> {
    let record = JudgedInstance::new(bounds, at, part, generation);
    if record.fits() {
        return Ok(record);
    }
    Err(match at.is_finite() {
        false => "its transform holds numbers that are not finite: give finite ones",
        true => "its box does not fit 32-bit floats: bring its size and place below 3e38",
    })
}

impl Kept {
    /// Puts a checked instance at a free index.
    fn insert(&mut self, desc: &InstanceDesc, epoch: u64) -> InstanceId {
        let owner = Owner {
            local: desc.bounds,
            added: epoch,
            round: 0,
            part: desc.part,
            is_changed: false,
            is_stale: false,
        };
        let index = match self.free.pop() {
            Some(index) => {
                if let Some(place) = self.owners.get_mut(index as usize) {
                    let is_changed = place.is_changed;
                    *place = Owner {
                        is_changed,
                        ..owner
                    };
                }
                index
            }
            None => {
                self.records.push(JudgedInstance::default());
                self.owners.push(owner);
                self.owners.len() as u32 - 1
            }
        };
        let before = self.records.get(index as usize);
        let before = before.map_or(0, |record| record.traits >> 8);
        // 0 stands for an index that never had an owner.
        let generation = match before + 1 {
            JudgedInstance::GENERATIONS => 1,
            next => next,
        };
        let id = InstanceId { index, generation };
        let record = JudgedInstance::new(&desc.bounds, &desc.at, desc.part, generation);
        self.put(id, record);
        id
    }

    /// The records of instances after transforms.
    fn place_all(
        &self,
        moved: &[Moved],
        records: &mut Vec<JudgedInstance>,
    ) -> Result<(), JudgeError> {
        records.reserve(moved.len());
        for Moved { id, at } in moved {
            let InstanceId { index, generation } = id;
            let Some(owner) = self.owners.get(*index as usize) else {
                continue;
            };
            let found = record(&owner.local, at, owner.part, *generation);
            records.push(found.map_err(|why| JudgeError::Instance {
                index: *index,
                why: why.to_owned(),
            })?);
        }
        Ok(())
    }

    /// Gives an instance its record.
    fn put(&mut self, id: InstanceId, record: JudgedInstance) {
        let index = id.index as usize;
        if let (Some(place), Some(owner)) = (self.records.get_mut(index), self.owners.get(index)) {
            *place = record;
            place.traits |= owner.round;
        }
        self.note(id.index);
    }

    /// Notes that a record has changed.
    fn note(&mut self, index: u32) {
        if let Some(owner) = self.owners.get_mut(index as usize)
            && !std::mem::replace(&mut owner.is_changed, true)
        {
            self.changed.push(index);
        }
        if let (Some(world), Some(owner)) = (&mut self.world, self.owners.get_mut(index as usize))
            && !std::mem::replace(&mut owner.is_stale, true)
        {
            world.stale.push(index);
        }
    }

    /// Refuses ids that mean no instance, and those that come twice.
    fn check_ids(&self, ids: impl Iterator<Item = InstanceId>) -> Result<(), JudgeError> {
        let mut seen = Vec::with_capacity(ids.size_hint().0);
        for id in ids {
            let record = self.records.get(id.index as usize);
            let own = JudgedInstance::LIVE | id.generation << 8;
            let mask = !(JudgedInstance::HIDES | JudgedInstance::TESTED | JudgedInstance::ROUND);
            if record.is_none_or(|record| record.traits & mask != own) {
                return Err(JudgeError::Unknown {
                    index: id.index,
                    generation: id.generation,
                });
            }
            seen.push(id.index);
        }
        // Mostly they come in order.
        if !seen.is_sorted() {
            seen.sort_unstable();
        }
        match seen.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(JudgeError::Twice { index: pair[0] }),
            None => Ok(()),
        }
    }
}
