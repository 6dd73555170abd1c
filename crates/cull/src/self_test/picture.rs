//! The hand-made picture that trials draw: rectangles of pixels at depths of their own, and what the host knows of it.
//!
//! Edges lie between pixels and depths are binary fractions, so that every answer is known exactly, on any device and with any number of samples.

use std::ops::Range;

use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4, Vec3};

use crate::judge::{JudgedInstance, Part};
use crate::split_point::SplitPoint;

/// Width and height of the picture. Neither is a power of two, so that the pyramid's levels have odd sides; the longer one has a level above 6.
pub(super) const SIZE: [u32; 2] = [100, 70];

/// The clip space of the picture is its world, seen from `EYE`: x to the right, y upwards, and depth.
pub(super) const CLIP_FROM_RELATIVE: Mat4 = Mat4::IDENTITY;

/// Where the picture is seen from: so far from the world's origin that an f32 has steps of half a unit. A device that joins the halves of a coordinate before it subtracts the eye draws another
/// picture.
pub(super) const EYE: DVec3 = DVec3::splat(6e6);

/// A rectangle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rect {
    /// Columns and rows of pixels, from the upper left.
    pub x: Range<u32>,
    pub y: Range<u32>,
    /// In the middle, and all over it where nothing tilts it.
    pub depth: f32,
    /// By how much its right and its upper edge are nearer than the middle.
    tilt: [f32; 2],
}

impl Rect {
    pub const fn new(x: Range<u32>, y: Range<u32>, depth: f32) -> Self {
        let tilt = [0.0; 2];
        Self { x, y, depth, tilt }
    }

    const fn tilted(self, right: f32, upper: f32) -> Self {
        let tilt = [right, upper];
        Self { tilt, ..self }
    }

    /// The number of its pixels.
    pub fn area(&self) -> u32 {
        self.x.len() as u32 * self.y.len() as u32
    }

    /// Middle and half sides in clip space, in an image of this size.
    fn place(&self, [width, height]: [u32; 2]) -> [[f32; 2]; 2] {
        let along = |side: &Range<u32>, pixels: u32| {
            let half = (side.end as f32 - side.start as f32) / pixels as f32;
            let middle = (side.end as f32 + side.start as f32) / pixels as f32 - 1.0;
            [middle, half]
        };
        let [x, half_x] = along(&self.x, width);
        let [y, half_y] = along(&self.y, height);
        [[x, -y], [half_x, half_y]]
    }

    /// The instance that draws the quad from -1 to 1 as this rectangle.
    pub fn instance(&self, size: [u32; 2]) -> GpuInstance {
        let [[x, y], [half_x, half_y]] = self.place(size);
        let SplitPoint { high, low } = in_world([x, y, self.depth]);
        GpuInstance {
            row_x: [half_x, 0.0, 0.0, high[0]],
            row_y: [0.0, half_y, 0.0, high[1]],
            row_z: [self.tilt[0], self.tilt[1], 1.0, high[2]],
            origin_low: low,
            material: 0,
        }
    }

    /// Centre, relative to the eye, and half edges of the box whose near face this rectangle is, so deep.
    pub fn solid(&self, deep: f32) -> [[f32; 3]; 4] {
        let [[x, y], [half_x, half_y]] = self.place(SIZE);
        let half = deep * 0.5;
        [
            [x, y, self.depth - half],
            [half_x, 0.0, 0.0],
            [0.0, half_y, 0.0],
            [0.0, 0.0, half],
        ]
    }

    /// The same box as it is judged.
    pub fn judged(&self, deep: f32, part: Part) -> JudgedInstance {
        let [centre, x, y, z] = self.solid(deep);
        let SplitPoint { high, low } = in_world(centre);
        let row = |axis: usize| [x[axis], y[axis], z[axis], high[axis]];
        JudgedInstance {
            row_x: row(0),
            row_y: row(1),
            row_z: row(2),
            centre_low: low,
            traits: JudgedInstance::traits(part, 0),
        }
    }

    /// The places of its pixels in an image that is `width` pixels wide; what is beyond the picture is cut off.
    fn pixels(&self) -> impl Iterator<Item = usize> {
        let [width, height] = SIZE;
        let columns = self.x.start.min(width)..self.x.end.min(width);
        let rows = self.y.start.min(height)..self.y.end.min(height);
        rows.flat_map(move |y| columns.clone().map(move |x| (y * width + x) as usize))
    }
}

/// A place relative to the eye in the world.
fn in_world(relative: [f32; 3]) -> SplitPoint {
    SplitPoint::new(EYE + Vec3::from(relative).as_dvec3())
}

/// Mirrors `Instance` of `shared/instance.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(super) struct GpuInstance {
    row_x: [f32; 4],
    row_y: [f32; 4],
    row_z: [f32; 4],
    origin_low: [f32; 3],
    material: u32,
}

assert_layout!(GpuInstance, "depth", "Instance", { row_x, row_y, row_z, origin_low, material });

