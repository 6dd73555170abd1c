//! What a hardware query draws to ask about an entity: the cheapest geometry that can hide no sample of it.

use antumbra_draw::{MeshDetail, SceneTable, ViewFrame};
use antumbra_scene::Topology;

/// Triangles of a box.
const BOX_TRIANGLES: u32 = 12;

/// How many pixels a box must be wider than its mesh on every side: twice what snapping to 1/256 of a pixel moves two vertices apart.
const MARGIN_PIXELS: f64 = 1.0 / 128.0;

/// The detail to ask about a slot with: its box. A mesh that is no dearer than its box stands for itself. So do lines and points, which
/// cover pixels that their boxes do not, and what is so small or so thin on the screen that the box's margin is less than a rasteriser may snap.
pub fn query_detail(table: &SceneTable, frame: &ViewFrame, slot: u32) -> MeshDetail {
    let boxed = table.class_of(slot).topology() == Topology::Triangles
        && table.primitives_of(slot, MeshDetail::Level(0)) > BOX_TRIANGLES
        && frame.pixels_of(table.box_margin(slot), &table.bounds(slot)) > MARGIN_PIXELS;
    if boxed {
        MeshDetail::Box
    } else {
        MeshDetail::Level(0)
    }
}
