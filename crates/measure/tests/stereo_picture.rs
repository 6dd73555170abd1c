//! Combined pictures of two eyes: each picture reaches its eye.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_measure::MeasureError;
use antumbra_measure::stereo_picture::{StereoLayout, combine_eyes};
use image::{Rgba, RgbaImage};

fn plain(colour: [u8; 3]) -> RgbaImage {
    let [r, g, b] = colour;
    RgbaImage::from_pixel(4, 3, Rgba([r, g, b, 255]))
}

/// The anaglyph of two plain colours.
fn anaglyph(left: [u8; 3], right: [u8; 3]) -> [u8; 3] {
    let parts = combine_eyes(plain(left), plain(right), StereoLayout::RedCyan).unwrap();
    let [part] = parts.as_slice() else {
        panic!("one picture")
    };
    assert_eq!((part.suffix, part.picture.dimensions()), ("", (4, 3)));
    let Rgba([r, g, b, alpha]) = *part.picture.get_pixel(3, 2);
    assert_eq!(alpha, 255);
    [r, g, b]
}

#[test]
fn the_left_eye_stands_left() {
    let left = RgbaImage::from_fn(3, 2, |x, y| Rgba([x as u8, y as u8, 1, 255]));
    let right = RgbaImage::from_fn(3, 2, |x, y| Rgba([x as u8, y as u8, 2, 255]));
    let parts = combine_eyes(left.clone(), right.clone(), StereoLayout::SideBySide).unwrap();
    assert_eq!(parts.len(), 1);
    let joined = &parts[0].picture;
    assert_eq!(joined.dimensions(), (6, 2));
    for (x, y, pixel) in joined.enumerate_pixels() {
        let expected = if x < 3 {
            left.get_pixel(x, y)
        } else {
            right.get_pixel(x - 3, y)
        };
        assert_eq!(pixel, expected, "{x}, {y}");
    }
    let parts = combine_eyes(left.clone(), right.clone(), StereoLayout::Separate).unwrap();
    assert_eq!(parts.len(), 2);
    assert_eq!((parts[0].suffix, &parts[0].picture), ("-left", &left));
    assert_eq!((parts[1].suffix, &parts[1].picture), ("-right", &right));
    let empty = combine_eyes(
        RgbaImage::new(0, 2),
        RgbaImage::new(0, 2),
        StereoLayout::SideBySide,
    );
    assert_eq!(empty.unwrap()[0].picture.dimensions(), (0, 2));
}

#[test]
fn what_one_eye_sees_reaches_its_lens() {
    // White for the left eye only is red; for the right eye only, cyan.
    let [r, g, b] = anaglyph([255; 3], [0; 3]);
    assert!(r > 250 && g == 0 && b == 0, "{r} {g} {b}");
    let [r, g, b] = anaglyph([0; 3], [255; 3]);
    assert!(r == 0 && g > 250 && b > 250, "{r} {g} {b}");
}

#[test]
fn greys_stay_grey_in_the_screen_plane() {
    for grey in [0u8, 1, 17, 128, 200, 255] {
        for channel in anaglyph([grey; 3], [grey; 3]) {
            assert!(channel.abs_diff(grey) <= 1, "{channel} of {grey}");
        }
    }
}

/// With a half-colour anaglyph, the right lens would show 0 here.
#[test]
fn red_is_seen_by_both_eyes() {
    let [r, g, _] = anaglyph([255, 0, 0], [255, 0, 0]);
    assert!(r > 150 && g > 120, "{r} {g}");
    // In linear light: 0.377 - 0.062 of full green.
    let expected = 1.055 * f64::from(0.315f32).powf(1.0 / 2.4) - 0.055;
    assert!((f64::from(g) / 255.0 - expected).abs() < 0.003);
}

#[test]
fn pictures_of_two_sizes_are_refused() {
    for layout in StereoLayout::ALL {
        let error = combine_eyes(plain([0; 3]), RgbaImage::new(3, 4), layout).unwrap_err();
        assert!(matches!(error, MeasureError::SizeMismatch { .. }));
        assert!(error.to_string().contains("3 x 4"), "{error}");
    }
}

#[test]
fn layouts_are_known_by_name() {
    for layout in StereoLayout::ALL {
        assert_eq!(layout.to_string().parse(), Ok(layout));
    }
    let error = "sideways".parse::<StereoLayout>().unwrap_err();
    assert!(error.contains("side-by-side") && error.contains("red-cyan"));
}
