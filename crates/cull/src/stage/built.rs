//! A stage's plan: the strategy's nodes between imports and outputs, view by view, compiled.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_graph::{
    BufferDesc, Clear, CompileOptions, Graph, Host, Mode, Plan, Texture, TextureDesc,
};

use super::{StageError, StageOptions, StageOutput, ViewSpec, draws};
use crate::audit::{Audit, Lessons};
use crate::draw_source::DrawSource;
use crate::frame_graph::{CULL, DRAW, FrameGraph, Shared, Shown};
use crate::narrowing::Narrowing;
use crate::renderer::{DEPTH_FORMAT, Renderer, Targets, ViewInputs};
use crate::stage_scene::{SceneFrame, SceneLayout, StageScene};
use crate::strategy::{SetVerdicts, Strategy, VerdictSource};
use crate::trust::Trust;
use crate::view::{GpuView, ViewFrame};
use crate::view_nodes::ViewNodes;

/// What a stage runs: the plan, and handles into it.
pub(super) struct Built {
    /// The scene it was built for: its memory is about slots and epochs of that scene.
    pub number: u64,
    pub layout: SceneLayout,
    /// The budget's step that it was declared on; 0 without a budget.
    pub step: usize,
    /// How often the stage's strategy had been replaced by then.
    pub replacements: u32,
    /// What is known of the driver, and what the strategy relies on.
    pub trust: Trust,
    /// Width and height of each view.
    pub sizes: Vec<[u32; 2]>,
    pub plan: Plan,
    /// Frames it has run.
    pub frames: u64,
    resumed: Stretch,
    earlier: Stretch,
    pub scene: Host<SceneFrame>,
    pub views: Vec<BuiltView>,
    pub shown: Vec<Shown>,
}

/// One view of a plan.
pub(super) struct BuiltView {
    pub frame: Host<ViewFrame>,
    /// The view in the last frame; `None` before the first.
    pub last: Option<ViewFrame>,
    pub reference: Option<Host<Arc<Vec<u32>>>>,
    pub imported: Option<Targets>,
    pub targets: Targets,
    /// What is drawn, in order, where answers are asked for.
    pub shaded: Vec<DrawSource>,
    pub verdicts: SetVerdicts,
    pub narrowing: Option<Narrowing>,
    pub audit: Option<Host<Audit>>,
    /// Audited frames that the stage has taken over from this plan.
    pub audits_taken: u64,
    /// What the audits of other plans have learned, for this plan's audit to go on from.
    pub lessons: Lessons,
}

impl Built {
    /// The stage's number of a frame that has this number in the plan.
    pub fn stage_frame(&self, frame: u64) -> u64 {
        match frame < self.resumed.plan_frame {
            true => self.earlier.stage_frame(frame),
            false => self.resumed.stage_frame(frame),
        }
    }

    /// The frames that the stage has run with it since it was made or resumed.
    pub fn age(&self, stage_frame: u64) -> u64 {
        stage_frame.saturating_sub(self.resumed.stage_frame)
    }

    /// Goes on from the plan that this one replaces, for the same scene and settings: what its nodes know on the host stays true.
    pub fn inherit(&mut self, old: &mut Self, stage_frame: u64) {
        self.plan.inherit(&mut old.plan);
        self.frames = old.frames;
        self.resumed = old.resumed;
        self.resume(stage_frame);
        for (view, old) in self.views.iter_mut().zip(&old.views) {
            view.audits_taken = old.audits_taken;
        }
    }

    /// Goes on at a frame of the stage, after other plans have run.
    pub fn resume(&mut self, stage_frame: u64) {
        self.earlier = std::mem::replace(
            &mut self.resumed,
            Stretch {
                plan_frame: self.frames,
                stage_frame,
            },
        );
    }
}

/// A run of frames without a pause: the first one's number in the plan and in the stage.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stretch {
    plan_frame: u64,
    stage_frame: u64,
}

impl Stretch {
    fn stage_frame(&self, frame: u64) -> u64 {
        (frame + self.stage_frame).saturating_sub(self.plan_frame)
    }
}

