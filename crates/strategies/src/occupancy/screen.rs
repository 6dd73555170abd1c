//! Where a bounding box lies on the screen of a view: outside the frustum, too near to be queried, or over which pixels.

use antumbra_cull::ViewFrame;
use antumbra_cull::boxes::{BoxContents, Widening};
use antumbra_scene::Aabb;
use glam::{DVec3, Mat4, Vec2, Vec4, Vec4Swizzles};

use super::map::BlockRect;

/// A view, prepared to place many boxes.
#[derive(Debug, Clone)]
pub struct Screen {
    eye: DVec3,
    /// The near plane relative to the eye: what is in front of it is positive.
    near: Plane,
    /// What the projection divides by; not above 0 beside and behind the eye.
    divisor: Plane,
    clip_from_relative: Mat4,
    size: Vec2,
    planes: Vec<Plane>,
    widening: Widening,
    block: f32,
    blocks: [u32; 2],
}

/// A plane, of the frustum or relative to the eye. Points inside have `normal . point + offset >= 0`.
#[derive(Debug, Clone, Copy)]
struct Plane {
    normal: DVec3,
    abs_normal: DVec3,
    offset: f64,
}

impl Plane {
    fn new(normal: DVec3, offset: f64) -> Self {
        Self {
            normal,
            abs_normal: normal.abs(),
            offset,
        }
    }

    fn at(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }

    /// The least value in a box of this centre and these half extents.
    fn least(&self, centre: DVec3, half: DVec3) -> f64 {
        self.at(centre) - self.abs_normal.dot(half)
    }
}

/// How much of a box lies in the frustum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Containment {
    /// All of it.
    Inside,
    /// A part of it may lie outside.
    Partial,
}

/// Where a box lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BoxPlacement {
    /// Outside the frustum.
    Outside,
    /// Around the eye, across the near plane or partly behind the camera: visible without a query.
    Near,
    /// On the screen.
    OnScreen {
        /// A bound on the pixels under it.
        pixels: PixelRect,
        /// How much of it lies in the frustum.
        containment: Containment,
    },
}

/// A rectangle in pixels from the left upper corner of the screen, clipped to the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelRect {
    /// Least x and y.
    pub least: Vec2,
    /// Greatest x and y.
    pub greatest: Vec2,
}

impl Screen {
    /// The screen of a view. `block`: pixels along a side of a block of the map, at least 1. `contents`: what the boxes hold.
    pub fn new(view: &ViewFrame, block: u32, contents: BoxContents) -> Self {
        let camera = &view.camera;
        let block = block.max(1);
        let near = camera.near_plane();
        let (divides, at_eye) = camera.divisor();
        Self {
            eye: camera.position,
            near: Plane::new(near.normal, near.distance(camera.position)),
            divisor: Plane::new(divides, at_eye),
            clip_from_relative: view.clip_from_relative(),
            size: Vec2::new(view.size[0] as f32, view.size[1] as f32),
            planes: (view.frustum.planes().iter())
                .map(|plane| Plane::new(plane.normal, plane.offset))
                .collect(),
            widening: Widening::new(view, contents),
            block: block as f32,
            blocks: view.size.map(|side| side.div_ceil(block)),
        }
    }

    /// Blocks of the map along x and along y.
    pub fn blocks(&self) -> [u32; 2] {
        self.blocks
    }

    /// The widening of the boxes that queries draw.
    pub fn widening(&self) -> &Widening {
        &self.widening
    }

    /// The eye's position in the world.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The square of the distance from the eye to a box's nearest corner, in square metres: the traversal's sort key.
    pub fn nearest_corner_distance_squared(&self, bounds: &Aabb) -> f32 {
        let (low, high) = (bounds.min - self.eye, bounds.max - self.eye);
        let nearest = (low * low).min(high * high);
        nearest.element_sum() as f32
    }

    /// Whether a box may share a point with the frustum.
    pub fn sees(&self, bounds: &Aabb) -> bool {
        let (centre, half) = (bounds.centre(), bounds.half_extents());
        // Written so that NaN counts as inside.
        !self
            .planes
            .iter()
            .any(|plane| plane.at(centre) + plane.abs_normal.dot(half) < 0.0)
    }

