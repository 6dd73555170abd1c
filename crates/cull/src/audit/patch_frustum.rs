//! The entities that may be seen through a patch: the tree's leaves in the part of the frustum behind it.

use antumbra_scene::Frustum;
use glam::{DVec2, UVec2};

use crate::draw_source::patches::PATCH_SIDE;
use crate::tree::Tree;
use crate::view::ViewFrame;

/// The margin of the patch's frustum in pixels: snapping and the width of lines bring in entities from outside.
const MARGIN: f64 = 2.0;

/// The part of the view frustum behind a patch.
pub(super) fn frustum(view: &ViewFrame, [column, row]: [u32; 2]) -> Frustum {
    let from = UVec2::new(column, row) * PATCH_SIDE;
    let size = UVec2::from(view.size).as_dvec2();
    let share = |pixel: DVec2| pixel / size * 2.0 - 1.0;
    let low = share(from.as_dvec2() - MARGIN);
    let high = share((from + PATCH_SIDE).as_dvec2() + MARGIN);
    view.camera.window(
        view.aspect(),
        DVec2::new(low.x, -high.y),
        DVec2::new(high.x, -low.y),
    )
}

/// Appends the slots of all tested entities whose boxes touch the frustum to `found`. Returns the number of visited nodes.
pub(super) fn visit(
    tree: &Tree,
    frustum: &Frustum,
    stack: &mut Vec<u32>,
    found: &mut Vec<u32>,
) -> u32 {
    let hierarchy = tree.hierarchy();
    let mut met = 0;
    stack.clear();
    stack.extend(hierarchy.roots());
    while let Some(number) = stack.pop() {
        let Some(node) = hierarchy.node(number) else {
            continue;
        };
        met += 1;
        if !frustum.intersects(&node.bounds) {
            continue;
        }
        match hierarchy.leaf(number) {
            Some(slot) => found.push(slot),
            None => stack.extend(node.children()),
        }
    }
    met
}
