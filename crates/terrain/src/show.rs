//! A prepared terrain as entities of a scene: one a crystal, and some for what is always drawn.

use std::collections::HashMap;

use antumbra_scene::{Drawable, EntityKey, Geometry, Light, Material, MaterialKey, Mesh, Scene};
use glam::{DAffine3, DQuat, DVec3, EulerRot, Vec3};

use crate::blocks::bits;
use crate::error::TerrainError;
use crate::field::Field;
use crate::packed::order;
use crate::terrain::Terrain;

/// Triangles of an entity that is always drawn.
const ALWAYS: usize = 1024;

/// A terrain in a scene. Moving `root` would make its horizons those of another place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownTerrain {
    /// The entity that all others hang below.
    pub root: EntityKey,
    /// The crystals' entities and their groups.
    pub groups: Vec<(EntityKey, u32)>,
    /// Entities of the triangles of no group, and which of those each shows.
    pub always: Vec<(EntityKey, Vec<u32>)>,
}

/// The triangles of no group, neighbours together.
fn always(terrain: &Terrain) -> Vec<u32> {
    let (field, groups) = (terrain.field(), terrain.groups());
    let range = groups.always();
    let rest = groups.order().get(range.start as usize..range.end as usize);
    let rest = rest.unwrap_or_default();
    let middle = |triangle: &u32| {
        field
            .corners(*triangle)
            .into_iter()
            .sum::<DVec3>()
            .truncate()
            / 3.0
    };
    let middles: Vec<_> = rest.iter().map(middle).collect();
    order(&middles)
        .into_iter()
        .map(|at| rest[at as usize])
        .collect()
}

/// From metres east, north and up to the world, Y up and Z south.
#[must_use]
pub fn to_world(place: DVec3) -> DVec3 {
    DVec3::new(place.x, place.z, -place.y)
}

/// The way back.
pub(crate) fn from_world(place: DVec3) -> DVec3 {
    DVec3::new(place.x, -place.z, place.y)
}

impl Terrain {
    /// Puts the terrain into a scene.
    ///
    /// # Errors
    /// [`TerrainError::Scene`] when the scene is full, or for an unknown material.
    pub fn show(
        &self,
        scene: &mut Scene,
        material: MaterialKey,
    ) -> Result<ShownTerrain, TerrainError> {
        let (field, groups) = (self.field(), self.groups());
        let place = DAffine3::from_translation(to_world(field.origin()));
        let root = scene.spawn(None, place)?;
        scene.set_entity_name(root, "terrain")?;
        let normals = normals(self);
        let mut add = |name: String, triangles: &[u32]| {
            let entity = scene.spawn(Some(root), DAffine3::IDENTITY)?;
            scene.set_entity_name(entity, name.as_str())?;
            let mesh = scene.add_mesh(Mesh::new(name, geometry(field, &normals, triangles)))?;
            scene.set_drawable(entity, Drawable { mesh, material })?;
            Ok::<_, TerrainError>(entity)
        };
        let mut shown = Vec::new();
        for (number, group) in groups.groups().iter().enumerate() {
            if group.is_leaf() {
                let entity = add(format!("group {number}"), groups.triangles(group))?;
                shown.push((entity, number as u32));
            }
        }
        let mut rest = Vec::new();
        for (number, triangles) in always(self).chunks(ALWAYS).enumerate() {
            let entity = add(format!("always {number}"), triangles)?;
            rest.push((entity, triangles.to_vec()));
        }
        Ok(ShownTerrain {
            root,
            groups: shown,
            always: rest,
        })
    }
}

impl Terrain {
    /// Puts the terrain into a scene in the colour of grass, with a sun in the south-west.
    ///
    /// # Errors
    /// As [`Terrain::show`].
    pub fn show_lit(&self, scene: &mut Scene) -> Result<ShownTerrain, TerrainError> {
        let material = scene.add_material(Material {
            name: "ground".to_owned(),
            base_colour: [0.36, 0.42, 0.24, 1.0],
            double_sided: true,
            ..Material::default()
        });
        let shown = self.show(scene, material)?;
        let slanting = DQuat::from_euler(EulerRot::YXZ, -0.7, -0.6, 0.0);
        let sun = scene.spawn(None, DAffine3::from_quat(slanting))?;
        scene.set_entity_name(sun, "sun")?;
        let light = Light::Directional {
            colour: [1.0, 0.97, 0.9],
            illuminance: 3.2,
        };
        scene.set_light(sun, light)?;
        Ok(shown)
    }
}

/// Unit normals of all vertices, each triangle counting by its area, and those of the margin too: where blocks meet, light goes on.
fn normals(terrain: &Terrain) -> Vec<[f32; 3]> {
    let field = terrain.field();
    let mut sums = vec![DVec3::ZERO; field.points().len()];
    for (triangle, corners) in field.triangles().iter().enumerate() {
        let [a, b, c] = field.corners(triangle as u32);
        for &corner in corners {
            sums[corner as usize] += (b - a).cross(c - a);
        }
    }
    let rings = field.outline().rings.iter().flatten();
    let border: HashMap<[u64; 3], u32> = rings
        .map(|&half| field.start(half))
        .map(|vertex| (bits(field.point(vertex)), vertex))
        .collect();
    for &[a, b, c] in terrain.margin() {
        for corner in [a, b, c] {
            if let Some(&vertex) = border.get(&bits(corner)) {
                sums[vertex as usize] += (b - a).cross(c - a);
            }
        }
    }
    let unit = |sum: DVec3| to_world(sum.normalize_or(DVec3::Z)).as_vec3().to_array();
    sums.into_iter().map(unit).collect()
}

fn geometry(field: &Field, normals: &[[f32; 3]], triangles: &[u32]) -> Geometry {
    let (corners, indices) = corners(field, triangles);
    Geometry {
        positions: corners.iter().map(|&at| position(field, at)).collect(),
        normals: corners.iter().map(|&at| normals[at as usize]).collect(),
        indices,
        ..Geometry::default()
    }
}

/// The vertices of some triangles in the order in which a mesh has them, and its indices.
pub(crate) fn corners(field: &Field, triangles: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut names: HashMap<u32, u32> = HashMap::new();
    let mut corners = Vec::new();
    let mut indices = Vec::with_capacity(triangles.len() * 3);
    for &triangle in triangles {
        for corner in field.triangles()[triangle as usize] {
            let name = *names.entry(corner).or_insert_with(|| {
                corners.push(corner);
                corners.len() as u32 - 1
            });
            indices.push(name);
        }
    }
    (corners, indices)
}

/// A vertex as a mesh has it.
pub(crate) fn position(field: &Field, vertex: u32) -> [f32; 3] {
    let place: Vec3 = to_world(field.point(vertex)).as_vec3();
    place.to_array()
}
