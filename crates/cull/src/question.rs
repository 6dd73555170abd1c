//! What a hardware query draws to ask about an entity: the cheapest geometry that can hide no sample of it.

use antumbra_draw::{Detail, SceneTable, ViewFrame};
use antumbra_scene::Topology;

/// Triangles of a box.
const BOX_TRIANGLES: u32 = 12;

/// From how many pixels on a box's margin, a hundredth of its size a side, is wide against the 1/256 of a pixel that vertices snap to.
const BOX_PIXELS: f64 = 8.0;

/// The detail to ask about a slot with: its box. A mesh that is no dearer than its box stands for itself. So do lines and points, which
/// cover pixels that their boxes do not, and what is small on the screen, where the box's margin is less than what a rasteriser may snap.
pub(crate) fn question(table: &SceneTable, frame: &ViewFrame, slot: u32) -> Detail {
    let boxed = table.class_of(slot).topology() == Topology::Triangles
        && table.primitives_of(slot, Detail::Level(0)) > BOX_TRIANGLES
        && frame.pixels_across(&table.bounds(slot)) > BOX_PIXELS;
    if boxed { Detail::Box } else { Detail::Level(0) }
}
