//! Brings the boxes onto the device while the worlds are in step, and tests them in the render world once a camera's opaque pass is done.

use antumbra::cull::judge::JudgeError;
use bevy::camera::MainPassResolutionOverride;
use bevy::ecs::entity::EntityHashMap;
use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy::render::MainWorld;
use bevy::render::mesh::RenderMesh;
use bevy::render::mesh::allocator::MeshAllocator;
use bevy::render::render_asset::RenderAssets;
use bevy::render::renderer::{PendingCommandBuffers, RenderContext, RenderDevice, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::ViewDepthStencilTexture;

use crate::audit::{Audited, Meshes, Order, Suspect};
use crate::culler::{Culler, Judging, SharedJudging};
use crate::settings::{AntumbraCulling, CullingReport, Strategy};
use crate::view::{Image2d, View};

/// In the render world: the cameras whose frames have begun, by their entities in the main world.
#[derive(Resource, Default)]
pub(crate) struct Begun(EntityHashMap<BegunView>);

struct BegunView {
    judging: SharedJudging,
    audit: Order,
}

type Camera3ds = (
    Entity,
    &'static AntumbraCulling,
    &'static Camera,
    &'static Msaa,
    &'static GlobalTransform,
    Has<MainPassResolutionOverride>,
    &'static mut CullingReport,
);

/// Begins a frame of each camera that culls: makes judges for new cameras, follows their sizes, and records what has changed.
pub(crate) fn begin(
    mut main: ResMut<MainWorld>,
    mut begun: ResMut<Begun>,
    device: Option<Res<RenderDevice>>,
    pending: Option<ResMut<PendingCommandBuffers>>,
) {
    begun.0.clear();
    let (Some(device), Some(mut pending)) = (device, pending) else {
        return;
    };
    let start = Instant::now();
    let mut cameras = main.query::<Camera3ds>();
    main.resource_scope(|main: &mut World, mut culler: Mut<Culler>| {
        let culler = &mut *culler;
        let mut encoder =
            device
                .wgpu_device()
                .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                    label: Some("antumbra: boxes"),
                });
        let mut live = Vec::new();
        let mut suspects = Vec::new();
        for (entity, settings, camera, msaa, place, is_scaled, mut report) in cameras.iter_mut(main)
        {
            if settings.strategy == Strategy::Off || !camera.is_active {
                continue;
            }
            let image = match image_of(camera, *msaa, is_scaled) {
                Ok(Some(image)) => image,
                Ok(None) => continue,
                Err(fault) => {
                    tell(&mut report, fault.to_owned());
                    continue;
                }
            };
            live.push(entity);
            if settings.frozen {
                continue;
            }
            let clip_from_world = camera.clip_from_view() * place.to_matrix().inverse();
            let judging = culler.begin(entity, image, settings, clip_from_world, &mut encoder);
            match judging {
                Ok(judging) => {
                    report.fault = None;
                    let mut audit = Order::Nothing;
                    if let Some(view) = culler.views.get_mut(&entity) {
                        if let Some(audited) = view.take_suspects() {
                            suspects.push((entity, audited));
                        } else if view.begin_audit(settings, &report.culled) {
                            audit = Order::Copy;
                        }
                    }
                    begun.0.insert(entity, BegunView { judging, audit });
                }
                Err(error) => {
                    culler.views.remove(&entity);
                    tell(&mut report, error.to_string());
                }
            }
        }
        for (entity, audited) in suspects {
            if let Some(view) = begun.0.get_mut(&entity) {
                view.audit = Order::Count(found(main, &audited), audited.clip_from_world);
            }
        }
        culler.views.retain(|entity, _| live.contains(entity));
        culler.occludees.epoch += 1;
        pending.push([encoder.finish()]);
        culler.spent.since(start);
    });
}

/// The meshes of what was culled, where it is now.
fn found(main: &World, audited: &Audited) -> Vec<Suspect> {
    let suspects = audited.culled.iter().filter_map(|entity| {
        Some(Suspect {
            mesh: main.get::<Mesh3d>(*entity)?.id(),
            place: main.get::<GlobalTransform>(*entity)?.affine(),
        })
    });
    suspects.collect()
}

/// The image that a camera draws; none while its target has no size.
fn image_of(camera: &Camera, msaa: Msaa, is_scaled: bool) -> Result<Option<Image2d>, &'static str> {
    let (Some(size), Some(part)) = (
        camera.physical_target_size(),
        camera.physical_viewport_rect(),
    ) else {
        return Ok(None);
    };
    if size.min_element() == 0 {
        return Ok(None);
    }
    if is_scaled || part.min != UVec2::ZERO || part.max != size {
        return Err("it draws into a part of its target; give it a target of its own");
    }
    Ok(Some(Image2d {
        size,
        samples: msaa.samples(),
    }))
}

/// Tells why a camera does not cull, once.
fn tell(report: &mut CullingReport, fault: String) {
    if report.fault.as_ref() != Some(&fault) {
        warn!("antumbra: this camera culls by its frustum alone: {fault}");
        report.fault = Some(fault);
    }
}

impl Culler {
    fn begin(
        &mut self,
        camera: Entity,
        image: Image2d,
        settings: &AntumbraCulling,
        clip_from_world: Mat4,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<SharedJudging, JudgeError> {
        let before = self.views.remove(&camera);
        let fits = before.filter(|view| view.image.samples == image.samples);
        let mut view = match fits {
            Some(view) => view,
            None => View::new(&self.gpu, image)?,
        };
        let eye = view.eye(settings, clip_from_world);
        let shared = view.judging.clone();
        let report = {
            let Judging { judge, .. } = &mut *shared.lock();
            if view.image.size != image.size {
                judge.resize(0, image.size.to_array())?;
                view.image = image;
            }
            judge.begin(&mut self.occludees.instances, &[eye], encoder)?
        };
        view.note_asked(report.frame, self.occludees.epoch);
        self.views.insert(camera, view);
        Ok(shared)
    }
}

/// Tests all boxes against what a camera's opaque pass has left in its depth.
pub(crate) fn test(
    view: ViewQuery<(&MainEntity, &ViewDepthStencilTexture)>,
    begun: Res<Begun>,
    assets: Res<RenderAssets<RenderMesh>>,
    allocator: Res<MeshAllocator>,
    mut context: RenderContext,
) {
    let (camera, depth) = view.into_inner();
    let Some(view) = begun.0.get(&camera.id()) else {
        return;
    };
    let Judging { judge, counter } = &mut *view.judging.lock();
    let encoder = context.command_encoder();
    if let Err(error) = judge.test(&[depth.texture()], encoder) {
        warn_once!("antumbra: {error}");
    }
    match &view.audit {
        Order::Nothing => {}
        Order::Copy => counter.copy(depth.texture(), encoder),
        Order::Count(suspects, clip_from_world) => {
            let meshes = Meshes {
                assets: &assets,
                allocator: &allocator,
            };
            counter.count(suspects, *clip_from_world, meshes, encoder);
        }
    }
}

/// Has the depth of cameras that cull made so that it can be read.
pub(crate) fn make_depth_readable(mut cameras: Query<&mut Camera3d, With<AntumbraCulling>>) {
    for mut camera in &mut cameras {
        let wanted = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let usages = wgpu::TextureUsages::from(camera.depth_texture_usages);
        if !usages.contains(wanted) {
            camera.depth_texture_usages = (usages | wanted).into();
        }
    }
}
