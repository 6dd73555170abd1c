//! `--measure`: the same scene in several apps, one a way to cull, whose frames take turns. Prints the median of each.

use std::any::TypeId;
use std::time::Duration;

use antumbra_bevy::{AntumbraPlugin, CullingReport};
use bevy::camera::RenderTarget;
use bevy::camera::visibility::VisibleEntities;
use bevy::core_pipeline::prepass::DepthPrepass;
use bevy::prelude::*;
use bevy::render::occlusion_culling::OcclusionCulling;

use crate::arguments::{Arguments, Way};
use crate::headless;
use crate::stages::{StageTimes, Stages};
use crate::view::View;

/// Frames of each way that are not counted: pipelines are compiled, and meshes come onto the device.
const WARM_UP: usize = 4;

/// One way to cull, and its app.
struct Contender {
    way: Way,
    app: App,
    camera: Entity,
    stages: Stages,
    times: Vec<Duration>,
    stage_times: Vec<StageTimes>,
    /// What is drawn after CPU culling, summed over the frames that count. Bevy's own occlusion culling draws fewer: it decides on the GPU.
    drawn: usize,
    /// Wrong pixels in percent, of frames that were audited.
    wrong: Vec<f32>,
    audits: u32,
}

/// Measures all ways that the arguments name, and prints a table.
pub fn measure(arguments: &Arguments, view: &View, spawn: &dyn Fn(&mut App)) {
    let ways = arguments.ways.iter();
    let mut contenders: Vec<Contender> = ways
        .map(|way| Contender::new(*way, arguments, view, spawn))
        .collect();
    if let Some(first) = contenders.first() {
        println!("{}", headless::device_name(&first.app));
    }
    for number in 0..WARM_UP + arguments.frames {
        let pose = view.pose(arguments.path_frame(number.saturating_sub(WARM_UP)));
        // The first of a turn changes, so that none always has the warmer caches.
        let count = contenders.len();
        for turn in 0..count {
            let contender = &mut contenders[(turn + number) % count];
            let time = contender.frame(pose);
            if number >= WARM_UP {
                contender.note(time);
            }
        }
    }
    println!(
        "way                  frame ms  extract ms  queue ms  prepare ms      drawn   wrong pixels, %"
    );
    for contender in &contenders {
        let frame = median(contender.times.iter().copied());
        let stages = contender.stage_times.iter();
        let extraction = median(stages.clone().map(|times| times.extraction));
        let queueing = median(stages.clone().map(|times| times.queueing));
        let preparation = median(stages.map(|times| times.preparation));
        let drawn = contender.drawn / contender.times.len().max(1);
        let wrong = match contender.wrong.len() {
            0 => String::new(),
            count => format!("{:.4}", contender.wrong.iter().sum::<f32>() / count as f32),
        };
        let name = contender.way.name();
        println!(
            "{name:18} {frame:10.2} {extraction:11.2} {queueing:9.2} {preparation:11.2} {drawn:10} {wrong:>17}"
        );
    }
}

impl Contender {
    fn new(way: Way, arguments: &Arguments, view: &View, spawn: &dyn Fn(&mut App)) -> Self {
        let mut app = headless::app();
        if way.is_ours() {
            app.add_plugins(AntumbraPlugin);
        }
        spawn(&mut app);
        let target = headless::target(&mut app, arguments.size);
        let camera = view.spawn(&mut app, RenderTarget::from(target));
        let mut entity = app.world_mut().entity_mut(camera);
        entity.insert(way.msaa());
        if way.has_prepass() {
            entity.insert(DepthPrepass);
        }
        if way.is_bevys_own() {
            entity.insert(OcclusionCulling);
        }
        if way.is_ours() {
            entity.insert(arguments.culling());
        }
        let stages = Stages::of(&mut app);
        headless::finish(&mut app);
        Self {
            way,
            app,
            camera,
            stages,
            times: Vec::new(),
            stage_times: Vec::new(),
            drawn: 0,
            wrong: Vec::new(),
            audits: 0,
        }
    }

    fn frame(&mut self, pose: Transform) -> Duration {
        self.app.world_mut().entity_mut(self.camera).insert(pose);
        headless::frame(&mut self.app)
    }

    /// Counts a frame.
    fn note(&mut self, time: Duration) {
        self.times.push(time);
        self.stage_times.push(self.stages.times());
        let visible = self.app.world().get::<VisibleEntities>(self.camera);
        self.drawn += visible.map_or(0, |visible| visible.len(TypeId::of::<Mesh3d>()));
        if let Some(report) = self.app.world().get::<CullingReport>(self.camera)
            && std::mem::replace(&mut self.audits, report.audits) != report.audits
        {
            self.wrong.extend(report.wrong);
        }
    }
}

/// The median in milliseconds.
fn median(times: impl Iterator<Item = Duration>) -> f64 {
    let mut times: Vec<Duration> = times.collect();
    times.sort_unstable();
    let middle = times.get(times.len() / 2).copied();
    middle.unwrap_or_default().as_secs_f64() * 1e3
}
