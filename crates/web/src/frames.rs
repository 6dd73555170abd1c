//! Draws frames of a scene with every strategy, and counts what is drawn, what is culled, and what is wrong.

use std::sync::Arc;

use antumbra_cull::{
    AuditOptions, Gpu, Stage, StageError, StageOptions, StageOutput, Verdict, ViewInput, ViewSpec,
};
use antumbra_draw::GpuScene;
use antumbra_graph::CompileError;
use antumbra_scene::{Camera, Stereo};
use antumbra_strategies::registry;
use antumbra_verify::{EntitySet, IdBuffer, Oracle};

use crate::WebError;
use crate::cases::{self, CaseSpec, StageKind};
use crate::opened::Offer;
use crate::report::Case;
use crate::scenes::{self, World};
use crate::scope::scoped;

/// Width and height of the images in pixels: no multiple of anything.
const SIZE: [u32; 2] = [161, 117];

/// Draws every case on the scene of all classes, and all ways on the built-in scenes.
pub(crate) async fn cases(
    gpu: &Gpu,
    offer: Offer,
    progress: &dyn Fn(&str),
) -> Result<Vec<Case>, WebError> {
    let mut found = Vec::new();
    let plain = cases::plain();
    if offer == Offer::Bare {
        // Most of what writes indirect draws is refused there, in words.
        play_all(gpu, offer, scenes::classes()?, &plain, &mut found, progress).await?;
        return Ok(found);
    }
    let all = cases::all();
    play_all(gpu, offer, scenes::classes()?, &all, &mut found, progress).await?;
    for world in scenes::built_in()? {
        play_all(gpu, offer, world, &plain, &mut found, progress).await?;
    }
    Ok(found)
}

async fn play_all(
    gpu: &Gpu,
    offer: Offer,
    world: World,
    specs: &[CaseSpec],
    found: &mut Vec<Case>,
    progress: &dyn Fn(&str),
) -> Result<(), WebError> {
    let mut player = Player::new(gpu, world).await?;
    for (number, spec) in specs.iter().enumerate() {
        let name = format!(
            "{}: {}, {}",
            player.world.name,
            spec.strategy,
            spec.kind.name()
        );
        if number % 25 == 0 {
            let of = specs.len();
            progress(&format!("{}: case {number} of {of}: {name}", offer.name()));
        }
        let outcome = match player.play(spec).await {
            Ok(outcome) => outcome,
            Err(Fault::Waits) => "waits within a frame".to_owned(),
            Err(Fault::Refused(words)) => format!("refused: {words}"),
            Err(Fault::Stage(error)) => format!("not made: {error}"),
        };
        found.push(Case { name, outcome });
    }
    Ok(())
}

/// Why a case has no counts.
enum Fault {
    /// Its plan waits for the GPU within a frame.
    Waits,
    /// The device refused something of it.
    Refused(String),
    /// The strategy or its stage did.
    Stage(StageError),
}

impl From<StageError> for Fault {
    fn from(error: StageError) -> Self {
        match &error {
            StageError::Compile { errors, .. } if errors.errors.iter().all(waits) => Self::Waits,
            _ => Self::Stage(error),
        }
    }
}

fn waits(error: &CompileError) -> bool {
    matches!(error, CompileError::SyncInBrowser { .. })
}

/// A world on the device, and what is to be seen in each frame.
struct Player {
    world: World,
    on_gpu: GpuScene,
    stereo: Stereo,
    oracle: Oracle,
    /// Of four samples a pixel.
    fine_oracle: Oracle,
    /// For each frame, the owners of the pixels of each eye's view: of the camera's own, the left and the right one, and of the camera's own with four samples.
    references: Vec<[IdBuffer; 4]>,
}

impl Player {
    async fn new(gpu: &Gpu, mut world: World) -> Result<Self, WebError> {
        let wrong = |reason: String| WebError::Scene {
            scene: world.name,
            reason,
        };
        let (on_gpu, refused) = scoped(&gpu.device, || GpuScene::new(gpu, &mut world.scene)).await;
        let on_gpu = on_gpu.map_err(|error| wrong(error.to_string()))?;
        if let Some(words) = refused {
            return Err(wrong(words));
        }
        let stereo = Stereo::new(0.065, 4.0).map_err(|error| wrong(error.to_string()))?;
        let mut oracle = Oracle::new(&on_gpu, SIZE);
        let mut fine_oracle = Oracle::new(&on_gpu, SIZE).with_samples(4);
        let mut references = Vec::new();
        for camera in &world.cameras {
            let eyes = stereo.eyes(camera);
            let [left, right] = eyes.map_err(|error| wrong(error.to_string()))?;
            let mut seen = [const { None }; 4];
            for (seen, camera) in seen.iter_mut().zip([*camera, left, right]) {
                let all = EntitySet::InFrustum;
                *seen = Some(oracle.render_async(&on_gpu, &camera, all).await?);
            }
            if let Some(fine) = seen.last_mut() {
                let all = EntitySet::InFrustum;
                *fine = Some(fine_oracle.render_async(&on_gpu, camera, all).await?);
            }
            references.push(seen.map(Option::unwrap_or_default));
        }
        Ok(Self {
            world,
            on_gpu,
            stereo,
            oracle,
            fine_oracle,
            references,
        })
    }

