//! Normals that cannot be: not finite, or without a direction. Their vertices get those of their triangles, so that the others keep their own.

use crate::budget::Budget;
use crate::left_out::LostPart;
use antumbra_scene::{Geometry, Topology};
use glam::Vec3;

/// Replaces invalid normals, and notes those that are not finite. Where no normal is valid, none is left: the geometry is shaded flat.
pub(crate) fn mend(geometry: &mut Geometry, place: &str, budget: &mut Budget) {
    let not_finite = |normal: &[f32; 3]| !Vec3::from(*normal).is_finite();
    let lost = geometry.normals.iter().filter(|normal| not_finite(normal));
    let reason = "normals that are not finite";
    let lost = lost.count() as u64;
    (budget.left_out).add_many(LostPart::Attribute, reason, lost, place);
    let is_bad = |normal: &[f32; 3]| {
        let squared = Vec3::from(*normal).length_squared();
        !(squared.is_finite() && squared > 1e-12)
    };
    let bad = geometry.normals.iter().filter(|normal| is_bad(normal));
    let bad = bad.count();
    if bad == 0 {
        return;
    }
    let normals = std::mem::take(&mut geometry.normals);
    if bad == normals.len() || geometry.topology != Topology::Triangles {
        // Lines and points face the eye without normals.
        return;
    }
    let computed = std::mem::take(geometry).with_computed_normals();
    *geometry = computed;
    for (own, read) in geometry.normals.iter_mut().zip(normals) {
        if !is_bad(&read) {
            *own = read;
        }
    }
}
