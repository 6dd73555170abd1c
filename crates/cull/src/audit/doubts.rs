//! Where a threshold may have left out what was seen, as far as the host can tell of a frame that was chosen on the GPU: by the counts of an earlier one. It
//! decides where the audit looks more often, and nothing else.

use antumbra_graph::Host;

use super::AUDIT;
use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::samples::Samples;
use crate::strategy::VerdictSource;
use crate::view_nodes::ViewNodes;

/// Counts of an earlier frame, and the threshold that this one may have by them.
#[derive(Debug, Clone, Default)]
pub(super) struct Doubts {
    samples: Samples,
    threshold: u32,
}

impl Doubts {
    /// Who of some is drawn by an earlier frame's counts; `None` before there are any.
    pub fn drawn<'a>(
        &'a self,
        candidates: &'a Candidates,
    ) -> Option<impl Iterator<Item = u32> + 'a> {
        self.samples.asked()?;
        let inside = candidates.inside().iter().copied();
        let enough = |slot: &u32| {
            let count = self.samples.get(*slot);
            count.is_none_or(|count| count > self.threshold)
        };
        Some(inside.filter(move |slot| candidates.is_exempt(*slot) || enough(slot)))
    }

    /// Entities that had visible samples, and too few of them.
    pub fn left_out<'a>(&'a self, candidates: &'a Candidates) -> impl Iterator<Item = u32> + 'a {
        // What was seen before a cut says nothing about what is seen after it.
        let cuts = candidates.stamp().cuts;
        let known = self.samples.asked().is_some_and(|asked| asked.cuts == cuts);
        let inside = candidates.inside().iter().copied();
        inside.filter(move |slot| {
            let count = self.samples.get(*slot).unwrap_or(0);
            known && count > 0 && count <= self.threshold
        })
    }
}

impl FrameGraph<'_> {
    /// What was left out by an earlier frame's counts; `None` where the host knows this one's, or nothing is left out by any.
    pub(super) fn doubts(
        &mut self,
        view: &ViewNodes,
        source: VerdictSource,
    ) -> Option<Host<Doubts>> {
        let VerdictSource::Gpu {
            candidates,
            asked,
            counts,
            layout,
            rule,
            turned,
        } = source
        else {
            return None;
        };
        if turned.is_none() && rule.threshold == 0 {
            return None;
        }
        let doubts = self.graph().host::<Doubts>(view.named("audit: doubts"));
        let mut node = self.graph().host_node(view.named("audit: doubt"));
        node.group(AUDIT).read(candidates);
        let allowed = turned.map(|turned| turned.allowed);
        if let Some(allowed) = allowed {
            node.read(allowed);
        }
        let answers = node.read_previous(counts, asked);
        let doubts = node.updates(doubts);
        node.run(move |ctx| {
            let mut known = ctx.get_mut(doubts)?;
            if let Some(late) = ctx.late(answers) {
                known.samples.take(late.tag, layout, late.bytes);
            }
            let candidates = ctx.get(candidates)?;
            let allowed = match allowed {
                Some(allowed) => ctx.get(allowed)?.samples,
                None => 0,
            };
            known.threshold = known.samples.highest_within(&candidates, rule, allowed);
            Ok(())
        });
        Some(doubts)
    }
}
