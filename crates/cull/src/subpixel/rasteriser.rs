//! A rasteriser on the CPU, for what no driver at hand does: any number of bits below a pixel, and either way to break ties. One sample a pixel, in its middle.
//!
//! Corners are rounded to the nearest step. A sample on an edge belongs to the triangle if the edge is at its top or left (Direct3D's rule), or to the one on the other side: Vulkan asks
//! only that just one of two neighbours has it. Depth is linear on the screen, between the corners as they were moved or as they were before (SwiftShader's way).

use glam::{DVec2, DVec3, Vec4};

/// Which neighbour has the samples on an edge that two share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ties {
    TopLeft,
    BottomRight,
}

/// Between which corners depth is linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depths {
    OfMovedCorners,
    OfCornersBefore,
}

/// Which triangles are drawn. Front faces are counter-clockwise, as wgpu's default is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Faces {
    Front,
    Both,
}

#[derive(Debug, Clone, Copy)]
pub struct Rasteriser {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Bits below a pixel.
    pub bits: u32,
    pub ties: Ties,
    pub depths: Depths,
}

/// A sample that a triangle covers.
#[derive(Debug, Clone, Copy)]
pub struct Fragment {
    pub pixel: [u32; 2],
    pub depth: f64,
}

impl Rasteriser {
    /// Calls `draw` for each sample of a triangle, given by its corners in clip space, all in front of the eye. Nothing is clipped but what is beside the image.
    pub fn triangle(&self, corners: [Vec4; 3], faces: Faces, mut draw: impl FnMut(Fragment)) {
        let before = corners.map(|corner| self.on_screen(corner));
        let step = f64::from(1u32 << self.bits);
        let mut moved = before
            .map(|corner| [corner.x, corner.y].map(|side| (side * step).round_ties_even() as i64));
        let mut points = match self.depths {
            Depths::OfMovedCorners => [0, 1, 2].map(|i| {
                let [x, y] = moved[i].map(|side| side as f64 / step);
                DVec3::new(x, y, before[i].z)
            }),
            Depths::OfCornersBefore => before,
        };
        // The screen counts y downwards, so what is counter-clockwise in clip space has a negative area here.
        let area = edge(moved[0], moved[1], moved[2]);
        if area == 0 || (area > 0 && faces == Faces::Front) {
            return;
        }
        if area < 0 {
            moved.swap(1, 2);
            points.swap(1, 2);
        }
        let half = 1i64 << (self.bits - 1);
        let middle = |pixel: i64| (pixel << self.bits) + half;
        let range = |axis: usize| {
            let sides = moved.map(|corner| corner[axis]);
            let least = sides.into_iter().min().unwrap_or(0) >> self.bits;
            let most = sides.into_iter().max().unwrap_or(0) >> self.bits;
            least.max(0)..(most + 1).min(i64::from(self.size[axis]))
        };
        for y in range(1) {
            for x in range(0) {
                let at = [middle(x), middle(y)];
                let covers = [(0, 1), (1, 2), (2, 0)].into_iter().all(|(from, to)| {
                    match edge(moved[from], moved[to], at) {
                        0 => self.has_edge(moved[from], moved[to]),
                        side => side > 0,
                    }
                });
                if covers {
                    let sample = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                    draw(Fragment {
                        pixel: [x as u32, y as u32],
                        depth: depth_at(points, sample),
                    });
                }
            }
        }
    }

    /// In pixels from the upper left, and depth.
    fn on_screen(&self, clip: Vec4) -> DVec3 {
        let clip = clip.as_dvec4();
        let at = clip.truncate() / clip.w;
        let [wide, high] = self.size.map(f64::from);
        DVec3::new((at.x + 1.0) * 0.5 * wide, (1.0 - at.y) * 0.5 * high, at.z)
    }

    /// Whether the samples on an edge are the triangle's own, which lies to the right of it as the screen counts, clockwise.
    fn has_edge(&self, from: [i64; 2], to: [i64; 2]) -> bool {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let is_top_left = y < 0 || (y == 0 && x > 0);
        is_top_left == (self.ties == Ties::TopLeft)
    }
}

