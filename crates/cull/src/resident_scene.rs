//! The scene as it lies on the device: the boxes of all slots, and the opaque entities laid out for indirect draws. It is uploaded when the scene has changed, so that a strategy on
//! the GPU does nothing by entity on the host while the scene stands still.

use antumbra_graph::{Buffer, BufferDesc, Host};
use antumbra_scene::Topology;

use crate::draw_source::DrawList;
use crate::entities::{GpuPartBox, MeshDetail, SceneTable};
use crate::frame_graph::{CULL, FrameGraph};
use crate::indirect::{IndirectLayout, LayoutEntries, LayoutSize, SampleBounds};
use crate::judge::{JudgedInstance, Part};
use crate::order::back_to_front;
use crate::view_nodes::ViewNodes;

/// The scene on the device, the same for all views of a stage.
#[derive(Debug, Clone, Copy)]
pub struct ResidentScene {
    /// The boxes of all slots: a [`JudgedInstance`] a slot. Bits 8 and up of its traits are no generation here: they say where its boxes in [`Self::parts`] begin; 0: it has none.
    pub boxes: Buffer,
    /// The boxes of the parts of all meshes: a [`GpuPartBox`] each.
    pub parts: Buffer,
    /// The full meshes of all opaque entities, inside and outside of any frustum. [`FrameGraph::compact`] keeps those with any sample.
    pub opaque: IndirectLayout,
    /// The slots of the transparent entities, ascending.
    transparent: Host<Vec<u32>>,
}

/// What the device has said to hold.
#[derive(Debug, Clone, Copy, Default)]
struct Held {
    /// The epoch of the boxes.
    epoch: Option<u64>,
    /// The arrangement that is laid out.
    arrangement: Option<u64>,
}

impl ResidentScene {
    /// The name of the node that uploads it. What it reads back tells of uploads, and is no answer about an entity.
    pub const UPLOAD: &str = "upload scene";

    /// Bytes of the [boxes](Self::boxes).
    pub fn box_bytes(g: &FrameGraph<'_>) -> u64 {
        u64::from(g.scene_layout().slots.max(1)) * size_of::<JudgedInstance>() as u64
    }
}

impl FrameGraph<'_> {
    /// The scene on the device. It is uploaded when it has changed, and until the device has said that it has it: a host may drop the encoder with an upload.
    pub fn resident_scene(&mut self, view: &ViewNodes) -> ResidentScene {
        if let Some(made) = self.shared.resident {
            return made;
        }
        let scene = view.inputs().scene;
        let bytes = ResidentScene::box_bytes(self);
        let size = LayoutSize {
            runs: self.scene_layout().batches,
            entries_a_slot: 1,
        };
        let undeclared = self.layout_buffers("opaque entities", size);
        let part_bytes =
            u64::from(self.scene_layout().part_boxes.max(1)) * size_of::<GpuPartBox>() as u64;
        let graph = self.graph();
        let parts = graph.buffer("boxes of parts", BufferDesc::new(part_bytes));
        let boxes = graph.buffer("boxes", BufferDesc::new(bytes));
        let stamp = graph.buffer("stamp of the resident scene", BufferDesc::new(16));
        let transparent: Host<Vec<u32>> = graph.host("transparent entities");
        let held: Host<Held> = graph.host("held scene");
        let mut node = graph.host_node(ResidentScene::UPLOAD);
        node.group(CULL).read(scene);
        let said = node.read_previous(stamp, held);
        let held = node.updates(held);
        let stamp = node.updates(stamp);
        let made = ResidentScene {
            boxes: node.updates(boxes),
            parts: node.updates(parts),
            opaque: IndirectLayout {
                list: node.updates(undeclared.list),
                entries: node.updates(undeclared.entries),
                runs: node.updates(undeclared.runs),
                settings: node.updates(undeclared.settings),
                ..undeclared
            },
            transparent: node.updates(transparent),
        };
        let mut records = Vec::new();
        let mut is_new = true;
        node.run(move |ctx| {
            let mut held = ctx.get_mut(held)?;
            if std::mem::take(&mut is_new) {
                // What was said of an earlier plan's buffers is not about these.
                *held = Held::default();
            } else if let Some(late) = ctx.late(said)
                && let Some((epoch, arrangement)) = late.bytes.split_first_chunk()
                && let Some(arrangement) = arrangement.first_chunk()
            {
                held.epoch = Some(u64::from_le_bytes(*epoch));
                held.arrangement = Some(u64::from_le_bytes(*arrangement));
            }
            let table = &ctx.get(scene)?.table;
            if held.epoch == Some(table.epoch()) {
                return Ok(());
            }
            records.clear();
            records.extend((0..table.slots()).map(|slot| record_of(table, slot)));
            ctx.upload(made.boxes, 0, bytemuck::cast_slice(&records))?;
            if held.arrangement != Some(table.arrangement()) {
                ctx.upload(made.parts, 0, bytemuck::cast_slice(table.part_boxes()))?;
                lay_out(&mut *ctx.get_mut(made.opaque.list)?, table).upload(ctx, made.opaque)?;
                let mut transparent = ctx.get_mut(made.transparent)?;
                transparent.clear();
                transparent.extend(
                    table
                        .live_slots()
                        .filter(|slot| table.is_transparent(*slot)),
                );
            }
            ctx.upload(stamp, 0, &table.epoch().to_le_bytes())?;
            ctx.upload(stamp, 8, &table.arrangement().to_le_bytes())?;
            Ok(())
        });
        self.shared.resident = Some(made);
        made
    }

    /// Lays out all transparent entities, back to front as a view sees them.
    pub fn resident_transparent(&mut self, view: &ViewNodes) -> IndirectLayout {
        let transparent = self.resident_scene(view).transparent;
        let size = LayoutSize {
            runs: self.scene_layout().slots.max(1),
            entries_a_slot: 1,
        };
        self.lay_out(
            view,
            "transparent entities",
            size,
            |node| {
                node.read(transparent);
            },
            move |ctx, table, frame, laid| {
                let slots = ctx.get(transparent)?;
                back_to_front(laid.list, table, frame, slots.iter().map(|slot| (*slot, 0)));
                laid.bound(table, |_| SampleBounds::SEEN, |_| false);
                Ok(())
            },
        )
    }
}

/// Lays out all opaque entities.
fn lay_out<'a>(list: &'a mut DrawList, table: &SceneTable) -> LayoutEntries<'a> {
    let mut laid = LayoutEntries::new(list);
    let opaque = table
        .live_slots()
        .filter(|slot| !table.is_transparent(*slot));
    laid.list.fill(table, opaque, MeshDetail::Level(0));
    laid.bound(table, |_| SampleBounds::SEEN, |_| false);
    laid
}

/// A slot's box as the device tests it.
fn record_of(table: &SceneTable, slot: u32) -> JudgedInstance {
    if table.occupant(slot).is_none() {
        return JudgedInstance::default();
    }
    let triangles = table.class_of(slot).topology() == Topology::Triangles;
    // What is not transparent is drawn before the test.
    let part = match (
        triangles && table.is_tested(slot),
        table.is_transparent(slot),
    ) {
        (true, false) => Part::Both,
        (true, true) => Part::Occludee,
        (false, false) => Part::Occluder,
        (false, true) => Part::Exempt,
    };
    JudgedInstance::oriented(&table.oriented(slot), part)
}
