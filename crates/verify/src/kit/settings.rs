//! What the kit checks with: the cases, the adapter, the image size and the seed.

use antumbra_cull::AdapterChoice;

use super::case::Case;

/// The settings of the kit. The default plays all cases on the fastest adapter that is not OpenGL.
#[derive(Debug, Clone)]
pub struct Kit {
    /// The adapter, unless [`Kit::check_on`] gets a device.
    pub adapter: AdapterChoice,
    /// Width and height of the views in pixels.
    pub size: [u32; 2],
    /// The seed of the random scenes. Every failure names it.
    pub seed: u64,
    /// Number of scenes in [`Case::RandomScenes`].
    pub random_scenes: u32,
    /// Number of entities in [`Case::Many`]; the default exceeds the 4,096 queries of one query set.
    pub many_entities: u32,
    /// The cases to play, in this order.
    pub cases: Vec<Case>,
    /// Whether late answers must cull no visible entity once they have settled on a still scene. Set it for a frame-late strategy
    /// whose only error is its latency: full-resolution proxies, no threshold.
    pub exact_when_still: bool,
    /// Number of frames within which the verdicts of a still scene must settle.
    pub settle_frames: u32,
}

impl Default for Kit {
    fn default() -> Self {
        Self {
            adapter: AdapterChoice::Auto,
            size: [128, 96],
            seed: 1,
            random_scenes: 4,
            many_entities: 5000,
            cases: Case::ALL.to_vec(),
            exact_when_still: false,
            settle_frames: 5,
        }
    }
}

impl Kit {
    /// The default kit on this adapter.
    pub fn on(adapter: AdapterChoice) -> Self {
        Self {
            adapter,
            ..Self::default()
        }
    }
}
