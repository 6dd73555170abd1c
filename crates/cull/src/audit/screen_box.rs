//! The part of the image that an entity may cover, and its nearest depth: the projection of its box, widened as the boxes of queries are.

use antumbra_scene::Topology;
use glam::{DMat4, DVec2, DVec3};

use crate::boxes::{BoxContents, Widening};
use crate::draw_source::patches::{Cover, PATCH_SIDE};
use crate::entities::SceneTable;
use crate::view::ViewFrame;

/// Projects boxes into a view's image.
#[derive(Debug)]
pub(super) struct ScreenProjector {
    clip_from_relative: DMat4,
    size: [u32; 2],
    solid: Widening,
    thin: Widening,
}

/// The projection of a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScreenBox {
    /// In pixels from the upper left corner, on the image or not.
    least: DVec2,
    greatest: DVec2,
    /// Reversed depth.
    nearest: f64,
}

impl ScreenBox {
    /// Unbounded: covers everything, in front of everything.
    const EVERYWHERE: Self = Self {
        least: DVec2::NEG_INFINITY,
        greatest: DVec2::INFINITY,
        nearest: f64::INFINITY,
    };

    /// Whether it is unbounded.
    pub fn is_everywhere(&self) -> bool {
        *self == Self::EVERYWHERE
    }
}

/// The error of an f32 depth: relative, and with a far plane absolute. A hundred times that of one operation.
const ROUNDING: f64 = 1e-5;

impl ScreenProjector {
    pub fn new(view: &ViewFrame) -> Self {
        Self {
            clip_from_relative: view.clip_from_relative().as_dmat4(),
            size: view.size,
            solid: Widening::new(view, BoxContents::Triangles),
            thin: Widening::new(view, BoxContents::AnyTopology),
        }
    }

    /// Projects an entity's box.
    pub fn project(&self, table: &SceneTable, slot: u32) -> ScreenBox {
        let widening = match table.class_of(slot).topology() {
            Topology::Triangles => &self.solid,
            _ => &self.thin,
        };
        let Some(corners) = widening.corners(&table.oriented(slot)) else {
            return ScreenBox::EVERYWHERE;
        };
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let (mut least, mut greatest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in corners {
            let clip = self.clip_from_relative * corner.as_dvec3().extend(1.0);
            // A corner beside or behind the eye, or beyond f32, may project anywhere.
            if !(clip.w > 0.0 && clip.is_finite()) {
                return ScreenBox::EVERYWHERE;
            }
            let at = clip.truncate() / clip.w;
            least = least.min(at);
            greatest = greatest.max(at);
        }
        // With a far plane, depth is a sum, and its error that of the larger part.
        let summed = self.clip_from_relative.row(2).truncate() != DVec3::ZERO;
        let lost = if summed { ROUNDING } else { 0.0 };
        // Upwards in clip space is downwards in pixels.
        let pixels = |x: f64, y: f64| (DVec2::new(x, -y) * 0.5 + 0.5) * size;
        ScreenBox {
            least: pixels(least.x, greatest.y),
            greatest: pixels(greatest.x, least.y),
            nearest: greatest.z * (1.0 + ROUNDING) + lost,
        }
    }

    /// The patches that it covers, as ranges of columns and rows within the image; `None` for none.
    pub fn patches(&self, screen_box: &ScreenBox) -> Option<[[u32; 2]; 2]> {
        let [x, y] = self.on_image(screen_box, [0, 0], self.size)?;
        Some([x, y].map(|[least, greatest]| [least / PATCH_SIDE, greatest / PATCH_SIDE]))
    }

    /// The part of a patch that it may cover; `None` for none.
    pub fn cover(&self, screen_box: &ScreenBox, [column, row]: [u32; 2]) -> Option<Cover> {
        let corner = [column * PATCH_SIDE, row * PATCH_SIDE];
        let end = |at: usize| self.size[at].min(corner[at] + PATCH_SIDE);
        let [x, y] = self.on_image(screen_box, corner, [end(0), end(1)])?;
        let nearest = screen_box.nearest as f32;
        Some(Cover {
            nearest: nearest.next_up(),
            least: [x[0], y[0]],
            greatest: [x[1], y[1]],
        })
    }

    /// The pixels in x and in y between two corners of the image, both ends included.
    fn on_image(
        &self,
        screen_box: &ScreenBox,
        from: [u32; 2],
        to: [u32; 2],
    ) -> Option<[[u32; 2]; 2]> {
        let along = |least: f64, greatest: f64, from: u32, to: u32| {
            // Casts saturate.
            let (first, last) = (least.floor() as u32, greatest.floor() as u32);
            let inside = greatest >= f64::from(from) && last >= from && first < to;
            inside.then(|| [first.max(from), last.min(to - 1)])
        };
        let x = along(screen_box.least.x, screen_box.greatest.x, from[0], to[0])?;
        let y = along(screen_box.least.y, screen_box.greatest.y, from[1], to[1])?;
        Some([x, y])
    }
}
