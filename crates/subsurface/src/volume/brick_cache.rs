//! A cache of bricks with a memory budget and least-recently-used eviction.
//!
//! Paging a volume by bricks is from Plate, Tirtasana, Carmona, Froehlich, *Octreemizer: a hierarchical approach for
//! interactive roaming through very large volumes*, 2002. The bricks here have one resolution.

use std::ops::Range;
use std::sync::Arc;

use lru::LruCache;
use rayon::prelude::*;

use super::axis::Axis;
use super::layout::VolumeLayout;
use super::sample_box::SampleBox;
use super::source::BrickSource;
use crate::error::SubsurfaceError;

/// The number of bricks that are read in parallel.
const BATCH: usize = 64;

/// The most bricks in memory. An entry takes some hundred bytes besides its samples, which with small bricks is most of it.
const MOST: usize = 1 << 18;

/// A cache of a volume's bricks. Bricks are read on demand and kept while there is room.
pub struct BrickCache {
    source: Arc<dyn BrickSource>,
    layout: VolumeLayout,
    /// The bricks in memory, by index.
    resident: LruCache<u64, Box<[u8]>>,
    /// The greatest number of bricks in memory.
    capacity: usize,
    stats: BrickCacheStats,
}

/// Statistics of a cache.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BrickCacheStats {
    /// The number of bricks read from the source.
    pub read: u64,
    /// The number of requested bricks that were in memory.
    pub hits: u64,
    /// The number of evicted bricks.
    pub evicted: u64,
    /// The number of bricks in memory.
    pub resident: usize,
    /// The number of bytes of samples in memory.
    pub bytes: usize,
    /// The greatest number of bytes of samples that were in memory at once.
    pub peak_bytes: usize,
}

/// A brick that is read into memory.
struct MissingBrick {
    rank: u64,
    brick: [u32; 3],
    samples: Box<[u8]>,
}

impl BrickCache {
    /// A cache that keeps at most `budget` bytes of samples in memory. Nothing is read yet.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`] for an invalid layout; [`SubsurfaceError::SmallBudget`] for less than a brick.
    pub fn new(source: Arc<dyn BrickSource>, budget: usize) -> Result<Self, SubsurfaceError> {
        let layout = *source.layout();
        layout.validate()?;
        let brick = layout.brick_bytes();
        if budget < brick {
            return Err(SubsurfaceError::SmallBudget { budget, brick });
        }
        Ok(Self {
            source,
            layout,
            resident: LruCache::unbounded(),
            capacity: (budget / brick).min(MOST),
            stats: BrickCacheStats::default(),
        })
    }

    /// The volume's layout.
    #[must_use]
    pub fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    /// The statistics so far.
    #[must_use]
    pub fn stats(&self) -> BrickCacheStats {
        self.stats
    }

    /// Reads a sample.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; the errors of the source.
    pub fn sample(&mut self, place: [u32; 3]) -> Result<u8, SubsurfaceError> {
        let alone = SampleBox {
            min: place,
            max: place,
        };
        alone.check("a sample", &self.layout)?;
        let edge = self.layout.brick;
        let [x, y, z] = place.map(|at| (at % edge) as usize);
        let edge = edge as usize;
        let mut sample = 0;
        self.visit(&[self.layout.brick_of(place)], |_, samples| {
            sample = samples[x + edge * (y + edge * z)];
        })?;
        Ok(sample)
    }

