//! The context of raster nodes: the render pass and its occlusion queries.

use std::ops::Range;

use super::common_context;
use crate::error::AccessError;
use crate::frame::PassView;

/// What the body of a raster node works with.
pub struct RasterContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) pass: wgpu::RenderPass<'static>,
    pub(crate) queries: QueryCursor,
}

common_context!(RasterContext);

/// The queries of one run of a body, by their numbers in the pass. The set's first query is the range's first.
#[derive(Clone, Debug, Default)]
pub(crate) struct QueryCursor {
    pub range: Range<u32>,
    pub next: u32,
}

impl RasterContext<'_> {
    /// The render pass, open, its viewport set.
    pub fn pass(&mut self) -> &mut wgpu::RenderPass<'static> {
        &mut self.pass
    }

    /// The queries that this run of the body issues; empty for a node without queries.
    #[must_use]
    pub fn query_range(&self) -> Range<u32> {
        self.queries.range.clone()
    }

    /// Issues query `index` around the commands of `draw`.
    ///
    /// # Errors
    /// It is not the next query of [`RasterContext::query_range`].
    pub fn query(
        &mut self,
        index: u32,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<(), AccessError> {
        if index != self.queries.next || index >= self.queries.range.end {
            return Err(AccessError::QueryOrder {
                pass: self.view.name.to_owned(),
                query: index,
                expected: self.queries.next,
                end: self.queries.range.end,
            });
        }
        self.pass
            .begin_occlusion_query(index - self.queries.range.start);
        draw(&mut self.pass);
        self.pass.end_occlusion_query();
        self.queries.next += 1;
        Ok(())
    }
}
