//! The instances of a host: boxes by stable index, which come, move and go.

use antumbra_scene::{Aabb, BoxArray};
use glam::{DAffine3, DVec3};

use super::error::JudgeError;
use super::record::{JudgedInstance, Part};
use super::upload::Uploader;
use crate::device::Gpu;

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

/// The instances that a [`Judge`](super::Judge) judges. Several judges may share them.
#[derive(Debug)]
pub struct Instances {
    gpu: Gpu,
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
    /// Bounds in the instances' own space.
    local: Vec<Aabb>,
    /// Bounds in the world.
    world: BoxArray,
    /// The epoch in which each instance came.
    added: Vec<u64>,
    parts: Vec<Part>,
    free: Vec<u32>,
    /// Indices whose records have changed since the last upload, each once.
    changed: Vec<u32>,
    is_changed: Vec<bool>,
    uploader: Uploader,
}

impl Instances {
    /// No instances yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            gpu: gpu.clone(),
            source: Source::Ours(Box::new(Kept {
                records: Vec::new(),
                local: Vec::new(),
                world: BoxArray::new(),
                added: Vec::new(),
                parts: Vec::new(),
                free: Vec::new(),
                changed: Vec::new(),
                is_changed: Vec::new(),
                uploader: Uploader::new(gpu),
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
        Ok(Self {
            gpu: gpu.clone(),
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
        for (desc, number) in new.iter().zip(0u32..) {
            check(number, desc)?;
        }
        let fresh = new.len().saturating_sub(kept.free.len());
        let instances = (kept.records.len() + fresh) as u64;
        if instances > most.min(u64::from(u32::MAX)) {
            return Err(JudgeError::TooMany {
                instances,
                bytes: instances * BYTES,
                most: most * BYTES,
            });
        }
        kept.reserve(fresh);
        Ok(new.iter().map(|desc| kept.insert(desc, epoch)).collect())
    }

    /// Moves an instance.
    ///
    /// # Errors
    /// [`JudgeError::Unknown`], and [`JudgeError::Instance`] for a transform that is not finite or too large for f32.
    pub fn move_to(&mut self, id: InstanceId, at: DAffine3) -> Result<(), JudgeError> {
        self.move_all(&[(id, at)])
    }

    /// Moves several; all or, on an error, none.
    ///
    /// # Errors
    /// As [`Self::move_to`], and [`JudgeError::Twice`].
    pub fn move_all(&mut self, moved: &[(InstanceId, DAffine3)]) -> Result<(), JudgeError> {
        let kept = self.kept_mut()?;
        kept.check_ids(moved.iter().map(|(id, _)| *id))?;
        for (id, at) in moved {
            let bounds = kept.local.get(id.index as usize).copied();
            check(
                id.index,
                &InstanceDesc {
                    bounds: bounds.unwrap_or(Aabb::EMPTY),
                    at: *at,
                    part: Part::Both,
                },
            )?;
        }
        for (id, at) in moved {
            kept.place(*id, at);
        }
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
        if let (Some(own), Some(record)) = (kept.parts.get_mut(index), kept.records.get_mut(index))
        {
            *own = part;
            record.traits = JudgedInstance::traits(part, id.generation);
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

    /// Brings what has changed onto the device, by an encoder: after its commands so far. [`Judge::begin`](super::Judge::begin) does it. Returns the buffer of
    /// the records.
    pub(super) fn upload(&mut self, encoder: &mut wgpu::CommandEncoder) -> wgpu::Buffer {
        match &mut self.source {
            Source::Theirs { buffer, .. } => buffer.clone(),
            Source::Ours(kept) => {
                if !kept.changed.is_empty() {
                    self.epoch += 1;
                }
                let kept = &mut **kept;
                kept.uploader
                    .upload(&kept.records, &mut kept.changed, encoder);
                kept.is_changed.fill(false);
                kept.uploader.buffer().clone()
            }
        }
    }

    /// Increases with each change that has reached the device.
    pub(super) fn epoch(&self) -> u64 {
        self.epoch
    }

    /// World bounds by index; `None` where the host has none.
    pub(super) fn world(&self) -> Option<&BoxArray> {
        Some(&self.kept()?.world)
    }

    /// The part and the epoch of the arrival of the instance that has an index now.
    pub(super) fn part(&self, index: u32) -> Option<(Part, u64)> {
        self.at(index)?;
        let kept = self.kept()?;
        let at = index as usize;
        Some((*kept.parts.get(at)?, *kept.added.get(at)?))
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

/// Refuses what f32 cannot hold, and boxes without a place. `index` is for the error.
fn check(index: u32, desc: &InstanceDesc) -> Result<(), JudgeError> {
    let fault = |why: &str| {
        Err(JudgeError::Instance {
            index,
            why: why.to_owned(),
        })
    };
    if desc.bounds.is_empty() || !desc.bounds.is_finite() {
        return fault("its bounds are empty or not finite: give two corners of a box");
    }
    if !desc.at.is_finite() {
        return fault("its transform holds numbers that are not finite: give finite ones");
    }
    if !JudgedInstance::new(&desc.bounds, &desc.at, desc.part, 0).fits() {
        return fault("its box does not fit 32-bit floats: bring its size and place below 3e38");
    }
    Ok(())
}

/// The bounds in the world of a box after a transform.
fn world_bounds(bounds: &Aabb, at: &DAffine3) -> Aabb {
    let half = bounds.half_extents();
    let axes = [
        at.matrix3.x_axis * half.x,
        at.matrix3.y_axis * half.y,
        at.matrix3.z_axis * half.z,
    ];
    let reach = axes.iter().fold(DVec3::ZERO, |sum, axis| sum + axis.abs());
    Aabb::from_centre(at.transform_point3(bounds.centre()), reach)
}

impl Kept {
    fn reserve(&mut self, more: usize) {
        self.records.reserve(more);
        self.local.reserve(more);
        self.added.reserve(more);
        self.parts.reserve(more);
        self.is_changed.reserve(more);
    }

    /// Puts a checked instance at a free index.
    fn insert(&mut self, desc: &InstanceDesc, epoch: u64) -> InstanceId {
        let world = world_bounds(&desc.bounds, &desc.at);
        let index = match self.free.pop() {
            Some(index) => index,
            None => {
                self.records.push(JudgedInstance::default());
                self.local.push(desc.bounds);
                self.world.push(world);
                self.added.push(epoch);
                self.parts.push(desc.part);
                self.is_changed.push(false);
                self.records.len() as u32 - 1
            }
        };
        let at = index as usize;
        let before = self.records.get(at).map_or(0, |record| record.traits >> 8);
        // Not 0: what the device remembers of an index without an owner is 0.
        let generation = match before + 1 {
            JudgedInstance::GENERATIONS => 1,
            next => next,
        };
        self.local[at] = desc.bounds;
        self.added[at] = epoch;
        self.parts[at] = desc.part;
        let id = InstanceId { index, generation };
        self.place(id, &desc.at);
        id
    }

    /// Gives an instance that exists, or is about to, a record for its place.
    fn place(&mut self, id: InstanceId, to: &DAffine3) {
        let at = id.index as usize;
        let bounds = self.local[at];
        self.records[at] = JudgedInstance::new(&bounds, to, self.parts[at], id.generation);
        self.world.set(at, world_bounds(&bounds, to));
        self.note(id.index);
    }

    /// Notes that a record has changed.
    fn note(&mut self, index: u32) {
        if let Some(changed) = self.is_changed.get_mut(index as usize)
            && !std::mem::replace(changed, true)
        {
            self.changed.push(index);
        }
    }

    /// Refuses ids that mean no instance, and those that come twice.
    fn check_ids(&self, ids: impl Iterator<Item = InstanceId>) -> Result<(), JudgeError> {
        let mut seen = Vec::with_capacity(ids.size_hint().0);
        for id in ids {
            let record = self.records.get(id.index as usize);
            let own = JudgedInstance::LIVE | id.generation << 8;
            let mask = !(JudgedInstance::HIDES | JudgedInstance::TESTED);
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
