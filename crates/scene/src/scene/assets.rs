//! The assets that entities share: meshes, materials and images; and the environment.

use super::Scene;
use crate::environment::Environment;
use crate::error::SceneError;
use crate::keys::{ImageKey, MaterialKey, MeshKey};
use crate::material::{Image, Material};
use crate::mesh::Mesh;
use slotmap::Key;

impl Scene {
    /// Adds a mesh.
    ///
    /// # Errors
    /// [`SceneError::BadMesh`]: no level, a position that is not finite, an index out of range, or attributes of
    /// another length than the positions.
    pub fn add_mesh(&mut self, mesh: Mesh) -> Result<MeshKey, SceneError> {
        mesh.validate()?;
        let bounds = mesh.bounds();
        let key = self.meshes.insert(mesh);
        if let Some(bounds) = bounds {
            self.mesh_bounds.insert(key, bounds);
        }
        Ok(key)
    }

    /// The mesh with this key.
    #[must_use]
    pub fn mesh(&self, mesh: MeshKey) -> Option<&Mesh> {
        self.meshes.get(mesh)
    }

    /// Every mesh, in arena order.
    pub fn meshes(&self) -> impl Iterator<Item = (MeshKey, &Mesh)> {
        self.meshes.iter()
    }

    /// The number of meshes, used or not.
    #[must_use]
    pub fn mesh_count(&self) -> usize {
        self.meshes.len()
    }

    /// Adds a material.
    pub fn add_material(&mut self, material: Material) -> MaterialKey {
        self.materials.insert(material)
    }

    /// The material with this key.
    #[must_use]
    pub fn material(&self, material: MaterialKey) -> Option<&Material> {
        self.materials.get(material)
    }

    /// Every material, in arena order.
    pub fn materials(&self) -> impl Iterator<Item = (MaterialKey, &Material)> {
        self.materials.iter()
    }

    /// Adds an image.
    ///
    /// # Errors
    /// [`SceneError::BadImage`] unless there are four bytes per pixel.
    pub fn add_image(&mut self, image: Image) -> Result<ImageKey, SceneError> {
        check(&image)?;
        Ok(self.images.insert(image))
    }

    /// Replaces an image for every material that uses it.
    ///
    /// # Errors
    /// As for [`Self::add_image`]; an unknown image.
    pub fn set_image(&mut self, key: ImageKey, image: Image) -> Result<(), SceneError> {
        check(&image)?;
        let Some(place) = self.images.get_mut(key) else {
            return Err(self.unknown_asset("image", &key, "a change of pixels".into()));
        };
        *place = image;
        self.changes.image_changed(key);
        Ok(())
    }

    /// The image with this key.
    #[must_use]
    pub fn image(&self, image: ImageKey) -> Option<&Image> {
        self.images.get(image)
    }

    /// Every image, in arena order.
    pub fn images(&self) -> impl Iterator<Item = (ImageKey, &Image)> {
        self.images.iter()
    }

    /// Sets or removes the environment.
    ///
    /// # Errors
    /// An unknown image; [`SceneError::BadEnvironment`] for an intensity that is below 0 or not finite.
    pub fn set_environment(&mut self, environment: Option<Environment>) -> Result<(), SceneError> {
        if let Some(Environment { image, intensity }) = environment {
            if !self.images.contains_key(image) {
                return Err(self.unknown_asset("image", &image, "the environment".into()));
            }
            if !(intensity.is_finite() && intensity >= 0.0) {
                return Err(SceneError::BadEnvironment {
                    scene: self.name.clone(),
                    intensity: intensity.to_string(),
                });
            }
        }
        if self.environment != environment {
            self.environment = environment;
            self.changes.environment_changed();
        }
        Ok(())
    }

    /// The environment.
    #[must_use]
    pub fn environment(&self) -> Option<Environment> {
        self.environment
    }

    pub(super) fn unknown_asset(
        &self,
        what: &'static str,
        key: &impl Key,
        entity: String,
    ) -> SceneError {
        SceneError::UnknownAsset {
            what,
            key: format!("{:?}", key.data()),
            entity,
            scene: self.name.clone(),
        }
    }
}

/// Refuses an image without four bytes per pixel.
fn check(image: &Image) -> Result<(), SceneError> {
    let expected = u64::from(image.width) * u64::from(image.height) * 4;
    if image.rgba.len() as u64 != expected {
        return Err(SceneError::BadImage {
            width: image.width,
            height: image.height,
            expected,
            actual: image.rgba.len(),
        });
    }
    Ok(())
}
