//! A prepared terrain as entities of a scene: one for each leaf group, and some for the ungrouped triangles, which are always drawn.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_scene::{Drawable, EntityKey, Geometry, Light, Material, MaterialKey, Mesh, Scene};
use glam::{DAffine3, DQuat, DVec3, EulerRot, Vec3};

use crate::error::TerrainError;
use crate::field::Field;
use crate::packed_tree::packed_order;
use crate::position_key::position_key;
use crate::terrain::Terrain;
use crate::world::to_world;

/// The most triangles of an entity that shows ungrouped triangles.
const UNGROUPED_TRIANGLES: usize = 1024;

/// The entities that show a terrain. Do not move `root`: the horizons hold only where the terrain was shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownTerrain {
    /// The parent of all other entities.
    pub root: EntityKey,
    /// The entities of the leaf groups.
    pub groups: Vec<ShownGroup>,
    /// The entities of the ungrouped triangles.
    pub ungrouped: Vec<ShownUngrouped>,
}

/// The entity that shows a leaf group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShownGroup {
    /// The entity.
    pub entity: EntityKey,
    /// The group, as an index of [`GroupHierarchy::groups`](crate::GroupHierarchy::groups).
    pub group: u32,
}

/// An entity that shows some of the ungrouped triangles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShownUngrouped {
    /// The entity.
    pub entity: EntityKey,
    /// The triangles, as indices of [`Field::triangles`].
    pub triangles: Vec<u32>,
}

/// A terrain, and the entities that show it in a scene.
#[derive(Debug, Clone)]
pub struct TerrainInScene {
    /// The terrain.
    pub terrain: Arc<Terrain>,
    /// Its entities.
    pub shown: ShownTerrain,
}

/// The ungrouped triangles, neighbours near each other.
fn ungrouped(terrain: &Terrain) -> Vec<u32> {
    let field = terrain.field();
    let triangles = terrain.groups().ungrouped_triangles();
    let centroid = |triangle: &u32| {
        field
            .corners(*triangle)
            .into_iter()
            .sum::<DVec3>()
            .truncate()
            / 3.0
    };
    let centroids: Vec<_> = triangles.iter().map(centroid).collect();
    packed_order(&centroids)
        .into_iter()
        .map(|at| triangles[at as usize])
        .collect()
}

impl Terrain {
    /// Adds the terrain's entities to a scene.
    ///
    /// # Errors
    /// [`TerrainError::Scene`] when the scene is full, or for an unknown material.
    pub fn show(
        &self,
        scene: &mut Scene,
        material: MaterialKey,
    ) -> Result<ShownTerrain, TerrainError> {
        let (field, groups) = (self.field(), self.groups());
        let transform = DAffine3::from_translation(to_world(field.origin()));
        let root = scene.spawn(None, transform)?;
        scene.set_entity_name(root, "terrain")?;
        let normals = normals(field, self.margin());
        let mut add = |name: String, triangles: &[u32]| {
            let entity = scene.spawn(Some(root), DAffine3::IDENTITY)?;
            scene.set_entity_name(entity, name.as_str())?;
            let mesh = scene.add_mesh(Mesh::new(name, geometry(field, &normals, triangles)))?;
            scene.set_drawable(entity, Drawable { mesh, material })?;
            Ok::<_, TerrainError>(entity)
        };
        let mut shown_groups = Vec::new();
        for (number, group) in groups.groups().iter().enumerate() {
            if group.is_leaf() {
                let entity = add(format!("group {number}"), groups.triangles(group))?;
                let group = number as u32;
                shown_groups.push(ShownGroup { entity, group });
            }
        }
        let mut shown_ungrouped = Vec::new();
        for (number, triangles) in ungrouped(self).chunks(UNGROUPED_TRIANGLES).enumerate() {
            let entity = add(format!("always {number}"), triangles)?;
            let triangles = triangles.to_vec();
            shown_ungrouped.push(ShownUngrouped { entity, triangles });
        }
        Ok(ShownTerrain {
            root,
            groups: shown_groups,
            ungrouped: shown_ungrouped,
        })
    }

