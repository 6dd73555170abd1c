//! From counts to a visible set: one edge of the graph decides whether it takes a frame, a stall, or neither.

use antumbra_graph::Host;

use crate::candidates::Candidates;
use crate::counting::Counts;
use crate::frame_graph::{CULL, FrameGraph};
use crate::samples::{SampleRule, Samples};
use crate::setting::Latency;
use crate::strategy::VisibleSet;
use crate::view_nodes::ViewNodes;

impl FrameGraph<'_> {
    /// Shades what the rule (a threshold alone, or more) makes of each entity's visible samples, by answers of the given latency.
    pub fn visible_samples(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        latency: Latency,
        rule: impl Into<SampleRule>,
    ) -> VisibleSet {
        let rule = rule.into();
        match latency {
            Latency::FrameLate => self.visible_late(view, candidates, counts, rule),
            Latency::SameFrame => self.visible_now(view, candidates, counts, rule),
            Latency::OnGpu => self.visible_on_gpu(view, candidates, counts, rule),
        }
    }

    /// `counts.previous()`, read by a host node: no stall, the answer one frame old. The newest answer stays in use until a newer one is there.
    fn visible_late(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        rule: SampleRule,
    ) -> VisibleSet {
        let samples = self.graph().host::<Samples>(view.named("latest samples"));
        let mut node = self.graph().host_node(view.named("read late"));
        node.group(CULL);
        let answers = node.read_previous(counts.buffer, counts.asked);
        let samples = node.updates(samples);
        node.run(move |ctx| {
            if let Some(late) = ctx.late(answers) {
                ctx.get_mut(samples)?
                    .take(late.tag, counts.layout, late.bytes);
            }
            Ok(())
        });
        let chosen = self.choose(
            view,
            |node| {
                node.read(candidates).read(samples);
            },
            move |ctx, table, _, verdicts| {
                ctx.get(samples)?
                    .judge(table, &*ctx.get(candidates)?, rule, verdicts);
                Ok(())
            },
        );
        self.shade(view, chosen)
    }

    /// `counts`, read by a host node: a sync point.
    fn visible_now(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        rule: SampleRule,
    ) -> VisibleSet {
        let mut samples = Samples::default();
        let chosen = self.choose(
            view,
            |node| {
                node.read(candidates)
                    .read(counts.asked)
                    .read_back(counts.buffer);
            },
            move |ctx, table, _, verdicts| {
                samples.take(
                    &*ctx.get(counts.asked)?,
                    counts.layout,
                    ctx.bytes(counts.buffer)?,
                );
                samples.judge(table, &*ctx.get(candidates)?, rule, verdicts);
                Ok(())
            },
        );
        self.shade(view, chosen)
    }
}
