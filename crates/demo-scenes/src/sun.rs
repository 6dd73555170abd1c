//! A directional light for simple scenes.

use antumbra_scene::{Light, Scene, SceneError};
use glam::{DAffine3, DQuat};

/// Adds a white directional light named "sun". It shines along -Z, rotated by `pitch` about X and then by `yaw` about
/// Y, in radians.
pub(super) fn add(scene: &mut Scene, yaw: f64, pitch: f64) -> Result<(), SceneError> {
    let slanting = DQuat::from_euler(glam::EulerRot::YXZ, yaw, pitch, 0.0);
    let sun = scene.spawn(None, DAffine3::from_quat(slanting))?;
    scene.set_entity_name(sun, "sun")?;
    let light = Light::Directional {
        colour: [1.0; 3],
        illuminance: 3.0,
    };
    scene.set_light(sun, light)?;
    Ok(())
}