    /// Places a box. `parent`: how much of an enclosing box lies in the frustum; with [`Containment::Inside`] the planes need no test.
    pub fn place(&self, bounds: &Aabb, parent: Containment) -> BoxPlacement {
        let (centre, half) = (bounds.centre(), bounds.half_extents());
        let mut containment = Containment::Inside;
        let planes = match parent {
            Containment::Inside => &[],
            Containment::Partial => self.planes.as_slice(),
        };
        for plane in planes {
            let distance = plane.at(centre);
            let reach = plane.abs_normal.dot(half);
            if distance + reach < 0.0 {
                return BoxPlacement::Outside;
            }
            let inside = distance - reach >= 0.0;
            if !inside {
                containment = Containment::Partial;
            }
        }
        let centre = centre - self.eye;
        let clearance = self.near.least(centre, half);
        let reach = centre.length() + half.length();
        let margin = self.widening.margin(reach) * 2.0 + self.near.offset.abs() * 1e-3;
        // In front of an oblique near plane, points may be beside the eye.
        let beside = self.divisor.least(centre, half) <= 0.0;
        // What is NaN counts as near.
        if clearance <= margin || clearance.is_nan() || beside {
            return BoxPlacement::Near;
        }
        let pixels = self.pixels(centre.as_vec3(), half.as_vec3());
        BoxPlacement::OnScreen {
            pixels,
            containment,
        }
    }

    /// The pixels under the part of a box in front of the near plane; an empty rectangle where the box lies behind it.
    pub fn clipped(&self, bounds: &Aabb) -> PixelRect {
        let corners = bounds.corners().map(|corner| corner - self.eye);
        let depths = corners.map(|corner| self.near.at(corner));
        let mut points = Vec::with_capacity(16);
        for (at, (corner, depth)) in corners.iter().zip(depths).enumerate() {
            if depth >= 0.0 {
                points.push(*corner);
            }
            for other in [at ^ 1, at ^ 2, at ^ 4]
                .into_iter()
                .filter(|other| *other > at)
            {
                let (to, beyond) = (corners[other], depths[other]);
                if (depth < 0.0) != (beyond < 0.0) {
                    points.push(corner.lerp(to, depth / (depth - beyond)));
                }
            }
        }
        if points.iter().any(|point| self.divisor.at(*point) <= 0.0) {
            // Beside or behind the eye there is no place on the screen.
            return self.rect(Vec2::NEG_INFINITY, Vec2::INFINITY);
        }
        let on_screen = points.iter().map(|point| {
            let clip = self.clip_from_relative * point.as_vec3().extend(1.0);
            clip.xy() / clip.w
        });
        let (mut least, mut greatest) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for point in on_screen {
            // NaN leaves the bounds unchanged.
            least = point.min(least);
            greatest = point.max(greatest);
        }
        self.rect(least, greatest)
    }

    /// The pixels under a box in front of the near plane.
    fn pixels(&self, centre: glam::Vec3, half: glam::Vec3) -> PixelRect {
        let matrix = &self.clip_from_relative;
        let middle = *matrix * centre.extend(1.0);
        let [x, y, z] = [
            matrix.x_axis * half.x,
            matrix.y_axis * half.y,
            matrix.z_axis * half.z,
        ];
        let (mut least, mut greatest) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for xy in [x + y, x - y, y - x, -x - y] {
            for corner in [middle + xy + z, middle + xy - z] {
                let corner: Vec4 = corner;
                let on_screen = corner.xy() / corner.w;
                least = least.min(on_screen);
                greatest = greatest.max(on_screen);
            }
        }
        self.rect(least, greatest)
    }

    /// Converts a rectangle from clip space to pixels.
    fn rect(&self, least: Vec2, greatest: Vec2) -> PixelRect {
        // Clip space points up, pixels count downwards.
        let scale = self.size * 0.5;
        let (low, high) = (least * scale, greatest * scale);
        PixelRect {
            least: Vec2::new(low.x + scale.x, scale.y - high.y).max(Vec2::ZERO),
            greatest: Vec2::new(high.x + scale.x, scale.y - low.y).min(self.size),
        }
    }

    /// The blocks of the map under a rectangle of pixels.
    pub fn blocks_of(&self, pixels: &PixelRect) -> BlockRect {
        // A cast of a float out of range saturates.
        let (least, greatest) = (pixels.least / self.block, pixels.greatest / self.block);
        let [wide, high] = self.blocks;
        BlockRect {
            left: (least.x as u32).min(wide.saturating_sub(1)),
            top: (least.y as u32).min(high.saturating_sub(1)),
            right: (greatest.x as u32).min(wide.saturating_sub(1)),
            bottom: (greatest.y as u32).min(high.saturating_sub(1)),
        }
    }
}
