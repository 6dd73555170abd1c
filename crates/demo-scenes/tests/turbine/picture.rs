//! A software rasteriser that gives the visible entity of each pixel, so that the content of a view can be tested
//! without a GPU.

use antumbra_scene::{EntityKey, Scene};
use glam::DVec3;

/// A camera outside the scene, and the image size in pixels.
pub struct View {
    pub eye: DVec3,
    pub target: DVec3,
    /// Full vertical angle in radians.
    pub fov_y: f64,
    pub size: [usize; 2],
}

/// The visible entity of each pixel, row by row from the top: the one with the nearest front face. Nothing may lie
/// behind the eye.
pub fn picture(scene: &Scene, view: &View) -> Vec<Option<EntityKey>> {
    let [width, height] = view.size;
    let ahead = (view.target - view.eye).normalize();
    let right = ahead.cross(DVec3::Y).normalize();
    let up = right.cross(ahead);
    let scale = 0.5 * height as f64 / (0.5 * view.fov_y).tan();
    let mut pixels = vec![None; width * height];
    let mut nearest = vec![0.0; width * height];
    for (entity, drawable) in scene.drawables() {
        let world = scene.world(entity).unwrap();
        let geometry = scene.mesh(drawable.mesh).unwrap().full().unwrap();
        let seen = |p: &[f32; 3]| {
            let place = DVec3::from(p.map(f64::from));
            let offset = world.transform_point3(place) - view.eye;
            let depth = offset.dot(ahead);
            assert!(depth > 0.0, "all of the scene lies before the eye");
            let x = 0.5 * width as f64 + scale * offset.dot(right) / depth;
            let y = 0.5 * height as f64 - scale * offset.dot(up) / depth;
            DVec3::new(x, y, 1.0 / depth)
        };
        let corners: Vec<DVec3> = geometry.positions.iter().map(seen).collect();
        for triangle in geometry.triangles() {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            // y points down: a counter-clockwise triangle has a negative area.
            let area = (b - a).truncate().perp_dot((c - a).truncate());
            if area >= 0.0 {
                continue;
            }
            // Pixels whose centres lie between two positions.
            let range = |low: f64, high: f64, most: usize| {
                let first = (low - 0.5).ceil().max(0.0) as usize;
                first..((high + 0.5).floor().max(0.0) as usize).min(most)
            };
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            for y in range(low.y, high.y, height) {
                for x in range(low.x, high.x, width) {
                    let p = DVec3::new(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                    let part =
                        |q: DVec3, r: DVec3| (q - p).truncate().perp_dot((r - p).truncate()) / area;
                    let (u, v, w) = (part(b, c), part(c, a), part(a, b));
                    let near = u * a.z + v * b.z + w * c.z;
                    let pixel = y * width + x;
                    if u.min(v).min(w) >= 0.0 && near > nearest[pixel] {
                        nearest[pixel] = near;
                        pixels[pixel] = Some(entity);
                    }
                }
            }
        }
    }
    pixels
}
