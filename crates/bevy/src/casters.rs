//! Leaves out of the shadow maps of point and spot lights what is hidden from the light, where lights ask for it.
//!
//! What is left out lies behind tagged occluders from where the light is, so that no texel of the shadow map depends on it. Answers are used only while the light and its occluders are where they were
//! tested: shadows are the same to the pixel.

use std::f32::consts::FRAC_PI_2;

use bevy::camera::primitives::{CUBE_MAP_FACES, CubeMapFace, CubemapFrusta};
use bevy::camera::visibility::{CubemapVisibleEntities, ViewVisibility, VisibleMeshEntities};
use bevy::light::{
    DirectionalLightShadowMap, PointLightShadowMap, spot_light_clip_from_view,
    spot_light_world_from_view,
};
use bevy::math::proj;
use bevy::platform::time::Instant;
use bevy::prelude::*;

use crate::culler::Culler;
use crate::dial::Margin;
use crate::meshes::Placed;
use crate::occludees::Kind;
use crate::occluders::{TaggedMeshes, fingerprint};
use crate::view::{Image2d, Pose, Request, View};

/// On a point or spot light with shadow maps: leave out of each what is hidden from the light behind meshes that are tagged with [`Occluder`](crate::Occluder).
#[derive(Component, Reflect, Debug, Clone, Copy, PartialEq, Eq, Default)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
#[require(ShadowReport)]
pub struct ShadowCulling;

/// On a light with [`ShadowCulling`]: what the last frame came to, summed over its shadow maps.
#[derive(Component, Reflect, Debug, Clone, Copy, PartialEq, Eq, Default)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct ShadowReport {
    /// Meshes that are drawn into them.
    pub drawn: u32,
    /// Meshes that are left out.
    pub culled: u32,
}

/// A shadow map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Face {
    pub light: Entity,
    /// Which of a point light's six; 0 for a spot light.
    pub number: u8,
}

/// A shadow map with a judge.
pub(crate) struct FaceView {
    pub view: View,
    /// Frames since it was tested.
    pub idle: u32,
}

/// A test of a shadow map.
pub(crate) struct FaceRequest {
    pub request: Request,
    pub image: Image2d,
    pub occluders: Vec<Placed>,
}

/// What is hidden must be so by a texel on all sides.
const MARGIN: Margin = Margin {
    sides: 1.0,
    ahead: 0.0,
};

type PointLights<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static PointLight,
        &'static GlobalTransform,
        &'static ViewVisibility,
        &'static mut CubemapVisibleEntities,
        &'static mut ShadowReport,
    ),
    (With<ShadowCulling>, With<CubemapFrusta>),
>;

type SpotLights<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static SpotLight,
        &'static GlobalTransform,
        &'static ViewVisibility,
        &'static mut VisibleMeshEntities,
        &'static mut ShadowReport,
    ),
    (With<ShadowCulling>, Without<PointLight>),
>;

/// Edits the lists of lights, after Bevy has made them.
pub(crate) fn cull_casters(
    mut culler: ResMut<Culler>,
    mut points: PointLights,
    mut spots: SpotLights,
    tagged: TaggedMeshes,
    point_map: Res<PointLightShadowMap>,
    spot_map: Res<DirectionalLightShadowMap>,
) {
    let start = Instant::now();
    culler.requests.clear();
    for (light, point, place, visibility, mut lists, mut report) in &mut points {
        report.set_if_neq(ShadowReport::default());
        if !point.shadow_maps_enabled || !visibility.get() {
            continue;
        }
        let eye = place.translation();
        let near = point.shadow_map_near_z;
        let clip_from_view = proj::perspective_infinite_reverse(FRAC_PI_2, 1.0, near);
        let faces = CUBE_MAP_FACES.iter().zip(lists.iter_mut()).zip(0u8..);
        for ((CubeMapFace { target, up }, list), number) in faces {
            let place = Transform::from_translation(eye).looking_to(*target, *up);
            let map = ShadowMap {
                face: Face { light, number },
                pose: Pose {
                    eye,
                    clip_from_world: clip_from_view * place.to_matrix().inverse(),
                    near,
                },
                size: point_map.size,
            };
            culler.cull_face(map, &mut list.entities, &tagged, &mut report);
        }
    }
    for (light, spot, place, visibility, mut list, mut report) in &mut spots {
        report.set_if_neq(ShadowReport::default());
        if !spot.shadow_maps_enabled || !visibility.get() {
            continue;
        }
        let near = spot.shadow_map_near_z;
        let view_from_world = spot_light_world_from_view(place).inverse();
        let clip_from_view = spot_light_clip_from_view(spot.outer_angle, near);
        let map = ShadowMap {
            face: Face { light, number: 0 },
            pose: Pose {
                eye: place.translation(),
                clip_from_world: clip_from_view * Mat4::from(view_from_world),
                near,
            },
            size: spot_map.size,
        };
        culler.cull_face(map, &mut list.entities, &tagged, &mut report);
    }
    culler.spent.since(start);
}

/// A shadow map of this frame.
struct ShadowMap {
    face: Face,
    pose: Pose,
    /// Texels a side.
    size: usize,
}

impl Culler {
    fn cull_face(
        &mut self,
        ShadowMap { face, pose, size }: ShadowMap,
        list: &mut Vec<Entity>,
        tagged: &TaggedMeshes,
        report: &mut ShadowReport,
    ) {
        let before = list.len();
        let placed = tagged.of(list.iter());
        let request = Request {
            pose,
            margin: MARGIN,
            way: Vec3::ZERO,
            is_moving: false,
            occluders: fingerprint(&placed) ^ self.occludees.changed_meshes,
        };
        if let Some(FaceView { view, .. }) = self.faces.get_mut(&face) {
            view.collect();
            if let Some(answers) = view.answers()
                && answers.of.request == request
            {
                let verdicts = answers.verdicts(pose);
                list.retain(|mesh| {
                    let found = self.occludees.find(Kind::Mesh, *mesh);
                    found.is_none_or(|found| !verdicts.hides(&found))
                });
            }
        }
        report.drawn += list.len() as u32;
        report.culled += (before - list.len()) as u32;
        if !placed.is_empty() {
            let request = FaceRequest {
                request,
                image: Image2d {
                    size: UVec2::splat(size as u32),
                    samples: 1,
                },
                occluders: placed,
            };
            self.requests.push((face, request));
        }
    }
}
