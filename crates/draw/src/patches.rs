//! Patches: small squares of the image into which some meshes are drawn again against the finished depth, to see in which pixels anything of
//! them would show. A mark a pixel, whoever leaves it: what covers a pixel twice is seen once.

use std::ops::Range;
use std::sync::Arc;

use antumbra_graph::{Bind, Buffer, Graph, Host};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use crate::detail::MeshDetail;
use crate::list::Run;
use crate::passes::{DepthTest, PassSpec, ViewInputs, bind, group};
use crate::record::Recorder;
use crate::table::SceneTable;

/// Pixels along a side of a patch. The image is divided into patches from its upper left corner; those at its far ends may reach beyond it.
pub const PATCH_SIDE: u32 = 16;
/// Bytes of marks a patch: a bit a pixel, row by row.
pub const MARK_BYTES: u64 = (PATCH_SIDE * PATCH_SIDE / 8) as u64;
/// Bytes that are kept of a patch: its marks, and in one word how many indices were drawn into it.
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

/// Mirrors `Entry` of `cull_patches.wgsl`: an entity in a patch.
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

assert_layout!(GpuPatchEntry, "cull_patches", "Entry", { slot, patch_number, draw, nearest, least, greatest });

/// An indexed indirect draw.
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

/// One patch and what may be drawn into it.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Patch {
    corner: [u32; 2],
    runs: Range<usize>,
}

/// What may be drawn into which patches.
#[derive(Debug, Clone, Default)]
pub struct PatchList {
    patches: Vec<Patch>,
    runs: Vec<Run>,
    draws: Vec<GpuDraw>,
    entries: Vec<GpuPatchEntry>,
}

impl PatchList {
    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.patches.clear();
        self.runs.clear();
        self.draws.clear();
        self.entries.clear();
    }

    /// Adds a patch by its column and row, with the full meshes of these live slots, which are sorted by batch on the way; says in how many
    /// draws. It takes the next number.
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

    /// Patches, with or without anything to draw into them.
    pub fn patches(&self) -> usize {
        self.patches.len()
    }

    /// All that may show in any patch.
    pub fn entries(&self) -> &[GpuPatchEntry] {
        &self.entries
    }

    /// A draw for each patch and batch, of no instance yet, with room for all entries there are.
    pub fn draws(&self) -> &[GpuDraw] {
        &self.draws
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}

/// A list that is on the GPU, and what was kept of it.
#[derive(Debug, Clone, Copy)]
pub struct PatchDraws {
    /// The list.
    pub list: Host<PatchList>,
    /// Slot and patch of each instance, 8 bytes, where its draw says.
    pub kept: Buffer,
    /// Its draws, with instances.
    pub draws: Buffer,
}

/// Marks in which pixels of its patches anything that was kept of a list lies at or before a finished depth: [`PATCH_BYTES`] a patch, of which
/// the marks must be zero before. With a `scratch` depth of the image's size it compares in the shader, without one it needs a forced early depth test.
pub fn patch_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: PatchDraws,
    test: DepthTest,
    shown: Buffer,
) -> Buffer {
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(inputs.view)
        .read(what.list)
        .vertex(what.kept)
        .indirect(what.draws)
        .uniform(inputs.uniform)
        .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE)
        // A value that cannot be read is the body's to complain of.
        .only_if(move |host| host.get(what.list).map_or(true, |list| !list.is_empty()));
    test.declare(&mut node);
    let marked = node.storage_write(shown);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let [width, height] = ctx.get(inputs.view)?.size;
        let draws = ctx.buffer(what.draws)?;
        let scene = bind(ctx, inputs, &pipelines, what.kept)?;
        let mut binds = vec![Bind::Buffer(0, marked)];
        binds.extend(test.bind(1));
        group(ctx, &pipelines, 3, &binds)?;
        let mut recorder = Recorder::new(&scene, &pipelines);
        for patch in &list.patches {
            let [x, y] = patch.corner;
            let side = |from: u32, end: u32| PATCH_SIDE.min(end.saturating_sub(from));
            let (wide, high) = (side(x, width), side(y, height));
            let runs = list.runs.get(patch.runs.clone()).unwrap_or_default();
            if runs.is_empty() || wide == 0 || high == 0 {
                continue;
            }
            ctx.pass().set_scissor_rect(x, y, wide, high);
            recorder.indirect(ctx.pass(), runs, draws, patch.runs.start);
        }
        Ok(())
    });
    marked
}