/// What earlier plans of a stage leave to the next one.
pub(super) struct Inherited<'a> {
    pub audits: &'a [Audit],
    /// Frames that the stage has run.
    pub frames: u64,
    /// The budget's step that the strategy is on; 0 without a budget.
    pub step: usize,
    /// How often the stage's strategy has been replaced.
    pub replacements: u32,
    /// What the self-test found of the driver.
    pub trust: Trust,
    pub renderer: &'a mut dyn Renderer,
}

/// Declares a strategy's nodes on a new graph and compiles it.
pub(super) fn build(
    scene: &dyn StageScene,
    strategy: &mut dyn Strategy,
    specs: &[ViewSpec],
    options: &StageOptions,
    mut inherited: Inherited<'_>,
) -> Result<Built, StageError> {
    let gpu = scene.gpu();
    let layout = scene.layout();
    let mut graph = Graph::new(strategy.name());
    let scene_handle = graph.import_host::<SceneFrame>("scene");
    let mut shared = Shared {
        gpu: gpu.clone(),
        layout: layout.clone(),
        colour_format: options.colour_format,
        samples: options.samples,
        output: options.output,
        frames_in_flight: options.frames_in_flight.max(1),
        trees: HashMap::new(),
        resident: None,
        shown: Vec::new(),
        trust: inherited.trust.clone(),
    };
    let declared = declare(
        &mut graph,
        &mut shared,
        scene_handle,
        strategy,
        specs,
        options,
        &mut inherited,
    );
    let views = declared?;
    let compile = CompileOptions {
        mode: options.mode,
        timing: options.timing,
        frames_in_flight: options.frames_in_flight,
        late_results: options.late_results,
        ..gpu.compile_options()
    };
    let plan = graph
        .compile(&compile)
        .map_err(|errors| StageError::Compile {
            strategy: strategy.name().to_owned(),
            errors,
        })?;
    Ok(Built {
        number: scene.number(),
        layout,
        step: inherited.step,
        replacements: inherited.replacements,
        trust: shared.trust,
        sizes: specs.iter().map(|spec| spec.size).collect(),
        plan,
        frames: 0,
        resumed: Stretch {
            plan_frame: 0,
            stage_frame: inherited.frames,
        },
        earlier: Stretch::default(),
        scene: scene_handle,
        views,
        shown: shared.shown,
    })
}

/// Declares a strategy's nodes for every view.
fn declare(
    graph: &mut Graph,
    shared: &mut Shared,
    scene_handle: Host<SceneFrame>,
    strategy: &mut dyn Strategy,
    specs: &[ViewSpec],
    options: &StageOptions,
    inherited: &mut Inherited<'_>,
) -> Result<Vec<BuiltView>, StageError> {
    let mut views = Vec::with_capacity(specs.len());
    for (index, spec) in specs.iter().enumerate() {
        let frame = graph.import_host::<ViewFrame>(format!("{} camera", spec.name));
        let needs_reference = strategy.needs_reference();
        let reference =
            needs_reference.then(|| graph.import_host(format!("{} reference", spec.name)));
        let (targets, imported) = targets(graph, spec, options);
        let mut nodes = ViewNodes {
            name: spec.name.clone(),
            prefix: prefix(spec, specs.len()),
            index,
            count: specs.len(),
            size: spec.size,
            inputs: inputs(graph, spec, specs.len(), scene_handle, frame),
            targets,
            reference,
            in_frustum: None,
            narrowing: None,
            shaded: Vec::new(),
            shades_in_loop: false,
        };
        let mut declared = FrameGraph::new(graph, shared, inherited.renderer);
        declared.begin_view(&nodes);
        let set = strategy.declare(&mut declared, &mut nodes)?;
        let lessons = Lessons::default();
        if let Some(audit) = inherited.audits.get(index) {
            lessons.teach(audit.experience().clone());
        }
        // What the audit relies on is not the strategy's affair.
        let of_strategy = declared.shared.trust.clone();
        let audit = options.audit.filter(|_| declared.can_audit());
        let audit = audit.map(|options| {
            let source = declared.said_of(&mut nodes, &set);
            declared.audit(&nodes, source, options, lessons.clone())
        });
        declared.shared.trust = of_strategy;
        match options.output {
            // An import keeps its writers anyway. As an output it would need more usages of the host's texture.
            StageOutput::Image if imported.is_none() => {
                nodes.targets.colour = resolved(graph, &nodes, options);
                graph.output(nodes.targets.colour);
            }
            StageOutput::Image => {}
            StageOutput::Answers if nodes.shades_in_loop => {
                return Err(StageError::NoAnswers {
                    strategy: strategy.name().to_owned(),
                });
            }
            StageOutput::Answers => draws::output(graph, &nodes.shaded),
        }
        if let Some(Narrowing { inside, left }) = set.narrowing {
            graph.output(inside);
            graph.output(left);
        }
        if let Some(audit) = audit {
            graph.output(audit);
        }
        match set.verdicts {
            SetVerdicts::DrawnBySlot(drawn) => graph.output(drawn),
            SetVerdicts::FromNodes(VerdictSource::Host(verdicts)) => graph.output(verdicts),
            SetVerdicts::FromNodes(VerdictSource::Gpu {
                candidates,
                queried,
                counts,
                adapted,
                ..
            }) => {
                if let Some(adapted) = adapted {
                    graph.output(adapted.buffer);
                }
                graph.output(candidates);
                graph.output(queried);
                graph.output(counts);
            }
        }
        views.push(BuiltView {
            frame,
            last: None,
            reference,
            imported,
            targets: nodes.targets,
            shaded: match options.output {
                StageOutput::Answers => nodes.shaded,
                StageOutput::Image => Vec::new(),
            },
            verdicts: set.verdicts,
            narrowing: set.narrowing,
            audit,
            audits_taken: 0,
            lessons,
        });
    }
    Ok(views)
}

