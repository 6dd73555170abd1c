//! The geometry of an entity's query: the cheapest one that covers every sample of the mesh.

use antumbra_scene::Topology;

use crate::entities::{MeshDetail, SceneTable};
use crate::view::ViewFrame;

/// Triangles of a box.
const BOX_TRIANGLES: u32 = 12;

/// The least margin of a box around its mesh, in pixels: twice the distance that snapping to 1/256 of a pixel can move two vertices apart.
const MARGIN_PIXELS: f64 = 1.0 / 128.0;

/// The detail that a query draws for a slot: its box, or the mesh itself. Meshes with no more triangles than a box are drawn as they are. So are lines and points, which
/// cover pixels outside their boxes, and meshes that are so small or thin on the screen that a rasteriser's snapping could exceed the box's margin.
pub fn query_detail(table: &SceneTable, frame: &ViewFrame, slot: u32) -> MeshDetail {
    let boxed = table.class_of(slot).topology() == Topology::Triangles
        && table.primitives_of(slot, MeshDetail::Level(0)) > BOX_TRIANGLES
        && frame.min_pixels(table.box_margin(slot), &table.bounds(slot)) > MARGIN_PIXELS;
    if boxed {
        MeshDetail::Box
    } else {
        MeshDetail::Level(0)
    }
}
