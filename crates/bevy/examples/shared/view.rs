//! The camera of an example, and the way that it goes.

use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::prelude::*;

/// A camera's way.
#[derive(Debug, Clone, Copy)]
pub struct View {
    pub way: Way,
    /// The field of view, degrees from the bottom to the top.
    pub degrees: f32,
}

/// Where it goes, a step a frame.
#[allow(dead_code, reason = "each example goes one of the ways")]
#[derive(Debug, Clone, Copy)]
pub enum Way {
    /// Around a centre, looking at it. Metres, and radians a frame.
    Orbit {
        distance: f32,
        height: f32,
        radians: f32,
    },
    /// Straight on, looking to either side by so many radians, and back to the start from the end.
    Walk {
        from: Vec3,
        to: Vec3,
        step: f32,
        sideways: f32,
    },
    /// On the spot, turning by so many radians a frame.
    Turn { radians: f32 },
}

impl View {
    /// Where the camera is in a frame.
    pub fn pose(&self, frame: usize) -> Transform {
        let frame = frame as f32;
        match self.way {
            Way::Orbit {
                distance,
                height,
                radians,
            } => {
                let (sin, cos) = (frame * radians).sin_cos();
                let eye = Vec3::new(distance * sin, height, distance * cos);
                Transform::from_translation(eye).looking_at(Vec3::ZERO, Vec3::Y)
            }
            Way::Walk {
                from,
                to,
                step,
                sideways,
            } => {
                let eye = from + (to - from).normalize() * (frame * step % from.distance(to));
                let turn = Quat::from_rotation_y(sideways * (frame * 0.05).sin());
                Transform::from_translation(eye).looking_to(turn * (to - from), Vec3::Y)
            }
            Way::Turn { radians } => {
                let (sin, cos) = (frame * radians).sin_cos();
                Transform::IDENTITY.looking_to(Vec3::new(sin, 0.2 * sin, cos), Vec3::Y)
            }
        }
    }

    /// Spawns the camera.
    pub fn spawn(&self, app: &mut App, target: RenderTarget) -> Entity {
        let projection = PerspectiveProjection {
            fov: self.degrees.to_radians(),
            ..default()
        };
        let camera = (
            Camera3d::default(),
            // Colours as they are: what is measured is drawing and culling.
            Tonemapping::None,
            DebandDither::Disabled,
            Projection::Perspective(projection),
            target,
            self.pose(0),
        );
        app.world_mut().spawn(camera).id()
    }
}
