//! Brings the boxes onto the device while the worlds are in step, and says what the render world is to test.

mod render;

use antumbra::cull::judge::JudgeError;
use bevy::camera::MainPassResolutionOverride;
use bevy::ecs::query::QueryData;
use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy::render::MainWorld;
use bevy::render::camera::TemporalJitter;
use bevy::render::renderer::{PendingCommandBuffers, RenderDevice};

pub(crate) use render::{Begun, test, test_tagged};
use render::{BegunView, Tagged};

use crate::audit::{Audited, Order};
use crate::camera::CameraView;
use crate::casters::{FaceRequest, FaceView};
use crate::cull::pose_of;
use crate::culler::Culler;
use crate::meshes::Placed;
use crate::settings::{AntumbraCulling, CullingReport, Occluders, Strategy};
use crate::view::{Image2d, Pose, View};

/// What says how a camera is tested.
#[derive(QueryData)]
#[query_data(mutable)]
struct CameraShape {
    entity: Entity,
    settings: &'static AntumbraCulling,
    camera: &'static Camera,
    projection: &'static Projection,
    msaa: &'static Msaa,
    place: &'static GlobalTransform,
    is_scaled: Has<MainPassResolutionOverride>,
    is_jittered: Has<TemporalJitter>,
    report: &'static mut CullingReport,
}

/// Begins a frame of each view that is tested: makes judges for new ones, follows their sizes, and records what has changed.
pub(crate) fn begin(
    mut main: ResMut<MainWorld>,
    mut begun: ResMut<Begun>,
    device: Option<Res<RenderDevice>>,
    pending: Option<ResMut<PendingCommandBuffers>>,
) {
    begun.cameras.clear();
    begun.tagged.clear();
    let (Some(device), Some(mut pending)) = (device, pending) else {
        return;
    };
    let start = Instant::now();
    let mut cameras = main.query::<CameraShape>();
    main.resource_scope(|main: &mut World, mut culler: Mut<Culler>| {
        let culler = &mut *culler;
        let gpu = culler.gpu.clone();
        // Bevy recovers with another device; once it is there, everything begins anew on it.
        let of_main = main.get_resource_ref::<RenderDevice>();
        let is_same = of_main.is_some_and(|of_main| culler.is_on(&of_main));
        if !is_same || !is_alive(&device) {
            return;
        }
        let mut encoder =
            device
                .wgpu_device()
                .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                    label: Some("antumbra: boxes"),
                });
        let mut live = Vec::new();
        let mut suspects = Vec::new();
        for mut shape in cameras.iter_mut(main) {
            let (settings, report) = (shape.settings, &mut *shape.report);
            if settings.strategy == Strategy::Off || !shape.camera.is_active {
                report.fault = None;
                continue;
            }
            let image = match image_of(
                shape.camera,
                settings.occluders,
                *shape.msaa,
                shape.is_scaled,
            ) {
                Ok(Some(image)) => image,
                Ok(None) => continue,
                Err(fault) => {
                    tell(report, fault.to_owned());
                    continue;
                }
            };
            live.push(shape.entity);
            if settings.frozen {
                continue;
            }
            let pose = pose_of(shape.camera, shape.projection, shape.place);
            let asked = Asking {
                image,
                settings,
                pose,
                is_jittered: shape.is_jittered,
            };
            match culler.begin(shape.entity, asked, &mut encoder) {
                Ok(view) => {
                    report.fault = None;
                    let mut audit = Order::Nothing;
                    if let Some(audited) = view.take_suspects() {
                        suspects.push((shape.entity, audited));
                    } else if view.begin_audit(settings, &report.culled) {
                        audit = Order::Copy(gpu.clone());
                    }
                    let judging = view.view.judging.clone();
                    let test = BegunView { judging, audit };
                    begun.cameras.insert(shape.entity, test);
                }
                Err(error) => {
                    culler.cameras.remove(&shape.entity);
                    tell(report, error.to_string());
                }
            }
        }
        for (entity, audited) in suspects {
            if let Some(view) = begun.cameras.get_mut(&entity) {
                view.audit = Order::Count(found(main, &audited), audited.clip_from_world);
            }
        }
        culler.cameras.retain(|entity, _| live.contains(entity));
        culler.move_tagged(&mut begun);
        culler.begin_faces(&mut begun.tagged, &mut encoder);
        culler.occludees.epoch += 1;
        pending.push([encoder.finish()]);
        culler.spent.since(start);
    });
}

/// For so many frames a shadow map that is not tested, for its light or its occluders are out of view, keeps its judge and its answers.
const FRAMES_KEPT: u32 = 120;

/// Whether a device makes buffers. One that is lost says so to its owner alone, and what it makes cannot be written.
fn is_alive(device: &RenderDevice) -> bool {
    let probe = device.wgpu_device().create_buffer(&wgpu::BufferDescriptor {
        label: Some("antumbra: probe"),
        size: 16,
        usage: wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: true,
    });
    probe.get_mapped_range_mut(..).is_ok()
}

