//! A traversal that waits for its queries within the frame: what the nodes of [`same_frame`](super::same_frame) ask of it.

use antumbra_cull::Verdicts;
use antumbra_cull::boxes::BoxList;

use super::context::TraversalContext;
use super::settings::TraversalSettings;
use crate::sketch::Sketch;

/// A traversal in batches. It is kept from frame to frame.
///
/// A frame calls `begin` once, and then `advance` and `answer` in turns until `is_done`.
pub trait WaitingTraversal: Default + Send + Sync + 'static {
    /// Starts a frame at the roots. `cuts`: camera cuts of the view so far.
    fn begin(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        cuts: u64,
        verdicts: &mut Verdicts,
    );

    /// Visits nodes until a batch of queries is full, and writes the batch's boxes. No box: the traversal is complete.
    fn advance(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    );

    /// The slots to be drawn that were found since the caller last cleared this list.
    fn found(&mut self) -> &mut Vec<u32>;

    /// Takes the answers of the batch in the order of its queries: whether any sample was visible.
    fn answer(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        answers: impl Iterator<Item = bool>,
    );

    /// Whether no node is left to be visited or queried.
    fn is_done(&self) -> bool;

    /// A record of the traversal, where the settings ask for one.
    fn sketch(&self) -> &Sketch;
}
