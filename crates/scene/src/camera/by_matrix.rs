//! What a camera with a matrix sees: planes that are sums of the matrix's rows.

use glam::{DVec2, DVec3, DVec4};

use super::clip_matrix::turned;
use super::{Camera, ClipMatrix, OPENING};
use crate::bounds::Aabb;
use crate::frustum::{Frustum, Plane};

impl Camera {
    /// The plane on which a row of a matrix is 0, inside where it is positive; `None` where it is the same everywhere.
    pub(super) fn plane(&self, row: DVec4) -> Option<Plane> {
        let (direction, offset) = turned(row, self.rotation);
        let length = direction.length();
        (length > 0.0).then(|| {
            let normal = direction / length;
            Plane {
                normal,
                offset: offset / length - normal.dot(self.position),
            }
        })
    }

    /// [`Self::window`] for a matrix.
    pub(super) fn matrix_window(&self, matrix: &ClipMatrix, low: DVec2, high: DVec2) -> Vec<Plane> {
        let [_, _, z, w] = matrix.rows();
        let mut planes = self.matrix_sides(matrix, low, high);
        let near = self.plane(matrix.near_row()).map(|plane| Plane {
            offset: plane.offset + plane.distance(self.position).abs() * OPENING,
            ..plane
        });
        let far = self.plane(z + w * OPENING);
        let ends = [near, far].into_iter().flatten();
        planes.extend(ends.map(|plane| self.opened(plane)));
        planes
    }

    /// The side planes of a matrix, opened. Where the window is off the axis, by as much more as its middle is.
    pub(super) fn matrix_sides(&self, matrix: &ClipMatrix, low: DVec2, high: DVec2) -> Vec<Plane> {
        let [x, y, _, w] = matrix.rows();
        let along = w.truncate();
        let off = |row: DVec4| {
            let shift = row.truncate().dot(along) / along.length_squared();
            if shift.is_finite() { shift.abs() } else { 0.0 }
        };
        let opening = |row: DVec4| w * (OPENING * (1.0 + off(row)));
        let rows = [
            x - w * low.x + opening(x),
            w * high.x - x + opening(x),
            y - w * low.y + opening(y),
            w * high.y - y + opening(y),
        ];
        let planes = rows.into_iter().filter_map(|row| self.plane(row));
        planes.map(|plane| self.opened(plane)).collect()
    }

    /// A plane that is farther outside by the rounding of the camera's position.
    fn opened(&self, plane: Plane) -> Plane {
        Plane {
            offset: plane.offset + self.rounding(),
            ..plane
        }
    }

    /// [`Self::crosses_near`] for a matrix. An oblique near plane may have points in front of it that are beside or behind the eye.
    pub(super) fn matrix_crosses_near(&self, matrix: &ClipMatrix, bounds: &Aabb) -> bool {
        let near = self.near_plane();
        let reach = (bounds.min - self.position)
            .abs()
            .max((bounds.max - self.position).abs());
        let clear = near.distance(self.position).abs();
        let margin = reach.max_element() * OPENING + clear * 1e-3 + self.rounding();
        let bounds = bounds.grown(DVec3::splat(margin));
        let (centre, half) = (bounds.centre(), bounds.half_extents());
        let (divides, at_eye) = self.divisor();
        let least = divides.dot(centre - self.position) + at_eye - divides.abs().dot(half);
        if least <= 0.0 {
            return true;
        }
        let (middle, around) = (near.distance(centre), near.normal.abs().dot(half));
        let cut = middle - around <= 0.0 && middle + around >= 0.0;
        let sides = self.matrix_sides(matrix, DVec2::NEG_ONE, DVec2::ONE);
        cut && Frustum::new(sides).intersects(&bounds)
    }
}