    /// The cameras of a frame, and where their references are.
    fn eyes(&self, camera: &Camera, kind: StageKind) -> Vec<(usize, Camera)> {
        let both = self.stereo.eyes(camera);
        match (kind, both) {
            (StageKind::TwoEyes, Ok([left, right])) => vec![(1, left), (2, right)],
            _ if kind.samples() > 1 => vec![(3, *camera)],
            _ => vec![(0, *camera)],
        }
    }

    /// Draws the frames of a case, and says what was drawn.
    async fn play(&mut self, spec: &CaseSpec) -> Result<String, Fault> {
        let strategy = registry().parse(&spec.strategy);
        let strategy =
            strategy.map_err(|error| Fault::Stage(StageError::Input(error.to_string())))?;
        let view = |name: &str| ViewSpec {
            name: name.to_owned(),
            size: SIZE,
        };
        let views = match spec.kind {
            StageKind::TwoEyes => vec![view("left"), view("right")],
            _ => vec![view("main")],
        };
        let options = options(spec.kind);
        let device = self.on_gpu.gpu().device.clone();
        let (stage, refused) = scoped(&device, || {
            Stage::new(&self.on_gpu, strategy, views, options)
        })
        .await;
        let mut stage = stage.map_err(Fault::from)?;
        let looped = stage.plan().loop_sync_points();
        if stage.plan().sync_points() > 0 || looped.iter().any(|looped| looped.sync_points > 0) {
            return Err(Fault::Waits);
        }
        if let Some(words) = refused {
            return Err(Fault::Refused(words));
        }
        let mut frames = Vec::new();
        for number in 0..self.world.cameras.len() {
            frames.push(self.frame(&mut stage, number, spec.kind).await?);
        }
        if let Some(audit) = stage.audit(0) {
            let wrong = audit.frames().filter(|frame| frame.found_any()).count();
            frames.push(format!("{} audits, {wrong} found", audit.audited()));
        }
        let instead = stage
            .distrust()
            .iter()
            .map(|distrust| format!("instead: {:?}, since {}", distrust.instead, distrust.cause));
        frames.extend(instead);
        Ok(frames.join("; "))
    }

    /// Draws a frame, and says what was drawn.
    async fn frame(
        &mut self,
        stage: &mut Stage,
        number: usize,
        kind: StageKind,
    ) -> Result<String, Fault> {
        let none = || StageError::Input("no such frame".to_owned());
        let camera = self.world.cameras.get(number).ok_or_else(none)?;
        let seen = self.references.get(number).ok_or_else(none)?;
        let eyes = self.eyes(camera, kind);
        let inputs = eyes.iter().map(|(of, camera)| ViewInput {
            reference: seen.get(*of).map(|seen| Arc::new(seen.owners())),
            ..ViewInput::new(*camera)
        });
        let inputs: Vec<ViewInput<'_>> = inputs.collect();
        let gpu = self.on_gpu.gpu().clone();
        let (drawn, refused) = scoped(&gpu.device, || stage.frame(&self.on_gpu, &inputs)).await;
        drawn?;
        if let Some(words) = refused {
            return Err(Fault::Refused(format!("frame {number}: {words}")));
        }
        gpu.wait_async().await.map_err(StageError::from)?;
        let mut views = Vec::new();
        for (view, (of, camera)) in eyes.iter().enumerate() {
            let verdicts = stage.verdicts_async(view, &self.on_gpu).await?;
            let set = EntitySet::Drawn(&verdicts);
            let oracle = match kind.samples() {
                1 => &mut self.oracle,
                _ => &mut self.fine_oracle,
            };
            let image = oracle.render_async(&self.on_gpu, camera, set).await?;
            let wrong = seen.get(*of).map_or(0, |seen| seen.wrong_pixels(&image));
            let tally = Verdict::ALL.iter().zip(verdicts.tally());
            let tally = tally
                .filter(|(_, count)| *count > 0)
                .map(|(verdict, count)| format!("{count} {}", verdict.word()));
            let tally: Vec<String> = tally.collect();
            let coarse = verdicts.drawn().filter(|slot| verdicts.level(*slot) > 0);
            let coarse = match coarse.count() {
                0 => String::new(),
                coarse => format!(", {coarse} coarser"),
            };
            views.push(format!("{}{coarse}, {wrong} wrong", tally.join(", ")));
        }
        Ok(views.join(" | "))
    }
}

fn options(kind: StageKind) -> StageOptions {
    let audited = matches!(kind, StageKind::Audited | StageKind::AuditedFourSamples);
    StageOptions {
        samples: kind.samples(),
        audit: audited.then(AuditOptions::default),
        timing: kind == StageKind::Timed,
        output: match kind {
            StageKind::Answers => StageOutput::Answers,
            _ => StageOutput::Image,
        },
        ..StageOptions::default()
    }
}
