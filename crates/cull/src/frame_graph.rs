//! The graph as a strategy sees it: the raw graph, and the steps that culling is made of.

use std::any::Any;
use std::collections::HashMap;
use std::sync::Arc;

use antumbra_graph::{
    BodyError, BufferDesc, Clear, Graph, Host, HostBuilder, HostContext, LoopOptions, Texture,
    TextureDesc,
};

use antumbra_scene::hierarchy::HierarchyShape;
use antumbra_shaders::Job;

use crate::boxes::{BoxDraws, BoxPipeline, BoxPurpose};
use crate::candidates::Candidates;
use crate::compute_pipeline::ComputePipeline;
use crate::device::Gpu;
use crate::draw_source::{DrawList, ListDraws};
use crate::entities::SceneTable;
use crate::narrowing::Narrowing;
use crate::order::back_to_front;
use crate::renderer::{DEPTH_FORMAT, IDENTITY_FORMAT, Renderer, ShadeTargets};
use crate::resident_scene::ResidentScene;
use crate::self_test::Capability;
use crate::stage::StageOutput;
use crate::stage_scene::SceneLayout;
use crate::strategy::VisibleSet;
use crate::tree::Tree;
use crate::trust::Trust;
use crate::verdict::{Verdict, Verdicts};
use crate::view::ViewFrame;
use crate::view_nodes::ViewNodes;

/// The group label of the nodes that find the visible set.
pub const CULL: &str = "cull";
/// The group label of the nodes that draw it.
pub const DRAW: &str = "draw";

/// The graph under declaration, with the steps that culling is made of.
pub struct FrameGraph<'g> {
    pub(crate) graph: &'g mut Graph,
    pub(crate) shared: &'g mut Shared,
    pub(crate) renderer: &'g mut dyn Renderer,
    /// Whether it is the graph of a host loop.
    pub(crate) in_loop: bool,
}

/// The handle of a host value that [`Stage::shown`](crate::Stage::shown) finds by view and name.
pub(crate) struct Shown {
    pub view: usize,
    pub name: &'static str,
    pub value: Box<dyn Any + Send + Sync>,
}

/// What all views of a stage share while they are declared.
pub(crate) struct Shared {
    pub gpu: Gpu,
    pub layout: SceneLayout,
    pub colour_format: wgpu::TextureFormat,
    pub samples: u32,
    pub output: StageOutput,
    pub frames_in_flight: u32,
    /// The trees, one a shape, for all views.
    pub trees: HashMap<HierarchyShape, Host<Tree>>,
    /// The scene on the device, for all views.
    pub resident: Option<ResidentScene>,
    /// What the strategy shows.
    pub shown: Vec<Shown>,
    /// What is known of the driver.
    pub trust: Trust,
}

/// Verdicts and the lists that follow from them.
#[derive(Debug, Clone, Copy)]
pub struct Chosen {
    /// Why each entity is drawn or not.
    pub verdicts: Host<Verdicts>,
    /// The entities that are drawn without blending, in canonical order.
    pub solid: ListDraws,
    /// The blended entities, back to front; `None` for a scene without.
    pub blended: Option<ListDraws>,
}

impl<'g> FrameGraph<'g> {
    pub(crate) fn new(
        graph: &'g mut Graph,
        shared: &'g mut Shared,
        renderer: &'g mut dyn Renderer,
    ) -> Self {
        Self {
            graph,
            shared,
            renderer,
            in_loop: false,
        }
    }

    /// The graph itself, for a strategy's own nodes.
    pub fn graph(&mut self) -> &mut Graph {
        self.graph
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.shared.gpu
    }

    /// Frames that the host has in flight, at least 1: by as many frames answers may be late.
    pub fn frames_in_flight(&self) -> u32 {
        self.shared.frames_in_flight
    }

    /// What the plan depends on: the scene's sizes, pipeline classes, transparency and lights.
    pub fn scene_layout(&self) -> &SceneLayout {
        &self.shared.layout
    }

