//! From counts to a visible set. One edge of the graph decides whether that costs a frame of delay, a stall, or neither.

use antumbra_graph::Host;

use crate::candidates::Candidates;
use crate::counting::Counts;
use crate::frame_graph::{CULL, FrameGraph};
use crate::guard::GuardOptions;
use crate::latency::Latency;
use crate::sample_rule::{Allowance, SampleRule, Selection};
use crate::samples::Samples;
use crate::strategy::VisibleSet;
use crate::view_nodes::ViewNodes;

impl FrameGraph<'_> {
    /// Shades the entities that a rule (a number is a threshold) selects by their visible samples. `latency` says which counts are used.
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

    /// The same, with a threshold that each frame is as high as an allowance permits by that frame's counts. On the GPU a compute node finds it; there, an
    /// allowance that is 0 when this is declared has no such node and stays without effect.
    pub fn visible_samples_within(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        latency: Latency,
        rule: impl Into<SampleRule>,
        allowance: &Allowance,
    ) -> VisibleSet {
        let selection = Selection {
            rule: rule.into(),
            allowance: allowance.shared(),
        };
        match latency {
            Latency::FrameLate => {
                self.visible_late(view, candidates, counts, selection, GuardOptions::OFF)
            }
            Latency::SameFrame => self.visible_now(view, candidates, counts, selection),
            Latency::OnGpu => self.visible_on_gpu(view, candidates, counts, selection),
        }
    }

    /// The same with late counts, of which a [guard](crate::guard) confirms what is occluded: what it does not is drawn.
    pub fn visible_samples_guarded(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        rule: impl Into<SampleRule>,
        allowance: &Allowance,
        guard: GuardOptions,
    ) -> VisibleSet {
        let selection = Selection {
            rule: rule.into(),
            allowance: allowance.shared(),
        };
        self.visible_late(view, candidates, counts, selection, guard)
    }

    /// `counts.previous()`, read by a host node: no stall, the answer is as many frames old as there are in flight. The newest answer stays in use until a newer one arrives.
    fn visible_late(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        selection: Selection,
        guard: GuardOptions,
    ) -> VisibleSet {
        let mut guard = self.begin_guard(view, guard);
        // After a resize the latest samples are still those of the size before.
        let size = view.size();
        let samples = self.graph().host::<Samples>(view.named("latest samples"));
        let mut node = self.graph().host_node(view.named("read previous results"));
        node.group(CULL);
        let answers = node.read_previous(counts.buffer, counts.queried);
        let samples = node.updates(samples);
        node.run(move |ctx| {
            if let Some(late) = ctx.late(answers) {
                let mut samples = ctx.get_mut(samples)?;
                samples.take(late.tag, counts.layout, late.bytes);
                samples.counted_for(size);
            }
            Ok(())
        });
        let chosen = self.choose_with(
            view,
            |node| {
                node.read(candidates).read(samples);
                guard.as_mut().map(|guard| guard.updated_by(node))
            },
            move |ctx, guard, table, _, verdicts| {
                let candidates = ctx.get(candidates)?;
                ctx.get(samples)?
                    .judge_at(table, &candidates, &selection, size, verdicts);
                if let Some(guard) = guard {
                    let inside = candidates.inside().iter().copied();
                    ctx.get_mut(*guard)?.confirm(table, inside, verdicts);
                }
                Ok(())
            },
        );
        let shown = self.shade(view, chosen);
        self.end_guard(view, guard);
        shown
    }

    /// `counts`, read by a host node: a sync point.
    fn visible_now(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        selection: Selection,
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
                samples.judge_within(table, &candidates, &selection, verdicts);
                Ok(())
            },
        );
        self.shade(view, chosen)
    }
}
