//! Axis-aligned boxes in f64: union, transform, and rounding outwards to f32.
//!
//! The box of a transformed box follows James Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems, 1990.

mod box_array;
mod equal_boxes;

pub use box_array::BoxArray;
pub(crate) use box_array::{Block, Hull, LANES};
pub(crate) use equal_boxes::tell_apart;

use glam::{DAffine3, DVec3, Vec3};

/// An axis-aligned box in metres. `min <= max` in every axis, or the box is [`Aabb::EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The least corner.
    pub min: DVec3,
    /// The greatest corner.
    pub max: DVec3,
}

impl Aabb {
    /// The box that contains no point. Its union with another box is the other box.
    pub const EMPTY: Self = Self {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The box between two opposite corners, in either order.
    #[must_use]
    pub fn new(a: DVec3, b: DVec3) -> Self {
        Self {
            min: a.min(b),
            max: a.max(b),
        }
    }

    /// The smallest box around `points`; `None` if there is no point.
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let mut found = Self::EMPTY;
        for point in points {
            found.min = found.min.min(point);
            found.max = found.max.max(point);
        }
        (!found.is_empty()).then_some(found)
    }

    /// The box with this centre and these half extents.
    #[must_use]
    pub fn from_centre(centre: DVec3, half_extents: DVec3) -> Self {
        Self {
            min: centre - half_extents,
            max: centre + half_extents,
        }
    }

    /// Whether the box contains no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether all six numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// The smallest box around both boxes.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The middle of the box.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Half the box's size in each axis.
    #[must_use]
    pub fn half_extents(&self) -> DVec3 {
        self.max * 0.5 - self.min * 0.5
    }

    /// Half the surface area, in square metres; 0 for an empty box.
    #[must_use]
    pub fn half_area(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let size = self.max - self.min;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// The eight corners; bit 0 of the index picks x, bit 1 y, bit 2 z (set = `max`).
    #[must_use]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }

    /// Whether `point` lies in the box or on its border.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// Whether this box contains all of `other`.
    #[must_use]
    pub fn contains_box(&self, other: &Self) -> bool {
        other.is_empty() || (self.min.cmple(other.min).all() && other.max.cmple(self.max).all())
    }

    /// Whether the two boxes share a point, borders included.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Distance in metres from `point` to the nearest point of the box; 0 inside.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        let outside = (self.min - point).max(point - self.max).max(DVec3::ZERO);
        outside.length()
    }

    /// The box around this box after `transform` (Arvo 1990). It is widened by the rounding error of the computation,
    /// so it contains every transformed point of this box.
    #[must_use]
    pub fn transformed(&self, transform: &DAffine3) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let (centre, half) = (self.centre(), self.half_extents());
        let size = transform.matrix3.abs();
        let reach = size * half;
        let magnitude = size * centre.abs() + transform.translation.abs() + reach;
        let slack = magnitude * (16.0 * f64::EPSILON);
        Self::from_centre(transform.transform_point3(centre), reach + slack)
    }

    /// How far points reach towards the corners: the largest distance of any of `points` from the middle, where the box is a cube with an edge of 2, rounded up. 1 is a ball that touches
    /// the sides; points that fill the box reach the root of 3.
    pub fn roundness(&self, points: impl IntoIterator<Item = DVec3>) -> f32 {
        let (centre, half) = (self.centre(), self.half_extents());
        // Along an axis without extent every point is in the middle.
        let inverse = DVec3::select(half.cmpgt(DVec3::ZERO), half.recip(), DVec3::ZERO);
        let squared = points
            .into_iter()
            .map(|point| ((point - centre) * inverse).length_squared())
            .fold(0.0, f64::max);
        (squared.sqrt() * (1.0 + 1e-6)) as f32
    }

    /// The box, larger by `margin` metres on every side.
    #[must_use]
    pub fn grown(&self, margin: DVec3) -> Self {
        Self {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// The box relative to `origin` in f32, as least and greatest corner. Each number is rounded outwards, so the f32
    /// box contains the whole box. Pass the camera's position to get the box that goes to the GPU.
    #[must_use]
    pub fn to_f32_outward(&self, origin: DVec3) -> (Vec3, Vec3) {
        let (low, high) = (self.min - origin, self.max - origin);
        let down = |v: f64| round_down(v.next_down());
        let up = |v: f64| round_up(v.next_up());
        (
            Vec3::new(down(low.x), down(low.y), down(low.z)),
            Vec3::new(up(high.x), up(high.y), up(high.z)),
        )
    }
}

/// The greatest f32 that is not above `value`.
#[must_use]
pub fn round_down(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) > value {
        near.next_down()
    } else {
        near
    }
}

/// The least f32 that is not below `value`.
#[must_use]
pub fn round_up(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) < value {
        near.next_up()
    } else {
        near
    }
}
