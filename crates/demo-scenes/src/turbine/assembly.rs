//! Construction of the engine: a part is made once and placed any number of times.

use super::environment::workshop;
use super::materials::{Lamp, MaterialKind, lamps};
use crate::solid::Solid;
use antumbra_scene::{Drawable, EntityKey, Environment, MaterialKey, Scene, SceneError};
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

/// A scene under construction.
pub(super) struct Assembly {
    scene: Scene,
    engine: EntityKey,
    /// Parent of the parts that are placed next.
    module: EntityKey,
    materials: Vec<(MaterialKind, MaterialKey)>,
}

/// A part that can be placed.
pub(super) struct Part {
    name: String,
    drawable: Drawable,
    placed: usize,
}

impl Assembly {
    /// A scene with the lights and the environment map of the workshop.
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
        for Lamp {
            name,
            position,
            light,
        } in lamps()
        {
            let lamp = scene.spawn(None, DAffine3::from_translation(position.into()))?;
            scene.set_entity_name(lamp, name)?;
            scene.set_light(lamp, light)?;
        }
        Ok(Self {
            scene,
            engine,
            module: engine,
            materials: Vec::new(),
        })
    }

    /// Starts a module: the parts that are placed next belong to it.
    pub fn module(&mut self, name: &str) -> Result<(), SceneError> {
        self.module = self.scene.spawn(Some(self.engine), DAffine3::IDENTITY)?;
        self.scene.set_entity_name(self.module, name)
    }

    /// Makes a part.
    pub fn part(
        &mut self,
        name: &str,
        material: MaterialKind,
        solid: Solid,
    ) -> Result<Part, SceneError> {
        let material = self.material(material);
        Ok(Part {
            name: name.to_owned(),
            drawable: Drawable {
                mesh: self.scene.add_mesh(solid.mesh(name))?,
                material,
            },
            placed: 0,
        })
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

    /// Places a part; this adds one component.
    pub fn place(&mut self, part: &mut Part, at: DAffine3) -> Result<(), SceneError> {
        let entity = self.scene.spawn(Some(self.module), at)?;
        part.placed += 1;
        let name = format!("{} {}", part.name, part.placed);
        self.scene.set_entity_name(entity, name)?;
        self.scene.set_drawable(entity, part.drawable)
    }

    /// Places a part `count` times around the axis, the first rotated by `first` radians.
    pub fn place_around(
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

    /// Makes and places a part that occurs once.
    pub fn place_single(
        &mut self,
        name: &str,
        material: MaterialKind,
        solid: Solid,
    ) -> Result<(), SceneError> {
        let mut part = self.part(name, material, solid)?;
        self.place(&mut part, DAffine3::IDENTITY)
    }

    /// Number of components so far.
    pub fn components(&self) -> usize {
        self.scene.drawable_count()
    }

    /// Ends the construction.
    pub fn finish(self) -> Scene {
        self.scene
    }
}

/// A translation along the axis and outwards.
pub(super) fn shifted(x: f64, radius: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, radius, 0.0))
}
