//! Antumbra's occlusion culling as a Bevy plug-in: leaves out of a camera's list of meshes what is hidden behind others.
//!
//! ```no_run
//! use antumbra_bevy::{AntumbraCulling, AntumbraPlugin};
//! use bevy::prelude::*;
//!
//! App::new()
//!     .add_plugins((DefaultPlugins, AntumbraPlugin))
//!     .add_systems(Startup, |mut commands: Commands| {
//!         commands.spawn((Camera3d::default(), AntumbraCulling::default()));
//!     })
//!     .run();
//! ```
//!
//! In each frame all boxes are tested on the GPU against the depth of the camera's opaque pass, and the answers are read back without waiting. In a later frame, what was hidden is taken out of
//! [`VisibleEntities`](bevy::camera::visibility::VisibleEntities) after Bevy has filled it, so that it is neither queued nor drawn. A mesh that is new, has moved out of what was tested, or has another
//! box is drawn; so is what was outside of the view. Shadows do not change.

mod audit;
mod cull;
mod culler;
pub mod diagnostics;
mod gizmos;
mod judging;
mod lights;
mod occludees;
mod roundness;
mod settings;
mod track;
mod view;

pub use gizmos::CullingGizmos;
pub use settings::{AntumbraCulling, Audit, Budget, CullingReport, Strategy};

use antumbra::cull::Gpu;
use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::VisibilitySystems;
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::core_3d::{main_opaque_pass_3d, main_transparent_pass_3d};
use bevy::light::SimulationLightSystems;
use bevy::prelude::*;
use bevy::render::renderer::{RenderAdapter, RenderAdapterInfo, RenderDevice, RenderQueue};
use bevy::render::{ExtractSchedule, RenderApp};
use bevy::transform::TransformSystems;

/// Adds culling to an app, for cameras that have [`AntumbraCulling`].
#[derive(Debug, Clone, Copy, Default)]
pub struct AntumbraPlugin;

/// The systems of this plug-in in [`PostUpdate`], after [`VisibilitySystems::CheckVisibility`].
#[derive(SystemSet, Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AntumbraSystems {
    /// Follows meshes and lights.
    Track,
    /// Edits the cameras' lists.
    Cull,
}

impl Plugin for AntumbraPlugin {
    fn build(&self, app: &mut App) {
        diagnostics::register(app);
        app.register_type::<AntumbraCulling>()
            .register_type::<CullingReport>()
            .configure_sets(
                PostUpdate,
                (AntumbraSystems::Track, AntumbraSystems::Cull)
                    .chain()
                    .after(VisibilitySystems::CheckVisibility)
                    .after(TransformSystems::Propagate)
                    .after(AssetEventSystems)
                    .before(SimulationLightSystems::AssignLightsToClusters)
                    .before(SimulationLightSystems::CheckLightVisibility)
                    .run_if(resource_exists::<culler::Culler>),
            )
            .add_systems(
                PostUpdate,
                (
                    (track::track_meshes, track::track_lights).in_set(AntumbraSystems::Track),
                    (
                        judging::make_depth_readable,
                        (cull::cull, lights::cull_lights, diagnostics::measure).chain(),
                    )
                        .in_set(AntumbraSystems::Cull),
                ),
            );
    }

    fn finish(&self, app: &mut App) {
        let world = app.world();
        let (Some(device), Some(queue), Some(info), Some(adapter)) = (
            world.get_resource::<RenderDevice>(),
            world.get_resource::<RenderQueue>(),
            world.get_resource::<RenderAdapterInfo>(),
            world.get_resource::<RenderAdapter>(),
        ) else {
            return;
        };
        let gpu = Gpu::adopt(
            device.wgpu_device().clone(),
            wgpu::Queue::clone(queue),
            wgpu::AdapterInfo::clone(info),
            adapter.get_downlevel_capabilities(),
        );
        app.insert_resource(culler::Culler::new(gpu));
        gizmos::add(app);
        let Some(render) = app.get_sub_app_mut(RenderApp) else {
            return;
        };
        render
            .init_resource::<judging::Begun>()
            .add_systems(ExtractSchedule, judging::begin)
            .add_systems(
                Core3d,
                judging::test
                    .after(main_opaque_pass_3d)
                    .before(bevy::pbr::main_transmissive_pass_3d)
                    .before(main_transparent_pass_3d),
            );
    }
}
