//! `assert_layout!`: agreement, and one sentence for each way to disagree.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_shaders::{Job, StructLayout, assert_layout, check_layout, layout_fields};

#[repr(C)]
struct View {
    clip_from_relative: [[f32; 4]; 4],
    eye_high: [f32; 3],
    wide: f32,
    eye_low: [f32; 3],
    pixels_high: f32,
}

assert_layout!(View, "depth", "View", { clip_from_relative, eye_high, wide: pixels_wide, eye_low, pixels_high });

fn settings() -> StructLayout {
    let job = Job::from_wgsl(
        "settings",
        "struct Settings { a: u32, direction: vec3<f32>, steps: array<vec3<f32>, 2>, padding: u32, _other: vec2<u32> }
        @group(0) @binding(0) var<storage> settings: Settings;
        @compute @workgroup_size(1) fn main() { _ = settings.a; }",
    );
    job.unwrap().struct_layout("Settings").unwrap().clone()
}

/// The sentence, or "same".
macro_rules! compare {
    ($rust:ty, $fields:tt) => {
        match check_layout(
            stringify!($rust),
            size_of::<$rust>(),
            &layout_fields!($rust, $fields),
            &settings(),
        ) {
            Ok(()) => "same".to_owned(),
            Err(mismatch) => mismatch.to_string(),
        }
    };
}

#[test]
fn equal_layouts_agree_whatever_the_padding_is_called() {
    #[repr(C)]
    struct Same {
        a: u32,
        pad: [u32; 3],
        direction: [f32; 4],
        steps: [[f32; 4]; 2],
        end: [u32; 4],
    }
    // A vec3 and the gap behind it are 12 and 4 bytes: a Rust field over both has the wrong size.
    assert_eq!(
        compare!(Same, { a, direction, steps }),
        "`Same.direction` has 16 bytes, but `Settings.direction` has 12 in WGSL; use a type of that size"
    );
    #[repr(C)]
    struct Right {
        a: u32,
        pad: [u32; 3],
        direction: [f32; 3],
        gap: u32,
        steps: [[f32; 4]; 2],
        end: [u32; 4],
    }
    assert_eq!(compare!(Right, { a, direction, steps }), "same");
    assert_eq!(
        compare!(Right, { a, direction }),
        "`Settings.steps` has no field in `Right`; add it to the list, or call it padding"
    );
    assert_eq!(
        compare!(Right, { a, direction, steps: stepss }),
        "`Right.steps` stands for `Settings.stepss`, which does not exist in WGSL; correct the name"
    );
}

#[test]
fn offsets_sizes_and_the_whole_size_are_compared() {
    #[repr(C)]
    struct Early {
        a: u32,
        direction: [f32; 3],
        steps: [[f32; 4]; 2],
    }
    assert_eq!(
        compare!(Early, { a, direction, steps }),
        "`Early.direction` is at byte 4, but `Settings.direction` is at byte 16 in WGSL; pad or reorder the fields"
    );
    #[repr(C)]
    struct Short {
        a: u32,
        pad: [u32; 3],
        direction: [f32; 3],
        gap: u32,
        steps: [[f32; 4]; 2],
    }
    assert_eq!(
        compare!(Short, { a, direction, steps }),
        "`Short` has 64 bytes, but `Settings` has 80 in WGSL; mind the padding at the end"
    );
}

#[test]
fn very_long_names_are_cut_and_not_a_panic() {
    let name: &'static str = Box::leak("é".repeat(1000).into_boxed_str());
    let error = check_layout(name, 1, &[], &settings()).unwrap_err();
    assert!(!error.to_string().is_empty());
}