/// What hides others: a wall over the left half, and posts and sills before and beside it, at other depths.
pub(super) fn occluders() -> Vec<Rect> {
    let mut all = vec![WALL];
    for number in 0..12u32 {
        let x = 3 + number * 8;
        let y = 2 + number * 29 % 60;
        let depth = 0.53125 + number as f32 / 64.0;
        all.push(Rect::new(
            x..x + 1 + number % 5,
            y..y + 3 + number % 4,
            depth,
        ));
    }
    all.push(Rect::new(60..97, 30..69, 0.375));
    all
}

/// The wall.
pub(super) const WALL: Rect = Rect::new(0..50, 0..70, 0.5);

/// With several samples a pixel: drawn in all of them but the last, so that samples of a pixel differ.
pub(super) const SHUTTER: Rect = Rect::new(64..96, 4..24, 0.75);

/// What is counted and queried, slot by slot, and in words.
pub(super) fn tested() -> Vec<(Rect, &'static str)> {
    let step = 1.0 / 4096.0;
    vec![
        (WALL, "the wall itself, at equal depth"),
        (
            Rect::new(10..20, 10..30, 0.96875),
            "a sheet before everything",
        ),
        (Rect::new(4..44, 6..60, 0.25), "a sheet behind the wall"),
        (
            Rect::new(30..70, 40..50, 0.25),
            "a sheet half behind the wall",
        ),
        (
            Rect::new(5..15, 50..60, 0.5),
            "a sheet in the wall, at equal depth",
        ),
        (
            Rect::new(5..45, 34..48, 0.5 - step),
            "a sheet closely behind the wall",
        ),
        (
            Rect::new(5..45, 34..48, 0.5 + step),
            "a sheet closely before the wall",
        ),
        (
            Rect::new(54..58, 4..14, 0.03125),
            "a sheet beside the wall, before nothing",
        ),
        (Rect::new(66..90, 8..20, 0.25), "a sheet behind the shutter"),
        (
            Rect::new(200..210, 10..20, 0.5),
            "a sheet outside of the view",
        ),
    ]
}

/// Sheets before everything, tilted in many ways, where none of what is [tested] is. Their depths are no binary fractions, so that a driver which computes a depth in two ways gets two depths.
pub(super) fn slopes() -> Vec<Rect> {
    vec![
        Rect::new(72..83, 26..37, 0.9).tilted(0.031, -0.017),
        Rect::new(85..98, 27..40, 0.87).tilted(-0.113, 0.0007),
        Rect::new(71..80, 41..54, 0.8137).tilted(0.0999, 0.0777),
        Rect::new(83..97, 43..52, 0.93).tilted(1e-4, -3e-5),
        Rect::new(72..77, 56..69, 0.85).tilted(0.0, 0.14),
        Rect::new(80..98, 55..68, 0.79).tilted(-0.05, -0.03),
    ]
}

/// The picture as the host knows it: a depth a sample, sample by sample.
pub(super) struct Painted {
    depths: Vec<Vec<f32>>,
}

impl Painted {
    /// The occluders, and a shutter before all samples but the last.
    pub fn new(samples: u32, shutter: Option<&Rect>) -> Self {
        let [width, height] = SIZE;
        let mut depths = vec![vec![0.0f32; (width * height) as usize]; samples as usize];
        let shut = depths.len().saturating_sub(1);
        let cover = |image: &mut Vec<f32>, rect: &Rect| {
            for at in rect.pixels() {
                if let Some(depth) = image.get_mut(at) {
                    *depth = depth.max(rect.depth);
                }
            }
        };
        for (number, image) in depths.iter_mut().enumerate() {
            for rect in occluders() {
                cover(image, &rect);
            }
            if let Some(shutter) = shutter.filter(|_| number < shut) {
                cover(image, shutter);
            }
        }
        Self { depths }
    }

    /// The samples of a rectangle that are at or before the picture.
    pub fn visible(&self, rect: &Rect) -> u32 {
        let of = |image: &Vec<f32>| {
            let before = |at: &usize| image.get(*at).is_some_and(|depth| rect.depth >= *depth);
            rect.pixels().filter(before).count() as u32
        };
        self.depths.iter().map(of).sum()
    }

    /// The depth of the farthest sample, pixel by pixel.
    pub fn farthest(&self) -> Vec<f32> {
        let mut images = self.depths.iter();
        let mut least = images.next().cloned().unwrap_or_default();
        for image in images {
            for (least, depth) in least.iter_mut().zip(image) {
                *least = least.min(*depth);
            }
        }
        least
    }
}

/// The pixels that each of these rectangles owns, once all are drawn in order and equal depths replace each other.
pub(super) fn owned<'a>(rects: impl Iterator<Item = &'a Rect>) -> Vec<u32> {
    let [width, height] = SIZE;
    let mut image = vec![(0.0f32, None); (width * height) as usize];
    let mut count = 0;
    for (number, rect) in rects.enumerate() {
        count = number + 1;
        for at in rect.pixels() {
            if let Some(pixel) = image.get_mut(at)
                && rect.depth >= pixel.0
            {
                *pixel = (rect.depth, Some(number));
            }
        }
    }
    let mut owned = vec![0; count];
    for (_, owner) in image {
        if let Some(owned) = owner.and_then(|owner| owned.get_mut(owner)) {
            *owned += 1;
        }
    }
    owned
}
