//! What the oracle saw: the owner of each pixel, and the sums that stand for what is blended.

/// The owners of an image's pixels, row after row, the first on top.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct IdBuffer {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// A pixel: the slot of the solid entity that owns it plus 1, or 0 where there is none.
    pub ids: Vec<u32>,
    /// What is blended; `None` for a scene without.
    pub transparent: Option<TransparentSums>,
}

/// What is blended, in sums that do not depend on the order of drawing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TransparentSums {
    /// A pixel: the sum of the mixed ids of its visible transparent fragments; 0 where there is none.
    pub signatures: Vec<u32>,
    /// A slot: how many visible transparent fragments it has.
    pub samples: Vec<u32>,
}

impl IdBuffer {
    /// The slots that own a pixel or, of transparent entities, have a visible sample; ascending.
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

    /// How many pixels each slot owns; of transparent entities, how many visible samples. Up to the last slot that has any.
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

    /// Which pixels have another owner, or another sum of transparent fragments, than in `other`; row after row.
    /// Where the sizes differ, all of them.
    pub fn wrong_pixel_mask(&self, other: &Self) -> Vec<bool> {
        if self.size != other.size {
            return vec![true; self.ids.len()];
        }
        let (mine, theirs) = (self.signatures(), other.signatures());
        let ids = self.ids.iter().zip(&other.ids);
        ids.enumerate()
            .map(|(pixel, (a, b))| a != b || mine.get(pixel) != theirs.get(pixel))
            .collect::<Vec<_>>()
    }

    /// How many pixels are wrong by [`Self::wrong_pixel_mask`].
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

    fn signatures(&self) -> Signatures<'_> {
        Signatures(
            self.transparent
                .as_ref()
                .map_or(&[], |transparent| &transparent.signatures),
        )
    }
}

/// Signatures of an image that may have none: then all are 0.
struct Signatures<'a>(&'a [u32]);

impl Signatures<'_> {
    fn get(&self, pixel: usize) -> u32 {
        self.0.get(pixel).copied().unwrap_or(0)
    }
}

/// Four bytes a pixel, in rows as copies from textures need them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Padded {
    size: [u32; 2],
    row_bytes: u32,
}

impl Padded {
    pub fn of(size: [u32; 2]) -> Self {
        let row_bytes = size[0].saturating_mul(4);
        let align = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;
        Self {
            size,
            row_bytes: row_bytes
                .checked_next_multiple_of(align)
                .unwrap_or(u32::MAX - u32::MAX % align),
        }
    }

    pub fn bytes(self) -> u64 {
        u64::from(self.row_bytes) * u64::from(self.size[1])
    }

    pub fn layout(self) -> wgpu::TexelCopyBufferLayout {
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(self.row_bytes),
            rows_per_image: None,
        }
    }

    pub fn extent(self) -> wgpu::Extent3d {
        wgpu::Extent3d {
            width: self.size[0],
            height: self.size[1],
            depth_or_array_layers: 1,
        }
    }

    pub fn unpack(self, bytes: &[u8], image: &mut IdBuffer) {
        image.size = self.size;
        image.ids.clear();
        for row in bytes.chunks(self.row_bytes.max(1) as usize) {
            let (texels, _) = row.as_chunks::<4>();
            image.ids.extend(
                texels
                    .iter()
                    .take(self.size[0] as usize)
                    .map(|texel| u32::from_le_bytes(*texel)),
            );
        }
    }
}
