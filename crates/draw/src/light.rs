//! The scene's lights as the shaded pass reads them, relative to the eye.
//!
//! Photometric strengths are brought to a common exposure: the strongest directional light becomes 1, and a positional
//! light is given its full strength at the distance of the scene's radius, so that scenes in any unit are lit alike.

use antumbra_scene::{Light, Scene};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3};

/// How many lights the shaded pass knows; further ones are left out (the strongest come first).
pub const LIGHTS_MOST: usize = 8;

/// A light in world space with f64 position.
#[derive(Debug, Clone, Copy)]
struct Placed {
    light: GpuLight,
    position: DVec3,
}

/// The lights of a scene, ready to be placed around any eye.
#[derive(Debug, Clone, Default)]
pub struct SceneLights {
    placed: Vec<Placed>,
    /// The environment's strength.
    around: Option<f32>,
}

/// Mirrors `Light` of `shared/light.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
struct GpuLight {
    colour: [f32; 3],
    kind: u32,
    direction: [f32; 3],
    range: f32,
    position: [f32; 3],
    cos_outer: f32,
    cos_inner: f32,
    reference_distance: f32,
    padding: [f32; 2],
}

/// Mirrors `Lights` of `shared/light.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GpuLights {
    ambient: [f32; 3],
    count: u32,
    lights: [GpuLight; LIGHTS_MOST],
}

assert_layout!(GpuLight, "shaded", "Light", { colour, kind, direction, range, position, cos_outer, cos_inner, reference_distance, padding });
assert_layout!(GpuLights, "shaded", "Lights", { ambient, count, lights });

const DIRECTIONAL: u32 = 0;
const POINT: u32 = 1;
const SPOT: u32 = 2;

impl SceneLights {
    /// Gathers a scene's lights; a scene without any is lit from above the viewer's left shoulder.
    pub fn gather(scene: &Scene) -> Self {
        let radius = scene
            .bounds()
            .map_or(1.0, |b| b.half_extents().length())
            .max(f64::MIN_POSITIVE) as f32;
        let found: Vec<(Light, DAffine3)> = scene
            .lights()
            .map(|placed| (placed.light, placed.world))
            .collect();
        let peak = |directional: bool| {
            found
                .iter()
                .map(|(light, _)| strength(light))
                .filter(|(_, kind)| (*kind == DIRECTIONAL) == directional)
                .map(|(value, _)| value)
                .fold(f32::MIN_POSITIVE, f32::max)
        };
        let (sun, lamp) = (peak(true), peak(false));
        let mut placed: Vec<Placed> = found
            .iter()
            .map(|(light, world)| place(light, world, radius, sun, lamp))
            .collect();
        // Stable, so that equal lights keep the scene's order.
        placed.sort_by(|a, b| {
            b.light
                .colour
                .iter()
                .sum::<f32>()
                .total_cmp(&a.light.colour.iter().sum())
        });
        placed.truncate(LIGHTS_MOST);
        let around = scene.environment().map(|around| around.intensity);
        Self { placed, around }
    }

    /// Whether any of them has a place.
    pub fn any_positional(&self) -> bool {
        self.placed
            .iter()
            .any(|placed| placed.light.kind != DIRECTIONAL)
    }

    /// The lights around an eye; `right` and `up` are the camera's, for the light of scenes that have none.
    pub fn around(&self, eye: DVec3, forward: DVec3, right: DVec3, up: DVec3) -> GpuLights {
        let mut lights = GpuLights {
            ambient: [self.around.unwrap_or(0.18); 3],
            count: self.placed.len() as u32,
            lights: Default::default(),
        };
        for (out, placed) in lights.lights.iter_mut().zip(&self.placed) {
            *out = placed.light;
            out.position = (placed.position - eye).as_vec3().to_array();
        }
        if self.placed.is_empty() {
            let direction = (forward + right * 0.4 - up * 0.6).normalize_or(DVec3::NEG_Z);
            lights.count = 1;
            lights.lights[0] = GpuLight {
                colour: [0.9; 3],
                direction: direction.as_vec3().to_array(),
                ..Default::default()
            };
        }
        lights
    }
}

fn strength(light: &Light) -> (f32, u32) {
    match light {
        Light::Directional { illuminance, .. } => (*illuminance, DIRECTIONAL),
        Light::Point { intensity, .. } => (*intensity, POINT),
        Light::Spot { intensity, .. } => (*intensity, SPOT),
    }
}

fn place(light: &Light, world: &DAffine3, radius: f32, sun: f32, lamp: f32) -> Placed {
    let (value, kind) = strength(light);
    let scale = value / if kind == DIRECTIONAL { sun } else { lamp };
    let (colour, range) = match light {
        Light::Directional { colour, .. } => (*colour, 0.0),
        Light::Point { colour, range, .. } | Light::Spot { colour, range, .. } => {
            (*colour, range.unwrap_or(0.0))
        }
    };
    let (inner, outer) = match light {
        Light::Spot { inner, outer, .. } => (*inner, *outer),
        _ => (0.0, 0.0),
    };
    let direction = world
        .transform_vector3(DVec3::NEG_Z)
        .normalize_or(DVec3::NEG_Z);
    let light = GpuLight {
        colour: colour.map(|c| c * scale * 0.9),
        kind,
        direction: direction.as_vec3().to_array(),
        range,
        position: [0.0; 3],
        cos_outer: outer.cos(),
        // smoothstep needs its edges apart.
        cos_inner: inner.cos().max(outer.cos() + 1e-4),
        reference_distance: radius,
        padding: [0.0; 2],
    };
    Placed {
        light,
        position: world.translation,
    }
}
