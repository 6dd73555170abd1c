//! What the plug-in holds: the boxes, and a judge a camera.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use antumbra::cull::Gpu;
use antumbra::cull::judge::Judge;
use bevy::ecs::entity::EntityHashMap;
use bevy::platform::time::Instant;
use bevy::prelude::*;

use crate::audit::Counter;
use crate::occludees::Occludees;
use crate::view::View;

/// In the main world. The judges are shared with the render world, which tests while the next frame may be under way here.
#[derive(Resource)]
pub(crate) struct Culler {
    pub gpu: Gpu,
    pub occludees: Occludees,
    pub views: EntityHashMap<View>,
    pub spent: Spent,
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

/// What works on the GPU for one camera, in both worlds.
pub(crate) struct Judging {
    pub judge: Judge,
    pub counter: Counter,
}

/// A camera's judge, which both worlds hold.
#[derive(Clone)]
pub(crate) struct SharedJudging(Arc<Mutex<Judging>>);

impl Culler {
    pub fn new(gpu: Gpu) -> Self {
        Self {
            occludees: Occludees::new(&gpu),
            views: EntityHashMap::default(),
            spent: Spent::default(),
            gpu,
        }
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
