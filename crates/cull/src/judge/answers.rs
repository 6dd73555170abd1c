//! Answers on the host, a frame late: which instances a test has found hidden.

use antumbra_graph::Late;

use super::depth::DepthRange;
use super::eye::Eye;
use super::instances::Instances;
use super::record::Part;
use crate::verdict::{Verdict, Verdicts};

/// When a test was made: travels with its answers.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Asked {
    pub epoch: u64,
    pub cuts: u64,
}

/// What a test has found hidden, as it was found: see [`Judge::hidden`](super::Judge::hidden).
#[derive(Debug, Clone, Copy)]
pub struct Hidden<'a> {
    /// The frame that the test was about.
    pub frame: u64,
    words: &'a [u32],
}

impl<'a> Hidden<'a> {
    /// Whether the instance that had an index in that frame was hidden. One that was outside of the view was not.
    pub fn contains(&self, index: u32) -> bool {
        let word = self.words.get(index as usize / 32).copied().unwrap_or(0);
        word >> (index % 32) & 1 != 0
    }

    /// The bits by index, 32 a word; what lies beyond the end is not hidden.
    pub fn words(&self) -> &'a [u32] {
        self.words
    }
}

/// The newest answers of a view that have arrived.
#[derive(Debug, Default)]
pub(super) struct Answers {
    asked: Option<Asked>,
    frame: Option<u64>,
    hidden: Vec<u32>,
}

impl Answers {
    /// Takes over a mask that has arrived.
    pub fn take(&mut self, late: &Late<'_, Asked>) {
        self.asked = Some(*late.tag);
        self.frame = Some(late.frame);
        self.hidden = bytemuck::pod_collect_to_vec(late.bytes);
    }

    /// The frame that they are about.
    pub fn frame(&self) -> Option<u64> {
        self.frame
    }

    /// What was hidden, unless the camera was cut since.
    pub fn hidden(&self, cuts: u64) -> Option<Hidden<'_>> {
        self.asked.filter(|asked| asked.cuts == cuts)?;
        Some(Hidden {
            frame: self.frame?,
            words: &self.hidden,
        })
    }

    /// Gives every instance a verdict for an eye of now. `inside` is memory for indices.
    pub fn judge(
        &self,
        instances: &mut Instances,
        eye: &Eye,
        range: DepthRange,
        cuts: u64,
        inside: &mut Vec<u32>,
        verdicts: &mut Verdicts,
    ) {
        verdicts.reset(instances.slots(), Verdict::Absent);
        for index in (0..instances.slots()).filter(|index| instances.at(*index).is_some()) {
            verdicts.set(index, Verdict::OutsideFrustum);
        }
        inside.clear();
        if let Some(world) = instances.world() {
            eye.frustum().cull(world, inside);
        }
        let asked = self.asked.filter(|asked| asked.cuts == cuts);
        let hidden = self.hidden(cuts);
        let is_hidden = |index| hidden.is_some_and(|hidden| hidden.contains(index));
        for index in inside.iter().copied() {
            let Some((part, added)) = instances.part(index) else {
                continue;
            };
            let verdict = match (part, asked) {
                (Part::Occluder | Part::Exempt, _) | (_, None) => Verdict::Untested,
                (_, Some(asked)) if added > asked.epoch => Verdict::New,
                _ if !is_hidden(index) => Verdict::Visible,
                _ => match instances.bounds(index) {
                    Some(bounds) if !eye.reaches_near(&bounds, range) => Verdict::Occluded,
                    _ => Verdict::Untested,
                },
            };
            verdicts.set(index, verdict);
        }
    }
}
