//! Draw sources: what a renderer is asked to draw, as a list on the host or as indirect draws that the GPU chose.

mod list;
pub mod patches;

use antumbra_graph::{Buffer, Host, HostBuilder};

pub use list::{DrawList, Run};

/// Bytes of an indexed indirect draw.
pub const INDIRECT_DRAW_BYTES: u64 = 20;

/// What a pass draws.
#[derive(Debug, Clone, Copy)]
pub enum DrawSource {
    /// A list on the host.
    List(ListDraws),
    /// Indirect draws on the GPU.
    Indirect(IndirectDraws),
}

/// A draw source on the host: a draw list, with its slots on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct ListDraws {
    /// The list.
    pub list: Host<DrawList>,
    /// [`DrawList::slots`], uploaded.
    pub slots: Buffer,
}

impl ListDraws {
    /// Declares on a host node that it writes the list and uploads the slots. Returns the versions it writes.
    pub fn written_by(self, node: &mut HostBuilder<'_>) -> Self {
        Self {
            list: node.write(self.list),
            slots: node.upload(self.slots),
        }
    }
}

/// A draw source on the GPU: indirect draws over the slots that a compute node kept of a list. One draw a run of the list.
#[derive(Debug, Clone, Copy)]
pub struct IndirectDraws {
    /// The list that was chosen from. It says which pipeline each draw takes.
    pub layout: Host<DrawList>,
    /// The kept slots, at the places of their runs.
    pub slots: Buffer,
    /// The indexed indirect draws, [`INDIRECT_DRAW_BYTES`] each.
    pub draws: Buffer,
}

impl IndirectDraws {
    /// The list that was chosen from, with the kept slots.
    pub fn as_list(self) -> ListDraws {
        ListDraws {
            list: self.layout,
            slots: self.slots,
        }
    }
}

impl DrawSource {
    /// The list: what is drawn, or what was chosen from.
    pub fn as_list(self) -> ListDraws {
        match self {
            Self::List(list) => list,
            Self::Indirect(draws) => draws.as_list(),
        }
    }
}

impl From<ListDraws> for DrawSource {
    fn from(list: ListDraws) -> Self {
        Self::List(list)
    }
}

impl From<IndirectDraws> for DrawSource {
    fn from(draws: IndirectDraws) -> Self {
        Self::Indirect(draws)
    }
}
