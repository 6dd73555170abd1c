//! Orders of drawing: front to back to save fragments, back to front to blend.

use crate::draw_source::DrawList;
use crate::entities::{MeshDetail, SceneTable};
use crate::view::ViewFrame;

/// Orders slots by the distance of their bounds' centres, nearest first, ties by slot. Each entry holds the slot in its low half and the
/// distance in its high half, so that integers are sorted.
pub fn front_to_back(
    order: &mut Vec<u64>,
    table: &SceneTable,
    view: &ViewFrame,
    slots: impl Iterator<Item = u32>,
) {
    let eye = view.camera.position;
    order.clear();
    order.extend(slots.map(|slot| {
        let distance = table.bounds(slot).centre().distance_squared(eye) as f32;
        // The bits of floats that are not negative sort as the floats do.
        u64::from(distance.to_bits()) << 32 | u64::from(slot)
    }));
    order.sort_unstable();
}

/// Orders transparent entities for blending: by the distance of their bounds' centres, farthest first, ties by slot. Each comes with its
/// level of detail.
pub fn back_to_front(
    list: &mut DrawList,
    table: &SceneTable,
    view: &ViewFrame,
    slots: impl Iterator<Item = (u32, u8)>,
) {
    let eye = view.camera.position;
    let mut order: Vec<(f64, u32, u8)> = slots
        .map(|(slot, level)| {
            (
                table.bounds(slot).centre().distance_squared(eye),
                slot,
                level,
            )
        })
        .collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    list.clear();
    for (_, slot, level) in order {
        list.push(table, slot, MeshDetail::Level(level));
    }
}

/// Orders slots by the distance from the eye to the nearest corner of their boxes, ties by slot.
pub fn by_nearest_corner(order: &mut [u32], table: &SceneTable, frame: &ViewFrame) {
    order.sort_by_cached_key(|slot| {
        let distance = frame
            .camera
            .nearest_corner_distance(&table.bounds(*slot))
            .max(0.0);
        // The bits of positive floats sort as the floats do.
        (distance.to_bits(), *slot)
    });
}
