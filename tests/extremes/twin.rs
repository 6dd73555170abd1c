//! The CPU twin of the oracle: casts rays through pixels against every triangle, in f64. It uses no frusta, matrices, slots or rasteriser.

use antumbra::scene::{Camera, EntityKey, Projection, Scene};
use glam::DVec3;

/// A pixel is certain if it has one owner within this distance of its centre, in pixels: more than vertex snapping and f32 rounding.
const AROUND: f64 = 0.1;
/// Depths with a smaller relative difference may be in either order.
const SAME_DEPTH: f64 = 1e-5;

/// All triangles in world space, each with its entity.
pub struct Twin {
    triangles: Vec<(EntityKey, [DVec3; 3])>,
}

/// A ray: its origin relative to the eye, and its direction.
struct Ray {
    from: DVec3,
    towards: DVec3,
}

impl Twin {
    /// The twin of a scene. All triangles are single-sided.
    pub fn of(scene: &Scene) -> Self {
        let triangles = scene
            .drawables()
            .flat_map(|(entity, drawable)| {
                let world = scene.world(entity).unwrap();
                let mesh = scene.mesh(drawable.mesh).unwrap().full().unwrap();
                let mirrored = world.matrix3.determinant() < 0.0;
                let corners = mesh.triangles().map(|triangle| {
                    let [a, b, c] = mesh
                        .corners(triangle)
                        .unwrap()
                        .map(|corner| world.transform_point3(corner));
                    (entity, if mirrored { [a, c, b] } else { [a, b, c] })
                });
                corners.collect::<Vec<_>>()
            })
            .collect();
        Self { triangles }
    }

    /// The owner of each pixel, row by row from the top: an entity, the background, or `None` where the pixel is not certain. Casts rays through
    /// the centre of the pixel and `steps` to each side of it; an object thinner than a step may be missed.
    pub fn look(
        &self,
        camera: &Camera,
        size: [u32; 2],
        steps: i32,
    ) -> Vec<Option<Option<EntityKey>>> {
        let off = move |step: i32| f64::from(step) / f64::from(steps) * AROUND;
        let relative: Vec<_> = self
            .triangles
            .iter()
            .map(|(entity, corners)| (*entity, corners.map(|corner| corner - camera.position)))
            .collect();
        let [width, height] = size;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y].map(f64::from)));
        pixels
            .map(|[x, y]| {
                let places = (-steps..=steps).flat_map(|x| (-steps..=steps).map(move |y| [x, y]));
                let mut owners = places.map(|[right, down]| {
                    let ray = ray(camera, size, x + 0.5 + off(right), y + 0.5 + off(down));
                    nearest(&relative, camera, &ray)
                });
                let first = owners.next().flatten()?;
                owners.all(|owner| owner == Some(first)).then_some(first)
            })
            .collect()
    }
}

fn ray(camera: &Camera, [width, height]: [u32; 2], x: f64, y: f64) -> Ray {
    let [wide, high] = [width, height].map(f64::from);
    // Normalised device coordinates, -1 to 1, Y up.
    let (x, y) = (x / wide * 2.0 - 1.0, 1.0 - y / high * 2.0);
    let across = |half: f64| camera.right() * (x * half * wide / high) + camera.up() * (y * half);
    match camera.projection {
        Projection::Perspective { fov_y, .. } => Ray {
            from: DVec3::ZERO,
            towards: camera.forward() + across((fov_y * 0.5).tan()),
        },
        Projection::Orthographic { height, .. } => Ray {
            from: across(height * 0.5),
            towards: camera.forward(),
        },
        other => panic!("the twin does not support {other:?}"),
    }
}

/// The entity of the nearest front face beyond the near plane; `None` if two entities are equally near. The ray's `towards` is one metre long
/// along the viewing direction, so that its parameter is the depth.
fn nearest(
    triangles: &[(EntityKey, [DVec3; 3])],
    camera: &Camera,
    ray: &Ray,
) -> Option<Option<EntityKey>> {
    let far = match camera.projection {
        Projection::Orthographic { far, .. } => far,
        _ => f64::INFINITY,
    };
    let mut best: Option<(f64, EntityKey)> = None;
    let mut rival: Option<(f64, EntityKey)> = None;
    for (entity, corners) in triangles {
        let Some(depth) = hit(corners, ray) else {
            continue;
        };
        if depth < camera.near() || depth > far {
            continue;
        }
        let this = (depth, *entity);
        match best {
            Some((nearest, _)) if depth >= nearest => {
                if rival.is_none_or(|(next, _)| depth < next) && best.map(|b| b.1) != Some(*entity)
                {
                    rival = Some(this);
                }
            }
            _ => {
                if best.is_some_and(|(_, before)| before != *entity) {
                    rival = best;
                }
                best = Some(this);
            }
        }
    }
    match (best, rival) {
        (Some((nearest, one)), Some((next, other)))
            if one != other && next - nearest <= nearest.abs() * SAME_DEPTH =>
        {
            None
        }
        (best, _) => Some(best.map(|(_, entity)| entity)),
    }
}

/// The ray parameter at which the ray hits the front of a triangle (Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
fn hit([a, b, c]: &[DVec3; 3], ray: &Ray) -> Option<f64> {
    let (along, across) = (b - a, c - a);
    let normal = ray.towards.cross(across);
    let determinant = along.dot(normal);
    if determinant <= 0.0 {
        return None;
    }
    let from = ray.from - a;
    let u = from.dot(normal);
    let turned = from.cross(along);
    let v = ray.towards.dot(turned);
    let inside = u >= 0.0 && v >= 0.0 && u + v <= determinant;
    inside.then(|| across.dot(turned) / determinant)
}