/// Twice the signed area of a triangle; greater than 0 where it is clockwise on the screen.
fn edge(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn depth_at([a, b, c]: [DVec3; 3], at: DVec2) -> f64 {
    let normal = (b - a).cross(c - a);
    if normal.z == 0.0 {
        return a.z.max(b.z).max(c.z);
    }
    a.z - (normal.x * (at.x - a.x) + normal.y * (at.y - a.y)) / normal.z
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [16, 16];

    /// A corner at a place in pixels.
    fn at(x: f32, y: f32, depth: f32) -> Vec4 {
        Vec4::new(x / 8.0 - 1.0, 1.0 - y / 8.0, depth, 1.0)
    }

    fn covered(rasteriser: &Rasteriser, corners: [Vec4; 3]) -> Vec<[u32; 2]> {
        let mut found = Vec::new();
        rasteriser.triangle(corners, Faces::Both, |fragment| found.push(fragment.pixel));
        found
    }

    fn rasteriser(bits: u32, ties: Ties) -> Rasteriser {
        Rasteriser {
            size: SIZE,
            bits,
            ties,
            depths: Depths::OfMovedCorners,
        }
    }

    #[test]
    fn neighbours_share_no_sample_and_leave_none_out() {
        // Edges through the middles of pixels: along an axis and along the diagonal.
        let [a, b, c, d] =
            [(2.5, 2.5), (9.5, 2.5), (9.5, 9.5), (2.5, 9.5)].map(|(x, y)| at(x, y, 0.5));
        for ties in [Ties::TopLeft, Ties::BottomRight] {
            let rasteriser = rasteriser(4, ties);
            let mut found = covered(&rasteriser, [a, b, c]);
            found.extend(covered(&rasteriser, [a, c, d]));
            found.sort_unstable();
            let first = if ties == Ties::TopLeft { 2 } else { 3 };
            let expected: Vec<_> = (first..first + 7)
                .flat_map(|x| (first..first + 7).map(move |y| [x, y]))
                .collect();
            assert_eq!(found, expected, "{ties:?}");
        }
    }

    #[test]
    fn fewer_bits_move_corners_farther() {
        // An edge a fortieth of a pixel beyond the middles of a column: a sixteenth is the nearest step.
        let corners = [at(2.0, 1.0, 0.5), at(6.475, 1.0, 0.5), at(6.475, 14.0, 0.5)];
        let reaches = |bits| {
            let pixels = covered(&rasteriser(bits, Ties::BottomRight), corners);
            pixels.into_iter().any(|[x, _]| x == 6)
        };
        assert!(reaches(4) && !reaches(8));
    }

    #[test]
    fn depth_is_linear_between_the_corners() {
        let corners = [at(0.0, 0.0, 0.0), at(16.0, 0.0, 1.0), at(0.0, 16.0, 0.0)];
        // The corners lie on the grid, so that either way gives the same.
        for depths in [Depths::OfMovedCorners, Depths::OfCornersBefore] {
            let rasteriser = Rasteriser {
                depths,
                ..rasteriser(8, Ties::TopLeft)
            };
            rasteriser.triangle(corners, Faces::Both, |fragment| {
                let expected = (f64::from(fragment.pixel[0]) + 0.5) / 16.0;
                assert!((fragment.depth - expected).abs() < 1e-12);
            });
        }
    }

    #[test]
    fn faces_are_told_apart() {
        let front = [at(1.0, 1.0, 0.5), at(1.0, 9.0, 0.5), at(9.0, 9.0, 0.5)];
        let [a, b, c] = front;
        let count = |corners| {
            let mut count = 0;
            rasteriser(8, Ties::TopLeft).triangle(corners, Faces::Front, |_| count += 1);
            count
        };
        assert!(count(front) > 20);
        assert_eq!(count([a, c, b]), 0);
    }
}
