//! The twin of the oracle: rays through pixels in f64, against every triangle. It knows nothing of frusta, matrices, slots or rasterisers.

use antumbra::scene::{Camera, EntityKey, Projection, Scene};
use glam::DVec3;

/// How far around a pixel's middle all must be the same for the pixel to be sure, in pixels: more than vertices are snapped by and f32 loses.
const AROUND: f64 = 0.1;
/// Depths that differ by less, as a share, may fall either way.
const SAME_DEPTH: f64 = 1e-5;

/// Triangles in the world, with whom they belong to.
pub struct Twin {
    triangles: Vec<(EntityKey, [DVec3; 3])>,
}

/// Where a ray starts, relative to the eye, and where it goes.
struct Ray {
    from: DVec3,
    towards: DVec3,
}

impl Twin {
    /// Of every triangle of a scene, all of them single-sided.
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

    /// Who owns each pixel, row after row from the top: nobody, somebody, or `None` where a little would change it. Rays go through the
    /// pixel's middle and as many `steps` around it; what is thinner than a step may slip through.
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
    // -1 to 1, upwards.
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
        other => panic!("the twin does not look through {other:?}"),
    }
}

/// The nearest front face beyond the near plane; `None` where two owners are as near. `towards` goes a metre ahead a metre of depth.
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

/// How far along the ray it meets the front of a triangle (Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
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
