//! Materials for the shaded pass: one storage buffer for the scene.

use antumbra_scene::{AlphaMode, Material};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use crate::environment;

/// A material's shader data. Mirrors `Material` of `shared/material.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GpuMaterial {
    base_colour: [f32; 4],
    uv_u: [f32; 3],
    alpha_cutoff: f32,
    uv_v: [f32; 3],
    unlit: u32,
    metallic: f32,
    roughness: f32,
    environment_level: f32,
    environment_inset: f32,
    emission: [f32; 3],
    padding: f32,
}

/// A number from 0 to `most`; 0 for one that is no number.
fn within(most: f32, value: f32) -> f32 {
    match value.is_nan() {
        true => 0.0,
        false => value.clamp(0.0, most),
    }
}

impl From<&Material> for GpuMaterial {
    fn from(material: &Material) -> Self {
        let [uv_u, uv_v] = material.uv_transform;
        let alpha_cutoff = match material.alpha {
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => 0.0,
        };
        let roughness = within(1.0, material.roughness);
        let level = environment::level(roughness);
        Self {
            base_colour: material.base_colour,
            uv_u,
            alpha_cutoff,
            uv_v,
            unlit: u32::from(material.unlit),
            metallic: within(1.0, material.metallic),
            roughness,
            environment_level: level as f32,
            environment_inset: environment::inset(level),
            emission: material.emission.map(|light| within(f32::MAX, light)),
            padding: 0.0,
        }
    }
}

assert_layout!(GpuMaterial, "shaded", "Material", { base_colour, uv_u, alpha_cutoff, uv_v, unlit, metallic, roughness, environment_level, environment_inset, emission, padding });

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_finite_and_never_negative() {
        let material = Material {
            emission: [f32::INFINITY, f32::NAN, -1.0],
            metallic: f32::INFINITY,
            roughness: f32::NAN,
            ..Material::default()
        };
        let shown = GpuMaterial::from(&material);
        assert_eq!(shown.emission, [f32::MAX, 0.0, 0.0]);
        assert_eq!((shown.metallic, shown.roughness), (1.0, 0.0));
    }
}
