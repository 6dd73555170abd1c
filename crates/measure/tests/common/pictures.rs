//! The pictures of a synthetic report: boxes in fog, some of them with a hole.

use std::path::Path;

use antumbra_measure::image_error::mark_wrong;
use antumbra_measure::report::Report;
use image::{Rgba, RgbaImage};

/// Draws the pictures that the report names below `dir`.
pub fn draw(report: &Report, dir: &Path) {
    std::fs::create_dir_all(dir.join("images")).unwrap();
    let [width, height] = report.scene.size;
    let reference = RgbaImage::from_fn(width, height, |x, y| {
        let (column, row) = (x / 40, y / 30);
        let inside = x % 40 < 32 && y % 30 < 24;
        let shade = ((column * 37 + row * 91) % 120) as u8;
        if inside {
            Rgba([90 + shade, 100 + shade / 2, 140, 255])
        } else {
            Rgba([190, 200, 210, 255])
        }
    });
    for strategy in &report.strategies {
        let Some(worst) = &strategy.worst else {
            continue;
        };
        let mut frame = reference.clone();
        let mut mask = vec![false; (width * height) as usize];
        for (x, y) in (0..5).flat_map(|y| (0..9).map(move |x| (x, y))) {
            let at = (403 + x, 212 + y);
            frame.put_pixel(at.0, at.1, Rgba([190, 200, 210, 255]));
            mask[(at.1 * width + at.0) as usize] = true;
        }
        reference.save(dir.join(&worst.images.reference)).unwrap();
        frame.save(dir.join(&worst.images.strategy)).unwrap();
        mark_wrong(&frame, &mask)
            .unwrap()
            .save(dir.join(&worst.images.marked))
            .unwrap();
    }
}