    /// Adds the terrain's entities to a scene in the colour of grass, and a sun in the south-west.
    ///
    /// # Errors
    /// As [`Terrain::show`].
    pub fn show_lit(&self, scene: &mut Scene) -> Result<ShownTerrain, TerrainError> {
        let material = ground_material(scene);
        let shown = self.show(scene, material)?;
        add_sun(scene)?;
        Ok(shown)
    }
}

/// The colour of grass.
pub(crate) fn ground_material(scene: &mut Scene) -> MaterialKey {
    scene.add_material(Material {
        name: "ground".to_owned(),
        base_colour: [0.36, 0.42, 0.24, 1.0],
        double_sided: true,
        ..Material::default()
    })
}

/// Adds a sun in the south-west.
pub(crate) fn add_sun(scene: &mut Scene) -> Result<(), TerrainError> {
    let slanting = DQuat::from_euler(EulerRot::YXZ, -0.7, -0.6, 0.0);
    let sun = scene.spawn(None, DAffine3::from_quat(slanting))?;
    scene.set_entity_name(sun, "sun")?;
    let light = Light::Directional {
        colour: [1.0, 0.97, 0.9],
        illuminance: 3.2,
    };
    scene.set_light(sun, light)?;
    Ok(())
}

/// The unit normals of all vertices, weighted by the areas of the triangles. The margin's triangles count too, so that the shading has no
/// seam between tiles.
pub(crate) fn normals(field: &Field, margin: &[[DVec3; 3]]) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; field.points().len()];
    for (triangle, corners) in field.triangles().iter().enumerate() {
        let [a, b, c] = field.corners(triangle as u32);
        for &corner in corners {
            sums[corner as usize] += (b - a).cross(c - a);
        }
    }
    let rings = field.boundary().rings.iter().flatten();
    let border: HashMap<[u64; 3], u32> = rings
        .map(|&half_edge| field.start(half_edge))
        .map(|vertex| (position_key(field.point(vertex)), vertex))
        .collect();
    for &[a, b, c] in margin {
        for corner in [a, b, c] {
            if let Some(&vertex) = border.get(&position_key(corner)) {
                sums[vertex as usize] += (b - a).cross(c - a);
            }
        }
    }
    let unit = |sum: DVec3| to_world(sum.normalize_or(DVec3::Z)).as_vec3().to_array();
    sums.into_iter().map(unit).collect()
}

/// A mesh of some triangles.
pub(crate) fn geometry(field: &Field, normals: &[[f32; 3]], triangles: &[u32]) -> Geometry {
    let IndexedTriangles { vertices, indices } = indexed(field, triangles);
    Geometry {
        positions: vertices
            .iter()
            .map(|&at| mesh_position(field, at))
            .collect(),
        normals: vertices.iter().map(|&at| normals[at as usize]).collect(),
        indices,
        ..Geometry::default()
    }
}

/// Some triangles of a field as a mesh has them.
pub(crate) struct IndexedTriangles {
    /// The field's vertices, in the order in which the triangles use them.
    pub vertices: Vec<u32>,
    /// Three for each triangle, into `vertices`.
    pub indices: Vec<u32>,
}

/// Indexes some triangles of a field.
pub(crate) fn indexed(field: &Field, triangles: &[u32]) -> IndexedTriangles {
    let mut index_of: HashMap<u32, u32> = HashMap::new();
    let mut vertices = Vec::new();
    let mut indices = Vec::with_capacity(triangles.len() * 3);
    for &triangle in triangles {
        for corner in field.triangles()[triangle as usize] {
            let index = *index_of.entry(corner).or_insert_with(|| {
                vertices.push(corner);
                vertices.len() as u32 - 1
            });
            indices.push(index);
        }
    }
    IndexedTriangles { vertices, indices }
}

/// The position of a vertex in a mesh: in the world's axes, relative to the field's origin.
pub(crate) fn mesh_position(field: &Field, vertex: u32) -> [f32; 3] {
    let position: Vec3 = to_world(field.point(vertex)).as_vec3();
    position.to_array()
}
