//! What the oracle renders: the entity that owns each sample, and order-independent sums for the transparent entities.

/// An entity-id buffer: the owners of an image's samples, row by row from the top, the samples of a pixel one after the other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct IdBuffer {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// One value a sample: the slot of the solid entity that owns it plus 1, or 0 for none.
    pub ids: Vec<u32>,
    /// The transparent entities; `None` in a scene that has none.
    pub transparent: Option<TransparentSums>,
}

/// The visible transparent fragments, in sums that do not depend on the order of drawing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TransparentSums {
    /// One value a pixel: the sum of the mixed ids of its visible transparent fragments; 0 for none.
    pub signatures: Vec<u32>,
    /// One value a slot: its number of visible transparent fragments.
    pub samples: Vec<u32>,
}

impl IdBuffer {
    /// The visible entities: slots that own a sample or, if transparent, have a visible fragment; ascending.
    pub fn owners(&self) -> Vec<u32> {
        let most = self.ids.iter().max().map_or(0, |most| *most as usize);
        let samples = self.samples();
        let mut owns = vec![false; most.max(samples.len())];
        for id in &self.ids {
            if let Some(place) = id
                .checked_sub(1)
                .and_then(|slot| owns.get_mut(slot as usize))
            {
                *place = true;
            }
        }
        for (place, samples) in owns.iter_mut().zip(samples) {
            *place |= *samples > 0;
        }
        (0u32..)
            .zip(owns)
            .filter_map(|(slot, owns)| owns.then_some(slot))
            .collect()
    }

    /// One value a slot: the number of samples that a solid entity owns, or of visible fragments that a transparent one has. Ends with the
    /// last slot that has any.
    pub fn samples_by_slot(&self) -> Vec<u32> {
        let mut counts = self.samples().to_vec();
        let most = self.ids.iter().max().map_or(0, |most| *most as usize);
        counts.resize(counts.len().max(most), 0);
        for id in &self.ids {
            if let Some(count) = id
                .checked_sub(1)
                .and_then(|slot| counts.get_mut(slot as usize))
            {
                *count += 1;
            }
        }
        while counts.last() == Some(&0) {
            counts.pop();
        }
        counts
    }

    /// The samples of a pixel; 1 for an image without pixels.
    pub fn samples_a_pixel(&self) -> usize {
        let [width, height] = self.size.map(|side| side as usize);
        (self.ids.len() / (width * height).max(1)).max(1)
    }

    /// The owners of the samples of each pixel, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = &[u32]> {
        self.ids.chunks(self.samples_a_pixel())
    }

    /// The number of pixels that show an entity: a solid one owns one of their samples, or they have a visible transparent fragment.
    pub fn owned_pixels(&self) -> usize {
        let shows = |(pixel, ids): (usize, &[u32])| {
            ids.iter().any(|id| *id != 0) || self.signature(pixel) != 0
        };
        self.pixels()
            .enumerate()
            .filter(|pixel| shows(*pixel))
            .count()
    }

    /// One value a pixel, row by row: whether the owner of any of its samples or its sum of transparent fragments differs from that in `other`. All are `true` if
    /// the sizes or the numbers of samples differ.
    pub fn wrong_pixel_mask(&self, other: &Self) -> Vec<bool> {
        if self.size != other.size || self.ids.len() != other.ids.len() {
            return vec![true; self.pixels().count()];
        }
        let pairs = self.pixels().zip(other.pixels()).enumerate();
        pairs
            .map(|(pixel, (a, b))| a != b || self.signature(pixel) != other.signature(pixel))
            .collect()
    }

    /// The number of pixels that [`Self::wrong_pixel_mask`] marks.
    pub fn wrong_pixels(&self, other: &Self) -> usize {
        self.wrong_pixel_mask(other)
            .iter()
            .filter(|wrong| **wrong)
            .count()
    }

    fn samples(&self) -> &[u32] {
        self.transparent
            .as_ref()
            .map_or(&[], |transparent| &transparent.samples)
    }

    /// The sum of the mixed ids of a pixel's visible transparent fragments; 0 for none. Pixels are numbered row by row.
    pub fn signature(&self, pixel: usize) -> u32 {
        let transparent = self.transparent.as_ref();
        transparent
            .and_then(|transparent| transparent.signatures.get(pixel).copied())
            .unwrap_or(0)
    }
}
