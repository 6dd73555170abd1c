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
    /// As high as the threshold may be if counts are somewhat others now.
    highest: u32,
}

/// An earlier frame's counts are not this one's: whom a adapted threshold would have left out then with so many times as much allowed is doubtful now. One who is left out on a
/// patch that is not doubtful is seldom looked at, and weighs all the more when it is.
const UNSURE: u64 = 2;

impl Doubts {
    /// How much is drawn by an earlier frame's counts, if each entity is as much as `size` says. Of those that were not counted then, as large a part is as of
    /// those that were. `None` where none was.
    pub fn drawn(&self, candidates: &Candidates, size: impl Fn(u32) -> f64) -> Option<f64> {
        let inside = candidates.inside().iter().copied();
        let (sure, judged): (Vec<u32>, Vec<u32>) =
            inside.partition(|slot| candidates.is_exempt(*slot));
        let judged = judged.into_iter().map(|slot| {
            let count = self.samples.get(slot);
            (size(slot), count.map(|count| count > self.threshold))
        });
        Some(sure.into_iter().map(&size).sum::<f64>() + reckon(judged)?)
    }

    /// Entities that had visible samples, and too few of them or hardly enough.
    pub fn may_be_left_out<'a>(
        &'a self,
        candidates: &'a Candidates,
    ) -> impl Iterator<Item = u32> + 'a {
        // What was seen before a cut says nothing about what is seen after it.
        let cuts = candidates.stamp().cuts;
        let known = self.samples.asked().is_some_and(|asked| asked.cuts == cuts);
        let inside = candidates.inside().iter().copied();
        inside.filter(move |slot| {
            let count = self.samples.get(*slot).unwrap_or(0);
            known && count > 0 && count <= self.highest
        })
    }
}

/// How much of some is drawn, by size and whether each was, where that is known: of the others as large a part. `None` where it is known of none.
fn reckon(judged: impl Iterator<Item = (f64, Option<bool>)>) -> Option<f64> {
    let (mut all, mut counted, mut drawn) = (0.0, 0.0, 0.0);
    for (size, known) in judged {
        all += size;
        if let Some(draws) = known {
            counted += size;
            drawn += if draws { size } else { 0.0 };
        }
    }
    (counted > 0.0).then(|| all * drawn / counted)
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
            adapted,
        } = source
        else {
            return None;
        };
        let doubts = self.graph().host::<Doubts>(view.named("audit: doubts"));
        let mut node = self.graph().host_node(view.named("audit: doubt"));
        node.group(AUDIT).read(candidates);
        let allowed = adapted.map(|adapted| adapted.allowed);
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
            let within = |allowed| known.samples.highest_within(&candidates, rule, allowed);
            (known.threshold, known.highest) = (within(allowed), within(allowed * UNSURE));
            Ok(())
        });
        Some(doubts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_what_was_not_counted_as_large_a_part_is_drawn_as_of_what_was() {
        let judged = [(6.0, Some(true)), (18.0, Some(false)), (40.0, None)];
        assert_eq!(reckon(judged.into_iter()), Some(16.0));
        assert_eq!(reckon(judged.into_iter().skip(2)), None);
        assert_eq!(reckon(judged.into_iter().take(2)), Some(6.0));
    }
}
