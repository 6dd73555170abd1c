//! What a count of visible samples decides: whether an entity is drawn, and at which level of detail.

use crate::dial::Dial;

/// What a count of visible samples decides about an entity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SampleRule {
    /// The entity is drawn when its visible samples exceed this.
    pub threshold: u32,
    /// With at most this many samples it is drawn one level of detail coarser, with at most a quarter of them two levels, with a sixteenth three.
    /// 0: everything is drawn at full detail. Blended entities always are.
    pub coarser: u32,
}

impl SampleRule {
    /// Levels of detail that a rule may choose from.
    pub const LEVELS: u8 = 4;

    /// The level of detail for a count of visible samples; 0 is the full mesh.
    pub fn level(self, samples: u32) -> u8 {
        (0..Self::LEVELS)
            .rev()
            .find(|level| samples <= self.most(*level))
            .unwrap_or(0)
    }

    /// The most samples with which an entity is drawn at this level or a coarser one.
    pub fn most(self, level: u8) -> u32 {
        match level {
            0 => u32::MAX,
            _ => self.coarser >> (2 * (u32::from(level) - 1)).min(31),
        }
    }
}

impl From<u32> for SampleRule {
    /// A threshold alone: everything is drawn at full detail.
    fn from(threshold: u32) -> Self {
        Self {
            threshold,
            coarser: 0,
        }
    }
}

/// How much visible area a frame may leave out: the entities with the fewest visible samples, as many as cover no more than this part of the image.
#[derive(Debug, Clone, Default)]
pub struct Allowance {
    /// The part, in percent of the image; 0: none.
    pub percent: Dial,
    /// Samples of the image that is counted in: its pixels, times the samples of each.
    pub image_samples: u32,
}

impl Allowance {
    /// No entity with more visible samples than this is left out, however large the allowance: a viewer would miss an object of that size.
    pub const LARGEST: u32 = 1024;

    /// Whether it allows anything now.
    pub(crate) fn allows(&self) -> bool {
        self.percent.get() > 0.0
    }

    /// In samples.
    pub(crate) fn samples(&self) -> u64 {
        (f64::from(self.percent.get()) / 100.0 * f64::from(self.image_samples)).max(0.0) as u64
    }

    /// The same allowance, for a node's body.
    pub(crate) fn shared(&self) -> Self {
        Self {
            percent: self.percent.shared(),
            image_samples: self.image_samples,
        }
    }
}

/// A rule, and the allowance that may raise its threshold.
#[derive(Debug)]
pub(crate) struct Selection {
    pub rule: SampleRule,
    pub allowance: Allowance,
}

/// The highest threshold at which the entities at or below it cover at most `allowed` samples. It is the count of the largest of these entities and no more: an
/// entity of a later frame may have a count in between.
pub(crate) fn highest_threshold(counts: impl Iterator<Item = u32>, allowed: u64) -> u32 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_are_left_out_first_and_no_more_than_is_allowed() {
        let counts = || [5, 3, 3, 0, 900, 1, 7, 2000].into_iter();
        let left_out = |allowed| {
            let threshold = highest_threshold(counts(), allowed);
            let below = counts().filter(|count| *count <= threshold);
            below.map(u64::from).sum::<u64>()
        };
        assert_eq!(
            [0, 1, 6, 7, 11, 12, 19, 918].map(left_out),
            [0, 1, 1, 7, 7, 12, 19, 19]
        );
        assert_eq!(left_out(919), 919);
        assert_eq!(highest_threshold(counts(), 100), 7);
        // What is as large as that is never left out.
        assert_eq!(left_out(u64::MAX), 919);
    }
}
