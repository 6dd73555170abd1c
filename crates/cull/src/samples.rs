//! Visible samples by slot, however they were counted, and the verdicts that follow from them.

use crate::candidates::{Candidates, Queried, Stamp};
use crate::count_layout::CountLayout;
use crate::entities::SceneTable;
use crate::sample_rule::{SampleRule, Selection, highest_threshold};
use crate::verdict::{Verdict, Verdicts};

/// Visible samples by slot.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    of: Vec<u32>,
    /// When they were queried; `None` before the first answer.
    stamp: Option<Stamp>,
    queries: u32,
    /// The size of the view that they were counted for.
    size: [u32; 2],
}

/// The count of a slot that was not tested.
const NOT_TESTED: u32 = u32::MAX;

impl Samples {
    /// Replaces all counts by an answer: the counts of the slots that were tested.
    pub fn take(&mut self, queried: &Queried, layout: CountLayout, bytes: &[u8]) {
        self.of.clear();
        let slots = queried
            .slots
            .iter()
            .max()
            .map_or(0, |most| *most as usize + 1);
        self.of.resize(slots, NOT_TESTED);
        self.stamp = Some(queried.stamp);
        self.queries = queried.queries();
        for (slot, query) in queried.by_query() {
            let count = layout.count(bytes, slot, query.number);
            if let (Some(place), Some(count)) = (self.of.get_mut(slot as usize), count) {
                *place = count.min(NOT_TESTED - 1);
            }
        }
    }

    /// Notes the size of the view that the counts are for.
    pub(crate) fn counted_for(&mut self, size: [u32; 2]) {
        self.size = size;
    }

    /// As [`Self::judge_within`], for a view of this size. Counts for another size say no more than whether anything was visible.
    pub(crate) fn judge_at(
        &self,
        table: &SceneTable,
        candidates: &Candidates,
        selection: &Selection,
        size: [u32; 2],
        verdicts: &mut Verdicts,
    ) {
        match self.size == size {
            true => self.judge_within(table, candidates, selection, verdicts),
            false => {
                let any = SampleRule {
                    threshold: 0,
                    coarser: 0,
                };
                self.judge(table, candidates, any, verdicts);
            }
        }
    }

    /// The count of a slot, if it was tested.
    pub fn get(&self, slot: u32) -> Option<u32> {
        self.of
            .get(slot as usize)
            .copied()
            .filter(|count| *count != NOT_TESTED)
    }

    /// As [`Self::judge`], with the highest threshold that an allowance permits.
    pub(crate) fn judge_within(
        &self,
        table: &SceneTable,
        candidates: &Candidates,
        selection: &Selection,
        verdicts: &mut Verdicts,
    ) {
        let threshold = self.threshold_within(candidates, selection);
        let rule = SampleRule {
            threshold,
            ..selection.rule
        };
        self.judge(table, candidates, rule, verdicts);
        verdicts.share_left_out_of(selection.allowance.image_samples);
    }

    /// The threshold of the rule, or a higher one that keeps within the allowance.
    fn threshold_within(&self, candidates: &Candidates, selection: &Selection) -> u32 {
        let own = selection.rule.threshold;
        let allowed = selection.allowance.samples();
        if allowed == 0 {
            return own;
        }
        own.max(self.highest_threshold(candidates, allowed))
    }

    /// The highest threshold at which the candidates at or below it have at most `allowed` samples together.
    pub(crate) fn highest_threshold(&self, candidates: &Candidates, allowed: u64) -> u32 {
        let testable = candidates.testable();
        highest_threshold(testable.filter_map(|slot| self.get(slot)), allowed)
    }

    /// When these counts were queried; `None` before the first answer.
    pub(crate) fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// Gives every entity a verdict. An entity without a trustworthy answer is drawn at full detail.
    pub fn judge(
        &self,
        table: &SceneTable,
        candidates: &Candidates,
        rule: SampleRule,
        verdicts: &mut Verdicts,
    ) {
        verdicts.reset_outside(table);
        verdicts.add_tested(self.queries);
        let now = candidates.stamp();
        let answer = self.stamp.filter(|stamp| stamp.cuts == now.cuts);
        for slot in candidates.inside() {
            let added = table
                .occupant(*slot)
                .map_or(u64::MAX, |occupant| occupant.added_epoch);
            let verdict = match (answer, self.get(*slot)) {
                _ if candidates.is_near(*slot) => {
                    if !table.is_tested(*slot) {
                        verdicts.note(*slot, true);
                    }
                    Verdict::Untested
                }
                (Some(answer), _) if added > answer.epoch => Verdict::New,
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
                        let coarsest = table.levels_of(*slot) - 1;
                        verdicts.set_level(*slot, rule.level(count).min(coarsest));
                    }
                    Verdict::Visible
                }
                _ => Verdict::Untested,
            };
            verdicts.set(*slot, verdict);
        }
    }
}
