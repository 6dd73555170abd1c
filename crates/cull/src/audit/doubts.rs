//! Where a threshold may have left out what was seen, and how much is drawn, as far as the host can tell of a frame that was chosen on the GPU: by the counts
//! of an earlier one. It decides where the audit looks more often and how much at all, and nothing else.

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
    /// How much is drawn by an earlier frame's counts, if each entity is as much as `size` says. Of those that were not counted then, as large a part is as of
    /// those that were. `None` where none was.
    pub fn drawn(&self, candidates: &Candidates, size: impl Fn(u32) -> f64) -> Option<f64> {
        let (mut sure, mut counted, mut enough, mut new) = (0.0, 0.0, 0.0, 0.0);
        for &slot in candidates.inside() {
            let size = size(slot);
            match self.samples.get(slot) {
                _ if candidates.is_exempt(slot) => sure += size,
                None => new += size,
                Some(count) => {
                    counted += size;
                    if count > self.threshold {
                        enough += size;
                    }
                }
            }
        }
        (counted > 0.0).then(|| sure + enough + new * enough / counted)
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
    /// What an earlier frame's counts say; `None` where the host knows this one's.
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
