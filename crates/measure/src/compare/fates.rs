//! Entities that a strategy lost for good: they own pixels of the reference, and it never drew them where they do.

use std::collections::BTreeMap;

use antumbra_cull::SceneTable;
use antumbra_scene::{EntityKey, Scene};
use antumbra_verify::{Differences, IdBuffer};

use crate::report::LostEntities;

/// The most lost entities that are named.
const NAMED: usize = 5;

/// An entity that owns samples of one view.
#[derive(Debug, Clone, Copy)]
pub struct SeenEntity {
    slot: u32,
    entity: EntityKey,
    samples: u32,
}

impl SeenEntity {
    /// All of them in an image, by slot.
    pub fn all(table: &SceneTable, ids: &IdBuffer) -> Vec<Self> {
        let counts = (0u32..).zip(ids.samples_by_slot());
        let seen = counts.filter(|(_, samples)| *samples > 0);
        seen.filter_map(|(slot, samples)| {
            Some(Self {
                slot,
                entity: table.occupant(slot)?.key,
                samples,
            })
        })
        .collect()
    }
}

/// What became of each entity that owned a sample so far.
#[derive(Debug, Default)]
pub struct Fates(BTreeMap<EntityKey, Fate>);

#[derive(Debug, Default)]
struct Fate {
    samples: u64,
    /// Whether it was drawn, or tied with what was, in any pose in which it owned a sample.
    shown: bool,
}

impl Fates {
    /// Adds one view of one pose.
    pub fn note(&mut self, seen: &[SeenEntity], found: &Differences) {
        let has = |slots: &[u32], slot: u32| slots.binary_search(&slot).is_ok();
        for one in seen {
            let fate = self.0.entry(one.entity).or_default();
            fate.samples += u64::from(one.samples);
            fate.shown |= !has(&found.undrawn, one.slot) || has(&found.tied, one.slot);
        }
    }

    /// The entities that were never shown.
    pub fn lost(&self, scene: &Scene) -> LostEntities {
        let lost = self.0.iter().filter(|(_, fate)| !fate.shown);
        let mut lost: Vec<(EntityKey, u64)> =
            lost.map(|(key, fate)| (*key, fate.samples)).collect();
        lost.sort_by(|(a, more), (b, less)| less.cmp(more).then(a.cmp(b)));
        let named = lost.iter().take(NAMED);
        LostEntities {
            entities: lost.len() as u64,
            of: self.0.len() as u64,
            named: named.map(|(key, _)| scene.describe(*key)).collect(),
        }
    }
}
