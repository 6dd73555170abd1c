//! Measures how well budgets are kept on paths that no setting was tuned for: flights with camera cuts through a scene in which every ninth
//! entity moves. Fixed settings run beside them, to compare the best of these, which is known only in hindsight, with what a budget finds.
//!
//! ```text
//! cargo run --release --example keep_a_budget -- 500 640x480 18 300 0.1 out/budget
//! ```
//!
//! The arguments: frames, image size, entities along a side of the grid, the first flight's seed, the audit's share of triangles, and the folder
//! for `report.json` and `report.html`.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;

use antumbra::cull::{AdapterChoice, AuditOptions, Budget, Gpu};
use antumbra::demo_scenes::{GridOptions, grid};
use antumbra::measure::audit_summary::audit_summaries;
use antumbra::measure::compare::{CompareOptions, Contender, Script, compare_scripted};
use antumbra::measure::path::CameraPath;
use antumbra::measure::table::{Table, facts};
use antumbra::scene::{Camera, EntityKey, Scene};
use antumbra::strategies::registry;
use glam::{DAffine3, DVec3};

/// Frames between two cuts.
const CUT_EVERY: usize = 125;
/// The default seed of the first flight; each further flight uses the next one.
const SEED: u64 = 300;

/// Consecutive frames of one strategy before the next strategy draws.
const BLOCK: usize = 5;

/// Fixed settings, the most accurate first; each is used in each latency.
const FIXED: [&str; 7] = [
    "threshold=0:scale=1:occluders=full:occludees=full",
    "threshold=0:scale=1",
    "threshold=0:scale=0.7",
    "threshold=0",
    "threshold=5",
    "threshold=20",
    "threshold=50",
];

const LATENCIES: [&str; 2] = ["same-frame", "on-gpu"];

/// Budgets of wrong pixels, in percent.
const BUDGETS: [f64; 3] = [0.02, 0.1, 0.5];

/// Entities that swing up and down, each in its own phase.
struct Swinging(Vec<(EntityKey, DAffine3)>);

impl Swinging {
    fn of(scene: &Scene) -> Self {
        let ninth = scene.drawables().map(|(key, _)| key).step_by(9);
        Self(
            ninth
                .filter_map(|key| Some((key, scene.local(key)?)))
                .collect(),
        )
    }
}

impl Script for Swinging {
    fn set(&mut self, scene: &mut Scene, pose: usize, _: &Camera) -> Result<(), String> {
        for (key, home) in &self.0 {
            let away = (pose as f64 * 0.05 + home.translation.x).sin() * 0.5;
            let place = DAffine3::from_translation(DVec3::Y * away) * *home;
            scene
                .set_local(*key, place)
                .map_err(|error| error.to_string())?;
        }
        Ok(())
    }
}

/// Flights of several seeds, one after the other, with a cut between them.
fn flights(scene: &Scene, frames: usize, first_seed: u64) -> Result<CameraPath, Box<dyn Error>> {
    let bounds = scene.bounds().ok_or("the scene is empty")?;
    let mut poses = Vec::with_capacity(frames);
    let mut projection = None;
    for (first, seed) in (0..frames).step_by(CUT_EVERY).zip(first_seed..) {
        let flight = CameraPath::flight(&bounds, seed, CUT_EVERY.min(frames - first))?;
        projection = Some(flight.projection());
        let at = poses.len();
        poses.extend_from_slice(flight.poses());
        if let Some(pose) = poses.get_mut(at) {
            pose.cut = true;
        }
    }
    Ok(CameraPath::new(
        "flights",
        projection.ok_or("no frames")?,
        poses,
    )?)
}

fn contenders(share: f64) -> Result<Vec<Contender>, Box<dyn Error>> {
    let registry = Arc::new(registry());
    let mut list = Vec::new();
    for name in ["frustum", "ideal"] {
        list.push(Contender::of("", &registry, name)?);
    }
    for latency in LATENCIES {
        for settings in FIXED {
            let spec = format!("three-pass:latency={latency}:{settings}");
            let label = format!("{latency}, {settings}");
            list.push(Contender::of(label, &registry, &spec)?);
        }
    }
    for latency in LATENCIES {
        let spec = format!("three-pass:latency={latency}");
        for budget in BUDGETS {
            let budget = Budget::WrongPixels(budget);
            let label = format!("{latency} within {budget}");
            let within = Contender::of(label, &registry, &spec)?.within(budget);
            list.push(within.audited(AuditOptions {
                share,
                ..AuditOptions::default()
            }));
        }
    }
    Ok(list)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let mut next = |usual: &str| args.next().unwrap_or_else(|| usual.to_owned());
    let frames: usize = next("500").parse()?;
    let size = next("640x480");
    let (wide, high) = size.split_once('x').ok_or("write the size as 320x240")?;
    let size = [wide.parse()?, high.parse()?];
    let per_side = next("18").parse()?;
    let seed = next(&SEED.to_string()).parse()?;
    let share = next(&AuditOptions::default().share.to_string()).parse()?;
    let out = PathBuf::from(next("out/budget"));

    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    let mut scene = grid(GridOptions {
        per_side,
        ..GridOptions::default()
    })?;
    scene.ensure_proxies(&Default::default());
    scene.update();
    let path = flights(&scene, frames, seed)?;
    let mut script = Swinging::of(&scene);
    let options = CompareOptions {
        size,
        command: format!("keep_a_budget {frames} {wide}x{high} {per_side} {seed} {share}"),
        scene_name: format!("grid:{per_side}, every ninth entity swinging"),
        // The path is flown once: the second time it would no longer be unseen.
        least_seconds: 0.0,
        // Short blocks, so that other load on the machine affects all strategies alike.
        block: Some(BLOCK),
        ..CompareOptions::default()
    };
    let mut comparison = compare_scripted(
        &gpu,
        &mut scene,
        &mut script,
        &path,
        &contenders(share)?,
        &options,
        &mut |_| {},
    )?;
    let report = &mut comparison.report;
    report.seeds.insert("path".to_owned(), seed);
    comparison.save(&out)?;
    for line in facts(&comparison.report) {
        println!("{line}");
    }
    println!("{}", Table::new(&comparison.report).terminal(false));
    for summary in audit_summaries(&comparison.report) {
        println!(
            "{}: {}",
            summary.strategy.title(),
            summary.lines.join("\n  ")
        );
    }
    println!("report: {}", out.join("report.html").display());
    Ok(())
}
