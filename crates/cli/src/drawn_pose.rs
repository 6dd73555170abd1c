//! One pose, drawn with one strategy until its late results have arrived: what `render` shows, and what `graph` times.

use antumbra::cull::{Gpu, Stage, StageOptions, Strategy};
use antumbra::draw::GpuScene;
use antumbra::scene::{Camera, Scene};
use antumbra::terrain::HorizonStrategy;
use antumbra::verify::Oracle;

use crate::args::ViewArgs;
use crate::eyes::inputs;
use crate::failure::Failure;
use crate::input::Input;
use crate::outputs::Outputs;
use crate::strategies::{Horizons, registry};
use crate::watch::Watch;

/// The first compiles pipelines, and late results need frames to arrive.
const FRAMES: usize = 3;

/// What to draw.
#[derive(Debug, Clone, Copy)]
pub struct PoseRequest<'a> {
    /// The scene, the path and the views.
    pub view: &'a ViewArgs,
    /// The strategy, `NAME:key=value`.
    pub strategy: &'a String,
    /// The pose of the path, from 0.
    pub pose: usize,
    /// Whether the strategy leaves a sketch.
    pub sketch: bool,
    /// Whether passes are timed.
    pub timing: bool,
}

/// A pose that was drawn.
pub struct DrawnPose {
    /// The stage after its last frame.
    pub stage: Stage,
    /// The scene on the GPU.
    pub scene: GpuScene,
    /// One camera a view.
    pub cameras: Vec<Camera>,
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// The scene on the host, which has the entities' names.
    pub host: Scene,
    /// The adapter.
    pub gpu: Gpu,
    /// The adapter is watched until it is dropped.
    pub watch: Watch,
}

impl DrawnPose {
    /// Loads the scene and draws it.
    ///
    /// # Errors
    /// Wrong usage, and an output that cannot be written, before anything is loaded; what stopped it otherwise.
    pub fn draw(request: PoseRequest<'_>, outputs: &mut Outputs) -> Result<Self, Failure> {
        request.chosen(None)?;
        outputs.probe()?;
        let gpu = Gpu::open(&request.view.adapter)?;
        let horizons = Horizons::of([request.strategy]);
        let mut input = Input::open(request.view, horizons, &gpu, outputs)?;
        let strategy = request.chosen(input.horizon.as_ref())?;
        let cameras = input.look(request.pose)?;
        let watch = Watch::start(request.view.patience);
        let scene = GpuScene::new(&gpu, &mut input.scene)?;
        let options = StageOptions {
            timing: request.timing,
            samples: input.samples,
            ..StageOptions::default()
        };
        let mut stage = Stage::new(&scene, strategy, input.views(), options)?;
        let needs_reference = stage.strategy().needs_reference();
        let mut oracle =
            needs_reference.then(|| Oracle::new(&scene, input.size).with_samples(input.samples));
        let views = inputs(oracle.as_mut(), &scene, &cameras)?;
        for _ in 0..FRAMES {
            stage.frame(&scene, &views)?;
            gpu.wait()?;
            watch.sign();
        }
        Ok(Self {
            stage,
            scene,
            cameras,
            size: input.size,
            samples: input.samples,
            host: input.scene,
            gpu,
            watch,
        })
    }
}

impl PoseRequest<'_> {
    /// The strategy that is named, set to leave a sketch where one is wanted.
    fn chosen(&self, horizon: Option<&HorizonStrategy>) -> Result<Box<dyn Strategy>, Failure> {
        let mut strategy = registry(horizon).parse(self.strategy)?;
        if self.sketch {
            // A strategy without this setting lists those it has.
            strategy.set("sketch", &true.into())?;
        }
        Ok(strategy)
    }
}
