//! A projection as a matrix, as a host's engine has it: perspective or parallel, on or off the axis, with any near plane, with a far plane or without.
//!
//! Depths are kept reversed. A matrix of forward depths becomes one of reversed depths by `z' = w - z`, which maps the near plane to 1, the far plane to 0, and
//! leaves what is seen where it is. The planes of the view volume are sums of rows of the matrix (Gribb and Hartmann, *Fast Extraction of Viewing Frustum Planes
//! from the World-View-Projection Matrix*, 2001).

use glam::{DMat4, DVec3, DVec4};

use super::error::CameraError;

/// A matrix from view to clip coordinates, as wgpu has them: y upwards, depths of 0 to w. It can be inverted, and mirrors nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipMatrix {
    reversed: DMat4,
}

impl ClipMatrix {
    /// A matrix of reversed depths: 1 at the near plane.
    ///
    /// # Errors
    /// [`CameraError::NotFinite`], [`CameraError::Singular`] and [`CameraError::Mirrored`].
    pub fn reversed(matrix: DMat4) -> Result<Self, CameraError> {
        let made = Self { reversed: matrix };
        made.validate()?;
        Ok(made)
    }

    /// A matrix of forward depths: 0 at the near plane.
    ///
    /// ```
    /// use antumbra_scene::{Camera, ClipMatrix, Projection};
    /// use glam::{DMat4, DQuat, DVec3};
    ///
    /// // A host's own: 90 degrees upwards and sideways, forward depth, the near plane at 0.1 m and the far plane at 100 m.
    /// let (near, far) = (0.1, 100.0);
    /// let depth = far / (near - far);
    /// let theirs = DMat4::from_cols_array_2d(&[
    ///     [1.0, 0.0, 0.0, 0.0],
    ///     [0.0, 1.0, 0.0, 0.0],
    ///     [0.0, 0.0, depth, -1.0],
    ///     [0.0, 0.0, depth * near, 0.0],
    /// ]);
    /// let projection = Projection::Matrix(ClipMatrix::forward(theirs)?);
    /// let camera = Camera::new(projection, DVec3::ZERO, DQuat::IDENTITY)?;
    /// assert!((camera.near() - near).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Self::reversed`].
    pub fn forward(matrix: DMat4) -> Result<Self, CameraError> {
        let mut rows = matrix.transpose();
        rows.z_axis = rows.w_axis - rows.z_axis;
        Self::reversed(rows.transpose())
    }

    /// The matrix, of reversed depths.
    #[must_use]
    pub fn matrix(&self) -> DMat4 {
        self.reversed
    }

    /// Refuses numbers that give no image.
    pub(super) fn validate(&self) -> Result<(), CameraError> {
        if !self.reversed.is_finite() {
            return Err(CameraError::NotFinite {
                what: "matrix",
                value: format!("{}", self.reversed),
            });
        }
        if !is_invertible(&self.reversed) {
            return Err(CameraError::Singular);
        }
        match self.is_mirrored() {
            true => Err(CameraError::Mirrored),
            false => Ok(()),
        }
    }

    /// Whether right and left, or up and down, are exchanged, so that front faces turn their backs.
    fn is_mirrored(&self) -> bool {
        let [x, y, z, w] = self.rows();
        // Along the line of sight through the image's middle, away from the eye, w grows; in a parallel view reversed depth falls.
        let towards_eye = x.truncate().cross(y.truncate());
        let (w, z) = (w.truncate().dot(towards_eye), z.truncate().dot(towards_eye));
        match w == 0.0 {
            true => z < 0.0,
            false => w > 0.0,
        }
    }

    /// The rows for x, y, z and w.
    pub(super) fn rows(&self) -> [DVec4; 4] {
        [0, 1, 2, 3].map(|row| self.reversed.row(row))
    }

    /// The row that is 0 on the near plane, and positive in front of it.
    pub(super) fn near_row(&self) -> DVec4 {
        let [_, _, z, w] = self.rows();
        w - z
    }

    /// Pixels a metre across the line of sight where w is 1, in an image of these pixels: the least and the most anywhere in it.
    #[must_use]
    pub fn pixels_a_metre(&self, pixels: [u32; 2]) -> [f64; 2] {
        let [x, y, _, w] = self.rows().map(DVec4::truncate);
        let [wide, high] = pixels.map(|side| f64::from(side.max(1)) * 0.5);
        let line = x.cross(y);
        let middle = line.normalize_or_zero();
        let (mut least, mut widest) = (f64::INFINITY, 0.0f64);
        for (across, up) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            // The derivatives of a pixel's place by a point's, times w: the singular values of these two rows bound all others. Their product is the length of
            // the rows' cross product, which is affine in the place on the image and so least at a corner along any direction; their largest is convex.
            let (a, b) = ((x - w * across) * wide, (y - w * up) * high);
            least = least.min(a.cross(b).dot(middle));
            widest = widest.max(a.length_squared() + b.length_squared());
        }
        let widest = widest.sqrt();
        [least.max(0.0) / widest, widest]
    }
}

