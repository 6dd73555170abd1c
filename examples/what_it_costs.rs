//! What a part of a scene costs when it is there: frames with it and without it, in turns, along the same orbit.
//!
//! ```text
//! cargo run --release --example what_it_costs                       # all parts
//! cargo run --release --example what_it_costs -- environment        # one of them
//! ```
//!
//! A plan holds what its scene requires and nothing else, so "without" is what everybody pays who does not use a part.

use std::error::Error;
use std::time::Instant;

use antumbra::cull::{Stage, StageOptions, ViewInput, ViewSpec};
use antumbra::demo_scenes::{GridOptions, grid};
use antumbra::draw::{AdapterChoice, Gpu, GpuScene};
use antumbra::scene::{
    AlphaMode, Camera, Drawable, Environment, Image, Light, Material, Projection, Sampler, Scene,
};
use antumbra::strategies::registry;
use antumbra::subsurface::{Axis, Slice, SliceOptions, VolumeLayout};
use glam::{DAffine3, DQuat, DVec3};

/// What a scene, or a strategy's question, may require.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Two views of everything.
    SecondEye,
    /// Something to blend.
    Transparency,
    /// A number of samples, where any would do.
    Counting,
    /// A tree to walk.
    Hierarchy,
    /// An image around it all to reflect.
    Environment,
    /// A light that stands somewhere.
    PositionalLights,
    /// A slice through a volume.
    Volume,
}

impl Part {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::SecondEye,
        Self::Transparency,
        Self::Counting,
        Self::Hierarchy,
        Self::Environment,
        Self::PositionalLights,
        Self::Volume,
    ];

    /// What the command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::SecondEye => "second-eye",
            Self::Transparency => "transparency",
            Self::Counting => "counting",
            Self::Hierarchy => "hierarchy",
            Self::Environment => "environment",
            Self::PositionalLights => "positional-lights",
            Self::Volume => "volume",
        }
    }

    /// Adds the part to a scene; those that are no part of a scene leave it as it is.
    pub fn add_to(self, scene: &mut Scene) -> Result<(), Box<dyn Error>> {
        match self {
            Self::SecondEye | Self::Counting | Self::Hierarchy => {}
            Self::Transparency => {
                // A ball of glass in the line of sight.
                let mesh = scene.drawables().next().map(|(_, drawable)| drawable.mesh);
                let material = scene.add_material(Material {
                    alpha: AlphaMode::Blend,
                    base_colour: [0.6, 0.8, 1.0, 0.3],
                    ..Material::default()
                });
                let large = DAffine3::from_scale_rotation_translation(
                    DVec3::splat(4.0),
                    DQuat::IDENTITY,
                    DVec3::new(10.0, 5.0, 22.0),
                );
                let glass = scene.spawn(None, large)?;
                if let Some(mesh) = mesh {
                    scene.set_drawable(glass, Drawable { mesh, material })?;
                }
            }
            Self::Environment => {
                let image = scene.add_image(sky())?;
                let intensity = 1.0;
                scene.set_environment(Some(Environment { image, intensity }))?;
            }
            Self::PositionalLights => {
                let lamp = scene.spawn(None, DAffine3::from_translation(DVec3::Y * 20.0))?;
                let light = Light::Point {
                    colour: [1.0; 3],
                    intensity: 500.0,
                    range: None,
                };
                scene.set_light(lamp, light)?;
            }
            Self::Volume => {
                let layout = VolumeLayout {
                    size: [64, 64, 64],
                    brick: 16,
                    origin: DVec3::splat(-8.0),
                    steps: [DVec3::X, DVec3::Z, DVec3::Y].map(|step| step * 0.25),
                    range: [-1.0, 1.0],
                };
                let options = SliceOptions::default();
                Slice::spawn(scene, None, &layout, Axis::Inline, 32, &options)?;
            }
        }
        Ok(())
    }

    /// The strategies without and with the part.
    fn strategies(self) -> [&'static str; 2] {
        match self {
            Self::Counting => [
                "three-pass:latency=same-frame:counting=queries:threshold=0",
                "three-pass:latency=same-frame:counting=identity:threshold=8",
            ],
            Self::Hierarchy => ["stop-and-wait:batch=4096", "stop-and-wait:tree=divided"],
            _ => ["frustum", "frustum"],
        }
    }

    fn views(self, there: bool) -> &'static [&'static str] {
        match (self, there) {
            (Self::SecondEye, true) => &["left", "right"],
            _ => &["main"],
        }
    }
}

