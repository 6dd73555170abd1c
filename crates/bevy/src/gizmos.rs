//! Shows what is culled: the boxes of what a camera has left out, and the volume that a frozen camera has seen. Off until its group is enabled, and then drawn over everything.

use bevy::prelude::*;

use crate::culler::Culler;
use crate::occludees::Kind;
use crate::settings::{AntumbraCulling, CullingReport};

/// The gizmos of this plug-in. To see them:
///
/// ```
/// # use antumbra_bevy::CullingGizmos;
/// # use bevy::prelude::*;
/// fn show(mut store: ResMut<GizmoConfigStore>) {
///     store.config_mut::<CullingGizmos>().0.enabled = true;
/// }
/// ```
#[derive(Reflect, GizmoConfigGroup, Debug, Clone, Copy)]
pub struct CullingGizmos {
    /// The boxes of meshes that are left out.
    pub culled: Color,
    /// The volume that a frozen camera saw.
    pub frozen: Color,
}

impl Default for CullingGizmos {
    fn default() -> Self {
        Self {
            culled: Color::srgb(0.2, 0.9, 0.3),
            frozen: Color::srgb(0.9, 0.8, 0.2),
        }
    }
}

/// Adds the group, where the app has gizmos.
pub(crate) fn add(app: &mut App) {
    if app.world().get_resource::<GizmoConfigStore>().is_none() {
        return;
    }
    app.init_gizmo_group::<CullingGizmos>();
    let mut store = app.world_mut().resource_mut::<GizmoConfigStore>();
    let config = store.config_mut::<CullingGizmos>().0;
    config.enabled = false;
    // What is culled lies behind something.
    config.depth_bias = -1.0;
    app.add_systems(PostUpdate, draw.after(crate::AntumbraSystems::Cull));
}

fn draw(
    culler: Res<Culler>,
    cameras: Query<(Entity, &AntumbraCulling, &CullingReport)>,
    store: Res<GizmoConfigStore>,
    mut gizmos: Gizmos<CullingGizmos>,
) {
    let (config, colours) = store.config::<CullingGizmos>();
    if !config.enabled {
        return;
    }
    for (camera, settings, report) in &cameras {
        for mesh in &report.culled {
            if let Some(found) = culler.occludees.find(Kind::Mesh, *mesh) {
                let [middle, half] = [found.bounds.centre(), found.bounds.half_extents()]
                    .map(|point| Vec3::from_array(point.as_vec3().to_array()));
                let place = Transform::from_translation(middle).with_scale(2.0 * half);
                gizmos.cube(place, colours.culled);
            }
        }
        if settings.frozen
            && let Some(asked) = culler
                .cameras
                .get(&camera)
                .and_then(|view| view.view.newest())
        {
            let matrix = asked.request.pose.clip_from_world;
            volume(&mut gizmos, matrix, colours.frozen);
        }
    }
}

/// The edges of what a matrix shows. The far plane of Bevy's perspective is infinitely far, so that its edges end before.
fn volume(gizmos: &mut Gizmos<CullingGizmos>, clip_from_world: Mat4, colour: Color) {
    let world_from_clip = clip_from_world.inverse();
    let corner = |x, y, z| world_from_clip.project_point3(Vec3::new(x, y, z));
    let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    for depth in [1.0, FAR_DEPTH] {
        gizmos.lineloop(around.map(|(x, y)| corner(x, y, depth)), colour);
    }
    for (x, y) in around {
        gizmos.line(corner(x, y, 1.0), corner(x, y, FAR_DEPTH), colour);
    }
}

/// A thousand times as far as the near plane of a perspective.
const FAR_DEPTH: f32 = 1e-3;
