//! The geometry of an entity's query: the cheapest one that covers every sample of the mesh.

use antumbra_scene::{Aabb, Topology};

use crate::entities::{MeshDetail, SceneTable};
use crate::subpixel;
use crate::view::ViewFrame;

/// Triangles of a box.
const BOX_TRIANGLES: u32 = 12;

/// The detail that a query draws for a slot: its box, or the mesh itself. Meshes with no more triangles than a box are drawn as they are. So are lines and points, which
/// cover pixels outside their boxes, and meshes that are so small or thin on the screen that a rasteriser's snapping could exceed the box's margin.
pub fn query_detail(table: &SceneTable, frame: &ViewFrame, slot: u32) -> MeshDetail {
    let boxed = table.class_of(slot).topology() == Topology::Triangles
        && table.primitives_of(slot, MeshDetail::Level(0)) > BOX_TRIANGLES
        && is_wide_enough(table.box_margin(slot), frame, &table.bounds(slot));
    if boxed {
        MeshDetail::Box
    } else {
        MeshDetail::Level(0)
    }
}

/// Whether a box that is wider than its mesh by `margin` metres covers it wherever a rasteriser moves the corners of both.
pub(crate) fn is_wide_enough(margin: f64, frame: &ViewFrame, bounds: &Aabb) -> bool {
    frame.min_pixels(margin, bounds) > subpixel::DRAWN
}
