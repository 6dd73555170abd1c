//! What the plug-in holds: everything that can be culled, and a judge a view.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use antumbra::cull::Gpu;
use antumbra::cull::judge::Judge;
use bevy::ecs::change_detection::{CheckChangeTicks, Tick};
use bevy::ecs::entity::EntityHashMap;
use bevy::platform::time::Instant;
use bevy::prelude::*;
use bevy::render::renderer::{RenderAdapter, RenderAdapterInfo, RenderDevice, RenderQueue};

use crate::audit::Counter;
use crate::camera::CameraView;
use crate::casters::{Face, FaceRequest, FaceView};
use crate::meshes::Placed;
use crate::occludees::Occludees;
use crate::occluders::{OccluderDepth, OccluderPipelines};

/// In the main world. The judges are shared with the render world, which tests while the next frame may be under way here.
#[derive(Resource)]
pub(crate) struct Culler {
    pub gpu: Gpu,
    pub occludees: Occludees,
    pub cameras: EntityHashMap<CameraView>,
    /// What hides from each camera in this frame, where tagged occluders alone do.
    pub occluders: EntityHashMap<Vec<Placed>>,
    pub faces: HashMap<Face, FaceView>,
    /// The faces of shadow maps that are to be tested in this frame.
    pub requests: Vec<(Face, FaceRequest)>,
    pub pipelines: OccluderPipelines,
    pub spent: Spent,
    /// Whether it has taken over the meshes and the lights that there are.
    pub has_meshes: bool,
    pub has_lights: bool,
    /// When Bevy got the device that this is on. Two devices of two instances of wgpu may be equal.
    device_since: Tick,
}

/// Time of the CPU since it was last asked for.
#[derive(Default)]
pub(crate) struct Spent(Duration);

impl Spent {
    pub fn since(&mut self, start: Instant) {
        self.0 += start.elapsed();
    }

    pub fn take(&mut self) -> Duration {
        std::mem::take(&mut self.0)
    }
}

/// What works on the GPU for one view, in both worlds.
pub(crate) struct Judging {
    pub judge: Judge,
    /// Of a view that has been audited.
    pub counter: Option<Counter>,
    pub occluders: OccluderDepth,
}

/// A view's judge, which both worlds hold.
#[derive(Clone)]
pub(crate) struct SharedJudging(Arc<Mutex<Judging>>);

impl Culler {
    /// On Bevy's device; `None` where it has none.
    pub fn of(world: &World) -> Option<Self> {
        let device = world.get_resource_ref::<RenderDevice>()?;
        let queue = world.get_resource::<RenderQueue>()?;
        let info = world.get_resource::<RenderAdapterInfo>()?;
        let adapter = world.get_resource::<RenderAdapter>()?;
        let gpu = Gpu::adopt(
            device.wgpu_device().clone(),
            wgpu::Queue::clone(queue),
            wgpu::AdapterInfo::clone(info),
            adapter.get_downlevel_capabilities(),
        );
        Some(Self {
            occludees: Occludees::new(&gpu),
            cameras: EntityHashMap::default(),
            occluders: EntityHashMap::default(),
            faces: HashMap::new(),
            requests: Vec::new(),
            pipelines: OccluderPipelines::default(),
            spent: Spent::default(),
            has_meshes: false,
            has_lights: false,
            device_since: device.last_changed(),
            gpu,
        })
    }

    /// Whether it is on this device of the main world.
    pub fn is_on(&self, device: &Ref<RenderDevice>) -> bool {
        self.device_since == device.last_changed()
    }
}

/// Bevy clamps the ticks that it knows of before they are too old to be compared. The same is done with ours, so that they stay equal.
pub(crate) fn keep_tick(check: On<CheckChangeTicks>, culler: Option<ResMut<Culler>>) {
    if let Some(mut culler) = culler {
        culler.device_since.check_tick(*check);
    }
}

/// Whether Bevy has recovered with another device.
pub(crate) fn has_other_device(culler: Res<Culler>, device: Option<Res<RenderDevice>>) -> bool {
    device.is_some_and(|device| !culler.is_on(&device.into()))
}

/// Begins anew on Bevy's device.
pub(crate) fn renew(world: &mut World) {
    if let Some(culler) = Culler::of(world) {
        world.insert_resource(culler);
    }
}

impl SharedJudging {
    pub fn new(judging: Judging) -> Self {
        Self(Arc::new(Mutex::new(judging)))
    }

    pub fn lock(&self) -> MutexGuard<'_, Judging> {
        // Nothing panics while it is held; a judge that was left in the middle of a frame starts anew with the next.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