/// The view's targets: textures of the plan, or imports from the host.
fn targets(
    graph: &mut Graph,
    spec: &ViewSpec,
    options: &StageOptions,
) -> (Targets, Option<Targets>) {
    let [width, height] = spec.size;
    let target = |format| TextureDesc::new(width, height, format).samples(options.samples);
    let (colour, depth) = (target(options.colour_format), target(DEPTH_FORMAT));
    let (colour_name, depth_name) = (
        format!("{} colour", spec.name),
        format!("{} depth", spec.name),
    );
    match (options.mode, options.output) {
        (Mode::Embedded, StageOutput::Image) => {
            let targets = Targets {
                colour: graph.import_texture(colour_name, colour),
                depth: graph.import_texture(depth_name, depth),
            };
            (targets, Some(targets))
        }
        (Mode::Owned, _) | (_, StageOutput::Answers) => {
            let colour = graph.texture(
                colour_name,
                colour.cleared(Clear::Colour(options.background)),
            );
            (
                Targets {
                    colour,
                    depth: graph.texture(depth_name, depth.cleared(Clear::Depth(0.0))),
                },
                None,
            )
        }
    }
}

/// The view's colour with one sample a pixel.
fn resolved(graph: &mut Graph, nodes: &ViewNodes, options: &StageOptions) -> Texture {
    let drawn = nodes.targets.colour;
    if options.samples == 1 {
        return drawn;
    }
    let [width, height] = nodes.size;
    let resolved = graph.texture(
        nodes.named("resolved colour"),
        TextureDesc::new(width, height, options.colour_format),
    );
    let mut node = graph.raster(nodes.named("resolve"));
    node.group(DRAW).colour(drawn);
    let resolved = node.resolve(resolved);
    node.run(|_| Ok(()));
    resolved
}

/// Uploads the view's uniforms.
fn inputs(
    graph: &mut Graph,
    spec: &ViewSpec,
    count: usize,
    scene: Host<SceneFrame>,
    view: Host<ViewFrame>,
) -> ViewInputs {
    let named = |what: &str| format!("{}{what}", prefix(spec, count));
    let uniform = graph.buffer(named("view"), BufferDesc::new(size_of::<GpuView>() as u64));
    let mut node = graph.host_node(named("upload view"));
    node.group(CULL).read(view);
    let uniform = node.upload(uniform);
    node.run(move |ctx| {
        let view = ctx.get(view)?;
        ctx.upload(uniform, 0, bytemuck::bytes_of(&view.uniform()))?;
        Ok(())
    });
    ViewInputs {
        scene,
        view,
        uniform,
    }
}

/// What names of a view's nodes and resources begin with: empty for a single view.
fn prefix(spec: &ViewSpec, count: usize) -> String {
    match count > 1 {
        true => format!("{}: ", spec.name),
        false => String::new(),
    }
}