/// Balls under parallel light, so many along each side: nothing that any part stands for.
pub fn plain(per_side: u32) -> Result<Scene, Box<dyn Error>> {
    let options = GridOptions {
        per_side,
        ..GridOptions::default()
    };
    Ok(grid(options)?)
}

/// Brighter towards the top.
fn sky() -> Image {
    let rows = (0..32u8).flat_map(|row| [[200 - row * 5, 210 - row * 4, 230, 255]; 64]);
    Image {
        name: "sky".to_owned(),
        width: 64,
        height: 32,
        rgba: rows.flatten().collect(),
        sampler: Sampler::default(),
    }
}

/// Frames of a block, and blocks of each kind.
const FRAMES: u32 = 12;
const BLOCKS: usize = 9;

/// A scene at work.
struct Run {
    scene: GpuScene,
    stage: Stage,
    views: usize,
    blocks: Vec<f64>,
}

impl Run {
    fn new(gpu: &Gpu, part: Part, there: bool) -> Result<Self, Box<dyn Error>> {
        let mut scene = plain(12)?;
        if there {
            part.add_to(&mut scene)?;
        }
        let scene = GpuScene::new(gpu, &mut scene)?;
        let strategy = registry().parse(part.strategies()[usize::from(there)])?;
        let views = part.views(there);
        let spec = |name: &&str| ViewSpec {
            name: (*name).to_owned(),
            size: [640, 480],
        };
        let specs = views.iter().map(spec).collect();
        Ok(Self {
            stage: Stage::new(&scene, strategy, specs, StageOptions::default())?,
            scene,
            views: views.len(),
            blocks: Vec::new(),
        })
    }

    /// Milliseconds a frame, each waited for.
    fn block(&mut self, gpu: &Gpu) -> Result<f64, Box<dyn Error>> {
        let started = Instant::now();
        for frame in 0..FRAMES {
            let turn = DQuat::from_rotation_y(f64::from(frame) * 0.1);
            let projection = Projection::Perspective {
                fov_y: 0.9,
                near: 0.1,
            };
            let eye = turn * DVec3::new(0.0, 8.0, 40.0);
            let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
            let inputs = vec![ViewInput::new(camera); self.views];
            self.stage.frame(&self.scene, &inputs)?;
            gpu.wait()?;
        }
        Ok(started.elapsed().as_secs_f64() * 1e3 / f64::from(FRAMES))
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let asked = std::env::args().nth(1);
    let parts: Vec<Part> = Part::ALL
        .into_iter()
        .filter(|part| asked.as_ref().is_none_or(|asked| part.name() == asked))
        .collect();
    if parts.is_empty() {
        let known = Part::ALL.map(Part::name).join(", ");
        return Err(format!("there is no such part; there are: {known}").into());
    }
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    println!(
        "{}, medians of {BLOCKS} blocks of {FRAMES} frames",
        gpu.title()
    );
    println!("| part | without, ms | with, ms | ratio |");
    println!("|---|---|---|---|");
    for part in parts {
        let mut runs = [Run::new(&gpu, part, false)?, Run::new(&gpu, part, true)?];
        // The first block warms up; then they take turns, so that what else the machine does hits both.
        for block in 0..=BLOCKS {
            for run in &mut runs {
                let milliseconds = run.block(&gpu)?;
                if block > 0 {
                    run.blocks.push(milliseconds);
                }
            }
        }
        let [without, with] = &runs;
        let ratios = with.blocks.iter().zip(&without.blocks);
        let ratios: Vec<f64> = ratios.map(|(with, without)| with / without).collect();
        println!(
            "| {} | {:.2} | {:.2} | {:.2} |",
            part.name(),
            median(&without.blocks),
            median(&with.blocks),
            median(&ratios)
        );
    }
    Ok(())
}
