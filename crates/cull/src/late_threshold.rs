//! A threshold for sets that are chosen on the GPU, as high as an allowance lets it be: by the counts of an earlier frame, which the host reads without
//! waiting. This frame's own counts then decide against it.

use antumbra_graph::Host;

use crate::candidates::{Candidates, Stamp};
use crate::counting::Counts;
use crate::frame_graph::{CULL, FrameGraph};
use crate::samples::{Allowance, CountLayout, SampleRule, Samples};
use crate::view_nodes::ViewNodes;

/// The threshold of a frame, and what it was found from.
#[derive(Debug, Clone, Default)]
pub(crate) struct LateThreshold {
    samples: Samples,
    /// Visible samples that an entity needs more than.
    pub threshold: u32,
    /// What it leaves out by those counts, in percent of the image; `None` before there were any.
    pub left_out: Option<f64>,
}

impl LateThreshold {
    /// Entities that had visible samples, and too few of them.
    pub fn left_out<'a>(&'a self, candidates: &'a Candidates) -> impl Iterator<Item = u32> + 'a {
        let inside = candidates.inside().iter().copied();
        let too_few = |slot: &u32| {
            let count = self.samples.get(*slot).unwrap_or(0);
            count > 0 && count <= self.threshold
        };
        inside.filter(too_few)
    }

    fn find(&mut self, candidates: &Candidates, rule: SampleRule, within: &Allowance, now: Stamp) {
        (self.threshold, self.left_out) = (rule.threshold, None);
        // What was seen before a cut says nothing about what is seen after it.
        if self
            .samples
            .asked()
            .is_some_and(|asked| asked.cuts == now.cuts)
        {
            let (threshold, left_out) = self.samples.highest_within(candidates, rule, within);
            (self.threshold, self.left_out) = (threshold, Some(left_out));
        }
    }
}

impl FrameGraph<'_> {
    /// Finds each frame's threshold from the counts of an earlier one, by slot.
    pub(crate) fn late_threshold(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        by_slot: Counts,
        (rule, within): (SampleRule, Allowance),
    ) -> Host<LateThreshold> {
        let late = self.graph().host::<LateThreshold>(view.named("threshold"));
        let mut node = self.graph().host_node(view.named("turn threshold"));
        node.group(CULL).read(candidates);
        let answers = node.read_previous(by_slot.buffer, by_slot.asked);
        let late = node.updates(late);
        node.run(move |ctx| {
            let mut known = ctx.get_mut(late)?;
            if let Some(late) = ctx.late(answers) {
                known
                    .samples
                    .take(late.tag, CountLayout::BySlot, late.bytes);
            }
            let candidates = ctx.get(candidates)?;
            known.find(&candidates, rule, &within, candidates.stamp());
            Ok(())
        });
        late
    }
}
