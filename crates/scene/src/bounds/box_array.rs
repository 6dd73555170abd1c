//! Many boxes as a structure of arrays, in blocks of 64. Each block has a hull, so a test runs over whole SIMD
//! registers and often decides a whole block at once.

use super::Aabb;
use glam::DVec3;

/// Boxes per block.
pub(crate) const LANES: usize = 64;

/// A growing array of boxes, stored as centres and half extents in f64, for [`Frustum::cull`](crate::Frustum::cull).
#[derive(Clone, Debug, Default)]
pub struct BoxArray {
    blocks: Vec<Block>,
    hulls: Vec<Hull>,
    len: usize,
}

/// Sixty-four boxes, stored axis by axis.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) centre: [[f64; LANES]; 3],
    pub(crate) half: [[f64; LANES]; 3],
}

/// The hull of a block: a box around all of its boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hull {
    pub(crate) centre: DVec3,
    /// NaN if a box of the block is not finite. Every comparison with NaN fails, so the block is then tested box by
    /// box.
    pub(crate) half: DVec3,
    /// Bit `i` is set if box `i` exists and is not empty.
    pub(crate) live: u64,
    /// Changes since the hull was last computed from the boxes. Between two computations the hull only grows.
    stale: u32,
}

impl BoxArray {
    /// An array without boxes.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of boxes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the array has no boxes.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Makes room for more boxes.
    pub fn reserve(&mut self, boxes: usize) {
        let blocks = (self.len + boxes).div_ceil(LANES) - self.blocks.len();
        self.blocks.reserve(blocks);
        self.hulls.reserve(blocks);
    }

    /// Removes every box.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.hulls.clear();
        self.len = 0;
    }

    /// Appends a box; its index is the previous [`len`](Self::len).
    pub fn push(&mut self, bounds: Aabb) {
        if self.len.is_multiple_of(LANES) {
            self.blocks.push(Block {
                centre: [[0.0; LANES]; 3],
                half: [[0.0; LANES]; 3],
            });
            self.hulls.push(Hull::NONE);
        }
        self.len += 1;
        self.store(self.len - 1, bounds);
    }

    /// Replaces box `index`. Returns false, and changes nothing, if the box does not exist.
    pub fn set(&mut self, index: usize, bounds: Aabb) -> bool {
        let there = index < self.len;
        if there {
            self.store(index, bounds);
        }
        there
    }

    /// Box `index`, exactly as stored or wider by a rounding error; `None` if it does not exist.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Aabb> {
        if index >= self.len {
            return None;
        }
        let (block, hull) = (
            self.blocks.get(index / LANES)?,
            self.hulls.get(index / LANES)?,
        );
        Some(block.lane(index % LANES, hull.live))
    }

    /// Removes box `index` and moves the last box to its index. Returns false if the box does not exist.
    pub fn swap_remove(&mut self, index: usize) -> bool {
        if index >= self.len {
            return false;
        }
        let last = self.len - 1;
        if let Some(moved) = self.get(last) {
            self.store(index, moved);
        }
        self.store(last, Aabb::EMPTY);
        self.len = last;
        self.blocks.truncate(last.div_ceil(LANES));
        self.hulls.truncate(last.div_ceil(LANES));
        true
    }

    /// The blocks of 64 boxes and their hulls.
    pub(crate) fn blocks(&self) -> (&[Block], &[Hull]) {
        (&self.blocks, &self.hulls)
    }

    fn store(&mut self, index: usize, bounds: Aabb) {
        let lane = index % LANES;
        let (Some(block), Some(hull)) = (
            self.blocks.get_mut(index / LANES),
            self.hulls.get_mut(index / LANES),
        ) else {
            return;
        };
        // An empty box has no finite centre. Any number serves, since its bit is not set.
        let empty = bounds.is_empty() && !bounds.min.is_nan() && !bounds.max.is_nan();
        let bounds = if empty {
            Aabb::new(DVec3::ZERO, DVec3::ZERO)
        } else {
            bounds
        };
        let centre = bounds.centre();
        let half = (bounds.max - centre).max(centre - bounds.min);
        // The half extents are widened, so that the box from the rounded centre contains the original box.
        let half = half + (centre.abs() + half) * f64::EPSILON;
        let numbers = (centre.to_array().into_iter()).zip(half.to_array());
        for ((centre, half), (c, h)) in (block.centre.iter_mut().zip(&mut block.half)).zip(numbers)
        {
            if let (Some(centre), Some(half)) = (centre.get_mut(lane), half.get_mut(lane)) {
                (*centre, *half) = (c, h);
            }
        }
        let bit = 1_u64 << lane;
        hull.live = if empty {
            hull.live & !bit
        } else {
            hull.live | bit
        };
        hull.stale += 1;
        if hull.stale as usize > LANES {
            *hull = block.hull(hull.live);
        } else if !empty {
            hull.include(&bounds);
        }
    }
}

impl Block {
    fn lane(&self, lane: usize, live: u64) -> Aabb {
        if live & (1 << lane) == 0 {
            return Aabb::EMPTY;
        }
        let pick = |arrays: &[[f64; LANES]; 3]| {
            DVec3::from_array(
                arrays
                    .each_ref()
                    .map(|a| a.get(lane).copied().unwrap_or(f64::NAN)),
            )
        };
        Aabb::from_centre(pick(&self.centre), pick(&self.half))
    }

    fn hull(&self, live: u64) -> Hull {
        let mut hull = Hull { live, ..Hull::NONE };
        for lane in (0..LANES).filter(|lane| live & (1 << lane) != 0) {
            hull.include(&self.lane(lane, live));
        }
        hull
    }
}

impl Hull {
    const NONE: Self = Self {
        centre: DVec3::ZERO,
        half: DVec3::NEG_ONE,
        live: 0,
        stale: 0,
    };

    fn include(&mut self, bounds: &Aabb) {
        if !bounds.is_finite() || self.half.is_nan() {
            self.half = DVec3::NAN;
            return;
        }
        let joined = if self.half.x < 0.0 {
            *bounds
        } else {
            Aabb::from_centre(self.centre, self.half).union(bounds)
        };
        self.centre = joined.centre();
        let half = (joined.max - self.centre).max(self.centre - joined.min);
        // The slack keeps every box inside the hull after repeated rounding.
        let slack = (self.centre.abs() + half) * (4.0 * f64::EPSILON);
        self.half = half + slack;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hull grows with each change. Without a new computation, moving boxes would end up in huge blocks.
    #[test]
    fn hulls_shrink_again_after_as_many_changes_as_a_block_has_boxes() {
        let mut array = BoxArray::new();
        let around = |centre: DVec3| Aabb::from_centre(centre, DVec3::ONE);
        (0..LANES).for_each(|_| array.push(around(DVec3::X * 1e6)));
        for lane in (0..LANES).cycle().take(LANES * 3) {
            array.set(lane, around(DVec3::ZERO));
        }
        let (_, hulls) = array.blocks();
        assert!(hulls[0].half.max_element() < 1.1, "{:?}", hulls[0]);
    }
}