    /// Makes a host value of a view readable after each frame, by name ([`Stage::shown`](crate::Stage::shown)): to see how the visible set was found.
    pub fn show<T: 'static>(&mut self, view: &ViewNodes, name: &'static str, value: Host<T>) {
        self.graph.output(value);
        self.shared.shown.push(Shown {
            view: view.index,
            name,
            value: Box::new(value),
        });
    }

    /// Declares a sub-graph that runs until its host value is true. More than eight turns an entity fail the frame: a traversal visits less than two nodes an
    /// entity and queries each at most twice, and a turn may find one node without a box.
    pub fn host_loop(
        &mut self,
        name: String,
        declare: impl FnOnce(&mut FrameGraph<'_>) -> Host<bool>,
    ) {
        let options = LoopOptions {
            limit: self
                .shared
                .layout
                .slots
                .saturating_mul(8)
                .saturating_add(16),
        };
        let (shared, renderer) = (&mut *self.shared, &mut *self.renderer);
        self.graph.host_loop_with(name, options, |graph| {
            declare(&mut FrameGraph {
                graph,
                shared,
                renderer,
                in_loop: true,
            })
        });
    }

    /// Whether there is an image, or answers alone.
    pub fn output(&self) -> StageOutput {
        self.shared.output
    }

    /// The samples a pixel of the views' targets, and of everything that the renderer draws.
    pub fn samples(&self) -> u32 {
        self.shared.samples
    }

    /// A depth texture, cleared to infinitely far by its first writer. It has as many samples a pixel as the views.
    pub fn depth_texture(&mut self, name: String, size: [u32; 2]) -> Texture {
        let depth = self.drawn(size, DEPTH_FORMAT);
        self.graph.texture(name, depth.cleared(Clear::Depth(0.0)))
    }

    /// A texture for entity ids, cleared to none by its first writer. It has as many samples a pixel as the views.
    pub fn id_texture(&mut self, name: String, size: [u32; 2]) -> Texture {
        let blank = Clear::Colour(wgpu::Color::TRANSPARENT);
        let ids = self.drawn(size, IDENTITY_FORMAT);
        self.graph.texture(name, ids.cleared(blank))
    }

    /// What the renderer draws into.
    fn drawn(&self, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> TextureDesc {
        TextureDesc::new(width, height, format).samples(self.shared.samples)
    }

    /// A draw list with room for every slot, and the buffer that its slots are uploaded to.
    pub fn unsubmitted(&mut self, name: &str) -> ListDraws {
        let list = self.graph.host::<DrawList>(name);
        let ids = self
            .graph
            .buffer(format!("{name}: slots"), BufferDesc::new(self.slot_bytes()));
        ListDraws { list, slots: ids }
    }

    /// The pipeline that draws boxes for queries.
    pub fn box_pipeline(&mut self) -> Arc<BoxPipeline> {
        self.relies_on(Capability::OcclusionQueries);
        let Shared { gpu, samples, .. } = &*self.shared;
        gpu.box_pipeline(*samples, BoxPurpose::Query)
    }

    /// The pipeline that draws boxes into depths of one sample a pixel, and the one that queries boxes against these.
    pub(crate) fn guard_pipelines(&mut self) -> [Arc<BoxPipeline>; 2] {
        self.relies_on(Capability::OcclusionQueries);
        let gpu = &self.shared.gpu;
        [BoxPurpose::Hide, BoxPurpose::Query].map(|purpose| gpu.box_pipeline(1, purpose))
    }

    /// A compute pipeline of one bind group, of the bindings that the entry point uses. It is compiled once a device.
    pub fn compute_pipeline(&mut self, job: &Job, entry: &'static str) -> Arc<ComputePipeline> {
        self.shared.gpu.compute_pipeline(job, entry)
    }

    /// A list of at most `most` boxes, and the buffer that they are uploaded to.
    pub fn unsubmitted_boxes(&mut self, name: &str, most: u64) -> BoxDraws {
        let bytes = BufferDesc::new(most * BoxPipeline::BYTES_A_BOX);
        BoxDraws {
            list: self.graph.host(name),
            buffer: self.graph.buffer(format!("{name}: corners"), bytes),
        }
    }

    /// A tree of boxes over all entities that may be culled, updated with the scene. All views share one a shape.
    pub fn tree(&mut self, view: &ViewNodes, shape: HierarchyShape) -> Host<Tree> {
        self.tree_for(view, shape, CULL)
    }

    /// The same. If the tree is new, its cost is accounted to `group`.
    pub(crate) fn tree_for(
        &mut self,
        view: &ViewNodes,
        shape: HierarchyShape,
        group: &'static str,
    ) -> Host<Tree> {
        if let Some(kept) = self.shared.trees.get(&shape) {
            return *kept;
        }
        let scene = view.inputs.scene;
        let tree = self.graph.host::<Tree>(format!("tree of {shape}"));
        let mut node = self.graph.host_node(format!("follow tree of {shape}"));
        node.group(group).read(scene);
        let tree = node.updates(tree);
        node.run(move |ctx| {
            let scene = ctx.get(scene)?;
            ctx.get_mut(tree)?.follow(&scene.table, shape)?;
            Ok(())
        });
        self.shared.trees.insert(shape, tree);
        tree
    }

    /// Whether the plan has a tree of this shape already.
    pub(crate) fn keeps_tree(&self, shape: HierarchyShape) -> bool {
        self.shared.trees.contains_key(&shape)
    }

    /// Four bytes a slot.
    pub fn slot_bytes(&self) -> u64 {
        u64::from(self.shared.layout.slots.max(1)) * 4
    }

    /// The entities in the view's frustum; in a [chain](Self::chain), those of them that the strategy before has left. Found once a view.
    pub fn in_frustum(&mut self, view: &mut ViewNodes) -> Host<Candidates> {
        if let Some(found) = view.in_frustum {
            return found;
        }
        let found = self.candidates(view, "frustum", |candidates, table, frame| {
            candidates.find(table, frame)
        });
        view.in_frustum = Some(found);
        found
    }

    /// All entities, in the frustum or not; in a chain, without those that the strategy before has taken out.
    pub fn everything(&mut self, view: &ViewNodes) -> Host<Candidates> {
        let all = self.candidates(view, "everything", |candidates, table, frame| {
            candidates.take_all(table, frame)
        });
        let Some(Narrowing { inside, left }) = view.narrowing else {
            return all;
        };
        let rest = self.graph.host::<Candidates>(view.named("remaining"));
        let mut node = self.graph.host_node(view.named("remove culled"));
        node.group(CULL).read(inside).read(left).read(all);
        let rest = node.write(rest);
        node.run(move |ctx| {
            let (inside, left) = (ctx.get(inside)?, ctx.get(left)?);
            ctx.get_mut(rest)?.narrow(&*ctx.get(all)?, |slots| {
                slots.retain(|slot| left.contains(*slot) || !inside.contains(*slot));
            });
            Ok(())
        });
        rest
    }

    fn candidates(
        &mut self,
        view: &ViewNodes,
        name: &str,
        find: impl Fn(&mut Candidates, &SceneTable, &ViewFrame) + Send + 'static,
    ) -> Host<Candidates> {
        let inputs = view.inputs;
        let found = self.graph.host::<Candidates>(view.named("candidates"));
        let mut node = self.graph.host_node(view.named(name));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let found = node.write(found);
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            find(&mut *ctx.get_mut(found)?, &scene.table, &frame);
            Ok(())
        });
        found
    }

    /// A part of the candidates: `keep` removes slots, in any order. The rest may be the occluders of [`Self::proxies_of`], or the candidates of the next strategy of a
    /// [chain](Self::chain).
    pub fn narrowed(
        &mut self,
        view: &ViewNodes,
        name: &str,
        candidates: Host<Candidates>,
        mut keep: impl FnMut(&SceneTable, &ViewFrame, &mut Vec<u32>) + Send + 'static,
    ) -> Host<Candidates> {
        let inputs = view.inputs;
        let kept = self.graph.host::<Candidates>(view.named(name));
        let mut node = self.graph.host_node(view.named(&format!("find {name}")));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let kept = node.read(candidates).write(kept);
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let mut narrower = ctx.get_mut(kept)?;
            narrower.narrow(&*ctx.get(candidates)?, |slots| {
                keep(&scene.table, &frame, slots)
            });
            Ok(())
        });
        kept
    }

    /// Adds a host node that gives every entity a verdict, and makes and uploads the draw lists that follow. `reads` declares what else the node reads. `judge` finds
    /// every entity at [`Verdict::OutsideFrustum`].
    pub fn choose(
        &mut self,
        view: &ViewNodes,
        reads: impl FnOnce(&mut HostBuilder<'_>),
        mut judge: impl FnMut(
            &HostContext<'_>,
            &SceneTable,
            &ViewFrame,
            &mut Verdicts,
        ) -> Result<(), BodyError>
        + Send
        + 'static,
    ) -> Chosen {
        let judge =
            move |ctx: &HostContext<'_>,
                  _: &(),
                  table: &SceneTable,
                  view: &ViewFrame,
                  verdicts: &mut Verdicts| judge(ctx, table, view, verdicts);
        self.choose_with(view, reads, judge)
    }

    /// The same, with what `reads` has declared handed to `judge`: handles that the node updates.
    pub(crate) fn choose_with<Declared: Send + 'static>(
        &mut self,
        view: &ViewNodes,
        reads: impl FnOnce(&mut HostBuilder<'_>) -> Declared,
        mut judge: impl FnMut(
            &HostContext<'_>,
            &Declared,
            &SceneTable,
            &ViewFrame,
            &mut Verdicts,
        ) -> Result<(), BodyError>
        + Send
        + 'static,
    ) -> Chosen {
        let inputs = view.inputs;
        let verdicts = self.graph.host::<Verdicts>(view.named("verdicts"));
        let solid = self.unsubmitted(&view.named("visible set"));
        let blended = self
            .shared
            .layout
            .transparent
            .then(|| self.unsubmitted(&view.named("visible transparent set")));
        let narrowing = view.narrowing;
        let mut node = self.graph.host_node(view.named("choose visible set"));
        if let Some(narrowing) = narrowing {
            narrowing.read(&mut node);
        }
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let declared = reads(&mut node);
        let chosen = Chosen {
            verdicts: node.write(verdicts),
            solid: solid.written_by(&mut node),
            blended: blended.map(|list| list.written_by(&mut node)),
        };
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let table = &scene.table;
            let mut verdicts = ctx.get_mut(chosen.verdicts)?;
            verdicts.reset_outside(table);
            judge(ctx, &declared, table, &frame, &mut verdicts)?;
            if let Some(narrowing) = narrowing {
                narrowing.hide(ctx, &mut verdicts)?;
            }
            let mut solid = ctx.get_mut(chosen.solid.list)?;
            let verdicts = &*verdicts;
            let drawn = |transparent| {
                let of_kind = move |slot: &u32| table.is_transparent(*slot) == transparent;
                let drawn = verdicts.drawn().filter(of_kind);
                drawn.map(|slot| (slot, verdicts.level(slot)))
            };
            solid.fill_levels(table, drawn(false), verdicts.levels());
            ctx.upload(chosen.solid.slots, 0, bytemuck::cast_slice(solid.slots()))?;
            if let Some(blended) = chosen.blended {
                let mut list = ctx.get_mut(blended.list)?;
                back_to_front(&mut list, table, &frame, drawn(true));
                ctx.upload(blended.slots, 0, bytemuck::cast_slice(list.slots()))?;
            }
            Ok(())
        });
        chosen
    }

    /// Shades the chosen entities: solid ones first, then blended ones.
    pub fn shade(&mut self, view: &mut ViewNodes, chosen: Chosen) -> VisibleSet {
        self.shade_list(view, "shaded", chosen.solid);
        if let Some(blended) = chosen.blended {
            self.shade_list(view, "transparent", blended);
        }
        VisibleSet::drawn(chosen.verdicts)
    }

    /// Shades one draw list into the view's targets.
    pub fn shade_list(&mut self, view: &mut ViewNodes, name: &str, list: ListDraws) {
        self.shade_source(view, name, list.into(), ShadeTargets::from(view.targets));
    }

    /// Chooses with a rule that looks at one candidate at a time, and shades the chosen entities.
    pub fn visible_by(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        rule: impl Fn(&SceneTable, &ViewFrame, u32) -> Verdict + Send + 'static,
    ) -> VisibleSet {
        let chosen = self.choose(
            view,
            |node| {
                node.read(candidates);
            },
            move |ctx, table, frame, verdicts| {
                for slot in ctx.get(candidates)?.inside() {
                    verdicts.set(*slot, rule(table, frame, *slot));
                }
                Ok(())
            },
        );
        self.shade(view, chosen)
    }
}
