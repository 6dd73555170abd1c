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

impl From<&Material> for GpuMaterial {
    fn from(material: &Material) -> Self {
        let [uv_u, uv_v] = material.uv_transform;
        let alpha_cutoff = match material.alpha {
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => 0.0,
        };
        let part = |value: f32| match value.is_nan() {
            true => 0.0,
            false => value.clamp(0.0, 1.0),
        };
        let roughness = part(material.roughness);
        let level = environment::level(roughness);
        Self {
            base_colour: material.base_colour,
            uv_u,
            alpha_cutoff,
            uv_v,
            unlit: u32::from(material.unlit),
            metallic: part(material.metallic),
            roughness,
            environment_level: level as f32,
            environment_inset: environment::inset(level),
            emission: material.emission.map(|light| {
                if light.is_finite() {
                    light.max(0.0)
                } else {
                    0.0
                }
            }),
            padding: 0.0,
        }
    }
}

assert_layout!(GpuMaterial, "shaded", "Material", { base_colour, uv_u, alpha_cutoff, uv_v, unlit, metallic, roughness, environment_level, environment_inset, emission, padding });
