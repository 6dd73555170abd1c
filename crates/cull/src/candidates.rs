//! Candidates: what of a scene lies in a view's frustum, and what of that no test may judge.

use std::sync::Arc;

use antumbra_draw::{SceneTable, ViewFrame};

/// The entities of one view in one frame that a strategy may choose from.
#[derive(Debug, Clone, Default)]
pub struct Candidates {
    inside: Vec<u32>,
    near: Vec<u32>,
    exempt: Vec<u32>,
    stamp: Stamp,
}

/// When a question was asked: what an answer must be held against before it is believed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Stamp {
    /// The scene's epoch.
    pub epoch: u64,
    /// The view's count of camera cuts.
    pub cuts: u64,
}

impl Candidates {
    /// Finds the entities whose bounds touch the view's frustum.
    pub fn find(&mut self, table: &SceneTable, view: &ViewFrame) {
        self.stamp = Stamp {
            epoch: table.epoch(),
            cuts: view.cuts,
        };
        self.inside.clear();
        self.near.clear();
        view.frustum.cull(table.boxes(), &mut self.inside);
        self.inside.retain(|slot| table.occupant(*slot).is_some());
        self.find_exempt(table, view);
    }

    /// Takes all entities, inside the frustum or not.
    pub fn take_all(&mut self, table: &SceneTable, view: &ViewFrame) {
        self.stamp = Stamp {
            epoch: table.epoch(),
            cuts: view.cuts,
        };
        self.inside.clear();
        self.near.clear();
        self.exempt.clear();
        self.inside.extend(table.live_slots());
    }

    /// Takes over what `keep` leaves of others, in whatever order it leaves them; what it adds is dropped.
    pub fn narrow(&mut self, others: &Self, keep: impl FnOnce(&mut Vec<u32>)) {
        self.stamp = others.stamp;
        self.inside.clear();
        self.inside.extend_from_slice(&others.inside);
        keep(&mut self.inside);
        self.inside.sort_unstable();
        self.inside.dedup();
        let known = |slot: &u32| others.inside.binary_search(slot).is_ok();
        self.inside.retain(known);
        let kept = |slot: &u32| self.inside.binary_search(slot).is_ok();
        self.near.clear();
        self.near.extend(others.near.iter().copied().filter(kept));
        self.exempt.clear();
        self.exempt
            .extend(others.exempt.iter().copied().filter(kept));
    }

    fn find_exempt(&mut self, table: &SceneTable, view: &ViewFrame) {
        let aspect = view.aspect();
        let crosses = |slot: &u32| view.camera.crosses_near(&table.bounds(*slot), aspect);
        self.near
            .extend(self.inside.iter().copied().filter(crosses));
        let (inside, near) = (&self.inside, &self.near);
        let exempt = |slot: &u32| !table.is_tested(*slot) || near.binary_search(slot).is_ok();
        self.exempt.clear();
        self.exempt.extend(inside.iter().copied().filter(exempt));
    }

    /// Slots of these that are not among others, ascending.
    pub fn without<'a>(&'a self, others: &'a Self) -> impl Iterator<Item = u32> + 'a {
        let gone = |slot: &u32| !others.contains(*slot);
        self.inside.iter().copied().filter(gone)
    }

    /// Whether a slot is among them.
    pub fn contains(&self, slot: u32) -> bool {
        self.inside.binary_search(&slot).is_ok()
    }

    /// Slots in the frustum, ascending.
    pub fn inside(&self) -> &[u32] {
        &self.inside
    }

    /// Those of them that reach over the near plane: visible, whatever a test of their clipped proxies would say. Ascending.
    pub fn near(&self) -> &[u32] {
        &self.near
    }

    /// Whether a slot reaches over the near plane.
    pub fn is_near(&self, slot: u32) -> bool {
        self.near.binary_search(&slot).is_ok()
    }

    /// Those that are drawn without a test: they reach over the near plane, or the scene says so. Ascending.
    pub fn exempt(&self) -> &[u32] {
        &self.exempt
    }

    /// Whether a slot is drawn without a test.
    pub fn is_exempt(&self, slot: u32) -> bool {
        self.exempt.binary_search(&slot).is_ok()
    }

    /// Slots in the frustum that a test may judge, ascending.
    pub fn testable(&self) -> impl Iterator<Item = u32> + Clone + '_ {
        self.inside
            .iter()
            .copied()
            .filter(|slot| !self.is_exempt(*slot))
    }

    /// When these were found.
    pub fn stamp(&self) -> Stamp {
        self.stamp
    }
}

/// What was asked: goes along with the answer, so that it can be held against what is asked now.
#[derive(Debug, Clone, Default)]
pub struct Queried {
    /// When.
    pub stamp: Stamp,
    /// The slots that were tested; with hardware queries, in the order of the queries.
    pub slots: Arc<Vec<u32>>,
    /// With hardware queries about several slots each: where each query's slots end. Empty: each slot has its own.
    pub ends: Arc<Vec<u32>>,
}

impl Queried {
    /// How many hardware queries were asked.
    pub fn queries(&self) -> u32 {
        match self.ends.len() {
            0 => self.slots.len() as u32,
            joined => joined as u32,
        }
    }

    /// Each slot with the query that asks about it, in the order of the queries.
    pub fn by_query(&self) -> impl Iterator<Item = (u32, Query)> + '_ {
        let mut number = 0;
        self.slots.iter().zip(0u32..).map(move |(slot, at)| {
            if self.ends.is_empty() {
                let number = at;
                return (*slot, Query { number, slots: 1 });
            }
            while self.ends.get(number).is_some_and(|end| *end <= at) {
                number += 1;
            }
            let end = |at: usize| self.ends.get(at).copied().unwrap_or(0);
            let slots = end(number) - number.checked_sub(1).map_or(0, end);
            let number = number as u32;
            (*slot, Query { number, slots })
        })
    }
}

/// A hardware query.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Query {
    /// Which, in the order of asking.
    pub number: u32,
    /// How many slots it asks about.
    pub slots: u32,
}
