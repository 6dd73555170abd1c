//! Where a box lies as seen from the eye: outside, too near to be asked about, or on so many pixels.

use antumbra_draw::ViewFrame;
use antumbra_draw::boxes::{BoxContents, Widening};
use antumbra_scene::Aabb;
use glam::{DVec3, Mat4, Vec2, Vec4, Vec4Swizzles};

use super::map::BlockRect;

/// A view, ready to place many boxes.
#[derive(Debug, Clone)]
pub struct Screen {
    eye: DVec3,
    forward: DVec3,
    near: f64,
    clip_from_relative: Mat4,
    size: Vec2,
    planes: Vec<(DVec3, DVec3, f64)>,
    widening: Widening,
    block: f32,
    blocks: [u32; 2],
}

/// Where a box lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// Outside the frustum.
    Outside,
    /// Around the eye, across the near plane or partly behind the camera: visible, and never to be asked about.
    Near,
    /// On the screen.
    OnScreen {
        /// Which pixels, at most.
        pixels: PixelRect,
        /// Whether all of it is in the frustum.
        whole: bool,
    },
}

/// Pixels from the left upper corner of the screen, as far as they are on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelRect {
    /// Least x and y.
    pub least: Vec2,
    /// Greatest x and y.
    pub greatest: Vec2,
}

impl Screen {
    /// For boxes seen by this view. `block`: pixels along a side of a block of the map, at least 1.
    pub fn new(view: &ViewFrame, block: u32, contents: BoxContents) -> Self {
        let camera = &view.camera;
        let block = block.max(1);
        Self {
            eye: camera.position,
            forward: camera.forward(),
            near: camera.near(),
            clip_from_relative: view.clip_from_relative(),
            size: Vec2::new(view.size[0] as f32, view.size[1] as f32),
            planes: (view.frustum.planes().iter())
                .map(|plane| (plane.normal, plane.normal.abs(), plane.offset))
                .collect(),
            widening: Widening::new(view, contents),
            block: block as f32,
            blocks: view.size.map(|side| side.div_ceil(block)),
        }
    }

    /// Blocks in a row of the map, and rows.
    pub fn blocks(&self) -> [u32; 2] {
        self.blocks
    }

    /// How boxes that are asked about are widened.
    pub fn widening(&self) -> &Widening {
        &self.widening
    }

    /// The eye.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The square of the distance from the eye to a box's nearest corner: what boxes are sorted by.
    pub fn nearness(&self, bounds: &Aabb) -> f32 {
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
            .any(|(normal, size, offset)| normal.dot(centre) + offset + size.dot(half) < 0.0)
    }

    /// Where a box lies. `inside`: it is known to be all in the frustum, as what lies in a box that is.
    pub fn place(&self, bounds: &Aabb, inside: bool) -> Place {
        let (centre, half) = (bounds.centre(), bounds.half_extents());
        let mut whole = true;
        let planes = if inside { &[] } else { self.planes.as_slice() };
        for (normal, size, offset) in planes {
            let (distance, reach) = (normal.dot(centre) + offset, size.dot(half));
            if distance + reach < 0.0 {
                return Place::Outside;
            }
            whole &= distance - reach >= 0.0;
        }
        let centre = centre - self.eye;
        let depth = self.forward.dot(centre) - self.forward.abs().dot(half);
        let reach = centre.length() + half.length();
        let margin = self.widening.margin(reach) * 2.0 + self.near.abs() * 1e-3;
        // What has no depth to tell counts as near.
        if depth <= self.near + margin || depth.is_nan() {
            return Place::Near;
        }
        let pixels = self.pixels(centre.as_vec3(), half.as_vec3());
        Place::OnScreen { pixels, whole }
    }

    /// The pixels under what of a box lies before the near plane: none of one behind it.
    pub fn clipped(&self, bounds: &Aabb) -> PixelRect {
        let corners = bounds.corners().map(|corner| corner - self.eye);
        let depths = corners.map(|corner| self.forward.dot(corner));
        let mut points = Vec::with_capacity(16);
        for (at, (corner, depth)) in corners.iter().zip(depths).enumerate() {
            if depth >= self.near {
                points.push(*corner);
            }
            for other in [at ^ 1, at ^ 2, at ^ 4]
                .into_iter()
                .filter(|other| *other > at)
            {
                let (to, beyond) = (corners[other], depths[other]);
                if (depth < self.near) != (beyond < self.near) {
                    points.push(corner.lerp(to, (self.near - depth) / (beyond - depth)));
                }
            }
        }
        let on_screen = points.iter().map(|point| {
            let clip = self.clip_from_relative * point.as_vec3().extend(1.0);
            clip.xy() / clip.w
        });
        let (mut least, mut greatest) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for point in on_screen {
            // A number that is none leaves the ends where they are.
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

    /// Pixels from clip space.
    fn rect(&self, least: Vec2, greatest: Vec2) -> PixelRect {
        // Upwards in clip space is downwards in pixels.
        let scale = self.size * 0.5;
        let (low, high) = (least * scale, greatest * scale);
        PixelRect {
            least: Vec2::new(low.x + scale.x, scale.y - high.y).max(Vec2::ZERO),
            greatest: Vec2::new(high.x + scale.x, scale.y - low.y).min(self.size),
        }
    }

    /// The blocks that pixels lie in.
    pub fn blocks_of(&self, pixels: &PixelRect) -> BlockRect {
        // Casts of what is out of range end at the range's ends.
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
