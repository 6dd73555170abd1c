//! Measures what a part of a scene costs: frames with it and without it, in alternating blocks, along the same orbit.
//!
//! ```text
//! cargo run --release --example what_it_costs                       # all parts
//! cargo run --release --example what_it_costs -- environment        # one of them
//! ```
//!
//! A plan contains only what its scene requires, so "without" is the cost for a scene that does not use the part.

use std::error::Error;
use std::time::Instant;

use antumbra::cull::{AdapterChoice, Gpu, Stage, StageOptions, ViewInput, ViewSpec};
use antumbra::demo_scenes::{GridOptions, grid};
use antumbra::draw::GpuScene;
use antumbra::scene::{
    AlphaMode, Camera, Drawable, Environment, Image, Light, Material, Projection, Sampler, Scene,
};
use antumbra::strategies::registry;
use antumbra::subsurface::{Axis, Slice, SliceOptions, VolumeLayout};
use glam::{DAffine3, DQuat, DVec3};

/// A part that a scene, or a strategy's test, may require.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A second view.
    SecondEye,
    /// A transparent entity.
    Transparency,
    /// Counts of samples, in place of queries that answer zero or not.
    Counting,
    /// A tree to traverse.
    Hierarchy,
    /// An environment image to reflect.
    Environment,
    /// A light with a position.
    PositionalLights,
    /// A slice through a volume.
    Volume,
}

impl Part {
    /// All parts.
    pub const ALL: [Self; 7] = [
        Self::SecondEye,
        Self::Transparency,
        Self::Counting,
        Self::Hierarchy,
        Self::Environment,
        Self::PositionalLights,
        Self::Volume,
    ];

    /// The name on the command line.
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

    /// Adds the part to a scene. A part that belongs to the strategy or the views changes nothing.
    pub fn add_to(self, scene: &mut Scene) -> Result<(), Box<dyn Error>> {
        match self {
            Self::SecondEye | Self::Counting | Self::Hierarchy => {}
            Self::Transparency => {
                // A transparent ball between the camera and the scene.
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

/// The scene without any part: balls under parallel light, `per_side` along each side.
pub fn plain(per_side: u32) -> Result<Scene, Box<dyn Error>> {
    let options = GridOptions {
        per_side,
        ..GridOptions::default()
    };
    Ok(grid(options)?)
}

/// An environment image that is brighter towards the top.
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

/// Frames in a block, and blocks with and without the part.
const FRAMES: u32 = 12;
const BLOCKS: usize = 9;

/// A scene on a stage, and the times of its blocks.
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

    /// Runs a block, waiting for each frame. Returns milliseconds a frame.
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
        // The first block warms up. The runs alternate, so that other load on the machine affects both.
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
