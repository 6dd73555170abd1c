//! Takes what is hidden out of a camera's list, after Bevy has made it.

use std::any::TypeId;

use bevy::camera::visibility::VisibleEntities;
use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy::render::renderer::RenderDevice;

use crate::culler::Culler;
use crate::occludees::Kind;
use crate::settings::{AntumbraCulling, CullingReport, Strategy};

/// The cameras that cull, with what their images depend on.
type Cameras<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static AntumbraCulling,
        &'static Camera,
        &'static Projection,
        &'static GlobalTransform,
        &'static mut VisibleEntities,
        &'static mut CullingReport,
    ),
>;

/// Leaves out of each camera's meshes what its newest answers call hidden. The order of the list stays, as Bevy's render world relies on it; the lists of lights, for their shadows, are not touched.
pub(crate) fn cull(
    mut culler: ResMut<Culler>,
    device: Option<Res<RenderDevice>>,
    mut cameras: Cameras,
) {
    let start = Instant::now();
    // Lets answers arrive that the GPU has finished; never waits.
    if let Some(device) = device
        && let Err(error) = device.poll(wgpu::PollType::Poll)
    {
        warn_once!("antumbra: {error}");
    }
    let Culler {
        occludees,
        views,
        spent,
        ..
    } = &mut *culler;
    for (entity, settings, camera, projection, place, mut visible, mut report) in &mut cameras {
        let meshes = visible.get_mut(TypeId::of::<Mesh3d>());
        report.culled.clear();
        report.age = None;
        let view = views.get_mut(&entity);
        if let Some(view) = view
            && camera.is_active
            && settings.strategy == Strategy::FrameLate
        {
            let eye = place.translation();
            if !settings.frozen {
                view.collect(settings, occludees, &mut report);
                view.follow(settings, eye);
            }
            report.shift = view.shift(settings);
            report.age = view.age();
            let mut nearest = f32::INFINITY;
            if let Some(verdicts) = view.verdicts(settings, eye, near(projection)) {
                meshes.retain(|mesh| {
                    let Some(found) = occludees.find(Kind::Mesh, *mesh) else {
                        return true;
                    };
                    if verdicts.hides(&found) {
                        report.culled.push(*mesh);
                        return false;
                    }
                    nearest = nearest.min(found.now.distance(eye));
                    true
                });
            }
            if !settings.frozen {
                view.note_nearest(nearest);
            }
        }
        report.drawn = meshes.len() as u32;
    }
    spent.since(start);
}

/// The distance of the near plane; 0 where it is not one of a perspective.
pub(crate) fn near(projection: &Projection) -> f32 {
    match projection {
        Projection::Perspective(perspective) => perspective.near,
        _ => 0.0,
    }
}