/// Whether a matrix can be inverted, however small its numbers are. What holds no numbers cannot.
#[must_use]
pub fn is_invertible(matrix: &DMat4) -> bool {
    // Held against the sum of the same products without their signs: a determinant that is only small belongs to a near plane close by, or to a large volume.
    let most = permanent(&matrix.to_cols_array_2d().map(|column| column.map(f64::abs)));
    matrix.determinant().abs() > most * 1e-12
}

/// The determinant with every sign positive.
fn permanent([a, b, c, d]: &[[f64; 4]; 4]) -> f64 {
    // By the rows that the first two columns take, and those that are left.
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let of_two = |one: &[f64; 4], other: &[f64; 4], (i, j): (usize, usize)| {
        one[i] * other[j] + one[j] * other[i]
    };
    let products = pairs.iter().zip(pairs.iter().rev());
    let products = products.map(|(rows, rest)| of_two(a, b, *rows) * of_two(c, d, *rest));
    products.sum()
}

/// A vector of a row in world directions.
pub(super) fn turned(row: DVec4, rotation: glam::DQuat) -> (DVec3, f64) {
    (rotation * row.truncate(), row.w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    /// Reversed depth, no far plane, a near plane of a tenth of a millimetre.
    fn near() -> DMat4 {
        DMat4::from_cols_array_2d(&[
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 1e-4, 0.0],
        ])
    }

    #[test]
    fn a_matrix_is_singular_only_where_it_cannot_be_inverted() {
        assert_eq!(permanent(&DMat4::IDENTITY.to_cols_array_2d()), 1.0);
        assert_eq!(permanent(&[[1.0; 4]; 4]), 24.0);
        // Also a thousand kilometres from the origin, and a volume of a million kilometres.
        let far_away = DMat4::from_rotation_y(0.7) * DMat4::from_translation(DVec3::splat(1e6));
        assert!(is_invertible(&near()));
        assert!(is_invertible(&(near() * far_away)));
        assert!(is_invertible(&DMat4::from_scale(DVec3::splat(1e-9))));
        assert!(!is_invertible(&DMat4::ZERO));
        let flat = near() * DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0));
        assert!(!is_invertible(&flat));
        let nan = DMat4::from_scale(DVec3::new(1.0, f64::NAN, 1.0));
        assert!(!is_invertible(&nan));
        assert_eq!(ClipMatrix::reversed(flat), Err(CameraError::Singular));
        assert!(matches!(
            ClipMatrix::reversed(nan),
            Err(CameraError::NotFinite { .. })
        ));
    }

    #[test]
    fn a_mirror_image_is_refused_whatever_the_projection() {
        let parallel = DMat4::from_cols_array_2d(&[
            [0.5, 0.0, 0.0, 0.0],
            [0.0, 0.5, 0.0, 0.0],
            [0.0, 0.0, 0.1, 0.0],
            [0.0, 0.0, 0.7, 1.0],
        ]);
        let turned = DMat4::from_quat(DQuat::from_rotation_x(2.0));
        for matrix in [near(), parallel, near() * turned, parallel * turned] {
            assert!(ClipMatrix::reversed(matrix).is_ok(), "{matrix}");
            for axis in [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0)] {
                let mirrored = DMat4::from_scale(axis) * matrix;
                let refused = ClipMatrix::reversed(mirrored);
                assert_eq!(refused, Err(CameraError::Mirrored), "{matrix}");
            }
        }
    }

    #[test]
    fn lengths_in_pixels_are_bounded_from_both_sides() {
        let off = DMat4::from_cols_array_2d(&[
            [1.3, 0.0, 0.0, 0.0],
            [0.0, 2.1, 0.0, 0.0],
            [0.3, -0.2, 0.0, -1.0],
            [0.0, 0.0, 0.1, 0.0],
        ]);
        let size = [640, 400];
        let matrix = ClipMatrix::reversed(off).unwrap();
        let [least, most] = matrix.pixels_a_metre(size);
        assert!(least > 0.0 && most.is_finite());
        let half = DVec3::new(320.0, 200.0, 0.0);
        let place = |point: DVec3| {
            let clip = off * point.extend(1.0);
            clip.truncate() / clip.w * half
        };
        let back = off.inverse();
        for corner in [(-1.0, -1.0), (0.0, 0.0), (0.9, -0.7), (1.0, 1.0)] {
            let seen = back * DVec4::new(corner.0, corner.1, 0.05, 1.0);
            let point = seen.truncate() / seen.w;
            let w = (off * point.extend(1.0)).w;
            let sight = point.normalize();
            let side = sight.any_orthonormal_vector();
            for turn in 0..12 {
                let across = DQuat::from_axis_angle(sight, f64::from(turn) * 0.5) * side * 1e-6;
                let pixels = (place(point + across) - place(point)).truncate().length() / 1e-6 * w;
                assert!(pixels >= least * 0.999, "{pixels} under {least}");
                assert!(pixels <= most * 1.001, "{pixels} over {most}");
            }
        }
    }
}