/// The meshes of what was culled, where it is now.
fn found(main: &World, audited: &Audited) -> Vec<Placed> {
    let suspects = audited.culled.iter().filter_map(|entity| {
        Some(Placed {
            mesh: main.get::<Mesh3d>(*entity)?.id(),
            place: main.get::<GlobalTransform>(*entity)?.affine(),
        })
    });
    suspects.collect()
}

/// The image that a camera is tested in; none while its target has no size.
fn image_of(
    camera: &Camera,
    occluders: Occluders,
    msaa: Msaa,
    is_scaled: bool,
) -> Result<Option<Image2d>, &'static str> {
    let (Some(size), Some(part)) = (
        camera.physical_target_size(),
        camera.physical_viewport_rect(),
    ) else {
        return Ok(None);
    };
    if size.min_element() == 0 || part.is_empty() {
        return Ok(None);
    }
    if occluders == Occluders::Tagged {
        if camera.invert_culling {
            return Err(
                "it draws the faces that occluders turn away (`Camera::invert_culling`); let it cull by its depth (`Occluders::Depth`)",
            );
        }
        return Ok(Some(Image2d {
            size: part.size(),
            samples: 1,
        }));
    }
    if is_scaled || part.min != UVec2::ZERO || part.max != size {
        return Err(
            "it draws into a part of its target; give it a target of its own, or tag occluders (`Occluders::Tagged`)",
        );
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

/// What a camera is tested with in a frame.
struct Asking<'a> {
    image: Image2d,
    settings: &'a AntumbraCulling,
    pose: Pose,
    is_jittered: bool,
}

impl Culler {
    fn begin(
        &mut self,
        camera: Entity,
        asked: Asking<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<&mut CameraView, JudgeError> {
        let Asking {
            image,
            settings,
            pose,
            is_jittered,
        } = asked;
        let before = self.cameras.remove(&camera);
        let fits = before.filter(|before| {
            before.view.image.samples == image.samples && before.occluders == settings.occluders
        });
        let mut view = match fits {
            Some(view) => view,
            None => CameraView::new(View::new(&self.gpu, image, &self.pipelines)?, settings),
        };
        let request = view.request(settings, pose, is_jittered);
        view.view
            .ask(request, image.size, &mut self.occludees, encoder)?;
        Ok(self.cameras.entry(camera).insert(view).into_mut())
    }

    /// Has cameras with tagged occluders tested against a depth of these.
    fn move_tagged(&mut self, begun: &mut Begun) {
        for (camera, view) in &self.cameras {
            if view.occluders != Occluders::Tagged {
                continue;
            }
            let (Some(asked), Some(test)) = (view.view.newest(), begun.cameras.remove(camera))
            else {
                continue;
            };
            let occluders = self.occluders.remove(camera).unwrap_or_default();
            let tagged = Tagged {
                occluders,
                clip_from_world: asked.request.pose.clip_from_world,
                size: view.view.image.size,
            };
            begun.tagged.push((test, tagged));
        }
    }

    /// Begins a frame of the shadow maps that are to be tested, and forgets those that have not been for some frames.
    fn begin_faces(
        &mut self,
        begun: &mut Vec<(BegunView, Tagged)>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        self.faces.retain(|_, face| {
            face.idle += 1;
            face.idle <= FRAMES_KEPT
        });
        for (face, request) in std::mem::take(&mut self.requests) {
            let FaceRequest {
                request,
                image,
                occluders,
            } = request;
            let view = self.faces.remove(&face).map_or_else(
                || View::new(&self.gpu, image, &self.pipelines),
                |before| Ok(before.view),
            );
            let asked = view.and_then(|mut view| {
                view.ask(request, image.size, &mut self.occludees, encoder)?;
                Ok(view)
            });
            match asked {
                Ok(view) => {
                    let test = BegunView {
                        judging: view.judging.clone(),
                        audit: Order::Nothing,
                    };
                    let tagged = Tagged {
                        occluders,
                        clip_from_world: request.pose.clip_from_world,
                        size: image.size,
                    };
                    begun.push((test, tagged));
                    self.faces.insert(face, FaceView { view, idle: 0 });
                }
                Err(error) => warn_once!("antumbra: a light keeps its casters: {error}"),
            }
        }
    }
}

/// Has the depth of cameras that cull by it made so that it can be read.
pub(crate) fn make_depth_readable(mut cameras: Query<(&mut Camera3d, &AntumbraCulling)>) {
    for (mut camera, settings) in &mut cameras {
        let wanted = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let usages = wgpu::TextureUsages::from(camera.depth_texture_usages);
        if settings.occluders == Occluders::Depth && !usages.contains(wanted) {
            camera.depth_texture_usages = (usages | wanted).into();
        }
    }
}
