//! Pictures side by side with words under them, for people who look at the files without the page.

use font8x8::UnicodeFonts;
use image::{Rgba, RgbaImage};

const GLYPH: u32 = 8;
const GAP: u32 = 8;
const PAPER: Rgba<u8> = Rgba([24, 26, 30, 255]);
const INK: Rgba<u8> = Rgba([235, 235, 235, 255]);

/// One picture and what it shows.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    /// The words under it; what does not fit its width is cut, what the font lacks is a `?`.
    pub caption: &'a str,
    /// The picture.
    pub image: &'a RgbaImage,
}

/// Sets the pictures beside one another, aligned at the top, each with its caption below. No panels
/// give an image of no pixels.
pub fn side_by_side(panels: &[Panel<'_>]) -> RgbaImage {
    let Some(tallest) = panels.iter().map(|p| p.image.height()).max() else {
        return RgbaImage::new(0, 0);
    };
    let widest = panels.iter().map(|p| p.image.width()).max().unwrap_or(0);
    // The 8-pixel font as large as some 40 letters a panel allow.
    let scale = (widest / (GLYPH * 40)).clamp(1, 6);
    let line = GLYPH * scale + 2 * GAP;
    let width = panels.iter().map(|p| p.image.width() + GAP).sum::<u32>() + GAP;
    let mut sheet = RgbaImage::from_pixel(width, GAP + tallest + line, PAPER);
    let mut x = GAP;
    for panel in panels {
        image::imageops::replace(&mut sheet, panel.image, i64::from(x), i64::from(GAP));
        write(
            &mut sheet,
            panel.caption,
            (x, GAP + panel.image.height() + GAP),
            panel.image.width(),
            scale,
        );
        x += panel.image.width() + GAP;
    }
    sheet
}

/// Writes a line with its upper left corner `at`, no wider than `room`.
fn write(sheet: &mut RgbaImage, text: &str, at: (u32, u32), room: u32, scale: u32) {
    for (n, letter) in (0..room / (GLYPH * scale)).zip(text.chars()) {
        let rows = glyph(letter);
        for (y, row) in (0u32..).zip(rows) {
            for x in (0..GLYPH).filter(|x| row >> x & 1 == 1) {
                let corner = (at.0 + (n * GLYPH + x) * scale, at.1 + y * scale);
                fill(sheet, corner, scale);
            }
        }
    }
}

fn fill(sheet: &mut RgbaImage, corner: (u32, u32), size: u32) {
    for (dx, dy) in (0..size).flat_map(|dy| (0..size).map(move |dx| (dx, dy))) {
        if let Some(pixel) = sheet.get_pixel_mut_checked(corner.0 + dx, corner.1 + dy) {
            *pixel = INK;
        }
    }
}

fn glyph(letter: char) -> [u8; 8] {
    let known = font8x8::BASIC_FONTS
        .get(letter)
        .or_else(|| font8x8::LATIN_FONTS.get(letter));
    known
        .or_else(|| font8x8::BASIC_FONTS.get('?'))
        .unwrap_or_default()
}
