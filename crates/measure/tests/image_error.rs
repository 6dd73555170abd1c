//! Wrong pixels, owners, FLIP and the pictures that show them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;

use antumbra_measure::image_error::{
    Panel, false_culls, flip, mark_wrong, overdrawn, owners, side_by_side, wrong_pixels,
};
use image::{Rgba, RgbaImage};
use proptest::prelude::*;

const NOBODY: u32 = u32::MAX;

fn ids() -> impl Strategy<Value = Vec<u32>> {
    prop::collection::vec(prop_oneof![0u32..6, Just(NOBODY)], 0..200)
}

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
    fn owners_count_every_pixel_once(ids in ids()) {
        let mut expected = BTreeMap::new();
        for id in ids.iter().filter(|id| **id != NOBODY) {
            *expected.entry(*id).or_insert(0u32) += 1;
        }
        let found: BTreeMap<_, _> = owners(&ids, NOBODY).iter().map(|o| (o.id, o.pixels)).collect();
        prop_assert_eq!(found, expected);
        prop_assert!(owners(&ids, NOBODY).is_sorted());
    }

    #[test]
    fn drawing_exactly_the_owners_is_ideal(ids in ids()) {
        let reference = owners(&ids, NOBODY);
        let drawn: Vec<u32> = reference.iter().map(|o| o.id).collect();
        prop_assert!(false_culls(&reference, &drawn).is_empty());
        prop_assert_eq!(overdrawn(&reference, &drawn), 0);
        prop_assert_eq!(false_culls(&reference, &[]), reference);
        prop_assert_eq!(overdrawn(&[], &drawn), drawn.len());
    }

    #[test]
    fn wrong_pixels_are_those_that_differ(ids in ids(), flips in prop::collection::vec(any::<bool>(), 200)) {
        let frame: Vec<u32> = ids.iter().zip(&flips).map(|(id, f)| if *f { id ^ 8 } else { *id }).collect();
        let wrong = wrong_pixels(&ids, &frame).unwrap();
        prop_assert_eq!(&wrong.mask[..], &flips[..ids.len()]);
        prop_assert_eq!(wrong.count, wrong.mask.iter().filter(|w| **w).count());
        prop_assert!((0.0..=100.0).contains(&wrong.percent()));
    }

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
fn percent_of_wrong_pixels() {
    assert_eq!(
        wrong_pixels(&[1, 2, 3, 4], &[1, 2, 3, 9])
            .unwrap()
            .percent(),
        25.0
    );
    assert_eq!(wrong_pixels(&[], &[]).unwrap().percent(), 0.0);
}

#[test]
fn sizes_that_differ_are_refused() {
    assert!(
        wrong_pixels(&[1], &[1, 2])
            .unwrap_err()
            .to_string()
            .contains("2 pixels")
    );
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

#[test]
fn panels_stand_side_by_side_with_their_words() {
    let (left, right) = (gradient(200, 100), gradient(300, 60));
    let sheet = side_by_side(&[
        Panel {
            caption: "reference",
            image: &left,
        },
        Panel {
            caption: "three-pass \u{202e} \u{1f980} and far more words than two hundred pixels hold",
            image: &right,
        },
    ]);
    assert_eq!(sheet.width(), 200 + 300 + 3 * 8);
    assert_eq!(sheet.get_pixel(8 + 50, 8 + 50), left.get_pixel(50, 50));
    assert_eq!(
        sheet.get_pixel(8 + 200 + 8 + 299, 8 + 59),
        right.get_pixel(299, 59)
    );
    let written = |x0: u32, x1: u32, y0: u32| {
        (y0..y0 + 20)
            .flat_map(|y| (x0..x1).map(move |x| (x, y)))
            .filter(|(x, y)| sheet[(*x, *y)].0[0] == 235)
            .count()
    };
    assert!(written(8, 208, 108) > 50, "the left caption");
    assert!(written(216, 516, 68) > 50, "the right caption");
    assert_eq!(side_by_side(&[]).dimensions(), (0, 0));
}
