//! What a view draws, for a host that draws by itself.

use antumbra_graph::Graph;

use super::Stage;
use crate::draw_source::{DrawList, DrawSource};

/// A part of what a view draws.
#[derive(Debug, Clone, Copy)]
pub enum Draws<'a> {
    /// A list on the host.
    List {
        /// The list: runs of slots, a batch each.
        list: &'a DrawList,
        /// Its slots on the device, a u32 each. Usages `VERTEX` and `STORAGE`.
        slots: &'a wgpu::Buffer,
    },
    /// Indirect draws that the device has chosen.
    Indirect {
        /// The list that was chosen from: it says which batch each draw is of.
        layout: &'a DrawList,
        /// The kept slots, a u32 each, at the places of their runs. Usages `VERTEX` and `STORAGE`.
        slots: &'a wgpu::Buffer,
        /// An indexed indirect draw a run of the layout, [`INDIRECT_DRAW_BYTES`](crate::INDIRECT_DRAW_BYTES) each, into the ranges of the scene's meshes. Usages `INDIRECT` and `STORAGE`.
        draws: &'a wgpu::Buffer,
    },
}

impl Stage {
    /// What a view draws in the frame that was recorded last, in order; nothing for a view that does not exist and for a stage that makes [an image](super::StageOutput::Image). Lists are
    /// there at once; what is on the device is there for commands that follow the frame's.
    pub fn draws(&self, view: usize) -> impl Iterator<Item = Draws<'_>> {
        let plan = &self.built.plan;
        let shaded = self
            .built
            .views
            .get(view)
            .map(|view| view.shaded.as_slice());
        let sources = shaded.unwrap_or_default().iter();
        sources.filter_map(move |source| {
            Some(match source {
                DrawSource::List(list) => Draws::List {
                    list: plan.get(list.list)?,
                    slots: plan.buffer(list.slots)?,
                },
                DrawSource::Indirect(indirect) => Draws::Indirect {
                    layout: plan.get(indirect.layout)?,
                    slots: plan.buffer(indirect.slots)?,
                    draws: plan.buffer(indirect.draws)?,
                },
            })
        })
    }
}

/// Makes sources readable after the frame.
pub(super) fn output(graph: &mut Graph, sources: &[DrawSource]) {
    use wgpu::BufferUsages as Usages;
    for source in sources {
        let list = source.as_list();
        graph.output(list.list);
        graph.output_as(list.slots, Usages::VERTEX | Usages::STORAGE);
        if let DrawSource::Indirect(indirect) = source {
            graph.output_as(indirect.draws, Usages::INDIRECT | Usages::STORAGE);
        }
    }
}
