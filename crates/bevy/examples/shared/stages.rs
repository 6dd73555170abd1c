//! What the CPU does in a frame besides drawing: the times of extraction, queueing and preparation.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy::render::{Render, RenderApp, RenderSystems};

/// Times of the last frame, which both worlds write.
#[derive(Resource, Clone, Default)]
pub struct Stages(Arc<Mutex<Clock>>);

/// What the stages of a frame took.
#[derive(Debug, Clone, Copy, Default)]
pub struct StageTimes {
    /// From the last system of the main world until what was extracted is in the render world.
    pub extraction: Duration,
    /// Until the phases of all views are specialised, queued and sorted.
    pub queueing: Duration,
    /// Until buffers and bind groups are written.
    pub preparation: Duration,
}

#[derive(Default)]
struct Clock {
    last: Option<Instant>,
    times: StageTimes,
}

impl Stages {
    /// Has the stages of an app timed.
    pub fn of(app: &mut App) -> Self {
        let stages = Self::default();
        app.insert_resource(stages.clone());
        app.add_systems(Last, |stages: Res<Stages>| stages.tick(|_, _| ()));
        if let Some(render) = app.get_sub_app_mut(RenderApp) {
            render.insert_resource(stages.clone()).add_systems(
                Render,
                (
                    (|stages: Res<Stages>| stages.tick(|times, passed| times.extraction = passed))
                        .after(RenderSystems::ExtractCommands)
                        .before(RenderSystems::CreateViews),
                    (|stages: Res<Stages>| stages.tick(|_, _| ()))
                        .after(RenderSystems::CreateViews)
                        .before(RenderSystems::Specialize),
                    (|stages: Res<Stages>| stages.tick(|times, passed| times.queueing = passed))
                        .after(RenderSystems::PhaseSort)
                        .before(RenderSystems::Prepare),
                    (|stages: Res<Stages>| stages.tick(|times, passed| times.preparation = passed))
                        .after(RenderSystems::Prepare)
                        .before(RenderSystems::Render),
                ),
            );
        }
        stages
    }

    /// The times of the last frame.
    pub fn times(&self) -> StageTimes {
        self.0.lock().map(|clock| clock.times).unwrap_or_default()
    }

    fn tick(&self, note: impl FnOnce(&mut StageTimes, Duration)) {
        let Ok(mut clock) = self.0.lock() else {
            return;
        };
        let passed = clock.last.map_or(Duration::ZERO, |last| last.elapsed());
        note(&mut clock.times, passed);
        clock.last = Some(Instant::now());
    }
}
