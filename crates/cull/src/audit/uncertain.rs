//! Entities that a threshold on the GPU may have left out although they are visible. The host does not know a frame's own counts, so it goes by those of an
//! earlier frame. This decides only where the audit samples more densely, and how much it may draw.

use antumbra_graph::Host;

use super::AUDIT;
use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::samples::Samples;
use crate::strategy::VerdictSource;
use crate::view_nodes::ViewNodes;

/// Counts of an earlier frame, and the threshold that follows from them for this frame.
#[derive(Debug, Clone, Default)]
pub(super) struct UncertainEntities {
    samples: Samples,
    threshold: u32,
    /// The threshold if counts have changed since: the highest that is plausible.
    highest: u32,
}

/// Counts of an earlier frame differ from this frame's: an entity that the adaptive threshold would have left out with this many times the allowance is uncertain.
/// An entity that is left out on a patch without uncertain entities is sampled seldom, and weighs heavily when it is.
const UNSURE: u64 = 2;

impl UncertainEntities {
    /// How much is drawn by an earlier frame's counts, with `size` the size of each entity. Of the entities without a count the same part is drawn as of those with one.
    /// `None` where no entity has a count.
    pub fn drawn(&self, candidates: &Candidates, size: impl Fn(u32) -> f64) -> Option<f64> {
        let inside = candidates.inside().iter().copied();
        let (exempt, tested): (Vec<u32>, Vec<u32>) =
            inside.partition(|slot| candidates.is_exempt(*slot));
        let tested = tested.into_iter().map(|slot| {
            let count = self.samples.get(slot);
            (size(slot), count.map(|count| count > self.threshold))
        });
        Some(exempt.into_iter().map(&size).sum::<f64>() + drawn_part(tested)?)
    }

    /// Entities with visible samples, but fewer than the highest plausible threshold.
    pub fn may_be_left_out<'a>(
        &'a self,
        candidates: &'a Candidates,
    ) -> impl Iterator<Item = u32> + 'a {
        // Counts from before a camera cut say nothing about the view after it.
        let cuts = candidates.stamp().cuts;
        let known = self.samples.stamp().is_some_and(|stamp| stamp.cuts == cuts);
        let inside = candidates.inside().iter().copied();
        inside.filter(move |slot| {
            let count = self.samples.get(*slot).unwrap_or(0);
            known && count > 0 && count <= self.highest
        })
    }
}

/// The size of all that is drawn, where for some it is not known whether they are: of these the same part is taken as of the others. `None` where it is known of none.
fn drawn_part(tested: impl Iterator<Item = (f64, Option<bool>)>) -> Option<f64> {
    let (mut all, mut counted, mut drawn) = (0.0, 0.0, 0.0);
    for (size, known) in tested {
        all += size;
        if let Some(draws) = known {
            counted += size;
            drawn += if draws { size } else { 0.0 };
        }
    }
    (counted > 0.0).then(|| all * drawn / counted)
}

impl FrameGraph<'_> {
    /// The entities that are uncertain by an earlier frame's counts; `None` where the host knows this frame's own.
    pub(super) fn uncertain(
        &mut self,
        view: &ViewNodes,
        source: VerdictSource,
    ) -> Option<Host<UncertainEntities>> {
        let VerdictSource::Gpu {
            candidates,
            queried,
            counts,
            layout,
            rule,
            adapted,
        } = source
        else {
            return None;
        };
        let uncertain = self
            .graph()
            .host::<UncertainEntities>(view.named("audit: uncertain entities"));
        let mut node = self
            .graph()
            .host_node(view.named("audit: find uncertain entities"));
        node.group(AUDIT).read(candidates);
        let allowed = adapted.map(|adapted| adapted.allowed);
        if let Some(allowed) = allowed {
            node.read(allowed);
        }
        let answers = node.read_previous(counts, queried);
        let uncertain = node.updates(uncertain);
        node.run(move |ctx| {
            let mut known = ctx.get_mut(uncertain)?;
            if let Some(late) = ctx.late(answers) {
                known.samples.take(late.tag, layout, late.bytes);
            }
            let candidates = ctx.get(candidates)?;
            let allowed = match allowed {
                Some(allowed) => ctx.get(allowed)?.samples,
                None => 0,
            };
            let within = |allowed| match allowed {
                0 => rule.threshold,
                _ => rule
                    .threshold
                    .max(known.samples.highest_threshold(&candidates, allowed)),
            };
            (known.threshold, known.highest) = (within(allowed), within(allowed * UNSURE));
            Ok(())
        });
        Some(uncertain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_what_was_not_counted_as_large_a_part_is_drawn_as_of_what_was() {
        let tested = [(6.0, Some(true)), (18.0, Some(false)), (40.0, None)];
        assert_eq!(drawn_part(tested.into_iter()), Some(16.0));
        assert_eq!(drawn_part(tested.into_iter().skip(2)), None);
        assert_eq!(drawn_part(tested.into_iter().take(2)), Some(6.0));
    }
}
