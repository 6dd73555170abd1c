//! The culling stage: a strategy's nodes between a scene and its image, compiled into a plan and run frame by frame.
//!
//! A stage runs on its own and submits, or it records into a host's encoder and draws into the host's textures.

mod built;
mod distrust;
mod draws;
mod error;
mod fallback;
mod input;
mod kept;
mod options;
mod report;

use std::sync::Arc;

use antumbra_graph::{FrameReport, Host, Plan};
use built::{Built, Inherited, build};
use kept::KeptPlans;

pub use distrust::{Distrust, DistrustCause, DistrustOptions, Instead};
pub use draws::Draws;
pub use error::StageError;
pub use input::{ImportedTargets, ViewInput};
pub use options::{StageOptions, StageOutput, ViewSpec};
pub use report::{Rebuilt, StageReport};

use crate::adaptive_threshold::GpuThreshold;
use crate::audit::Audit;
use crate::budget::{Budget, BudgetController, BudgetState};
use crate::candidates::{Candidates, Queried};
use crate::count_layout::CountLayout;
use crate::device::Gpu;
use crate::narrowing::{Narrowing, hide};
use crate::read_back;
use crate::renderer::Renderer;
use crate::samples::Samples;
use crate::self_test::SelfTestReport;
use crate::stage_scene::StageScene;
use crate::strategy::{SetVerdicts, Strategy, VerdictSource};
use crate::trust::Trust;
use crate::tuning::Step;
use crate::verdict::Verdicts;
use crate::view::ViewFrame;

/// A strategy at work on a scene.
pub struct Stage {
    gpu: Gpu,
    strategy: Box<dyn Strategy>,
    specs: Vec<ViewSpec>,
    options: StageOptions,
    built: Built,
    kept: KeptPlans,
    renderer: Box<dyn Renderer>,
    /// Why there is another plan, until a frame has run with it.
    rebuilt: Option<Rebuilt>,
    cuts: Vec<u64>,
    /// Frames drawn so far, by all plans.
    frames: u64,
    audits: Vec<Audit>,
    controller: Option<BudgetController>,
    /// What the self-test found.
    tested: Option<Arc<SelfTestReport>>,
    distrust: Vec<Distrust>,
    /// How often the strategy was replaced.
    replacements: u32,
    /// The frame from which on all frames must be without a wrong pixel; `None`: the strategy does not promise it now.
    conservative_from: Option<u64>,
}

impl std::fmt::Debug for Stage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stage")
            .field("strategy", &self.strategy.name())
            .field("views", &self.specs)
            .finish_non_exhaustive()
    }
}

impl Stage {
    /// Declares a strategy's nodes for these views and compiles them.
    ///
    /// # Errors
    /// [`StageError::Declare`] and [`StageError::Compile`]; [`StageError::Input`] without a view or with one of no pixels; [`StageError::Device`] for samples
    /// that the device does not have.
    pub fn new(
        scene: &dyn StageScene,
        strategy: Box<dyn Strategy>,
        specs: Vec<ViewSpec>,
        options: StageOptions,
    ) -> Result<Self, StageError> {
        if specs.is_empty() {
            return Err(StageError::Input("no view".to_owned()));
        }
        for spec in &specs {
            spec.check(scene.gpu())?;
        }
        scene.gpu().check_capabilities()?;
        scene.gpu().check_samples(options.samples)?;
        let mut strategy = strategy;
        let mut options = options;
        if let Some(Budget::WrongPixels(percent)) = options.budget
            && percent > 0.0
        {
            options.audit.get_or_insert_default();
        }
        let controller = options
            .budget
            .map(|budget| BudgetController::new(budget, strategy.as_mut(), options.mode))
            .transpose()?;
        let mut renderer = scene.renderer();
        let inherited = Inherited {
            audits: &[],
            frames: 0,
            step: step(controller.as_ref()),
            replacements: 0,
            trust: Trust::default(),
            renderer: renderer.as_mut(),
        };
        let built = build(scene, strategy.as_mut(), &specs, &options, inherited)?;
        let cuts = vec![0; specs.len()];
        let audits = specs.iter().map(|_| Audit::default()).collect();
        let mut stage = Self {
            gpu: scene.gpu().clone(),
            strategy,
            specs,
            options,
            built,
            kept: KeptPlans::default(),
            renderer,
            rebuilt: None,
            cuts,
            frames: 0,
            audits,
            controller,
            tested: None,
            distrust: Vec::new(),
            replacements: 0,
            conservative_from: None,
        };
        let trust = stage.built.trust.clone();
        if stage.heeds(&trust)? {
            stage.built = stage.declare(scene)?;
        }
        Ok(stage)
    }

