//! Replays: one case played again, with what there is to see of every frame.

use antumbra_cull::Verdicts;

use super::failure::Violation;
use crate::oracle::IdBuffer;

/// A case played to a strategy, with all of its frames up to the violation.
#[derive(Debug)]
pub struct Replay {
    /// The frames of all runs of the case, each view after the other.
    pub frames: Vec<ReplayFrame>,
    /// What ended the case; `None` where the strategy conforms. Its frame is one of the last run's.
    pub violation: Option<Violation>,
}

/// One view of a frame.
#[derive(Debug, Clone)]
pub struct ReplayFrame {
    /// The run, from 0: some cases play several scenes.
    pub run: u32,
    /// The number of the frame in its run, from 0.
    pub frame: u32,
    /// The view.
    pub view: usize,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What the strategy decided.
    pub verdicts: Verdicts,
    /// Who owns each pixel when everything is drawn.
    pub reference: IdBuffer,
    /// Who owns each pixel when only what the verdicts draw is drawn.
    pub drawn: IdBuffer,
}

impl ReplayFrame {
    /// The view as an image: RGBA, four bytes a pixel, row by row. Entities have one of 128 greys (that of a pixel's first sample), nothing is black, and a wrong pixel is red.
    pub fn rgba(&self) -> Vec<u8> {
        let wrong = self.reference.wrong_pixel_mask(&self.drawn);
        let firsts = self
            .reference
            .pixels()
            .map(|samples| samples.first().copied().unwrap_or(0));
        let colours = firsts.zip(wrong).map(|(id, wrong)| match (id, wrong) {
            (_, true) => [255, 0, 0, 255],
            (0, false) => [0, 0, 0, 255],
            (id, false) => {
                // Neighbouring slots differ clearly: multiplied by the golden ratio of 32 bits.
                let grey = 80 + (id.wrapping_mul(0x9E37_79B9) >> 25) as u8;
                [grey, grey, grey, 255]
            }
        });
        colours.flatten().collect()
    }
}
