//! What a strategy's verdicts lose of the reference, and what they merely show as another entity of equal depth.
//!
//! The depths are compared by the depth test itself, at every sample and on every backend: the entities that are missing are drawn first, and what was drawn comes
//! after them. Where what was drawn is in front then, nothing was nearer: a tie.

use antumbra_cull::{StageError, StageScene, Verdicts};
use antumbra_scene::Camera;

use super::{EntitySet, IdBuffer, Oracle};

/// How what verdicts draw differs from the reference.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Differences {
    /// Slots of the entities that own a sample of the reference, or have a visible transparent fragment, and are not drawn; ascending. Ties are among them.
    pub undrawn: Vec<u32>,
    /// Those of them that lost nothing but ties: wherever they own a sample, an entity of equal depth is drawn. They are no false culls.
    pub tied: Vec<u32>,
    /// One value a pixel, row by row: whether it is wrong. Empty where none is.
    pub wrong: Vec<bool>,
    /// One value a pixel: whether it shows another entity of equal depth, and nothing else about it is wrong. Empty where there is none.
    pub tie: Vec<bool>,
}

impl Differences {
    /// The number of entities that own a sample and are not drawn, ties not counted.
    pub fn false_culls(&self) -> usize {
        self.undrawn.len() - self.tied.len()
    }

    /// The number of wrong pixels.
    pub fn wrong_pixels(&self) -> usize {
        self.wrong.iter().filter(|wrong| **wrong).count()
    }

    /// The number of pixels that show another entity of equal depth.
    pub fn tie_pixels(&self) -> usize {
        self.tie.iter().filter(|tie| **tie).count()
    }
}

impl Oracle {
    /// Compares what `verdicts` draw with `reference`, which this oracle rendered of the same scene from the same camera.
    ///
    /// Nothing is drawn where every owner is drawn at full detail. At coarser levels of detail no difference counts as a tie, since a silhouette that moved
    /// may be nearer.
    ///
    /// # Errors
    /// As for [`Self::render`].
    pub fn differences(
        &mut self,
        scene: &dyn StageScene,
        camera: &Camera,
        reference: &IdBuffer,
        verdicts: &Verdicts,
    ) -> Result<Differences, StageError> {
        let owners = reference.owners();
        let drawn = |slot: &u32| verdicts.get(*slot).draws();
        let undrawn: Vec<u32> = owners.into_iter().filter(|slot| !drawn(slot)).collect();
        let full_detail = verdicts.levels() == 1;
        if undrawn.is_empty() && full_detail {
            return Ok(Differences::default());
        }
        let seen = self.render(scene, camera, EntitySet::Drawn(verdicts))?;
        let mut found = Differences {
            wrong: reference.wrong_pixel_mask(&seen),
            undrawn,
            ..Differences::default()
        };
        // A sample that shows nothing is no tie.
        let shown_by_another = |(was, is): (&u32, &u32)| was != is && *is != 0;
        let mut pairs = reference.ids.iter().zip(&seen.ids);
        if full_detail && pairs.any(shown_by_another) {
            let over = EntitySet::DrawnOver {
                verdicts,
                under: &found.undrawn,
            };
            let over = self.render(scene, camera, over)?;
            found.set_ties_apart(reference, &seen, &over);
        }
        if !found.wrong.contains(&true) {
            found.wrong.clear();
        }
        Ok(found)
    }
}

impl Differences {
    /// Moves the ties out of the wrong pixels. `seen` is what was drawn; `over` the same, drawn over what is missing.
    fn set_ties_apart(&mut self, reference: &IdBuffer, seen: &IdBuffer, over: &IdBuffer) {
        let mut tie = vec![false; self.wrong.len()];
        let pixels = reference.pixels().zip(seen.pixels()).zip(over.pixels());
        let marks = self.wrong.iter_mut().zip(&mut tie);
        for (pixel, (((was, is), over), (wrong, tie))) in pixels.zip(marks).enumerate() {
            let glass = reference.signature(pixel) != seen.signature(pixel);
            *tie = *wrong && !glass && was != is && over == is;
            *wrong &= !*tie;
        }
        if tie.contains(&true) {
            self.tie = tie;
        }
        // A sample that the missing entity takes back from what was drawn was lost.
        let samples = reference.ids.iter().zip(&seen.ids).zip(&over.ids);
        let mut lost: Vec<u32> = samples
            .filter(|((_, is), over)| is != over)
            .filter_map(|((was, _), _)| was.checked_sub(1))
            .collect();
        lost.sort_unstable();
        lost.dedup();
        let owned = reference.samples_by_slot();
        let glass = reference.transparent.as_ref();
        let glass = glass.map_or(&[][..], |sums| &sums.samples);
        let count = |counts: &[u32], slot: u32| counts.get(slot as usize).copied().unwrap_or(0);
        let is_tied = |slot: &u32| {
            let solid = count(&owned, *slot) > count(glass, *slot);
            solid && lost.binary_search(slot).is_err()
        };
        self.tied = self.undrawn.iter().copied().filter(is_tied).collect();
    }
}
