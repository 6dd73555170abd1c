//! What the plug-in holds: the boxes, and a judge a camera.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use antumbra::cull::Gpu;
use antumbra::cull::judge::Judge;
use bevy::ecs::entity::EntityHashMap;
use bevy::prelude::*;

use crate::occludees::Occludees;
use crate::view::View;

/// In the main world. The judges are shared with the render world, which tests while the next frame may be under way here.
#[derive(Resource)]
pub(crate) struct Culler {
    pub gpu: Gpu,
    pub occludees: Occludees,
    pub views: EntityHashMap<View>,
}

/// A judge for one camera, in both worlds.
#[derive(Clone)]
pub(crate) struct SharedJudge(Arc<Mutex<Judge>>);

impl Culler {
    pub fn new(gpu: Gpu) -> Self {
        Self {
            occludees: Occludees::new(&gpu),
            views: EntityHashMap::default(),
            gpu,
        }
    }
}

impl SharedJudge {
    pub fn new(judge: Judge) -> Self {
        Self(Arc::new(Mutex::new(judge)))
    }

    pub fn lock(&self) -> MutexGuard<'_, Judge> {
        // Nothing panics while it is held; a judge that was left in the middle of a frame starts anew with the next.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
