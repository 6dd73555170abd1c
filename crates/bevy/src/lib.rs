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
mod camera;
mod casters;
mod cull;
mod culler;
pub mod diagnostics;
mod dial;
mod gizmos;
mod judging;
mod lights;
mod meshes;
mod occludees;
mod occluders;
mod roundness;
mod settings;
mod track;
mod view;

pub use casters::{ShadowCulling, ShadowReport};
pub use gizmos::CullingGizmos;
pub use occluders::Occluder;
pub use settings::{AntumbraCulling, Audit, Budget, CullingReport, Occluders, Strategy};

use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::VisibilitySystems;
use bevy::core_pipeline::Core3d;
use bevy::core_pipeline::core_3d::{main_opaque_pass_3d, main_transparent_pass_3d};
use bevy::light::SimulationLightSystems;
use bevy::prelude::*;
use bevy::render::{ExtractSchedule, Render, RenderApp, RenderSystems};
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
    /// Edits the lights' lists, after [`SimulationLightSystems::CheckLightVisibility`].
    CullCasters,
}

impl Plugin for AntumbraPlugin {
    fn build(&self, app: &mut App) {
        diagnostics::register(app);
        app.register_type::<AntumbraCulling>()
            .register_type::<CullingReport>()
            .register_type::<Occluder>()
            .register_type::<ShadowCulling>()
            .register_type::<ShadowReport>()
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
            .configure_sets(
                PostUpdate,
                AntumbraSystems::CullCasters
                    .after(AntumbraSystems::Cull)
                    .after(SimulationLightSystems::CheckLightVisibility)
                    .run_if(resource_exists::<culler::Culler>),
            )
            .add_systems(
                PostUpdate,
                (
                    (
                        culler::renew.run_if(culler::has_other_device),
                        track::track_meshes,
                        track::track_lights,
                    )
                        .chain()
                        .in_set(AntumbraSystems::Track),
                    (
                        judging::make_depth_readable,
                        (cull::cull, lights::cull_lights).chain(),
                    )
                        .in_set(AntumbraSystems::Cull),
                    (casters::cull_casters, diagnostics::measure)
                        .chain()
                        .in_set(AntumbraSystems::CullCasters),
                ),
            );
    }

    fn finish(&self, app: &mut App) {
        let Some(culler) = culler::Culler::of(app.world()) else {
            return;
        };
        app.insert_resource(culler);
        app.add_observer(culler::keep_tick);
        gizmos::add(app);
        let Some(render) = app.get_sub_app_mut(RenderApp) else {
            return;
        };
        render
            .init_resource::<judging::Begun>()
            .add_systems(ExtractSchedule, judging::begin)
            .add_systems(
                Render,
                judging::test_tagged.in_set(RenderSystems::PrepareBindGroups),
            )
            .add_systems(
                Core3d,
                judging::test
                    .after(main_opaque_pass_3d)
                    .before(bevy::pbr::main_transmissive_pass_3d)
                    .before(main_transparent_pass_3d),
            );
    }
}
