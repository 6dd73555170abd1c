//! Construction of the city: a tree of nodes, and prefabs that are made once and placed any number of times.

use super::materials::{MaterialKind, Sun, sun};
use crate::solid::Solid;
use antumbra_scene::{Drawable, EntityKey, MaterialKey, MeshKey, Scene, SceneError};
use glam::{DAffine3, DMat3, DVec3};
use std::collections::HashMap;

/// A mesh with a name and a default material, and the function that makes it.
pub(super) struct Prefab {
    pub name: &'static str,
    pub material: MaterialKind,
    pub make: fn() -> Solid,
}

/// A scene under construction.
pub(super) struct CityBuilder {
    scene: Scene,
    city: EntityKey,
    meshes: HashMap<String, MeshKey>,
    materials: Vec<(MaterialKind, MaterialKey)>,
}

impl CityBuilder {
    /// A scene with the root node and the sun.
    pub fn new(name: &str) -> Result<Self, SceneError> {
        let mut scene = Scene::new();
        scene.set_name(name);
        let city = scene.spawn(None, DAffine3::IDENTITY)?;
        scene.set_entity_name(city, name)?;
        let Sun { transform, light } = sun();
        let lamp = scene.spawn(None, transform)?;
        scene.set_entity_name(lamp, "sun")?;
        scene.set_light(lamp, light)?;
        Ok(Self {
            scene,
            city,
            meshes: HashMap::new(),
            materials: Vec::new(),
        })
    }

    /// The root node.
    pub fn city(&self) -> EntityKey {
        self.city
    }

    /// Adds an inner node.
    pub fn node(
        &mut self,
        parent: EntityKey,
        name: &str,
        at: DAffine3,
    ) -> Result<EntityKey, SceneError> {
        let node = self.scene.spawn(Some(parent), at)?;
        self.scene.set_entity_name(node, name)?;
        Ok(node)
    }

    /// Places a prefab.
    pub fn put(
        &mut self,
        parent: EntityKey,
        prefab: &Prefab,
        at: DAffine3,
    ) -> Result<(), SceneError> {
        self.make(parent, prefab.name, prefab.material, at, prefab.make)
    }

    /// Places a prefab with another material.
    pub fn place_with_material(
        &mut self,
        parent: EntityKey,
        prefab: &Prefab,
        material: MaterialKind,
        at: DAffine3,
    ) -> Result<(), SceneError> {
        self.make(parent, prefab.name, material, at, prefab.make)
    }

    /// Places the mesh of this name; `solid` makes it the first time.
    pub fn make(
        &mut self,
        parent: EntityKey,
        name: &str,
        material: MaterialKind,
        at: DAffine3,
        solid: impl FnOnce() -> Solid,
    ) -> Result<(), SceneError> {
        let mesh = match self.meshes.get(name) {
            Some(mesh) => *mesh,
            None => {
                let mesh = self.scene.add_mesh(solid().mesh(name))?;
                self.meshes.insert(name.to_owned(), mesh);
                mesh
            }
        };
        let material = self.material(material);
        let entity = self.scene.spawn(Some(parent), at)?;
        self.scene.set_drawable(entity, Drawable { mesh, material })
    }

    fn material(&mut self, kind: MaterialKind) -> MaterialKey {
        let known = self.materials.iter().find(|(other, _)| *other == kind);
        if let Some((_, key)) = known {
            return *key;
        }
        let key = self.scene.add_material(kind.material());
        self.materials.push((kind, key));
        key
    }

    /// Ends the construction.
    pub fn finish(self) -> Scene {
        self.scene
    }
}

/// A translation in metres.
pub(super) fn at(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

/// An exact rotation about the Y axis by quarters; one quarter maps +Z to +X.
pub(super) fn quarter_rotation(quarters: i32) -> DAffine3 {
    let (sin, cos) = match quarters.rem_euclid(4) {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    };
    let turn = DMat3::from_cols(
        DVec3::new(cos, 0.0, -sin),
        DVec3::Y,
        DVec3::new(sin, 0.0, cos),
    );
    DAffine3::from_mat3(turn)
}

/// A translation and a rotation about the Y axis in degrees.
pub(super) fn rotated_at(x: f64, y: f64, z: f64, degrees: f64) -> DAffine3 {
    at(x, y, z) * DAffine3::from_rotation_y(degrees.to_radians())
}
