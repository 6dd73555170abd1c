//! Draw lists with a hardware query around each entry, or around several neighbours, and the record that travels with the answers.

use std::sync::Arc;

use antumbra_cull::{
    DrawList, FrameGraph, ListDraws, MeshDetail, Queried, SceneTable, ShadeTargets, Stamp,
    ViewFrame, ViewNodes,
};
use antumbra_graph::{BodyError, Buffer, BufferDesc, Host, HostBuilder, HostContext};

use super::entity_test::{fill_with_tests, sorted_tests};

/// A draw list with queries, and their answers.
#[derive(Debug, Clone, Copy)]
pub(super) struct QueriedList {
    pub list: ListDraws,
    /// The slots and the frame of the queries.
    pub queried: Host<Queried>,
    /// A u64 a query.
    pub answers: Buffer,
}

/// What the lists of a frame are made from.
#[derive(Clone, Copy)]
pub(super) struct ListSource<'a> {
    pub table: &'a SceneTable,
    pub view: &'a ViewFrame,
    /// The frame and the camera cut of the candidates.
    pub stamp: Stamp,
}

/// Which tests may share a query.
pub(super) struct Sharing<F> {
    /// Most entities a query; 1: no sharing.
    pub most: u32,
    /// Whether a slot may share a query.
    pub allowed: F,
}

impl QueriedList {
    pub fn declare(g: &mut FrameGraph<'_>, view: &ViewNodes, name: &str) -> Self {
        let bytes = g.slot_bytes() * 2;
        let named = |what: &str| view.named(&format!("{name}{what}"));
        Self {
            list: g.unsubmitted(&named("")),
            queried: g.graph().host::<Queried>(named(": queried")),
            answers: g.graph().buffer(named(": answers"), BufferDesc::new(bytes)),
        }
    }

    /// Declares on a host node that it writes the list and its record. Returns the versions it writes.
    pub fn written_by(self, node: &mut HostBuilder<'_>) -> Self {
        Self {
            list: self.list.written_by(node),
            queried: node.write(self.queried),
            answers: self.answers,
        }
    }

    /// Declares on a host node that it waits for the answers.
    pub fn read_back(self, node: &mut HostBuilder<'_>) {
        let queried = self.queried;
        node.read(queried)
            .read_back(self.answers)
            .bytes(move |host| {
                host.get(queried)
                    .map_or(0, |queried| u64::from(queried.queries()) * 8)
            });
    }

    /// Fills the list with the full meshes of these slots, in this order, with a query each. Returns the number of queries.
    pub fn submit(
        &self,
        ctx: &mut HostContext<'_>,
        source: ListSource<'_>,
        slots: impl Iterator<Item = u32>,
    ) -> Result<u32, BodyError> {
        let mut list = ctx.get_mut(self.list.list)?;
        fill(&mut list, source.table, slots);
        self.upload(ctx, &mut list, source.stamp)
    }

    /// Fills the list with the test geometry of these slots, sorted by batch. Returns the number of queries.
    pub fn submit_tests(
        &self,
        ctx: &mut HostContext<'_>,
        source: ListSource<'_>,
        slots: impl Iterator<Item = u32>,
        sharing: Sharing<impl Fn(u32) -> bool>,
    ) -> Result<u32, BodyError> {
        let tests = sorted_tests(source.table, source.view, slots, sharing.allowed);
        let mut list = ctx.get_mut(self.list.list)?;
        fill_with_tests(&mut list, source.table, &tests);
        if sharing.most > 1 {
            let mut end = 0;
            let shared = tests
                .chunk_by(|a, b| a.may_share_with(b))
                .flat_map(|alike| alike.chunks(sharing.most as usize));
            list.group_queries(shared.map(|members| {
                end += members.len() as u32;
                end
            }));
        }
        self.upload(ctx, &mut list, source.stamp)
    }

    /// Uploads the filled list and writes its record. Returns the number of queries.
    fn upload(
        &self,
        ctx: &mut HostContext<'_>,
        list: &mut DrawList,
        stamp: Stamp,
    ) -> Result<u32, BodyError> {
        ctx.upload(self.list.slots, 0, bytemuck::cast_slice(list.slots()))?;
        let queried = Queried {
            stamp,
            slots: Arc::new(list.slots().to_vec()),
            ends: Arc::new(list.query_ends().to_vec()),
        };
        let queries = queried.queries();
        *ctx.get_mut(self.queried)? = queried;
        Ok(queries)
    }

    /// Shades the list, with its queries. Returns the list with the answers of this pass.
    pub fn shade(self, g: &mut FrameGraph<'_>, view: &mut ViewNodes, name: &str) -> Self {
        let into = ShadeTargets {
            queries: Some(self.answers),
            ..view.targets.into()
        };
        let out = g.shade_source(view, name, self.list.into(), into);
        Self {
            answers: out.queries.unwrap_or(self.answers),
            ..self
        }
    }

    /// Tests the list against the depth so far. Returns the list with the answers of this pass.
    pub fn test(self, g: &mut FrameGraph<'_>, view: &ViewNodes, name: &str) -> Self {
        let answers = g.query(view, name, self.list, view.targets.depth, self.answers);
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

/// Fills and uploads a list of full meshes without queries, in this order.
pub(super) fn submit_unqueried(
    ctx: &mut HostContext<'_>,
    draws: ListDraws,
    table: &SceneTable,
    slots: impl Iterator<Item = u32>,
) -> Result<(), BodyError> {
    let mut list = ctx.get_mut(draws.list)?;
    fill(&mut list, table, slots);
    ctx.upload(draws.slots, 0, bytemuck::cast_slice(list.slots()))?;
    Ok(())
}
