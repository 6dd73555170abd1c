//! The engine while it is put together: parts are made once and placed as often as they occur.

use super::look::{Look, lamps};
use super::workshop::workshop;
use crate::solid::Solid;
use antumbra_scene::{Drawable, EntityKey, Environment, MaterialKey, Scene, SceneError};
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

/// A scene that grows by parts.
pub(super) struct Assembly {
    scene: Scene,
    engine: EntityKey,
    /// Below which parts are hung.
    module: EntityKey,
    looks: Vec<(Look, MaterialKey)>,
}

/// A part that can be placed.
pub(super) struct Part {
    name: String,
    drawable: Drawable,
    placed: usize,
}

impl Assembly {
    /// Only the lamps and the workshop.
    pub fn new(name: &str) -> Result<Self, SceneError> {
        let mut scene = Scene::new();
        scene.set_name(name);
        let image = scene.add_image(workshop())?;
        scene.set_environment(Some(Environment {
            image,
            intensity: 1.5,
        }))?;
        let engine = scene.spawn(None, DAffine3::IDENTITY)?;
        scene.set_entity_name(engine, "engine")?;
        for (name, place, light) in lamps() {
            let lamp = scene.spawn(None, DAffine3::from_translation(place.into()))?;
            scene.set_entity_name(lamp, name)?;
            scene.set_light(lamp, light)?;
        }
        Ok(Self {
            scene,
            engine,
            module: engine,
            looks: Vec::new(),
        })
    }

    /// What is placed from now on belongs to this module.
    pub fn module(&mut self, name: &str) -> Result<(), SceneError> {
        self.module = self.scene.spawn(Some(self.engine), DAffine3::IDENTITY)?;
        self.scene.set_entity_name(self.module, name)
    }

    /// A part to be placed.
    pub fn part(&mut self, name: &str, look: Look, solid: Solid) -> Result<Part, SceneError> {
        let known = self.looks.iter().find(|(other, _)| *other == look);
        let material = match known {
            Some((_, material)) => *material,
            None => {
                let material = self.scene.add_material(look.material());
                self.looks.push((look, material));
                material
            }
        };
        Ok(Part {
            name: name.to_owned(),
            drawable: Drawable {
                mesh: self.scene.add_mesh(solid.mesh(name))?,
                material,
            },
            placed: 0,
        })
    }

    /// Places a part: one component more.
    pub fn place(&mut self, part: &mut Part, at: DAffine3) -> Result<(), SceneError> {
        let entity = self.scene.spawn(Some(self.module), at)?;
        part.placed += 1;
        let name = format!("{} {}", part.name, part.placed);
        self.scene.set_entity_name(entity, name)?;
        self.scene.set_drawable(entity, part.drawable)
    }

    /// Places a part `count` times around the axis, the first turned by `first` radians.
    pub fn around(
        &mut self,
        part: &mut Part,
        count: usize,
        first: f64,
        at: DAffine3,
    ) -> Result<(), SceneError> {
        (0..count).try_for_each(|i| {
            let angle = first + TAU * i as f64 / count as f64;
            self.place(part, DAffine3::from_rotation_x(angle) * at)
        })
    }

    /// Places a part that occurs once, as it stands.
    pub fn single(&mut self, name: &str, look: Look, solid: Solid) -> Result<(), SceneError> {
        let mut part = self.part(name, look, solid)?;
        self.place(&mut part, DAffine3::IDENTITY)
    }

    /// How many components there are so far.
    pub fn components(&self) -> usize {
        self.scene.drawable_count()
    }

    /// The scene.
    pub fn finish(self) -> Scene {
        self.scene
    }
}

/// Moves along the axis and outwards.
pub(super) fn shifted(x: f64, radius: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, radius, 0.0))
}
