//! Patches: small squares of the image into which meshes are drawn again against the finished depth, to find the pixels in which any of them
//! is visible. Each pixel has one mark, whichever mesh sets it.

use std::ops::Range;

use antumbra_graph::{Buffer, Host};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use super::list::Run;
use crate::entities::{MeshDetail, SceneTable};

/// Pixels along a side of a patch. The image is divided into patches from its upper left corner; those at the right and lower edges may
/// extend beyond it.
pub const PATCH_SIDE: u32 = 16;
/// Bytes of the marks of a patch: one bit a pixel, row by row.
pub const MARK_BYTES: u64 = (PATCH_SIDE * PATCH_SIDE / 8) as u64;
/// Bytes of the result of a patch: its marks, and one u32 with the number of indices that were drawn into it.
pub const PATCH_BYTES: u64 = MARK_BYTES + size_of::<u32>() as u64;

/// The part of a patch that an entity's bounding box may cover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// Reversed depth of the box's nearest point.
    pub nearest: f32,
    /// The least pixel, x and y on the image; it lies on the patch.
    pub least: [u32; 2],
    /// The greatest pixel, likewise, included.
    pub greatest: [u32; 2],
}

/// An entity that may show in a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchMember {
    /// Its slot; live.
    pub slot: u32,
    /// What it may cover.
    pub cover: Cover,
}

/// An entity in a patch. Mirrors `Entry` of `cull_patches.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GpuPatchEntry {
    slot: u32,
    patch_number: u32,
    draw: u32,
    nearest: f32,
    least: u32,
    greatest: u32,
}

assert_layout!(GpuPatchEntry, "cull_patches_one", "Entry", { slot, patch_number, draw, nearest, least, greatest });

/// An indexed indirect draw. Mirrors `Draw` of `compact.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub struct GpuDraw {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    base_vertex: i32,
    first_instance: u32,
}

assert_layout!(GpuDraw, "compact", "Draw", { index_count, instance_count, first_index, base_vertex, first_instance });

/// One patch and the runs that may be drawn into it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patch {
    /// Upper left pixel.
    pub corner: [u32; 2],
    /// Its runs: indices into [`PatchList::runs`] and [`PatchList::draws`].
    pub runs: Range<usize>,
}

/// Patches, and the entities that may be drawn into each.
#[derive(Debug, Clone, Default)]
pub struct PatchList {
    patches: Vec<Patch>,
    runs: Vec<Run>,
    draws: Vec<GpuDraw>,
    entries: Vec<GpuPatchEntry>,
}

impl PatchList {
    /// Empties the list. The memory is kept.
    pub fn clear(&mut self) {
        self.patches.clear();
        self.runs.clear();
        self.draws.clear();
        self.entries.clear();
    }

    /// Adds a patch by its column and row, with the full meshes of its members, which are sorted by batch in place. Returns the number of
    /// draws. Patches are numbered in the order in which they are added.
    pub fn push(
        &mut self,
        table: &SceneTable,
        [column, row]: [u32; 2],
        members: &mut [PatchMember],
    ) -> u32 {
        let number = self.patches.len() as u32;
        let before = self.runs.len();
        members.sort_unstable_by_key(|member| (table.batch_of(member.slot), member.slot));
        for PatchMember { slot, cover } in members.iter().copied() {
            let (batch, detail) = (table.batch_of(slot), MeshDetail::Level(0));
            let first = self.entries.len() as u32;
            match self.runs.get_mut(before..).and_then(<[Run]>::last_mut) {
                Some(run) if run.batch == batch => run.count += 1,
                _ => {
                    let mesh = table.batches().get(batch as usize).map(|batch| batch.mesh);
                    let range = mesh.map(|mesh| table.range(mesh, detail));
                    let range = range.unwrap_or_default();
                    self.draws.push(GpuDraw {
                        index_count: range.index_count,
                        instance_count: 0,
                        first_index: range.first_index,
                        base_vertex: range.base_vertex,
                        first_instance: first,
                    });
                    self.runs.push(Run {
                        batch,
                        detail,
                        first,
                        count: 1,
                    });
                }
            }
            let [least, greatest] = [cover.least, cover.greatest].map(|[x, y]| x | y << 16);
            self.entries.push(GpuPatchEntry {
                slot,
                patch_number: number,
                draw: self.runs.len() as u32 - 1,
                nearest: cover.nearest,
                least,
                greatest,
            });
        }
        let runs = before..self.runs.len();
        let draws = runs.len() as u32;
        self.patches.push(Patch {
            corner: [column * PATCH_SIDE, row * PATCH_SIDE],
            runs,
        });
        draws
    }

    /// The patches, empty ones included.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The runs of all patches, one a draw.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The entities of all patches.
    pub fn entries(&self) -> &[GpuPatchEntry] {
        &self.entries
    }

    /// A draw for each patch and batch. Its instance count is 0, and its instances have room for all entries of that patch and batch.
    pub fn draws(&self) -> &[GpuDraw] {
        &self.draws
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}

/// A patch list with the entries that a compute node kept of it.
#[derive(Debug, Clone, Copy)]
pub struct PatchDraws {
    /// The list.
    pub list: Host<PatchList>,
    /// Slot and patch number of each instance, two u32, at the instances of its draw.
    pub kept: Buffer,
    /// The list's draws, with their instance counts.
    pub draws: Buffer,
}
