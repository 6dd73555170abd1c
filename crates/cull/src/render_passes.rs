//! The renderer's passes as steps of a strategy.

use antumbra_graph::{Buffer, Texture};

use crate::audit::AUDIT;
use crate::draw_source::patches::PatchDraws;
use crate::draw_source::{DrawSource, ListDraws};
use crate::frame_graph::{CULL, DRAW, FrameGraph};
use crate::renderer::{DepthTest, IdTargets, Pass, Renderer, ShadeTargets};
use crate::self_test::Capability;
use crate::view_nodes::ViewNodes;

impl FrameGraph<'_> {
    /// Shades a source. The image's next versions are then the view's targets; what else the pass wrote is returned.
    pub fn shade_source(
        &mut self,
        view: &mut ViewNodes,
        name: &str,
        source: DrawSource,
        into: ShadeTargets,
    ) -> ShadeTargets {
        self.relies_on_drawing(source);
        if into.queries.is_some() {
            self.relies_on(Capability::OcclusionQueries);
        }
        let (renderer, pass) = self.pass(view, name, DRAW);
        let out = renderer.shade(pass, source, into);
        view.targets = out.targets;
        view.shaded.push(source);
        view.shades_in_loop |= self.in_loop;
        out
    }

    /// Writes the depth of a list.
    pub fn draw_depth(
        &mut self,
        view: &ViewNodes,
        name: &str,
        source: ListDraws,
        depth: Texture,
    ) -> Texture {
        let (renderer, pass) = self.pass(view, name, CULL);
        renderer.tests().depth(pass, source, depth)
    }

    /// Writes the entity ids and the depth of a list.
    pub fn draw_ids(
        &mut self,
        view: &ViewNodes,
        name: &str,
        source: ListDraws,
        targets: IdTargets,
    ) -> IdTargets {
        let (renderer, pass) = self.pass(view, name, CULL);
        renderer.tests().ids(pass, source, targets)
    }

    /// Counts the samples of a source that pass against a finished depth, by slot, a u32 each.
    pub fn count(
        &mut self,
        view: &ViewNodes,
        name: &str,
        source: DrawSource,
        test: DepthTest,
        counts: Buffer,
    ) -> Buffer {
        self.relies_on_drawing(source);
        let (renderer, pass) = self.pass(view, name, CULL);
        renderer.tests().count(pass, source, test, counts)
    }

    /// Tests a list against a depth with one hardware query for each of its queries. The results are a u64 each: zero, or something else.
    pub fn query(
        &mut self,
        view: &ViewNodes,
        name: &str,
        source: ListDraws,
        depth: Texture,
        results: Buffer,
    ) -> Buffer {
        self.relies_on(Capability::OcclusionQueries);
        let (renderer, pass) = self.pass(view, name, CULL);
        renderer.tests().query(pass, source, depth, results)
    }

    /// Marks the pixels of patches in which culled entities are visible.
    pub(crate) fn mark_patches(
        &mut self,
        view: &ViewNodes,
        name: &str,
        source: PatchDraws,
        test: DepthTest,
        marks: Buffer,
    ) -> Buffer {
        let (renderer, pass) = self.pass(view, name, AUDIT);
        renderer.tests().mark_patches(pass, source, test, marks)
    }

    /// Lets the renderer add what the passes of a view share.
    pub(crate) fn begin_view(&mut self, view: &ViewNodes) {
        let (renderer, pass) = self.pass(view, "begin view", CULL);
        renderer.begin_view(pass);
    }

    fn relies_on_drawing(&mut self, source: DrawSource) {
        if let DrawSource::Indirect(_) = source {
            self.relies_on(Capability::IndirectFirstInstance);
        }
    }

    fn pass<'a>(
        &'a mut self,
        view: &'a ViewNodes,
        name: &str,
        group: &'static str,
    ) -> (&'a mut dyn Renderer, Pass<'a>) {
        let pass = Pass {
            graph: &mut *self.graph,
            name: view.named(name),
            group,
            view: view.index,
            prefix: &view.prefix,
            inputs: view.inputs,
            layout: &self.shared.layout,
            colour_format: self.shared.colour_format,
            samples: self.shared.samples,
            output: self.shared.output,
        };
        (&mut *self.renderer, pass)
    }
}
