//! One view as a strategy sees it while it declares its nodes.

use std::sync::Arc;

use antumbra_graph::Host;

use crate::candidates::Candidates;
use crate::draw_source::DrawSource;
use crate::narrowing::Narrowing;
use crate::renderer::{Targets, ViewInputs};

/// One view while its nodes are declared.
#[derive(Debug)]
pub struct ViewNodes {
    pub(crate) name: String,
    /// What names of nodes and resources begin with: empty for a single view.
    pub(crate) prefix: String,
    pub(crate) index: usize,
    pub(crate) count: usize,
    pub(crate) size: [u32; 2],
    pub(crate) inputs: ViewInputs,
    /// The view's image so far.
    pub targets: Targets,
    pub(crate) reference: Option<Host<Arc<Vec<u32>>>>,
    pub(crate) in_frustum: Option<Host<Candidates>>,
    /// What the strategy before has left, in a chain.
    pub(crate) narrowing: Option<Narrowing>,
    /// What has been shaded so far, in order.
    pub(crate) shaded: Vec<DrawSource>,
    /// Whether something is shaded in a host loop, where a source has no one value a frame.
    pub(crate) shades_in_loop: bool,
}

impl ViewNodes {
    /// The view's name: `main`, `left`, `right`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Which view, from 0; views are declared in this order.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Whether no view comes after it.
    pub fn is_last(&self) -> bool {
        self.index + 1 >= self.count
    }

    /// Width and height of its image in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The scene, camera and uniforms that every drawing node of the view reads.
    pub fn inputs(&self) -> ViewInputs {
        self.inputs
    }

    /// The slots that own a pixel of the reference, for a strategy that [needs it](crate::Strategy::needs_reference).
    pub fn reference(&self) -> Option<Host<Arc<Vec<u32>>>> {
        self.reference
    }

    /// In a chain, the candidates that the strategy before has left; otherwise `None`. A strategy that does not start from
    /// [`FrameGraph::in_frustum`](crate::FrameGraph::in_frustum), for example one that traverses a tree, must keep to these.
    pub fn narrowed_to(&self) -> Option<Host<Candidates>> {
        self.narrowing.map(|narrowing| narrowing.left)
    }

    /// The draw sources that have been shaded so far, in order: what the view draws.
    pub fn shaded(&self) -> &[DrawSource] {
        &self.shaded
    }

    /// A node's or resource's name in this view.
    pub fn named(&self, what: &str) -> String {
        format!("{}{what}", self.prefix)
    }
}
