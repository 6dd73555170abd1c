//! The seismic volume of the built-in model: reflections lie at the horizons.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_demo_scenes::subsurface::{Model, ModelOptions, ModelVolume};
use antumbra_subsurface::BrickSource;
use glam::DVec2;

fn model(nodes_per_side: u32) -> Model {
    let options = ModelOptions {
        nodes_per_side,
        ..ModelOptions::default()
    };
    Model::new(&options).unwrap()
}

/// All samples of a column.
fn trace(volume: &ModelVolume, [inline, crossline]: [u32; 2]) -> Vec<f32> {
    let layout = volume.layout();
    let mut brick = vec![0; layout.brick_bytes()];
    let within = (crossline % 32 * 32 + inline % 32) as usize;
    let mut trace = Vec::new();
    for z in 0..layout.bricks()[2] {
        volume
            .read([inline / 32, crossline / 32, z], &mut brick)
            .unwrap();
        let samples = brick.iter().skip(within).step_by(32 * 32);
        trace.extend(samples.map(|sample| layout.value(*sample).unwrap()));
    }
    trace.truncate(layout.size[2] as usize);
    trace
}

/// Index of the strongest sample in a range.
fn strongest(trace: &[f32], range: std::ops::Range<usize>) -> usize {
    let within = range.start.min(trace.len())..range.end.min(trace.len());
    within
        .max_by(|a, b| trace[*a].abs().total_cmp(&trace[*b].abs()))
        .unwrap()
}

#[test]
fn the_strongest_samples_lie_at_the_horizons() {
    let model = model(ModelOptions::default().nodes_per_side);
    let volume = model.volume();
    let mut columns = vec![[5, 7], [100, 400], [262, 237], [517, 60]];
    // On both sides of the largest fault, through the horizon with its largest throw.
    let fault = model.faults()[0];
    let towards = DVec2::new(fault.strike.cos(), -fault.strike.sin());
    let column = |place: DVec2| {
        let at = (place + DVec2::new(3275.0, 2962.5)) / 12.5;
        [at.x.round() as u32, at.y.round() as u32]
    };
    let across = [-1.0, 1.0].map(|side| column(fault.centre + towards * side * 110.0));
    columns.extend(across);
    let mut checked = 0;
    let mut thrown = Vec::new();
    for at in columns {
        let trace = trace(&volume, at);
        let place = DVec2::new(-3275.0, -2962.5) + DVec2::from(at.map(f64::from)) * 12.5;
        let depths: Vec<_> = (0..11).map(|k| model.depth(k, place)).collect();
        let near = |sample: usize| {
            let away = |depth: &f64| (depth / 4.0 - sample as f64).abs();
            depths
                .iter()
                .flatten()
                .map(away)
                .fold(f64::INFINITY, f64::min)
        };
        let most = strongest(&trace, 0..trace.len());
        assert!(near(most) <= 2.0, "{at:?}: the strongest sample is {most}");
        for depth in depths.iter().flatten() {
            let expected = depth / 4.0;
            let found = strongest(&trace, expected as usize - 5..expected as usize + 7);
            assert!(
                (found as f64 - expected).abs() <= 2.0,
                "{at:?}: {found} for {expected}"
            );
            assert!(trace[found].abs() > 0.4);
            checked += 1;
        }
        if across.contains(&at) {
            let expected = depths[fault.horizon].unwrap() / 4.0;
            thrown.push(strongest(
                &trace,
                expected as usize - 5..expected as usize + 7,
            ));
        }
    }
    assert!(checked >= 60);
    let jump = (thrown[1] as f64 - thrown[0] as f64) * 4.0;
    assert!(jump > fault.throw * 0.6, "{jump} m of {}", fault.throw);
}

#[test]
fn bricks_do_not_depend_on_what_was_read_before() {
    let (a, b) = (model(60).volume(), model(60).volume());
    let read = |volume: &ModelVolume, brick| {
        let mut samples = vec![0; volume.layout().brick_bytes()];
        volume.read(brick, &mut samples).unwrap();
        samples
    };
    let bricks = [[0, 0, 1], [1, 1, 2], [2, 0, 0]];
    let forwards = bricks.map(|brick| read(&a, brick));
    let mut backwards = bricks;
    backwards.reverse();
    let mut backwards = backwards.map(|brick| read(&b, brick));
    backwards.reverse();
    assert_eq!(forwards, backwards);
    assert!(forwards.iter().flatten().all(|sample| *sample > 0));
}

#[test]
fn what_lies_beyond_the_end_repeats_the_last_samples() {
    let volume = model(60).volume();
    let layout = *volume.layout();
    let last = layout.bricks().map(|count| count - 1);
    let mut brick = vec![0; layout.brick_bytes()];
    volume.read(last, &mut brick).unwrap();
    let known = [0, 1, 2].map(|axis| (layout.size[axis] - last[axis] * 32) as usize);
    assert!(
        known.iter().all(|count| *count < 32),
        "the test needs a partial brick"
    );
    for (at, sample) in brick.iter().enumerate() {
        let within = [at % 32, at / 32 % 32, at / 1024];
        let [x, y, z] = [0, 1, 2].map(|axis| within[axis].min(known[axis] - 1));
        assert_eq!(*sample, brick[x + 32 * (y + 32 * z)]);
    }
}

#[test]
fn the_volume_is_as_large_as_the_papers_and_keeps_its_place_at_every_size() {
    let full = *model(ModelOptions::default().nodes_per_side)
        .volume()
        .layout();
    assert_eq!(full.size, [525, 475, 751]);
    for nodes in [2, 3, 60, 1000] {
        let layout = *model(nodes).volume().layout();
        assert_eq!(layout.problem(), None);
        assert_eq!(layout.origin, full.origin);
        let end = |layout: &antumbra_subsurface::VolumeLayout| {
            layout.position(glam::UVec3::from(layout.size).as_dvec3() - 1.0)
        };
        assert!(end(&layout).distance(end(&full)) < 1e-6);
    }
}

#[test]
fn bricks_that_are_not_there_are_refused() {
    let volume = model(60).volume();
    let mut samples = vec![0; volume.layout().brick_bytes()];
    let [x, y, z] = volume.layout().bricks();
    for brick in [[x, 0, 0], [0, y, 0], [0, 0, z], [u32::MAX; 3]] {
        assert!(volume.read(brick, &mut samples).is_err());
    }
    samples.pop();
    assert!(volume.read([0; 3], &mut samples).is_err());
}
