//! From counts to a visible set: one edge of the graph decides whether it takes a frame, a stall, or neither.

use antumbra_graph::Host;

use crate::candidates::Candidates;
use crate::counting::Counts;
use crate::frame_graph::{CULL, FrameGraph};
use crate::latency::Latency;
use crate::samples::{Allowance, SampleRule, Samples};
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
        let none = Allowance::default();
        self.visible_samples_within(view, candidates, counts, latency, rule, &none)
    }

    /// The same with a threshold that each frame is as high as an allowance lets it be by the counts it goes by. On the GPU, where no host sees these, a
    /// compute node turns it; an allowance that stands at 0 when this is declared has none there, and stays without effect.
    pub fn visible_samples_within(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        latency: Latency,
        rule: impl Into<SampleRule>,
        allowance: &Allowance,
    ) -> VisibleSet {
        let rule = rule.into();
        let within = allowance.shared();
        match latency {
            Latency::FrameLate => self.visible_late(view, candidates, counts, (rule, within)),
            Latency::SameFrame => self.visible_now(view, candidates, counts, (rule, within)),
            Latency::OnGpu => self.visible_on_gpu(view, candidates, counts, (rule, within)),
        }
    }

    /// `counts.previous()`, read by a host node: no stall, the answer one frame old. The newest answer stays in use until a newer one is there.
    fn visible_late(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        (rule, within): (SampleRule, Allowance),
    ) -> VisibleSet {
        let samples = self.graph().host::<Samples>(view.named("latest samples"));
        let mut node = self.graph().host_node(view.named("read late"));
        node.group(CULL);
        let answers = node.read_previous(counts.buffer, counts.queried);
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
                let candidates = ctx.get(candidates)?;
                ctx.get(samples)?
                    .judge_within(table, &candidates, rule, &within, verdicts);
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
        (rule, within): (SampleRule, Allowance),
    ) -> VisibleSet {
        let mut samples = Samples::default();
        let chosen = self.choose(
            view,
            |node| {
                node.read(candidates)
                    .read(counts.queried)
                    .read_back(counts.buffer);
            },
            move |ctx, table, _, verdicts| {
                samples.take(
                    &*ctx.get(counts.queried)?,
                    counts.layout,
                    ctx.bytes(counts.buffer)?,
                );
                let candidates = ctx.get(candidates)?;
                samples.judge_within(table, &candidates, rule, &within, verdicts);
                Ok(())
            },
        );
        self.shade(view, chosen)
    }
}
