//! The scene `grid`: a cube of many small, equal spheres.

use crate::error::DemoSceneError;
use antumbra_scene::{Drawable, Material, Mesh, Scene, icosphere};
use glam::{DAffine3, DVec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Size of the grid and seed of its jitter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridOptions {
    /// Spheres along an edge of the cube.
    pub per_side: u32,
    /// Seed of the jitter. One seed gives the same scene on every platform.
    pub seed: u64,
}

impl Default for GridOptions {
    fn default() -> Self {
        Self {
            per_side: 26,
            seed: 1,
        }
    }
}

/// Maximum number of entities of a built-in scene.
const MAX_ENTITIES: u64 = 100_000_000;
/// Radius of the grid's spheres in metres.
const RADIUS: f32 = 0.45;
/// Maximum offset of a sphere along each axis, in metres.
const JITTER: f64 = 0.1;

/// Builds `per_side`³ icospheres of 320 triangles and 0.45 m radius, 1 m apart around the origin, each moved by up to
/// 0.1 m along each axis. They share one mesh and one material; the scene has one directional light. The default, 26
/// along an edge, gives 17,576 drawable entities.
///
/// # Errors
/// [`DemoSceneError::TooLarge`] for more than a hundred million spheres.
pub fn grid(options: GridOptions) -> Result<Scene, DemoSceneError> {
    let side = u64::from(options.per_side);
    if side.saturating_pow(3) > MAX_ENTITIES {
        return Err(DemoSceneError::TooLarge {
            name: "grid",
            size: options.per_side,
            max_entities: MAX_ENTITIES,
        });
    }
    let mut scene = Scene::new();
    scene.set_name("grid");
    let sphere = icosphere(2, RADIUS);
    let drawable = Drawable {
        mesh: scene.add_mesh(Mesh::new("icosphere", sphere))?,
        material: scene.add_material(Material {
            name: "white".into(),
            ..Material::default()
        }),
    };
    let mut random = Pcg32::seed_from_u64(options.seed);
    let mut jitter = || (f64::from(random.next_u32()) / f64::from(u32::MAX) * 2.0 - 1.0) * JITTER;
    let middle = (f64::from(options.per_side) - 1.0) * 0.5;
    let along = |i: u32| f64::from(i) - middle;
    for z in 0..options.per_side {
        for y in 0..options.per_side {
            for x in 0..options.per_side {
                let shift = DVec3::new(jitter(), jitter(), jitter());
                let place = DVec3::new(along(x), along(y), along(z)) + shift;
                let entity = scene.spawn(None, DAffine3::from_translation(place))?;
                scene.set_drawable(entity, drawable)?;
            }
        }
    }
    super::sun::add(&mut scene, 0.6, -1.0)?;
    Ok(scene)
}