    /// Gives a view another size, from the next frame on. That frame compiles a new plan ([`Rebuilt::Size`]); what the strategy knows on the
    /// host stays, and is used.
    ///
    /// # Errors
    /// [`StageError::Input`] for a view that does not exist, and for a size that [`Self::new`] refuses.
    pub fn resize(&mut self, view: usize, size: [u32; 2]) -> Result<(), StageError> {
        let views = self.specs.len();
        let Some(spec) = self.specs.get_mut(view) else {
            return Err(StageError::Input(format!(
                "a size for view {view}, and it has {views}"
            )));
        };
        if spec.size != size {
            let resized = ViewSpec {
                name: spec.name.clone(),
                size,
            };
            resized.check(&self.gpu)?;
            *spec = resized;
        }
        Ok(())
    }

    /// The strategy; `frustum` once the driver was [found wrong](Self::distrust) in what another relied on.
    pub fn strategy(&self) -> &dyn Strategy {
        self.strategy.as_ref()
    }

    /// The compiled plan: its passes, sync points, timings and picture.
    pub fn plan(&self) -> &Plan {
        &self.built.plan
    }

    /// The plan, to drain its timings.
    pub fn plan_mut(&mut self) -> &mut Plan {
        &mut self.built.plan
    }

    /// Runs a frame and submits it. The scene must have been synced (`GpuScene::sync`). With another scene than in the last frame the stage starts over: nothing
    /// that it knows of the last one is used.
    ///
    /// # Errors
    /// [`StageError::Input`] when the inputs are not one a view; otherwise what failed.
    pub fn frame(
        &mut self,
        scene: &dyn StageScene,
        views: &[ViewInput<'_>],
    ) -> Result<StageReport, StageError> {
        self.prepare(scene, views)?;
        let report = self.built.plan.execute(&self.gpu.device, &self.gpu.queue)?;
        self.gpu.check()?;
        Ok(self.finish(report))
    }

    /// Records a frame into a host's encoder; for a stage of [`Mode::Embedded`](antumbra_graph::Mode::Embedded).
    ///
    /// # Errors
    /// As for [`Self::frame`].
    pub fn record(
        &mut self,
        scene: &dyn StageScene,
        views: &[ViewInput<'_>],
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<StageReport, StageError> {
        self.prepare(scene, views)?;
        let plan = &mut self.built.plan;
        let report = plan.record(&self.gpu.device, &self.gpu.queue, encoder)?;
        Ok(self.finish(report))
    }

    /// Tells the stage how long the last frame took, in milliseconds: a [`Budget::FrameTime`] goes by this. The caller decides what is timed, the frame itself or the
    /// interval between frames.
    pub fn note_time(&mut self, milliseconds: f64) {
        if let Some(controller) = &mut self.controller {
            controller.note_time(milliseconds);
        }
    }

    /// The step that the budget is on, with its settings and its dial; `None` without a budget.
    pub fn budget_state(&self) -> Option<(BudgetState, &Step)> {
        self.controller.as_ref()?.state()
    }

    fn finish(&mut self, plan: FrameReport) -> StageReport {
        let frame = self.frames;
        self.collect();
        StageReport {
            frame,
            plan,
            rebuilt: self.rebuilt.take(),
        }
    }

    /// Takes over the audits that have come in, and passes them to the budget's controller.
    fn collect(&mut self) {
        self.frames += 1;
        self.built.frames += 1;
        let promised_from = self.conservative_from;
        let mut wrong = None;
        for (view, audit) in self.audits.iter_mut().enumerate() {
            let Some(built) = self.built.views.get(view) else {
                continue;
            };
            let Some(of_plan) = built.audit.and_then(|audit| self.built.plan.get(audit)) else {
                continue;
            };
            let audited = of_plan.audited();
            // A frame that failed has reset the plan's audit.
            let taken = match audited < built.audits_taken {
                true => 0,
                false => built.audits_taken,
            };
            let fresh = (audited - taken) as usize;
            let skipped = of_plan.frames().len().saturating_sub(fresh);
            for found in of_plan.frames().skip(skipped) {
                let mut found = found.clone();
                found.frame = self.built.stage_frame(found.frame);
                if let Some(controller) = &mut self.controller {
                    controller.note_audit(&found, self.frames);
                }
                let promised = promised_from.is_some_and(|from| found.frame >= from);
                if promised && found.found_any() && wrong.is_none() {
                    wrong = Some((view, found.clone()));
                }
                audit.take(found);
            }
            if fresh > 0 {
                audit.learn(of_plan.experience().clone());
            }
            if let Some(built) = self.built.views.get_mut(view) {
                built.audits_taken = audited;
            }
        }
        if let Some((view, found)) = wrong {
            self.trip(view, &found);
        }
    }

    /// Declares the strategy's nodes again, for the scene and the settings as they are now.
    fn declare(&mut self, scene: &dyn StageScene) -> Result<Built, StageError> {
        if let Some(audit) = &mut self.options.audit {
            // A new plan may count its frames from 0, and must not draw the same patches once more.
            audit.seed = audit.seed.wrapping_add(1 << 32);
        }
        let inherited = Inherited {
            trust: self.trust(),
            audits: &self.audits,
            frames: self.frames,
            step: step(self.controller.as_ref()),
            replacements: self.replacements,
            renderer: self.renderer.as_mut(),
        };
        let strategy = self.strategy.as_mut();
        let built = build(scene, strategy, &self.specs, &self.options, inherited)?;
        Ok(match self.heeds(&built.trust)? {
            true => self.declare(scene)?,
            false => built,
        })
    }

    /// A kept plan, ready to go on. Its nodes see a camera cut: answers from before the pause are not used.
    fn resumed(&mut self, mut kept: Built) -> Built {
        kept.resume(self.frames);
        self.cut();
        for (built, audit) in kept.views.iter().zip(&self.audits) {
            built.lessons.teach(audit.experience().clone());
        }
        kept
    }

    /// Makes the plan fit the scene, the sizes of the views, and the budget's step.
    fn rebuild(
        &mut self,
        scene: &dyn StageScene,
        step: usize,
    ) -> Result<Option<Rebuilt>, StageError> {
        if scene.number() != self.built.number {
            if !scene.gpu().is(&self.gpu) {
                let what = "a scene on another device than the one that it was made for";
                return Err(StageError::Input(what.to_owned()));
            }
            self.kept.clear();
            let before = std::mem::replace(&mut self.renderer, scene.renderer());
            match self.declare(scene) {
                Ok(built) => self.built = built,
                Err(error) => {
                    self.renderer = before;
                    return Err(error);
                }
            }
            return Ok(Some(Rebuilt::Scene));
        }
        if self.built.replacements != self.replacements {
            self.kept.clear();
            self.built = self.declare(scene)?;
            return Ok(Some(Rebuilt::Distrust));
        }
        let same_layout = scene.layout() == self.built.layout;
        let sizes = self.specs.iter().map(|spec| &spec.size);
        if !same_layout || !sizes.eq(&self.built.sizes) {
            self.kept.clear();
            let mut next = self.declare(scene)?;
            if self.built.step == step && self.built.replacements == next.replacements {
                if self.built.age(self.frames) < self.answered() {
                    // Answers that were under way are lost again, so what is known would grow older and older: begin anew.
                    self.cut();
                }
                next.inherit(&mut self.built, self.frames);
            }
            self.built = next;
            return Ok(Some(match same_layout {
                false => Rebuilt::Layout,
                true => Rebuilt::Size,
            }));
        }
        if self.built.step == step {
            return Ok(None);
        }
        let (next, how) = match self.kept.take(step) {
            Some(kept) => (self.resumed(kept), Rebuilt::Resumed),
            None => (self.declare(scene)?, Rebuilt::Step),
        };
        let before = std::mem::replace(&mut self.built, next);
        if before.replacements != self.replacements {
            self.kept.clear();
            return Ok(Some(Rebuilt::Distrust));
        }
        self.kept.keep(before);
        Ok(Some(how))
    }

    /// Frames after which the answers to a frame's queries have arrived.
    fn answered(&self) -> u64 {
        u64::from(self.options.frames_in_flight.max(1)) + 2
    }

    /// Makes all views see a camera cut.
    fn cut(&mut self) {
        for cuts in &mut self.cuts {
            *cuts += 1;
        }
    }

    /// Follows the budget, and sets everything that the frame's nodes read.
    fn prepare(
        &mut self,
        scene: &dyn StageScene,
        views: &[ViewInput<'_>],
    ) -> Result<(), StageError> {
        if views.len() != self.specs.len() {
            return Err(StageError::Input(format!(
                "{} views, and it has {}",
                views.len(),
                self.specs.len()
            )));
        }
        if let Some(controller) = &mut self.controller {
            controller.follow(self.strategy.as_mut())?;
        }
        let step = step(self.controller.as_ref());
        if let Some(rebuilt) = self.rebuild(scene, step)? {
            if let Some(controller) = &mut self.controller {
                controller.note_rebuilt(rebuilt);
            }
            self.rebuilt = Some(rebuilt);
        }
        self.note_promise();
        let Built {
            plan,
            scene: scene_handle,
            views: built,
            ..
        } = &mut self.built;
        plan.set(*scene_handle, scene.frame())?;
        for (((input, spec), built), cuts) in
            views.iter().zip(&self.specs).zip(built).zip(&mut self.cuts)
        {
            input
                .camera
                .validate()
                .map_err(|error| StageError::Camera {
                    view: spec.name.clone(),
                    error,
                })?;
            *cuts += u64::from(input.cut);
            let frame = ViewFrame::new(input.camera, spec.size, *cuts);
            built.last = Some(frame.clone());
            plan.set(built.frame, frame)?;
            if let Some(handle) = built.reference {
                let Some(reference) = &input.reference else {
                    return Err(StageError::Input(format!(
                        "no reference for view '{}', and strategy '{}' needs one",
                        spec.name,
                        self.strategy.name()
                    )));
                };
                plan.set(handle, Arc::clone(reference))?;
            }
            if let Some(imported) = built.imported {
                let Some(targets) = input.targets else {
                    return Err(StageError::Input(format!(
                        "no targets for view '{}', and an embedded stage draws into its owner's",
                        spec.name
                    )));
                };
                for (handle, texture) in [
                    (imported.colour, targets.colour),
                    (imported.depth, targets.depth),
                ] {
                    plan.bind_texture(handle, &texture.create_view(&Default::default()), texture)?;
                }
            }
        }
        Ok(())
    }

    /// A view's colour texture of the last frame; `None` for a view that does not exist, or whose targets are imported.
    pub fn colour(&self, view: usize) -> Option<&wgpu::Texture> {
        self.built
            .plan
            .texture(self.built.views.get(view)?.targets.colour)
    }

    /// A value that the strategy [shows](crate::FrameGraph::show), as of the last frame; `None` where it shows none of this name and type.
    pub fn shown<T: 'static>(&self, view: usize, name: &str) -> Option<&T> {
        let mut shown = self.built.shown.iter();
        let shown = shown.find(|shown| shown.view == view && shown.name == name)?;
        self.built.plan.get(*shown.value.downcast_ref::<Host<T>>()?)
    }

    /// What a view's audit has found so far; `None` for a stage without audit.
    pub fn audit(&self, view: usize) -> Option<&Audit> {
        self.options.audit?;
        self.audits.get(view)
    }

    /// A view's verdicts of the last frame. Verdicts that exist on the GPU alone are read back, which waits: for measuring, not for every frame.
    ///
    /// # Errors
    /// As for [`Self::verdicts_async`]; [`StageError::Device`] in a browser.
    pub fn verdicts(&self, view: usize, scene: &dyn StageScene) -> Result<Verdicts, StageError> {
        self.gpu.block_on(
            "`Stage::verdicts`",
            "`Stage::verdicts_async`",
            self.verdicts_async(view, scene),
        )
    }

    /// [`Self::verdicts`], to be awaited.
    ///
    /// # Errors
    /// [`StageError::Device`] when the device is lost meanwhile; [`StageError::Input`] for a view that does not exist or no frame yet.
    pub async fn verdicts_async(
        &self,
        view: usize,
        scene: &dyn StageScene,
    ) -> Result<Verdicts, StageError> {
        let missing = || StageError::Input(format!("view {view}, which has no verdicts yet"));
        let built = self.built.views.get(view).ok_or_else(missing)?;
        let plan = &self.built.plan;
        let mut verdicts = match built.verdicts {
            SetVerdicts::FromNodes(VerdictSource::Host(verdicts)) => {
                plan.get(verdicts).ok_or_else(missing)?.clone()
            }
            SetVerdicts::DrawnBySlot(drawn) => {
                let buffer = plan.buffer(drawn).ok_or_else(missing)?;
                let bytes = read_back::buffer_async(&self.gpu, buffer).await?;
                let frame = built.last.as_ref().ok_or_else(missing)?;
                let mut candidates = Candidates::default();
                candidates.find(scene.table(), frame);
                let drawn = |slot| CountLayout::BySlot.count(&bytes, slot, 0).unwrap_or(0) > 0;
                Verdicts::of_drawn(scene.table(), &candidates, drawn)
            }
            SetVerdicts::FromNodes(VerdictSource::Gpu {
                candidates,
                queried,
                counts,
                layout,
                mut rule,
                adapted,
            }) => {
                if let Some(adapted) = adapted {
                    let buffer = plan.buffer(adapted.buffer).ok_or_else(missing)?;
                    let bytes = read_back::buffer_async(&self.gpu, buffer).await?;
                    let found: GpuThreshold = bytemuck::pod_read_unaligned(&bytes);
                    rule.threshold = found.threshold;
                }
                let candidates = plan.get(candidates).ok_or_else(missing)?;
                let queried: &Queried = plan.get(queried).ok_or_else(missing)?;
                let buffer = plan.buffer(counts).ok_or_else(missing)?;
                let bytes = read_back::buffer_async(&self.gpu, buffer).await?;
                let mut samples = Samples::default();
                samples.take(queried, layout, &bytes);
                let mut verdicts = Verdicts::default();
                samples.judge(scene.table(), candidates, rule, &mut verdicts);
                verdicts
            }
        };
        if let Some(Narrowing { inside, left }) = built.narrowing {
            let [inside, left] = [inside, left].map(|list| plan.get(list).ok_or_else(missing));
            hide(inside?, left?, &mut verdicts);
        }
        Ok(verdicts)
    }
}

/// The step that a budget is on; 0 without one.
fn step(controller: Option<&BudgetController>) -> usize {
    let state = controller.and_then(BudgetController::state);
    state.map_or(0, |(state, _)| state.step)
}
