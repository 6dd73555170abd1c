//! The components of an entity: mesh with material, light, camera, and its role in tests.

use super::Scene;
use super::drawable::Drawable;
use super::transforms::BOUNDS_DIRTY;
use crate::camera::Camera;
use crate::error::SceneError;
use crate::keys::{EntityKey, MeshKey};
use crate::light::Light;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use slotmap::Key;

/// A light of a scene and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLight {
    /// The entity that carries the light.
    pub entity: EntityKey,
    /// The light. It shines from the entity's origin, along the entity's -Z.
    pub light: Light,
    /// The transform from the entity's frame to the world.
    pub world: DAffine3,
}

impl Scene {
    /// Sets an entity's mesh and material.
    ///
    /// # Errors
    /// An unknown entity, mesh or material.
    pub fn set_drawable(
        &mut self,
        entity: EntityKey,
        drawable: Drawable,
    ) -> Result<(), SceneError> {
        let slot = self.known(entity)? as usize;
        if !self.meshes.contains_key(drawable.mesh) {
            return Err(self.unknown_asset("mesh", &drawable.mesh, self.describe(entity)));
        }
        if !self.materials.contains_key(drawable.material) {
            return Err(self.unknown_asset("material", &drawable.material, self.describe(entity)));
        }
        if let Some(before) = self.drawables.insert(entity, drawable) {
            self.deforming.unused(before.mesh, entity);
        }
        self.changes.touched(entity);
        self.deforming.used(drawable.mesh, entity);
        if self.transforms.mesh[slot] != drawable.mesh {
            self.transforms.mesh[slot] = drawable.mesh;
            self.mark_dirty(entity, BOUNDS_DIRTY);
        }
        Ok(())
    }

    /// Removes an entity's mesh and material, and returns them.
    pub fn clear_drawable(&mut self, entity: EntityKey) -> Option<Drawable> {
        let had = self.drawables.remove(entity)?;
        self.deforming.unused(had.mesh, entity);
        let slot = self.tree.get(entity)?.slot as usize;
        self.changes.touched(entity);
        self.transforms.mesh[slot] = MeshKey::null();
        self.mark_dirty(entity, BOUNDS_DIRTY);
        Some(had)
    }

    /// Sets whether a visibility test may cull an entity. The default is true. An entity that is not tested is drawn
    /// wherever it touches the frustum, and occludes like any other.
    ///
    /// # Errors
    /// An unknown entity.
    pub fn set_tested(&mut self, entity: EntityKey, tested: bool) -> Result<(), SceneError> {
        self.known(entity)?;
        if tested {
            self.untested.remove(entity);
        } else {
            self.untested.insert(entity, ());
        }
        self.changes.touched(entity);
        Ok(())
    }

    /// Whether a visibility test may cull the entity.
    #[must_use]
    pub fn is_tested(&self, entity: EntityKey) -> bool {
        !self.untested.contains_key(entity)
    }

    /// The entity's mesh and material, if it is drawable.
    #[must_use]
    pub fn drawable(&self, entity: EntityKey) -> Option<Drawable> {
        self.drawables.get(entity).copied()
    }

    /// Every drawable entity, in arena order.
    pub fn drawables(&self) -> impl Iterator<Item = (EntityKey, Drawable)> + '_ {
        self.drawables
            .iter()
            .map(|(entity, drawable)| (entity, *drawable))
    }

    /// The number of drawable entities.
    #[must_use]
    pub fn drawable_count(&self) -> usize {
        self.drawables.len()
    }

    /// The number of triangles of all drawables' full geometry. A shared mesh counts once per entity.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        let meshes = self
            .drawables
            .values()
            .filter_map(|d| self.meshes.get(d.mesh));
        meshes.map(|mesh| mesh.triangle_count() as u64).sum()
    }

    /// Sets an entity's light. It shines along the entity's -Z.
    ///
    /// # Errors
    /// An unknown entity; a light with a number that is negative or not finite.
    pub fn set_light(&mut self, entity: EntityKey, light: Light) -> Result<(), SceneError> {
        self.known(entity)?;
        if let Some(problem) = light.problem() {
            let entity = self.describe(entity);
            return Err(SceneError::BadLight { entity, problem });
        }
        self.lights.insert(entity, light);
        Ok(())
    }

    /// Removes an entity's light, and returns it.
    pub fn clear_light(&mut self, entity: EntityKey) -> Option<Light> {
        self.lights.remove(entity)
    }

    /// Every light with its entity's world transform, in arena order.
    pub fn lights(&self) -> impl Iterator<Item = PlacedLight> + '_ {
        let mut lights: Vec<_> = self.lights.iter().collect();
        lights.sort_unstable_by_key(|(entity, _)| *entity);
        (lights.into_iter()).filter_map(|(entity, light)| {
            Some(PlacedLight {
                entity,
                light: *light,
                world: self.world(entity)?,
            })
        })
    }

    /// Sets an entity's camera. Its pose is relative to the entity.
    ///
    /// # Errors
    /// An unknown entity; as for [`Camera::validate`].
    pub fn set_camera(&mut self, entity: EntityKey, camera: Camera) -> Result<(), SceneError> {
        self.known(entity)?;
        if let Err(source) = camera.validate() {
            let entity = self.describe(entity);
            return Err(SceneError::BadCamera { entity, source });
        }
        self.cameras.insert(entity, camera);
        Ok(())
    }

    /// Removes an entity's camera, and returns it.
    pub fn clear_camera(&mut self, entity: EntityKey) -> Option<Camera> {
        self.cameras.remove(entity)
    }

    /// The entity's camera; its pose is relative to the entity.
    #[must_use]
    pub fn camera(&self, entity: EntityKey) -> Option<Camera> {
        self.cameras.get(entity).copied()
    }

    /// Every camera with its pose in the world, in arena order. Scales of the entity and its ancestors move the
    /// camera, but do not scale what it sees.
    pub fn cameras(&self) -> impl Iterator<Item = (EntityKey, Camera)> + '_ {
        let mut cameras: Vec<_> = self.cameras.iter().collect();
        cameras.sort_unstable_by_key(|(entity, _)| *entity);
        cameras.into_iter().filter_map(|(entity, camera)| {
            let world = self.world(entity)?;
            let turned = unscaled_rotation(&world) * camera.rotation;
            let camera = Camera {
                position: world.transform_point3(camera.position),
                rotation: turned.normalize(),
                ..*camera
            };
            camera.validate().is_ok().then_some((entity, camera))
        })
    }
}

/// The rotation of a transform whose axes may be scaled, sheared or flat.
fn unscaled_rotation(world: &DAffine3) -> DQuat {
    let z = world.matrix3.z_axis.normalize_or(DVec3::Z);
    let y = world.matrix3.y_axis;
    let x = y
        .cross(z)
        .try_normalize()
        .unwrap_or_else(|| z.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z))
}
