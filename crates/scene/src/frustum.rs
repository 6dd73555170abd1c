//! View frusta as sets of planes, and the test of boxes against them: one box at a time, or millions at once.
//!
//! A box is outside if it is wholly behind one plane (Assarsson and Möller, "Optimized View Frustum Culling
//! Algorithms for Bounding Boxes", 2000). Near the frustum's edges a box outside may count as inside, never the
//! reverse.

use crate::bounds::{Aabb, Block, BoxArray, Hull, LANES};
use glam::DVec3;
use rayon::prelude::*;

/// The plane `normal . p + offset = 0`. The inside is where the value is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The inward normal, of unit length.
    pub normal: DVec3,
    /// The signed distance of the world's origin from the plane, in metres.
    pub offset: f64,
}

impl Plane {
    /// The plane through `point` whose inside is in the direction of the unit vector `normal`.
    #[must_use]
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self {
            normal,
            offset: -normal.dot(point),
        }
    }

    /// The signed distance from the plane in metres, positive inside.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }
}

/// A view frustum: the intersection of the inner half-spaces of its planes. It has five planes without a far plane,
/// six with one.
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum {
    planes: Vec<Plane>,
}

impl Frustum {
    /// The frustum with these planes.
    #[must_use]
    pub fn new(planes: Vec<Plane>) -> Self {
        Self { planes }
    }

    /// The planes: left, right, bottom, top, near and, if there is one, far.
    #[must_use]
    pub fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// Whether the box may share a point with the frustum. Never false for a box that does.
    #[must_use]
    pub fn intersects(&self, bounds: &Aabb) -> bool {
        if bounds.is_empty() {
            return false;
        }
        let (centre, half) = (bounds.centre(), bounds.half_extents());
        // The comparison is written so that NaN counts as inside.
        !self
            .planes
            .iter()
            .any(|plane| plane.distance(centre) + plane.normal.abs().dot(half) < 0.0)
    }

    /// Appends the indices of the boxes that may share a point with the frustum, in ascending order. The result does
    /// not depend on the machine or the number of threads. Empty boxes are never in it.
    pub fn cull(&self, boxes: &BoxArray, out: &mut Vec<u32>) {
        let mut words = Vec::new();
        self.cull_into_bits(boxes, &mut words);
        out.reserve(words.iter().map(|word| word.count_ones() as usize).sum());
        for (i, mut word) in words.into_iter().enumerate() {
            let base = (i * LANES) as u32;
            if word == u64::MAX {
                out.extend(base..base + LANES as u32);
                continue;
            }
            while word != 0 {
                out.push(base + word.trailing_zeros());
                word &= word - 1;
            }
        }
    }

    /// The same result as a bit set: bit `i % 64` of word `i / 64` is box `i`. `out` is overwritten.
    pub fn cull_into_bits(&self, boxes: &BoxArray, out: &mut Vec<u64>) {
        let (blocks, hulls) = boxes.blocks();
        let planes = self.wide();
        out.clear();
        out.resize(blocks.len(), 0);
        let tasks = (blocks.par_chunks(BLOCKS_A_TASK))
            .zip(hulls.par_chunks(BLOCKS_A_TASK))
            .zip(out.par_chunks_mut(BLOCKS_A_TASK));
        tasks.for_each(|((blocks, hulls), out)| masks(&planes, blocks, hulls, out));
    }

    fn wide(&self) -> Vec<WidePlane> {
        let wide = |plane: &Plane| WidePlane {
            normal: plane.normal.to_array(),
            size: plane.normal.abs().to_array(),
            offset: plane.offset,
        };
        self.planes.iter().map(wide).collect()
    }
}

/// Blocks of 64 boxes per parallel task, enough to outweigh the cost of waking a thread.
const BLOCKS_A_TASK: usize = 256;

/// A plane with precomputed values for the inner loop.
#[derive(Clone, Copy)]
struct WidePlane {
    normal: [f64; 3],
    size: [f64; 3],
    offset: f64,
}

impl WidePlane {
    /// The least and the greatest signed distance of a box's points.
    fn span(&self, centre: DVec3, half: DVec3) -> (f64, f64) {
        let distance = DVec3::from_array(self.normal).dot(centre) + self.offset;
        let reach = DVec3::from_array(self.size).dot(half);
        (distance - reach, distance + reach)
    }
}

/// One word per block: the boxes that may be inside. A block whose hull is wholly outside, or inside every plane, is
/// decided without a test of its boxes. For other blocks only the planes that cut the hull are tested.
fn masks(planes: &[WidePlane], blocks: &[Block], hulls: &[Hull], out: &mut [u64]) {
    let mut cutting = Vec::with_capacity(planes.len());
    for ((block, hull), out) in blocks.iter().zip(hulls).zip(out) {
        cutting.clear();
        let mut outside = false;
        for plane in planes {
            let (least, greatest) = plane.span(hull.centre, hull.half);
            outside |= greatest < 0.0;
            // NaN counts as a cut.
            if least < 0.0 || least.is_nan() {
                cutting.push(*plane);
            }
        }
        *out = match (outside, cutting.is_empty()) {
            (true, _) => 0,
            (false, true) => hull.live,
            (false, false) => block_mask(&cutting, block) & hull.live,
        };
    }
}

/// Boxes that the inner loop keeps in registers.
const WIDTH: usize = 8;

/// One bit per box of the block that is behind none of the planes. No branch depends on a box.
#[multiversion::multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx"
))]
fn block_mask(planes: &[WidePlane], block: &Block) -> u64 {
    let [cx, cy, cz] = block.centre.each_ref().map(|a| a.as_chunks::<WIDTH>().0);
    let [hx, hy, hz] = block.half.each_ref().map(|a| a.as_chunks::<WIDTH>().0);
    let mut inside = 0_u64;
    let lanes = cx.iter().zip(cy).zip(cz).zip(hx).zip(hy).zip(hz);
    for (group, (((((cx, cy), cz), hx), hy), hz)) in lanes.enumerate() {
        let mut least = [0.0_f64; WIDTH];
        for plane in planes {
            let ([nx, ny, nz], [sx, sy, sz]) = (plane.normal, plane.size);
            for i in 0..WIDTH {
                let distance = nx * cx[i] + ny * cy[i] + nz * cz[i] + plane.offset;
                let greatest = distance + (sx * hx[i] + sy * hy[i] + sz * hz[i]);
                // A comparison with NaN is false, so such a box stays inside.
                least[i] = if greatest < least[i] {
                    greatest
                } else {
                    least[i]
                };
            }
        }
        let mut bits = 0_u64;
        for (i, least) in least.iter().enumerate() {
            bits |= u64::from(*least >= 0.0) << i;
        }
        inside |= bits << (group * WIDTH);
    }
    inside
}
