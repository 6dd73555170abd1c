//! Takes what is hidden out of a camera's list, after Bevy has made it.

use std::any::TypeId;

use bevy::camera::visibility::VisibleEntities;
use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy::render::renderer::RenderDevice;

use crate::culler::Culler;
use crate::occludees::Kind;
use crate::occluders::TaggedMeshes;
use crate::settings::{AntumbraCulling, CullingReport, Occluders, Strategy};
use crate::view::Pose;

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

/// Leaves out of each camera's meshes what its newest answers call hidden. The order of the list stays, as Bevy's render world relies on it.
pub(crate) fn cull(
    mut culler: ResMut<Culler>,
    device: Option<Res<RenderDevice>>,
    mut cameras: Cameras,
    tagged: TaggedMeshes,
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
        cameras: views,
        occluders,
        spent,
        ..
    } = &mut *culler;
    occluders.clear();
    for (entity, settings, camera, projection, place, mut visible, mut report) in &mut cameras {
        let meshes = visible.get_mut(TypeId::of::<Mesh3d>());
        report.culled.clear();
        report.age = None;
        report.shift = 0.0;
        if camera.is_active && settings.strategy == Strategy::FrameLate {
            if settings.occluders == Occluders::Tagged {
                occluders.insert(entity, tagged.of(meshes.iter()));
            }
            if let Some(view) = views.get_mut(&entity) {
                let pose = pose_of(camera, projection, place);
                if !settings.frozen {
                    view.collect(settings, occludees, &mut report);
                }
                view.follow(settings, pose.eye);
                report.age = view.view.age();
                let mut nearest = f32::INFINITY;
                if let Some(verdicts) = view.verdicts(settings, pose) {
                    report.shift = verdicts.margin().most();
                    meshes.retain(|mesh| {
                        let Some(found) = occludees.find(Kind::Mesh, *mesh) else {
                            return true;
                        };
                        if verdicts.hides(&found) {
                            report.culled.push(*mesh);
                            return false;
                        }
                        nearest = nearest.min(found.distance(pose.eye));
                        true
                    });
                }
                if !settings.frozen {
                    view.note_nearest(nearest);
                }
            }
        }
        report.drawn = meshes.len() as u32;
    }
    spent.since(start);
}

/// Where a camera is seen from.
pub(crate) fn pose_of(camera: &Camera, projection: &Projection, place: &GlobalTransform) -> Pose {
    Pose {
        eye: place.translation(),
        clip_from_world: camera.clip_from_view() * place.to_matrix().inverse(),
        near: match projection {
            Projection::Perspective(perspective) => perspective.near,
            _ => 0.0,
        },
    }
}
