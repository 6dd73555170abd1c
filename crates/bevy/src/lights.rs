//! Leaves out point and spot lights whose whole reach is hidden, with their shadow maps, where cameras ask for it.

use std::any::TypeId;

use bevy::camera::visibility::{ViewVisibility, VisibleEntities};
use bevy::ecs::entity::EntityHashSet;
use bevy::light::cluster::ClusterVisibilityClass;
use bevy::platform::time::Instant;
use bevy::prelude::*;

use crate::cull::pose_of;
use crate::culler::Culler;
use crate::occludees::Kind;
use crate::settings::{AntumbraCulling, CullingReport, Strategy};

type Cameras<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static Camera,
        &'static Projection,
        &'static GlobalTransform,
        &'static VisibleEntities,
        Option<(&'static AntumbraCulling, &'static mut CullingReport)>,
    ),
>;

/// A light is left out when each camera that has it in view asks for it, and finds its reach hidden: nothing that is seen is lit by it then. Bevy has marked it as visible in this frame,
/// which is taken back before lights are assigned and extracted. One that is a mesh as well stays.
pub(crate) fn cull_lights(
    mut culler: ResMut<Culler>,
    mut cameras: Cameras,
    mut lights: Query<
        &mut ViewVisibility,
        (Or<(With<PointLight>, With<SpotLight>)>, Without<Mesh3d>),
    >,
) {
    let asks =
        |settings: &AntumbraCulling| settings.lights && settings.strategy == Strategy::FrameLate;
    let start = Instant::now();
    let mut are_asked_for = false;
    for (.., ours) in &mut cameras {
        if let Some((settings, mut report)) = ours {
            report.lights = 0;
            are_asked_for |= asks(settings);
        }
    }
    if !are_asked_for {
        return;
    }
    let mut hidden = EntityHashSet::default();
    let mut seen = EntityHashSet::default();
    for (entity, camera, projection, place, visible, ours) in &mut cameras {
        if !camera.is_active {
            continue;
        }
        let in_view = visible.get(TypeId::of::<ClusterVisibilityClass>());
        let pose = pose_of(camera, projection, place);
        let verdicts = ours
            .as_ref()
            .filter(|(settings, _)| asks(settings))
            .and_then(|(settings, _)| culler.cameras.get(&entity)?.verdicts(settings, pose));
        let mut left_out = 0;
        for light in in_view {
            let found = culler.occludees.find(Kind::Light, *light);
            let is_hidden = lights.contains(*light)
                && verdicts
                    .as_ref()
                    .zip(found)
                    .is_some_and(|(verdicts, found)| verdicts.hides(&found));
            if is_hidden {
                left_out += 1;
                hidden.insert(*light);
            } else {
                seen.insert(*light);
            }
        }
        if let Some((_, mut report)) = ours {
            report.lights = left_out;
        }
    }
    for light in hidden.difference(&seen) {
        if let Ok(mut visibility) = lights.get_mut(*light) {
            *visibility = ViewVisibility::HIDDEN;
        }
    }
    culler.spent.since(start);
}
