//! Visible samples by slot, from whichever way of counting, and the judgement they lead to.

use antumbra_draw::SceneTable;

use crate::candidates::{Candidates, Queried, Query, Stamp};
use crate::dial::Dial;
use crate::verdict::{Verdict, Verdicts};

/// How a buffer of counts is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CountLayout {
    /// A u32 a slot.
    BySlot,
    /// A u64 a query, in the order of [`Queried::slots`]: zero, or anything else for "at least one sample".
    ByQuery,
}

impl CountLayout {
    /// Each slot that was asked about, its query, and whether any sample was visible; slots whose answer the bytes do not hold are
    /// left out.
    pub fn answers<'a>(
        self,
        asked: &'a Queried,
        bytes: &'a [u8],
    ) -> impl Iterator<Item = (u32, Query, bool)> + 'a {
        let slots = asked.by_query();
        slots.filter_map(move |(slot, query)| {
            Some((slot, query, self.count(bytes, slot, query.number)? > 0))
        })
    }

    /// The count of a slot whose question was the so-manieth.
    fn count(self, bytes: &[u8], slot: u32, query: u32) -> Option<u32> {
        match self {
            Self::BySlot => word(bytes, slot as usize * 4),
            // Boolean by contract, though some drivers count.
            Self::ByQuery => word(bytes, query as usize * 8).map(|low| {
                let high = word(bytes, query as usize * 8 + 4).unwrap_or(0);
                u32::from(low != 0 || high != 0)
            }),
        }
    }
}

/// Visible samples by slot.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    of: Vec<u32>,
    asked: Option<Stamp>,
    questions: u32,
}

/// What a count of visible samples earns an entity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SampleRule {
    /// It is drawn when its visible samples exceed this.
    pub threshold: u32,
    /// With at most this many it is drawn one level of detail coarser, with at most a quarter of them two, a sixteenth three;
    /// 0: whatever is drawn is drawn in full. What is blended always is.
    pub coarser: u32,
}

impl SampleRule {
    /// Levels of detail that a rule may choose from.
    pub const LEVELS: u8 = 4;

    /// The level that a count of visible samples earns.
    pub fn level(self, samples: u32) -> u8 {
        (0..Self::LEVELS)
            .rev()
            .find(|level| samples <= self.most(*level))
            .unwrap_or(0)
    }

    /// The most samples that earn this level or a coarser one.
    pub fn most(self, level: u8) -> u32 {
        match level {
            0 => u32::MAX,
            _ => self.coarser >> (2 * (u32::from(level) - 1)).min(31),
        }
    }
}

impl From<u32> for SampleRule {
    /// A threshold alone: whatever is drawn is drawn in full.
    fn from(threshold: u32) -> Self {
        Self {
            threshold,
            coarser: 0,
        }
    }
}

/// How much a frame may leave out that was seen: of those with the fewest visible samples, as many as share no more than a part of the image.
#[derive(Debug, Clone, Default)]
pub struct Allowance {
    /// The part, in percent of the image's pixels; 0: none.
    pub percent: Dial,
    /// Pixels of the image that samples are counted in.
    pub pixels: u32,
}

impl Allowance {
    /// Nobody with more visible samples than this is left out, however much is allowed: a thing of that size is missed.
    pub const LARGEST: u32 = 1024;

    /// Whether it allows anything now.
    pub(crate) fn allows(&self) -> bool {
        self.percent.get() > 0.0
    }

    /// In samples.
    pub(crate) fn samples(&self) -> u64 {
        (f64::from(self.percent.get()) / 100.0 * f64::from(self.pixels)).max(0.0) as u64
    }

    /// The same allowance, for a node's body.
    pub(crate) fn shared(&self) -> Self {
        Self {
            percent: self.percent.shared(),
            pixels: self.pixels,
        }
    }
}

/// Stands for a slot that was not asked about.
const NOT_ASKED: u32 = u32::MAX;

impl Samples {
    /// Takes an answer in: the counts of the slots that were asked about.
    pub fn take(&mut self, asked: &Queried, layout: CountLayout, bytes: &[u8]) {
        self.of.clear();
        let slots = asked
            .slots
            .iter()
            .max()
            .map_or(0, |most| *most as usize + 1);
        self.of.resize(slots, NOT_ASKED);
        self.asked = Some(asked.stamp);
        self.questions = asked.queries();
        for (slot, query) in asked.by_query() {
            let count = layout.count(bytes, slot, query.number);
            if let (Some(place), Some(count)) = (self.of.get_mut(slot as usize), count) {
                *place = count.min(NOT_ASKED - 1);
            }
        }
    }

    /// The count of a slot, if it was asked about.
    pub fn get(&self, slot: u32) -> Option<u32> {
        self.of
            .get(slot as usize)
            .copied()
            .filter(|count| *count != NOT_ASKED)
    }

