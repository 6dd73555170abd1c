//! In the render world: tests all boxes, once there is a depth to test against.

use bevy::ecs::entity::EntityHashMap;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy::render::mesh::RenderMesh;
use bevy::render::mesh::allocator::MeshAllocator;
use bevy::render::render_asset::RenderAssets;
use bevy::render::renderer::{PendingCommandBuffers, RenderContext, RenderDevice, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ViewDepthStencilTexture, ViewTarget};

use crate::audit::{Counter, Order};
use crate::culler::{Judging, SharedJudging};
use crate::meshes::{Meshes, Placed};

/// In the render world: what is to be tested in this frame.
#[derive(Resource, Default)]
pub(crate) struct Begun {
    /// Against the depths of cameras, by their entities in the main world.
    pub cameras: EntityHashMap<BegunView>,
    /// Against depths of tagged occluders.
    pub tagged: Vec<(BegunView, Tagged)>,
}

/// A view whose frame has begun.
pub(crate) struct BegunView {
    pub judging: SharedJudging,
    pub audit: Order,
}

/// Occluders that are to be drawn.
pub(crate) struct Tagged {
    pub occluders: Vec<Placed>,
    pub clip_from_world: Mat4,
    pub size: UVec2,
}

/// Bevy's meshes on the device.
#[derive(SystemParam)]
pub(crate) struct OnDevice<'w> {
    assets: Res<'w, RenderAssets<RenderMesh>>,
    allocator: Res<'w, MeshAllocator>,
}

impl OnDevice<'_> {
    fn meshes(&self) -> Meshes<'_> {
        Meshes {
            assets: &self.assets,
            allocator: &self.allocator,
        }
    }
}

/// Tests all boxes against what a camera's opaque pass has left in its depth.
pub(crate) fn test(
    view: ViewQuery<(&MainEntity, &ViewDepthStencilTexture), With<ViewTarget>>,
    begun: Res<Begun>,
    on_device: OnDevice,
    mut context: RenderContext,
) {
    let (camera, depth) = view.into_inner();
    if let Some(view) = begun.cameras.get(&camera.id()) {
        view.test(
            depth.texture(),
            on_device.meshes(),
            context.command_encoder(),
        );
    }
}

/// Tests all boxes against depths of tagged occluders, which it draws.
pub(crate) fn test_tagged(
    begun: Res<Begun>,
    on_device: OnDevice,
    device: Res<RenderDevice>,
    mut pending: ResMut<PendingCommandBuffers>,
) {
    if begun.tagged.is_empty() {
        return;
    }
    let mut encoder =
        device
            .wgpu_device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("antumbra: occluders"),
            });
    for (view, tagged) in &begun.tagged {
        let meshes = on_device.meshes();
        let depth = {
            let depth = &mut view.judging.lock().occluders;
            depth
                .draw(
                    &tagged.occluders,
                    tagged.clip_from_world,
                    tagged.size,
                    meshes,
                    &mut encoder,
                )
                .clone()
        };
        view.test(&depth, meshes, &mut encoder);
    }
    pending.push([encoder.finish()]);
}

impl BegunView {
    fn test(&self, depth: &wgpu::Texture, meshes: Meshes<'_>, encoder: &mut wgpu::CommandEncoder) {
        let Judging { judge, counter, .. } = &mut *self.judging.lock();
        if let Err(error) = judge.test(&[depth], encoder) {
            warn_once!("antumbra: {error}");
        }
        match &self.audit {
            Order::Nothing => {}
            Order::Copy(gpu) => counter
                .get_or_insert_with(|| Counter::new(gpu))
                .copy(depth, encoder),
            Order::Count(suspects, clip_from_world) => {
                if let Some(counter) = counter {
                    counter.count(suspects, *clip_from_world, meshes, encoder);
                }
            }
        }
    }
}
