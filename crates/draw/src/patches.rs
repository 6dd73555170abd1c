//! Patches: small squares of the image into which some meshes are drawn again against the finished depth, to see in which pixels anything of
//! them would show. A mark a pixel, whoever leaves it: what covers a pixel twice is seen once.

use std::ops::Range;
use std::sync::Arc;

use antumbra_graph::{Bind, Buffer, Graph, Host, Texture};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use crate::list::{Detail, Run};
use crate::passes::{PassSpec, ViewInputs, bind, group};
use crate::record::Recorder;
use crate::table::SceneTable;

/// Pixels along a side of a patch. The image is divided into patches from its upper left corner; those at its far ends may reach beyond it.
pub const PATCH_SIDE: u32 = 16;
/// Bytes of marks a patch: a bit a pixel, row by row.
pub const PATCH_BYTES: u64 = (PATCH_SIDE * PATCH_SIDE / 8) as u64;

/// Mirrors `Drawn` of `shared/patch.wgsl`: who is drawn already, where that was decided on the GPU.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub struct GpuDrawn {
    threshold: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

assert_layout!(GpuDrawn, "patch_early", "Drawn", { threshold, padding_a, padding_b, padding_c });

impl GpuDrawn {
    /// Whoever has more visible samples than this.
    pub fn above(threshold: u32) -> Self {
        Self {
            threshold,
            padding_a: 0,
            padding_b: 0,
            padding_c: 0,
        }
    }
}

/// One patch and what is drawn into it.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Patch {
    corner: [u32; 2],
    runs: Range<usize>,
}

/// What is drawn into which patches.
#[derive(Debug, Clone, Default)]
pub struct PatchList {
    patches: Vec<Patch>,
    runs: Vec<Run>,
    entries: Vec<[u32; 2]>,
}

impl PatchList {
    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.patches.clear();
        self.runs.clear();
        self.entries.clear();
    }

    /// Adds a patch by its column and row, with the full meshes of these live slots, which are sorted by batch on the way; says what drawing
    /// it comes to. It takes the next number.
    pub fn push(
        &mut self,
        table: &SceneTable,
        [column, row]: [u32; 2],
        slots: &mut [u32],
    ) -> PatchWork {
        let number = self.patches.len() as u32;
        let before = self.runs.len();
        slots.sort_unstable_by_key(|slot| (table.batch_of(*slot), *slot));
        let mut triangles = 0;
        for slot in slots.iter().copied() {
            let (batch, detail) = (table.batch_of(slot), Detail::Level(0));
            triangles += u64::from(table.primitives_of(slot, detail));
            let first = self.entries.len() as u32;
            self.entries.push([slot, number]);
            match self.runs.get_mut(before..).and_then(<[Run]>::last_mut) {
                Some(run) if run.batch == batch => run.count += 1,
                _ => self.runs.push(Run {
                    batch,
                    detail,
                    first,
                    count: 1,
                }),
            }
        }
        let runs = before..self.runs.len();
        let draws = runs.len() as u32;
        self.patches.push(Patch {
            corner: [column * PATCH_SIDE, row * PATCH_SIDE],
            runs,
        });
        PatchWork { triangles, draws }
    }

    /// Patches, with or without anything to draw into them.
    pub fn patches(&self) -> usize {
        self.patches.len()
    }

    /// Slot and patch of each instance, for [`SubmittedPatches::entries`].
    pub fn entries(&self) -> &[[u32; 2]] {
        &self.entries
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}

/// What drawing into a patch comes to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PatchWork {
    /// Triangles, lines or points.
    pub triangles: u64,
    /// Draws.
    pub draws: u32,
}

/// A list that is on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct SubmittedPatches {
    /// The list.
    pub list: Host<PatchList>,
    /// Its entries, 8 bytes each.
    pub entries: Buffer,
    /// [`GpuDrawn`].
    pub drawn: Buffer,
    /// Visible samples by slot, or one word of zero.
    pub counts: Buffer,
}

/// Marks in which pixels of its patches anything of a list lies at or before a finished depth: [`PATCH_BYTES`] a patch, which must be zero
/// before. With a `scratch` depth of the image's size it compares in the shader, without one it needs a forced early depth test.
pub fn patch_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: SubmittedPatches,
    (depth, scratch): (Texture, Option<Texture>),
    shown: Buffer,
) -> Buffer {
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(inputs.view)
        .read(what.list)
        .vertex(what.entries)
        .uniform(inputs.uniform)
        .uniform(what.drawn)
        .storage_read(what.counts)
        // A value that cannot be read is the body's to complain of.
        .only_if(move |host| host.get(what.list).map_or(true, |list| !list.is_empty()));
    match scratch {
        Some(scratch) => {
            node.sample(depth).depth(scratch);
        }
        None => {
            node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
                .depth_read(depth);
        }
    }
    let marked = node.storage_write(shown);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let [width, height] = ctx.get(inputs.view)?.size;
        let scene = bind(ctx, inputs, &pipelines, what.entries)?;
        let mut binds = vec![
            Bind::Buffer(0, marked),
            Bind::Buffer(1, what.drawn),
            Bind::Buffer(2, what.counts),
        ];
        binds.extend(scratch.map(|_| Bind::Texture(3, depth)));
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
            for run in runs {
                recorder.run(ctx.pass(), run, run.first..run.first + run.count);
            }
        }
        Ok(())
    });
    marked
}
