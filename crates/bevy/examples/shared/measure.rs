//! `--measure`: the same scene in several apps, one a way to cull, whose frames take turns. Prints the median of each.

use std::time::Duration;

use bevy::camera::RenderTarget;
use bevy::core_pipeline::prepass::DepthPrepass;
use bevy::prelude::*;
use bevy::render::occlusion_culling::OcclusionCulling;

use crate::arguments::{Arguments, Way};
use crate::headless::{self, FrameTime};
use crate::view::View;

/// Frames of each way that are not counted: pipelines are compiled, and meshes come onto the device.
const WARM_UP: usize = 4;

/// One way to cull, and its app.
struct Contender {
    way: Way,
    app: App,
    camera: Entity,
    times: Vec<FrameTime>,
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
        // Whoever comes first in a turn changes, so that nobody always has the warmer caches.
        let count = contenders.len();
        for turn in 0..count {
            let contender = &mut contenders[(turn + number) % count];
            let time = contender.frame(pose);
            if number >= WARM_UP {
                contender.times.push(time);
            }
        }
    }
    println!("{:28} {:>10} {:>10}", "way", "frame ms", "host ms");
    for contender in &contenders {
        let whole = median(contender.times.iter().map(|time| time.whole));
        let host = median(contender.times.iter().map(|time| time.host));
        println!("{:28} {whole:10.2} {host:10.2}", contender.way.name());
    }
}

impl Contender {
    fn new(way: Way, arguments: &Arguments, view: &View, spawn: &dyn Fn(&mut App)) -> Self {
        let mut app = headless::app();
        spawn(&mut app);
        let target = headless::target(&mut app, arguments.size);
        let camera = view.spawn(&mut app, RenderTarget::from(target));
        let mut entity = app.world_mut().entity_mut(camera);
        entity.insert(way.msaa());
        if way.is_bevys_own() {
            entity.insert((DepthPrepass, OcclusionCulling));
        }
        headless::finish(&mut app);
        Self {
            way,
            app,
            camera,
            times: Vec::new(),
        }
    }

    fn frame(&mut self, pose: Transform) -> FrameTime {
        self.app.world_mut().entity_mut(self.camera).insert(pose);
        headless::frame(&mut self.app)
    }
}

/// The median in milliseconds.
fn median(times: impl Iterator<Item = Duration>) -> f64 {
    let mut times: Vec<Duration> = times.collect();
    times.sort_unstable();
    let middle = times.get(times.len() / 2).copied();
    middle.unwrap_or_default().as_secs_f64() * 1e3
}
