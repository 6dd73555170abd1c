//! The city while it is put together: a tree of nodes, and pieces that are made once and placed as often as they occur.

use super::look::{Look, sun};
use crate::solid::Solid;
use antumbra_scene::{Drawable, EntityKey, MaterialKey, MeshKey, Scene, SceneError};
use glam::{DAffine3, DMat3, DVec3};
use std::collections::HashMap;

/// Something that is placed as it is: its name, its look where no other is asked for, and how it is made.
pub(super) struct Piece {
    pub name: &'static str,
    pub look: Look,
    pub make: fn() -> Solid,
}

/// A scene that grows by nodes and pieces.
pub(super) struct Kit {
    scene: Scene,
    city: EntityKey,
    meshes: HashMap<String, MeshKey>,
    looks: Vec<(Look, MaterialKey)>,
}

impl Kit {
    /// Only the sun.
    pub fn new(name: &str) -> Result<Self, SceneError> {
        let mut scene = Scene::new();
        scene.set_name(name);
        let city = scene.spawn(None, DAffine3::IDENTITY)?;
        scene.set_entity_name(city, name)?;
        let (at, light) = sun();
        let lamp = scene.spawn(None, at)?;
        scene.set_entity_name(lamp, "sun")?;
        scene.set_light(lamp, light)?;
        Ok(Self {
            scene,
            city,
            meshes: HashMap::new(),
            looks: Vec::new(),
        })
    }

    /// The node above all others.
    pub fn city(&self) -> EntityKey {
        self.city
    }

    /// An inner node.
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

    /// Places a piece.
    pub fn put(
        &mut self,
        parent: EntityKey,
        piece: &Piece,
        at: DAffine3,
    ) -> Result<(), SceneError> {
        self.make(parent, piece.name, piece.look, at, piece.make)
    }

    /// Places a piece with another look.
    pub fn put_as(
        &mut self,
        parent: EntityKey,
        piece: &Piece,
        look: Look,
        at: DAffine3,
    ) -> Result<(), SceneError> {
        self.make(parent, piece.name, look, at, piece.make)
    }

    /// Places what `solid` makes, or what it made under this name before.
    pub fn make(
        &mut self,
        parent: EntityKey,
        name: &str,
        look: Look,
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
        let known = self.looks.iter().find(|(other, _)| *other == look);
        let material = match known {
            Some((_, material)) => *material,
            None => {
                let material = self.scene.add_material(look.material());
                self.looks.push((look, material));
                material
            }
        };
        let entity = self.scene.spawn(Some(parent), at)?;
        self.scene.set_drawable(entity, Drawable { mesh, material })
    }

    /// The scene.
    pub fn finish(self) -> Scene {
        self.scene
    }
}

/// A place.
pub(super) fn at(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

/// A turn about the vertical by whole quarters, exact; a quarter takes +Z to +X.
pub(super) fn quarter_turn(quarters: i32) -> DAffine3 {
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

/// A place turned about the vertical by degrees.
pub(super) fn turned(x: f64, y: f64, z: f64, degrees: f64) -> DAffine3 {
    at(x, y, z) * DAffine3::from_rotation_y(degrees.to_radians())
}
