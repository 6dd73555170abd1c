//! A ray caster: the first hit on a straight line through a scene.

use antumbra_scene::{EntityKey, Scene};
use glam::{DMat3, DVec3};

/// The first entity that a ray hits, from either side, and its distance in metres. The scene is up to date.
pub fn first_on(scene: &Scene, from: DVec3, along: DVec3) -> Option<(EntityKey, f64)> {
    let boxes = scene.drawables().filter(|(entity, _)| {
        let bounds = scene.world_bounds(*entity).unwrap();
        let ends = [bounds.min, bounds.max].map(|end| (end - from) / along);
        let (into, out) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        into.max_element() <= out.min_element()
    });
    let hits = boxes.filter_map(|(entity, drawable)| {
        let geometry = scene.mesh(drawable.mesh)?.full()?;
        let back = scene.world(entity)?.inverse();
        let (from, along) = (back.transform_point3(from), back.transform_vector3(along));
        let distances = geometry.triangles().filter_map(|triangle| {
            let [a, b, c] = geometry.corners(triangle)?;
            let sides = DMat3::from_cols(b - a, c - a, -along);
            if sides.determinant() == 0.0 {
                return None;
            }
            let [u, v, distance] = (sides.inverse() * (from - a)).to_array();
            (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
        });
        Some((entity, distances.min_by(f64::total_cmp)?))
    });
    hits.min_by(|(_, a), (_, b)| a.total_cmp(b))
}
