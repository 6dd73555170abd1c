//! Bricks in memory, never more than a budget allows: the ones that were not used for longest go first.
//!
//! Paging a volume by bricks is the idea of Plate, Tirtasana, Carmona, Froehlich, *Octreemizer: a hierarchical approach for interactive roaming
//! through very large volumes*, 2002; the bricks here are of one resolution.

use std::ops::Range;
use std::sync::Arc;

use lru::LruCache;
use rayon::prelude::*;

use super::{Axis, BrickSource, SampleBox, VolumeLayout};
use crate::error::SubsurfaceError;

/// How many bricks are read at a time, in parallel.
const BATCH: usize = 64;

/// A volume's bricks, read when they are asked for and kept as long as there is room.
pub struct BrickCache {
    source: Arc<dyn BrickSource>,
    layout: VolumeLayout,
    /// By rank.
    resident: LruCache<u64, Box<[u8]>>,
    /// The most bricks that may be resident.
    room: usize,
    stats: BrickCacheStats,
}

/// What happened to a volume's bricks so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BrickCacheStats {
    /// Bricks read from the source.
    pub read: u64,
    /// Bricks that were asked for and already there.
    pub hits: u64,
    /// Bricks dropped to make room.
    pub evicted: u64,
    /// Bricks in memory now.
    pub resident: usize,
    /// Bytes of samples in memory now.
    pub bytes: usize,
    /// The most bytes of samples that ever were in memory at once.
    pub peak_bytes: usize,
}

impl BrickCache {
    /// Keeps at most `budget` bytes of samples in memory. Nothing is read yet.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`] for a layout that cannot be; [`SubsurfaceError::SmallBudget`] for less than a brick.
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
            room: budget / brick,
            stats: BrickCacheStats::default(),
        })
    }

    /// The volume's layout.
    #[must_use]
    pub fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    /// What happened so far.
    #[must_use]
    pub fn stats(&self) -> BrickCacheStats {
        self.stats
    }

    /// A sample.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; what the source says.
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

    /// A rectangle of the section at `index` along `axis`: `right` and `down` are ranges along the axes of [`Axis::plane`], and `samples` takes
    /// `right.len() * down.len()` bytes, row after row.
    ///
    /// # Errors
    /// [`SubsurfaceError::Outside`]; [`SubsurfaceError::BufferLength`]; what the source says.
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

    /// Shows each of the bricks, in their order, reading those that are not in memory; several at a time and in parallel, as far as they fit the
    /// budget.
    ///
    /// # Errors
    /// [`SubsurfaceError::NoSuchBrick`]; what the source says. Bricks before it may have been shown.
    pub fn visit(
        &mut self,
        wanted: &[[u32; 3]],
        mut show: impl FnMut([u32; 3], &[u8]),
    ) -> Result<(), SubsurfaceError> {
        for batch in wanted.chunks(self.room.min(BATCH)) {
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

    /// Makes bricks resident, not more than there is room for.
    fn fetch(&mut self, batch: &[[u32; 3]]) -> Result<(), SubsurfaceError> {
        let mut missing: Vec<(u64, [u32; 3], Box<[u8]>)> = Vec::new();
        for brick in batch {
            let rank = self.layout.rank(*brick)?;
            if self.resident.get(&rank).is_some() || missing.iter().any(|one| one.0 == rank) {
                self.stats.hits += 1;
            } else {
                missing.push((rank, *brick, Box::default()));
            }
        }
        // Those of the batch that are there were used last: none of them goes.
        let kept = self.room - missing.len().min(self.room);
        let mut spare = Vec::new();
        while self.resident.len() > kept {
            spare.extend(self.resident.pop_lru().map(|(_, samples)| samples));
        }
        self.stats.evicted += spare.len() as u64;
        let bytes = self.layout.brick_bytes();
        for (.., samples) in &mut missing {
            *samples = (spare.pop()).unwrap_or_else(|| vec![0; bytes].into_boxed_slice());
        }
        let source = &self.source;
        let read = (missing.par_iter_mut())
            .try_for_each(|(_, brick, samples)| source.read(*brick, samples));
        if read.is_ok() {
            self.stats.read += missing.len() as u64;
            for (rank, _, samples) in missing {
                self.resident.put(rank, samples);
            }
        }
        self.stats.resident = self.resident.len();
        self.stats.bytes = self.resident.len() * bytes;
        self.stats.peak_bytes = self.stats.peak_bytes.max(self.stats.bytes);
        read
    }
}