    /// Reads a rectangle of the section at `index` along `axis`. `right` and `down` are ranges along the axes of
    /// [`Axis::plane`], and `samples` has `right.len() * down.len()` bytes, row by row.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::BufferLength`]; the errors of the source.
    pub fn section(
        &mut self,
        axis: Axis,
        index: u32,
        [right, down]: [Range<u32>; 2],
        samples: &mut [u8],
    ) -> Result<(), SubsurfaceError> {
        let width = right.len();
        let (expected, actual) = (width.saturating_mul(down.len()), samples.len());
        if expected != actual {
            return Err(SubsurfaceError::BufferLength { expected, actual });
        }
        if expected == 0 {
            return Ok(());
        }
        let area = SampleBox {
            min: axis.place(index, [right.start, down.start]),
            max: axis.place(index, [right.end - 1, down.end - 1]),
        };
        area.check("a section", &self.layout)?;
        let edge = self.layout.brick;
        let wanted: Vec<_> = area.bricks(&self.layout).collect();
        self.visit(&wanted, |brick, bytes| {
            let strides = [1, edge as usize, (edge as usize).pow(2)];
            let base = (index % edge) as usize * axis.of(strides);
            let [to_right, to_down] = axis.plane().map(|along| along.of(strides));
            let [left, top] = axis.plane().map(|along| along.of(brick) * edge);
            let within = |start: u32, range: &Range<u32>| {
                (range.start.max(start) - start)..(range.end.min(start + edge) - start)
            };
            let (columns, rows) = (within(left, &right), within(top, &down));
            for row in rows {
                let from = base + row as usize * to_down + columns.start as usize * to_right;
                let to = (top + row - down.start) as usize * width
                    + (left + columns.start - right.start) as usize;
                let into = &mut samples[to..to + columns.len()];
                if to_right == 1 {
                    into.copy_from_slice(&bytes[from..from + columns.len()]);
                } else {
                    let bytes = bytes[from..].iter().step_by(to_right);
                    into.iter_mut()
                        .zip(bytes)
                        .for_each(|(to, from)| *to = *from);
                }
            }
        })
    }

    /// Calls `show` with each of the bricks and its samples, in order. Bricks that are not in memory are read, in
    /// parallel, several at a time as far as the budget allows.
    ///
    /// # Errors
    /// [`SubsurfaceError::NoSuchBrick`]; the errors of the source. `show` may have been called for preceding bricks.
    pub fn visit(
        &mut self,
        wanted: &[[u32; 3]],
        mut show: impl FnMut([u32; 3], &[u8]),
    ) -> Result<(), SubsurfaceError> {
        for batch in wanted.chunks(self.capacity.min(BATCH)) {
            self.fetch(batch)?;
            for brick in batch {
                let rank = self.layout.rank(*brick)?;
                if let Some(samples) = self.resident.peek(&rank) {
                    show(*brick, samples);
                }
            }
        }
        Ok(())
    }

    /// Loads bricks into memory, no more than there is room for.
    fn fetch(&mut self, batch: &[[u32; 3]]) -> Result<(), SubsurfaceError> {
        let mut missing: Vec<MissingBrick> = Vec::new();
        for brick in batch {
            let rank = self.layout.rank(*brick)?;
            if self.resident.get(&rank).is_some() || missing.iter().any(|one| one.rank == rank) {
                self.stats.hits += 1;
            } else {
                missing.push(MissingBrick {
                    rank,
                    brick: *brick,
                    samples: Box::default(),
                });
            }
        }
        // Bricks of the batch that are in memory were used last, so none of them is evicted.
        let kept = self.capacity - missing.len().min(self.capacity);
        let mut spare = Vec::new();
        while self.resident.len() > kept {
            spare.extend(self.resident.pop_lru().map(|(_, samples)| samples));
        }
        self.stats.evicted += spare.len() as u64;
        let bytes = self.layout.brick_bytes();
        for one in &mut missing {
            one.samples = (spare.pop()).unwrap_or_else(|| vec![0; bytes].into_boxed_slice());
        }
        let source = &self.source;
        let read =
            (missing.par_iter_mut()).try_for_each(|one| source.read(one.brick, &mut one.samples));
        if read.is_ok() {
            self.stats.read += missing.len() as u64;
            for one in missing {
                self.resident.put(one.rank, one.samples);
            }
        }
        self.stats.resident = self.resident.len();
        self.stats.bytes = self.resident.len() * bytes;
        self.stats.peak_bytes = self.stats.peak_bytes.max(self.stats.bytes);
        read
    }
}
