//! Uploads a scene's materials and textures.

use std::sync::Arc;

use antumbra_scene::{ImageKey, MaterialKey, Scene};

use super::GpuScene;
use crate::arena::submit_portion;
use crate::error::DrawError;
use crate::material::GpuMaterial;
use crate::texture;

/// Bytes of images that are written before they are submitted.
const PORTION: u64 = 64 << 20;

impl GpuScene {
    /// The index of a material, uploaded if needed.
    pub(super) fn material(&mut self, scene: &Scene, key: MaterialKey) -> Result<u32, DrawError> {
        if let Some(number) = self.material_index.get(key) {
            return Ok(*number);
        }
        let material = scene.material(key).cloned().unwrap_or_default();
        let number = self
            .materials
            .append(&self.gpu, &[GpuMaterial::from(&material)])? as u32;
        self.material_index.insert(key, number);
        Ok(number)
    }

    /// The index of an image's bind group, uploaded if needed; 0 for an image that does not exist.
    pub(super) fn texture(&mut self, scene: &Scene, key: ImageKey) -> Result<u32, DrawError> {
        if let Some(number) = self.texture_index.get(key) {
            return Ok(*number);
        }
        let Some(image) = scene.image(key) else {
            return Ok(0);
        };
        let number = self.textures.len();
        let bound = texture::upload(&self.gpu, &self.texture_layout, image, number)?;
        self.unsubmitted += image.rgba.len() as u64;
        if self.unsubmitted >= PORTION {
            submit_portion(&self.gpu);
            self.unsubmitted = 0;
        }
        Arc::make_mut(&mut self.textures).push(bound);
        self.texture_index.insert(key, number as u32);
        Ok(number as u32)
    }

    /// Uploads images again that have changed.
    pub(super) fn repaint(&mut self, scene: &Scene, images: &[ImageKey]) -> Result<(), DrawError> {
        for key in images {
            let (Some(number), Some(image)) = (self.texture_index.get(*key), scene.image(*key))
            else {
                continue;
            };
            let number = *number as usize;
            let bound = texture::upload(&self.gpu, &self.texture_layout, image, number)?;
            if let Some(place) = Arc::make_mut(&mut self.textures).get_mut(number) {
                *place = bound;
            }
        }
        Ok(())
    }
}
