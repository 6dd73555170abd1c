//! The scene's lights for the shaded pass, relative to the eye.
//!
//! Photometric intensities are normalised to a common exposure: the strongest directional light becomes 1, and a positional light has its
//! full intensity at the distance of the scene's radius. Scenes in any unit are therefore lit alike.

use antumbra_scene::{Light, Scene};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3};

use antumbra_cull::ViewAxes;

/// The most lights that the shaded pass uses. Of more lights, the strongest are taken.
pub const MAX_LIGHTS: usize = 8;

/// A light with its world position in f64.
#[derive(Debug, Clone, Copy)]
struct Placed {
    light: GpuLight,
    position: DVec3,
}

/// The lights of a scene.
#[derive(Debug, Clone, Default)]
pub struct SceneLights {
    placed: Vec<Placed>,
    /// The environment's intensity.
    environment: Option<f32>,
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
    lights: [GpuLight; MAX_LIGHTS],
}

assert_layout!(GpuLight, "shaded", "Light", { colour, kind, direction, range, position, cos_outer, cos_inner, reference_distance, padding });
assert_layout!(GpuLights, "shaded", "Lights", { ambient, count, lights });

const DIRECTIONAL: u32 = 0;
const POINT: u32 = 1;
const SPOT: u32 = 2;

impl SceneLights {
    /// Gathers a scene's lights. A scene without lights is lit from behind the upper left of the eye.
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
                .map(|(light, _)| Strength::of(light))
                .filter(|strength| (strength.kind == DIRECTIONAL) == directional)
                .map(|strength| strength.value)
                .fold(f32::MIN_POSITIVE, f32::max)
        };
        let exposure = Exposure {
            directional: peak(true),
            positional: peak(false),
            radius,
        };
        let mut placed: Vec<Placed> = found
            .iter()
            .map(|(light, world)| place(light, world, exposure))
            .collect();
        // Stable, so that equal lights keep the scene's order.
        placed.sort_by(|a, b| {
            b.light
                .colour
                .iter()
                .sum::<f32>()
                .total_cmp(&a.light.colour.iter().sum())
        });
        placed.truncate(MAX_LIGHTS);
        let environment = scene.environment().map(|environment| environment.intensity);
        Self {
            placed,
            environment,
        }
    }

    /// Whether any of them is a point or a spot light.
    pub fn any_positional(&self) -> bool {
        self.placed
            .iter()
            .any(|placed| placed.light.kind != DIRECTIONAL)
    }

    /// The lights relative to an eye. `axes` is the camera's, for the light of scenes that have none.
    pub fn relative_to(&self, eye: DVec3, axes: ViewAxes) -> GpuLights {
        let mut lights = GpuLights {
            ambient: [self.environment.unwrap_or(0.18); 3],
            count: self.placed.len() as u32,
            lights: Default::default(),
        };
        for (out, placed) in lights.lights.iter_mut().zip(&self.placed) {
            *out = placed.light;
            out.position = (placed.position - eye).as_vec3().to_array();
        }
        if self.placed.is_empty() {
            let direction =
                (axes.forward + axes.right * 0.4 - axes.up * 0.6).normalize_or(DVec3::NEG_Z);
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

/// A light's strength in the unit of its kind: lux or candela.
struct Strength {
    value: f32,
    kind: u32,
}

impl Strength {
    fn of(light: &Light) -> Self {
        let (value, kind) = match light {
            Light::Directional { illuminance, .. } => (*illuminance, DIRECTIONAL),
            Light::Point { intensity, .. } => (*intensity, POINT),
            Light::Spot { intensity, .. } => (*intensity, SPOT),
        };
        Self { value, kind }
    }
}

/// What lights are normalised by.
#[derive(Debug, Clone, Copy)]
struct Exposure {
    /// The strongest directional light.
    directional: f32,
    /// The strongest positional light.
    positional: f32,
    /// The scene's radius in metres.
    radius: f32,
}

fn place(light: &Light, world: &DAffine3, exposure: Exposure) -> Placed {
    let Strength { value, kind } = Strength::of(light);
    let scale = value
        / match kind {
            DIRECTIONAL => exposure.directional,
            _ => exposure.positional,
        };
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
        // smoothstep needs different edges.
        cos_inner: inner.cos().max(outer.cos() + 1e-4),
        reference_distance: exposure.radius,
        padding: [0.0; 2],
    };
    Placed {
        light,
        position: world.translation,
    }
}
