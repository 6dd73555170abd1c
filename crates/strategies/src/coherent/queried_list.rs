//! Draw lists with a query around each entry, and what goes along with the answers.

use std::sync::Arc;

use antumbra_draw::passes::{self, ListDraws};
use antumbra_draw::{DrawList, MeshDetail, PipelineKind, SceneTable, ViewFrame};
use antumbra_graph::{BodyError, Buffer, BufferDesc, Host, HostBuilder, HostContext};

use antumbra_cull::{CULL, DRAW, FrameGraph, Queried, Stamp, ViewNodes, query_detail};

/// What is asked about an entity; in the order of asking.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Test {
    batch: u32,
    boxed: bool,
    settled: bool,
    slot: u32,
}

/// A list, and its answers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asking {
    pub list: ListDraws,
    pub asked: Host<Queried>,
    /// A u64 an entry.
    pub answers: Buffer,
}

impl Asking {
    pub fn declare(g: &mut FrameGraph<'_>, view: &ViewNodes, name: &str) -> Self {
        let bytes = g.slot_bytes() * 2;
        let named = |what: &str| view.named(&format!("{name}{what}"));
        Self {
            list: g.unsubmitted(&named("")),
            asked: g.graph().host::<Queried>(named(": asked")),
            answers: g.graph().buffer(named(": answers"), BufferDesc::new(bytes)),
        }
    }

    /// The versions that a host node writes.
    pub fn written_by(self, node: &mut HostBuilder<'_>) -> Self {
        Self {
            list: self.list.written_by(node),
            asked: node.write(self.asked),
            answers: self.answers,
        }
    }

    /// Declares that a host node waits for the answers.
    pub fn read_back(self, node: &mut HostBuilder<'_>) {
        let asked = self.asked;
        node.read(asked).read_back(self.answers).bytes(move |host| {
            host.get(asked)
                .map_or(0, |asked| u64::from(asked.queries()) * 8)
        });
    }

    /// Fills the list with full meshes, in this order, a question each.
    pub fn submit(
        &self,
        ctx: &mut HostContext<'_>,
        table: &SceneTable,
        stamp: Stamp,
        slots: impl Iterator<Item = u32>,
    ) -> Result<u32, BodyError> {
        let mut list = ctx.get_mut(self.list.list)?;
        fill(&mut list, table, slots);
        self.ask(ctx, &mut list, stamp)
    }

    /// Fills the list with the stand-ins of these slots, in the order of batches. Those that `settled` holds for share a question with up
    /// to `most` of their batch.
    pub fn submit_tests(
        &self,
        ctx: &mut HostContext<'_>,
        (table, view): (&SceneTable, &ViewFrame),
        stamp: Stamp,
        slots: impl Iterator<Item = u32>,
        (most, settled): (u32, impl Fn(u32) -> bool),
    ) -> Result<u32, BodyError> {
        let mut tests: Vec<Test> = slots
            .map(|slot| Test {
                batch: table.batch_of(slot),
                boxed: query_detail(table, view, slot) == MeshDetail::Box,
                settled: settled(slot),
                slot,
            })
            .collect();
        tests.sort_unstable();
        let mut list = ctx.get_mut(self.list.list)?;
        list.clear();
        for test in &tests {
            let detail = match test.boxed {
                true => MeshDetail::Box,
                false => MeshDetail::Level(0),
            };
            list.push(table, test.slot, detail);
        }
        if most > 1 {
            let joins = |a: &Test, b: &Test| {
                a.settled && b.settled && (a.batch, a.boxed) == (b.batch, b.boxed)
            };
            let mut end = 0;
            let ends = tests
                .chunk_by(joins)
                .flat_map(|alike| alike.chunks(most as usize));
            list.group_queries(ends.map(|together| {
                end += together.len() as u32;
                end
            }));
        }
        self.ask(ctx, &mut list, stamp)
    }

    fn ask(
        &self,
        ctx: &mut HostContext<'_>,
        list: &mut DrawList,
        stamp: Stamp,
    ) -> Result<u32, BodyError> {
        ctx.upload(self.list.slots, 0, bytemuck::cast_slice(list.slots()))?;
        let asked = Queried {
            stamp,
            slots: Arc::new(list.slots().to_vec()),
            ends: Arc::new(list.query_ends().to_vec()),
        };
        let queries = asked.queries();
        *ctx.get_mut(self.asked)? = asked;
        Ok(queries)
    }

    /// Shades the list, a query an entry.
    pub fn shade(self, g: &mut FrameGraph<'_>, view: &mut ViewNodes, name: &str) -> Self {
        let kind = g.shaded_kind();
        let spec = g.pass(view.named(name), DRAW, kind);
        let (inputs, targets) = (view.inputs(), view.targets);
        let queried =
            passes::shaded_query_pass(g.graph(), &spec, inputs, self.list, targets, self.answers);
        view.targets = queried.targets;
        Self {
            answers: queried.answers,
            ..self
        }
    }

    /// Tests the list against the depth so far, a query an entry.
    pub fn test(self, g: &mut FrameGraph<'_>, view: &ViewNodes, name: &str) -> Self {
        let spec = g.pass(view.named(name), CULL, PipelineKind::Query);
        let (inputs, depth) = (view.inputs(), view.targets.depth);
        let answers = passes::query_pass(g.graph(), &spec, inputs, self.list, depth, self.answers);
        Self { answers, ..self }
    }
}

/// Fills a list with full meshes, in this order.
fn fill(list: &mut DrawList, table: &SceneTable, slots: impl Iterator<Item = u32>) {
    list.clear();
    for slot in slots {
        list.push(table, slot, MeshDetail::Level(0));
    }
}

/// Submits full meshes that nothing is asked about, in this order.
pub(super) fn submit_unasked(
    ctx: &mut HostContext<'_>,
    set: ListDraws,
    table: &SceneTable,
    slots: impl Iterator<Item = u32>,
) -> Result<(), BodyError> {
    let mut list = ctx.get_mut(set.list)?;
    fill(&mut list, table, slots);
    ctx.upload(set.slots, 0, bytemuck::cast_slice(list.slots()))?;
    Ok(())
}