    /// As [`Self::judge`], with a threshold as high as an allowance lets it be: all that it leaves out has no more visible samples together.
    pub fn judge_within(
        &self,
        table: &SceneTable,
        candidates: &Candidates,
        mut rule: SampleRule,
        allowance: &Allowance,
        verdicts: &mut Verdicts,
    ) {
        rule.threshold = self.highest_within(candidates, rule, allowance.samples());
        self.judge(table, candidates, rule, verdicts);
        verdicts.share_left_out_of(allowance.pixels);
    }

    /// The threshold of a rule, or as high a one as lets so many samples be left out.
    pub(crate) fn highest_within(
        &self,
        candidates: &Candidates,
        rule: SampleRule,
        allowed: u64,
    ) -> u32 {
        if allowed == 0 {
            return rule.threshold;
        }
        let counts = candidates.inside().iter().filter_map(|slot| {
            let judged = !candidates.is_exempt(*slot);
            self.get(*slot).filter(|_| judged)
        });
        rule.threshold.max(highest(counts, allowed))
    }

    /// When the question was asked; `None` before any answer.
    pub(crate) fn asked(&self) -> Option<Stamp> {
        self.asked
    }

    /// Judges every entity: what has no trustworthy answer is drawn, and in full.
    pub fn judge(
        &self,
        table: &SceneTable,
        candidates: &Candidates,
        rule: SampleRule,
        verdicts: &mut Verdicts,
    ) {
        outside(table, verdicts);
        verdicts.add_tested(self.questions);
        let now = candidates.stamp();
        let asked = self.asked.filter(|asked| asked.cuts == now.cuts);
        for slot in candidates.inside() {
            let born = table
                .occupant(*slot)
                .map_or(u64::MAX, |occupant| occupant.added_epoch);
            let verdict = match (asked, self.get(*slot)) {
                _ if candidates.is_near(*slot) => {
                    if !table.is_tested(*slot) {
                        verdicts.note(*slot, true);
                    }
                    Verdict::Untested
                }
                (Some(asked), _) if born > asked.epoch => Verdict::New,
                (Some(_), count) if !table.is_tested(*slot) => {
                    if let Some(count) = count {
                        verdicts.note(*slot, count > 0);
                    }
                    Verdict::Untested
                }
                (Some(_), Some(0)) => Verdict::Occluded,
                (Some(_), Some(count)) if count <= rule.threshold => {
                    verdicts.leave_out(count);
                    Verdict::BelowThreshold
                }
                (Some(_), Some(count)) => {
                    if rule.coarser > 0 && !table.is_transparent(*slot) {
                        verdicts
                            .set_level(*slot, rule.level(count).min(table.levels_of(*slot) - 1));
                    }
                    Verdict::Visible
                }
                _ => Verdict::Untested,
            };
            verdicts.set(*slot, verdict);
        }
    }
}

/// The threshold at which as many as possible share no more than is allowed: as many samples as the largest of them has and no more, for whoever goes by
/// it a frame later may meet somebody who has.
fn highest(counts: impl Iterator<Item = u32>, allowed: u64) -> u32 {
    let mut having = [0u64; Allowance::LARGEST as usize + 1];
    for count in counts {
        if let Some(number) = having.get_mut(count as usize) {
            *number += 1;
        }
    }
    let mut sum = 0;
    let mut highest = 0;
    for (number, count) in having.iter().zip(0u32..) {
        sum += number * u64::from(count);
        if sum > allowed {
            break;
        }
        if *number > 0 {
            highest = count;
        }
    }
    highest
}

/// Starts verdicts: every entity outside the frustum, until something better is known.
pub fn outside(table: &SceneTable, verdicts: &mut Verdicts) {
    verdicts.reset(table.slots(), Verdict::Absent);
    for slot in table.live_slots() {
        verdicts.set(slot, Verdict::OutsideFrustum);
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    four.try_into().ok().map(u32::from_le_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_are_left_out_first_and_no_more_than_is_allowed() {
        let counts = || [5, 3, 3, 0, 900, 1, 7, 2000].into_iter();
        let left_out = |allowed| {
            let threshold = highest(counts(), allowed);
            let below = counts().filter(|count| *count <= threshold);
            below.map(u64::from).sum::<u64>()
        };
        assert_eq!(
            [0, 1, 6, 7, 11, 12, 19, 918].map(left_out),
            [0, 1, 1, 7, 7, 12, 19, 19]
        );
        assert_eq!(left_out(919), 919);
        assert_eq!(highest(counts(), 100), 7);
        // What is as large as that is never left out.
        assert_eq!(left_out(u64::MAX), 919);
    }
}
