//! Follows meshes and lights as they are added, move, change and are removed.

use bevy::camera::primitives::{Aabb, Sphere};
use bevy::camera::visibility::{DynamicSkinnedMeshBounds, NoCpuCulling, NoFrustumCulling};
use bevy::ecs::query::QueryData;
use bevy::mesh::skinning::SkinnedMesh;
use bevy::platform::time::Instant;
use bevy::prelude::*;

use crate::culler::Culler;
use crate::occludees::{Kind, Occludees, Shape};
use crate::roundness::Roundness;

/// What says whether a mesh is tested, and where it is.
#[derive(QueryData)]
pub(crate) struct Mesh3dShape {
    entity: Entity,
    mesh: &'static Mesh3d,
    aabb: &'static Aabb,
    place: &'static GlobalTransform,
    is_skinned: Has<SkinnedMesh>,
    is_skin_bounded: Has<DynamicSkinnedMeshBounds>,
    /// Other materials may move vertices within the box.
    is_standard: Has<MeshMaterial3d<StandardMaterial>>,
}

impl Mesh3dShapeItem<'_, '_> {
    /// Whether the box holds all that is drawn. As in Bevy's own culling, it has to hold what morph targets make of a mesh.
    fn is_bounded(&self) -> bool {
        !self.is_skinned || self.is_skin_bounded
    }

    /// Has it tested as it is now, or not at all.
    fn put(&self, occludees: &mut Occludees, meshes: &Assets<Mesh>) {
        if !self.is_bounded() {
            return occludees.remove(Kind::Mesh, self.entity);
        }
        let roundness = match self.is_standard && !self.is_skinned {
            true => occludees.roundness.of(self.mesh.id(), meshes, self.aabb),
            false => Roundness::ANGULAR,
        };
        let shape = Shape::Mesh {
            aabb: *self.aabb,
            place: *self.place,
            roundness,
        };
        occludees.put(self.entity, shape);
    }
}

/// Meshes that Bevy culls by their boxes.
type Culled = (
    With<Mesh3d>,
    Without<NoFrustumCulling>,
    Without<NoCpuCulling>,
);

/// What may change whether, or where, a mesh is tested.
type MeshChanged = Or<(
    Changed<Aabb>,
    Changed<GlobalTransform>,
    // Bevy marks it when the asset has changed, too.
    Changed<Mesh3d>,
    Added<MeshMaterial3d<StandardMaterial>>,
    Added<SkinnedMesh>,
    Added<DynamicSkinnedMeshBounds>,
)>;

/// Takes over what has changed since the last frame.
pub(crate) fn track_meshes(
    mut culler: ResMut<Culler>,
    meshes: Res<Assets<Mesh>>,
    mut events: MessageReader<AssetEvent<Mesh>>,
    changed: Query<Mesh3dShape, (Culled, MeshChanged)>,
    all: Query<Mesh3dShape, Culled>,
    exempt: Query<
        Entity,
        (
            With<Mesh3d>,
            Or<(Added<NoFrustumCulling>, Added<NoCpuCulling>)>,
        ),
    >,
    mut gone: ParamSet<(
        RemovedComponents<Mesh3d>,
        RemovedComponents<Aabb>,
        RemovedComponents<NoFrustumCulling>,
        RemovedComponents<NoCpuCulling>,
        RemovedComponents<SkinnedMesh>,
        RemovedComponents<DynamicSkinnedMeshBounds>,
        RemovedComponents<MeshMaterial3d<StandardMaterial>>,
    )>,
) {
    let start = Instant::now();
    let Culler {
        occludees,
        spent,
        has_meshes,
        ..
    } = &mut *culler;
    let mut again: Vec<Entity> = exempt.iter().collect();
    again.extend(gone.p0().read());
    again.extend(gone.p1().read());
    again.extend(gone.p2().read());
    again.extend(gone.p3().read());
    again.extend(gone.p4().read());
    again.extend(gone.p5().read());
    again.extend(gone.p6().read());
    for event in events.read() {
        if let AssetEvent::Modified { id } | AssetEvent::Removed { id } = event {
            occludees.roundness.forget(*id);
            occludees.changed_meshes += 1;
        }
    }
    for entity in again {
        match all.get(entity) {
            Ok(mesh) => mesh.put(occludees, &meshes),
            Err(_) => occludees.remove(Kind::Mesh, entity),
        }
    }
    if !std::mem::replace(has_meshes, true) {
        for mesh in &all {
            mesh.put(occludees, &meshes);
        }
    }
    for mesh in &changed {
        mesh.put(occludees, &meshes);
    }
    occludees.settle();
    spent.since(start);
}

/// Lights with a reach.
type Lights = Or<(With<PointLight>, With<SpotLight>)>;

/// Takes over what has changed of lights since the last frame.
pub(crate) fn track_lights(
    mut culler: ResMut<Culler>,
    changed: Query<(Entity, &Sphere), (Lights, Changed<Sphere>)>,
    lights: Query<(Entity, &Sphere), Lights>,
    mut gone: ParamSet<(RemovedComponents<PointLight>, RemovedComponents<SpotLight>)>,
) {
    let start = Instant::now();
    let Culler {
        occludees,
        spent,
        has_lights,
        ..
    } = &mut *culler;
    let mut again: Vec<Entity> = gone.p0().read().collect();
    again.extend(gone.p1().read());
    for entity in again {
        if lights.get(entity).is_err() {
            occludees.remove(Kind::Light, entity);
        }
    }
    let mut put = |(entity, sphere): (Entity, &Sphere)| {
        let shape = Shape::Ball {
            centre: sphere.center.into(),
            radius: sphere.radius,
        };
        occludees.put(entity, shape);
    };
    if !std::mem::replace(has_lights, true) {
        lights.iter().for_each(&mut put);
    }
    changed.iter().for_each(put);
    spent.since(start);
}
