//! The camera of an example: it circles the scene, and looks at its middle.

use bevy::camera::RenderTarget;
use bevy::prelude::*;

/// A circle around a centre.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// What the camera looks at, metres.
    pub centre: Vec3,
    /// The circle's radius in metres.
    pub distance: f32,
    /// The circle's height above the centre in metres.
    pub height: f32,
    /// The angle between two frames in radians.
    pub radians_per_frame: f32,
}

impl View {
    /// That of `antumbra compare grid`.
    pub const GRID: Self = Self {
        centre: Vec3::ZERO,
        distance: 40.0,
        height: 10.0,
        radians_per_frame: 0.02,
    };

    /// Where the camera is in a frame.
    pub fn pose(&self, frame: usize) -> Transform {
        let (sin, cos) = (frame as f32 * self.radians_per_frame).sin_cos();
        let away = Vec3::new(self.distance * sin, self.height, self.distance * cos);
        Transform::from_translation(self.centre + away).looking_at(self.centre, Vec3::Y)
    }

    /// Spawns the camera: 45 degrees high, nothing nearer than 0.1 m.
    pub fn spawn(&self, app: &mut App, target: RenderTarget) -> Entity {
        let projection = PerspectiveProjection {
            fov: std::f32::consts::FRAC_PI_4,
            ..default()
        };
        let camera = (
            Camera3d::default(),
            Projection::Perspective(projection),
            target,
            self.pose(0),
        );
        app.world_mut().spawn(camera).id()
    }
}
