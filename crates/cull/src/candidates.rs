//! Candidates: the entities in a view's frustum, and which of them must not be tested.

use std::sync::Arc;

use crate::entities::SceneTable;
use crate::view::ViewFrame;

/// The entities that a strategy chooses from, for one view and frame.
#[derive(Debug, Clone, Default)]
pub struct Candidates {
    inside: Vec<u32>,
    near: Vec<u32>,
    exempt: Vec<u32>,
    stamp: Stamp,
}

/// When a query was made: what an answer is checked against before it is used.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Stamp {
    /// The scene's epoch.
    pub epoch: u64,
    /// The number of camera cuts of the view so far.
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

    /// Becomes the part of `others` that `keep` leaves, in any order. Slots that `keep` adds are dropped.
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

    /// Slots that are not among `others`, ascending.
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

    /// Slots that cross the near plane, ascending: they count as visible, since a test would see clipped proxies.
    pub fn near(&self) -> &[u32] {
        &self.near
    }

    /// Whether a slot crosses the near plane.
    pub fn is_near(&self, slot: u32) -> bool {
        self.near.binary_search(&slot).is_ok()
    }

    /// Slots that are drawn without a test, ascending: they cross the near plane, or the scene exempts them.
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

/// What was tested. Travels with the answer, so that the answer can be matched with the present frame.
#[derive(Debug, Clone, Default)]
pub struct Queried {
    /// When it was tested.
    pub stamp: Stamp,
    /// The slots that were tested; with hardware queries, in the order of the queries.
    pub slots: Arc<Vec<u32>>,
    /// With hardware queries that test several slots each: the end of each query's slots. Empty: a query a slot.
    pub ends: Arc<Vec<u32>>,
}

impl Queried {
    /// All of these candidates, tested without hardware queries.
    pub fn all(candidates: &Candidates) -> Self {
        Self {
            stamp: candidates.stamp(),
            slots: Arc::new(candidates.inside().to_vec()),
            ends: Arc::default(),
        }
    }

    /// The number of hardware queries.
    pub fn queries(&self) -> u32 {
        match self.ends.len() {
            0 => self.slots.len() as u32,
            joined => joined as u32,
        }
    }

    /// Each slot with the query that tests it, in the order of the queries.
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
    /// Its number, in the order of issue.
    pub number: u32,
    /// How many slots it tests.
    pub slots: u32,
}
