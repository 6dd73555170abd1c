//! A cube of spheres: many small, equal entities.

use super::BuiltinError;
use crate::material::Material;
use crate::mesh::{Geometry, Mesh};
use crate::scene::{Drawable, Scene};
use glam::{DAffine3, DVec3, Vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::collections::HashMap;

/// How large the grid is and how its jitter falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridOptions {
    /// Spheres along an edge of the cube.
    pub per_side: u32,
    /// Seed of the jitter; the same seed gives the same scene everywhere.
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

/// The most entities a built-in scene may have.
const MOST_ENTITIES: u64 = 100_000_000;
/// Radius of the grid's spheres in metres.
const RADIUS: f32 = 0.45;
/// Greatest shift of a sphere in each axis, in metres.
const JITTER: f64 = 0.1;

/// `per_side`³ icospheres of 320 triangles and 0.45 m radius, 1 m apart around the origin and each shifted by up to 0.1 m in
/// each axis; one mesh, one material, one directional light. With the default 26 a side that is 17,576 drawable entities.
///
/// # Errors
/// [`BuiltinError::TooLarge`] beyond a hundred million spheres.
pub fn grid(options: GridOptions) -> Result<Scene, BuiltinError> {
    let side = u64::from(options.per_side);
    if side.saturating_pow(3) > MOST_ENTITIES {
        return Err(BuiltinError::TooLarge {
            name: "grid",
            size: options.per_side,
            most: MOST_ENTITIES,
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

/// A sphere around the origin: an icosahedron whose triangles are split in four `splits` times (at most 8), its vertices
/// pushed out to `radius` metres. 20 * 4^splits triangles, counter-clockwise from outside, with normals.
#[must_use]
pub fn icosphere(splits: u32, radius: f32) -> Geometry {
    let corners = ICOSAHEDRON_VERTICES.into_iter().map(Vec3::from_array);
    let mut directions: Vec<Vec3> = corners.map(Vec3::normalize).collect();
    let mut triangles = ICOSAHEDRON_TRIANGLES.to_vec();
    for _ in 0..splits.min(8) {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let ends = [a, b].map(|i| directions.get(i as usize).copied().unwrap_or(Vec3::X));
                directions.push(ends.into_iter().sum::<Vec3>().normalize());
                directions.len() as u32 - 1
            })
        };
        triangles = (triangles.into_iter())
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    Geometry {
        positions: directions
            .iter()
            .map(|d| (*d * radius).to_array())
            .collect(),
        normals: directions.iter().map(|d| d.to_array()).collect(),
        indices: triangles.into_flattened(),
        ..Geometry::default()
    }
}

/// The golden ratio.
const PHI: f32 = 1.618_034;

/// The icosahedron of edge length 2.
const ICOSAHEDRON_VERTICES: [[f32; 3]; 12] = [
    [0.0, -1.0, -PHI],
    [-1.0, -PHI, 0.0],
    [-PHI, 0.0, -1.0],
    [0.0, -1.0, PHI],
    [-1.0, PHI, 0.0],
    [PHI, 0.0, -1.0],
    [0.0, 1.0, -PHI],
    [1.0, -PHI, 0.0],
    [-PHI, 0.0, 1.0],
    [0.0, 1.0, PHI],
    [1.0, PHI, 0.0],
    [PHI, 0.0, 1.0],
];

const ICOSAHEDRON_TRIANGLES: [[u32; 3]; 20] = [
    [0, 1, 2],
    [0, 7, 1],
    [0, 2, 6],
    [0, 6, 5],
    [0, 5, 7],
    [1, 8, 2],
    [1, 7, 3],
    [1, 3, 8],
    [2, 4, 6],
    [2, 8, 4],
    [3, 7, 11],
    [3, 9, 8],
    [3, 11, 9],
    [4, 10, 6],
    [4, 8, 9],
    [4, 9, 10],
    [5, 6, 10],
    [5, 11, 7],
    [5, 10, 11],
    [9, 11, 10],
];
