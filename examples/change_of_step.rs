//! What a budget's change of step costs: milliseconds of the frames in which the step changes, to a new step and back to one it was on before, beside frames
//! without a change.
//!
//! ```text
//! cargo run --release --example change_of_step -- coherent 640x480 14
//! ```
//!
//! The strategy, the image size and the entities along a side of the grid.

use std::error::Error;
use std::time::Instant;

use antumbra::cull::{AdapterChoice, Budget, Gpu, Stage, StageOptions, ViewInput, ViewSpec};
use antumbra::demo_scenes::{GridOptions, grid};
use antumbra::draw::GpuScene;
use antumbra::scene::{Camera, Projection};
use antumbra::strategies::registry;
use glam::DVec3;

/// The budget in milliseconds; the example reports frame times above and below it at will.
const BUDGET: f64 = 10.0;

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let strategy = words.next().unwrap_or_else(|| "coherent".to_owned());
    let size = words.next().unwrap_or_else(|| "640x480".to_owned());
    let (width, height) = size.split_once('x').ok_or("write the size as 640x480")?;
    let per_side = words.next().map_or(Ok(14), |word| word.parse())?;
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    let mut scene = grid(GridOptions {
        per_side,
        ..GridOptions::default()
    })?;
    scene.ensure_proxies(&Default::default());
    let on_gpu = GpuScene::new(&gpu, &mut scene)?;
    let options = StageOptions {
        budget: Some(Budget::FrameTime(BUDGET)),
        ..StageOptions::default()
    };
    let views = vec![ViewSpec::main(width.parse()?, height.parse()?)];
    let mut stage = Stage::new(&on_gpu, registry().parse(&strategy)?, views, options)?;
    let projection = Projection::Perspective {
        fov_y: 0.9,
        near: 0.05,
    };
    let eye = DVec3::new(0.9, 0.6, 1.2) * f64::from(per_side);
    let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
    let (mut still, mut new, mut back) = (Vec::new(), Vec::new(), Vec::new());
    let mut visited = Vec::new();
    let mut before = None;
    let mut reported = BUDGET * 1.2;
    for frame in 0..400 {
        let start = Instant::now();
        stage.frame(&on_gpu, &[ViewInput::new(camera)])?;
        let time = start.elapsed().as_secs_f64() * 1e3;
        gpu.wait()?;
        let step = stage.budget_state().map(|(state, _)| state.step);
        if frame > 0 && step == before {
            still.push(time);
        } else if visited.contains(&step) {
            back.push(time);
        } else {
            visited.push(step);
            // The first frame of all has everything to make.
            if frame > 0 {
                new.push(time);
            }
        }
        before = step;
        // Slow for sixty frames, then fast for sixty: the controller goes to the fastest step and back.
        if frame % 60 == 59 {
            reported = if reported > BUDGET {
                BUDGET * 0.6
            } else {
                BUDGET * 1.2
            };
        }
        stage.note_time(reported);
    }
    println!(
        "{strategy}, {size}, {} entities, {} steps",
        per_side.pow(3),
        visited.len()
    );
    for (what, times) in [
        ("without a change", &mut still),
        ("to a new step", &mut new),
        ("back to a step", &mut back),
    ] {
        println!(
            "{what}: {:.2} ms (median of {})",
            median(times),
            times.len()
        );
    }
    Ok(())
}
