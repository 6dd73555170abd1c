//! Draws a field from above or at an angle, lit from the north-west, each triangle in a colour of its own.

use antumbra_terrain::Field;
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

/// The direction that a field is drawn from, with a parallel projection.
#[derive(Clone, Copy)]
pub enum View {
    /// From above, north up.
    Plan,
    /// From the south, 35 degrees above the horizon, with heights doubled.
    Oblique,
}

impl View {
    /// A position to the right, up and towards the camera, metres.
    fn rotate(self, at: DVec3) -> DVec3 {
        match self {
            Self::Plan => at,
            Self::Oblique => {
                let (sine, cosine) = 35_f64.to_radians().sin_cos();
                let up = 2.0 * at.z;
                DVec3::new(at.x, at.y * sine + up * cosine, up * sine - at.y * cosine)
            }
        }
    }
}

/// A picture that is `across` pixels wide.
pub fn draw(field: &Field, view: View, across: u32, colour: impl Fn(u32) -> [u8; 3]) -> RgbImage {
    let rotated: Vec<DVec3> = field.points().iter().map(|&at| view.rotate(at)).collect();
    let (low, high) = rotated
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| {
            (low.min(*at), high.max(*at))
        });
    let size = high - low;
    let scale = f64::from(across) / size.x;
    let down = (size.y * scale).ceil().max(1.0) as u32;
    let mut picture = RgbImage::from_pixel(across, down, Rgb([255, 255, 255]));
    let mut depths = vec![f64::NEG_INFINITY; (across * down) as usize];
    let light = DVec3::new(-1.0, 1.0, 1.5).normalize();
    for (number, corners) in field.triangles().iter().enumerate() {
        let [a, b, c] = field.corners(number as u32);
        let shade = 0.35 + 0.65 * (b - a).cross(c - a).normalize().dot(light).max(0.0);
        let colour = colour(number as u32).map(|part| (f64::from(part) * shade) as u8);
        let project = |corner: u32| {
            let at = rotated[corner as usize] - low;
            DVec3::new(at.x * scale, (size.y - at.y) * scale, at.z)
        };
        fill(corners.map(project), [across, down], |[x, y], depth| {
            let known = &mut depths[(y * across + x) as usize];
            if depth > *known {
                *known = depth;
                picture.put_pixel(x, y, Rgb(colour));
            }
        });
    }
    picture
}

/// The pixel of a position in the plan, in a picture from above.
pub fn plan(field: &Field, across: u32, at: DVec2) -> [i64; 2] {
    let [low, high] = field.plan_bounds();
    let scale = f64::from(across) / (high.x - low.x);
    [(at.x - low.x) * scale, (high.y - at.y) * scale].map(|number| number as i64)
}

/// Draws a red cross with a white outline.
pub fn mark(picture: &mut RgbImage, [x, y]: [i64; 2]) {
    for (half, colour) in [(2, [255, 255, 255]), (1, [220, 0, 0])] {
        for along in -10..=10_i64 {
            for beside in -half..=half {
                for [x, y] in [[x + along, y + beside], [x + beside, y + along]] {
                    let inside = x >= 0
                        && y >= 0
                        && x < i64::from(picture.width())
                        && y < i64::from(picture.height());
                    if inside {
                        picture.put_pixel(x as u32, y as u32, Rgb(colour));
                    }
                }
            }
        }
    }
}

/// Joins pictures in rows, with white gaps between them.
pub fn tile(rows: &[Vec<RgbImage>]) -> RgbImage {
    const GAP: u32 = 6;
    let wide = |row: &Vec<RgbImage>| row.iter().map(|picture| picture.width() + GAP).sum::<u32>();
    let high =
        |row: &Vec<RgbImage>| row.iter().map(RgbImage::height).max().unwrap_or_default() + GAP;
    let across = rows.iter().map(wide).max().unwrap_or_default();
    let mut all = RgbImage::from_pixel(across, rows.iter().map(high).sum(), Rgb([255, 255, 255]));
    let mut y = 0;
    for row in rows {
        let mut x = 0;
        for picture in row {
            image::imageops::replace(&mut all, picture, i64::from(x), i64::from(y));
            x += picture.width() + GAP;
        }
        y += high(row);
    }
    all
}

/// Calls `pixel` for every pixel whose middle lies in a triangle, with the depth there.
fn fill([a, b, c]: [DVec3; 3], [across, down]: [u32; 2], mut pixel: impl FnMut([u32; 2], f64)) {
    let [p, q, r] = [a, b, c].map(DVec3::truncate);
    let (low, high) = (p.min(q).min(r).floor(), p.max(q).max(r).ceil());
    let whole = (q - p).perp_dot(r - p);
    if whole == 0.0 {
        return;
    }
    let rows = low.y.max(0.0) as u32..(high.y.max(0.0) as u32).min(down);
    for y in rows {
        for x in low.x.max(0.0) as u32..(high.x.max(0.0) as u32).min(across) {
            let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let shares = [
                (q - at).perp_dot(r - at),
                (r - at).perp_dot(p - at),
                (p - at).perp_dot(q - at),
            ]
            .map(|share| share / whole);
            if shares.iter().all(|share| *share >= 0.0) {
                pixel([x, y], a.z * shares[0] + b.z * shares[1] + c.z * shares[2]);
            }
        }
    }
}
