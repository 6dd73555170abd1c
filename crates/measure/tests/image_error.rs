//! FLIP, and pictures with marked wrong pixels.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_measure::image_error::{flip, mark_wrong};
use image::{Rgba, RgbaImage};
use proptest::prelude::*;

fn gradient(width: u32, height: u32) -> RgbaImage {
    RgbaImage::from_fn(width, height, |x, y| {
        Rgba([
            (x * 255 / width) as u8,
            (y * 255 / height) as u8,
            ((x * 7 + y * 13) % 256) as u8,
            255,
        ])
    })
}

proptest! {
    #[test]
    fn marks_cover_exactly_the_wrong_pixels(width in 1u32..40, height in 1u32..40, seed in any::<u64>()) {
        let mask: Vec<bool> = (0..width * height).map(|i| (seed.rotate_left(i)) % 5 == 0).collect();
        let marked = mark_wrong(&gradient(width, height), &mask).unwrap();
        for (pixel, wrong) in marked.pixels().zip(&mask) {
            prop_assert_eq!(pixel.0 == [255, 0, 255, 255], *wrong);
        }
    }
}

#[test]
fn sizes_that_differ_are_refused() {
    assert!(mark_wrong(&gradient(2, 2), &[true; 3]).is_err());
    assert!(flip(&gradient(2, 2), &gradient(2, 3)).is_err());
}

#[test]
fn flip_is_exactly_zero_for_equal_images_and_grows_with_the_difference() {
    let reference = gradient(64, 48);
    let equal = flip(&reference, &reference.clone()).unwrap();
    assert_eq!((equal.mean, equal.max), (0.0, 0.0));
    let spoiled = |side: u32| {
        let mut image = reference.clone();
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            image.put_pixel(10 + x, 10 + y, Rgba([255, 0, 255, 255]));
        }
        flip(&reference, &image).unwrap()
    };
    let (small, large) = (spoiled(2), spoiled(12));
    assert!(
        0.0 < small.mean && small.mean < large.mean && large.mean < 1.0,
        "{small:?} {large:?}"
    );
    assert!(
        small.max <= 1.0 && large.max <= 1.0 && large.max > 0.3,
        "{large:?}"
    );
}

#[test]
fn flip_takes_images_of_any_size() {
    let black = RgbaImage::from_pixel(1, 1, Rgba([0, 0, 0, 255]));
    let white = RgbaImage::from_pixel(1, 1, Rgba([255; 4]));
    let one = flip(&black, &white).unwrap();
    assert!(one.mean > 0.5 && one.mean <= 1.0, "{one:?}");
    let none = flip(&RgbaImage::new(0, 0), &RgbaImage::new(0, 0)).unwrap();
    assert_eq!(none.mean, 0.0);
}

#[test]
fn one_wrong_pixel_of_a_large_frame_is_seen_in_a_thumbnail() {
    let (width, height) = (1920, 1080);
    let mut mask = vec![false; (width * height) as usize];
    mask[(500 * width + 700) as usize] = true;
    let marked = mark_wrong(&gradient(width, height), &mask).unwrap();
    let thumb = image::imageops::thumbnail(&marked, 128, 72);
    let magenta = |p: &Rgba<u8>| p.0[0].min(p.0[2]).saturating_sub(p.0[1]);
    assert!(thumb.pixels().map(magenta).max().unwrap() > 40);
    let clean = mark_wrong(&gradient(width, height), &vec![false; mask.len()]).unwrap();
    assert_eq!(clean.pixels().map(magenta).max().unwrap(), 0);
}
