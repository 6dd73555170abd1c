//! The order and geometry of a list of visibility tests.

use antumbra_cull::{DrawList, MeshDetail, SceneTable, ViewFrame, query_detail};

/// The test of one entity. Tests are sorted by these fields, in this order, so that entries drawn alike are neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct EntityTest {
    batch: u32,
    /// Whether the box is drawn instead of the mesh.
    boxed: bool,
    /// Whether it may share a query with its neighbours.
    may_share: bool,
    slot: u32,
}

impl EntityTest {
    /// Whether two neighbours may share a query: both allow it, and they are drawn alike.
    pub fn may_share_with(&self, other: &Self) -> bool {
        self.may_share && other.may_share && (self.batch, self.boxed) == (other.batch, other.boxed)
    }
}

/// The tests of these slots, sorted.
pub(super) fn sorted_tests(
    table: &SceneTable,
    view: &ViewFrame,
    slots: impl Iterator<Item = u32>,
    may_share: impl Fn(u32) -> bool,
) -> Vec<EntityTest> {
    let mut tests: Vec<EntityTest> = slots
        .map(|slot| EntityTest {
            batch: table.batch_of(slot),
            boxed: query_detail(table, view, slot) == MeshDetail::Box,
            may_share: may_share(slot),
            slot,
        })
        .collect();
    tests.sort_unstable();
    tests
}

/// Fills a draw list with tests, in their order.
pub(super) fn fill_with_tests(list: &mut DrawList, table: &SceneTable, tests: &[EntityTest]) {
    list.clear();
    for test in tests {
        let detail = match test.boxed {
            true => MeshDetail::Box,
            false => MeshDetail::Level(0),
        };
        list.push(table, test.slot, detail);
    }
}
