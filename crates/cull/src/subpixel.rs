//! How far rasterisers move corners, and the margins of boxes that follow from it. All margins that are counted in pixels are here.
//!
//! A rasteriser keeps a corner with some bits below a pixel and rounds to the nearest, so each corner moves by at most half a step in x and in y, each by itself. What it covers lies
//! within its moved corners, so no covered point has moved by more than they have.

#[cfg(test)]
mod drawn_boxes;
#[cfg(test)]
mod rasteriser;
#[cfg(test)]
mod tested_boxes;
#[cfg(test)]
mod world;

/// Bits below a pixel that a rasteriser keeps of a corner. wgpu does not report them on any backend, so they are what every device has: Vulkan (`subPixelPrecisionBits`) and OpenGL
/// (`GL_SUBPIXEL_BITS`) promise four; D3D12 has eight. SwiftShader has four.
pub const RASTERISER_BITS: u32 = 4;
/// Bits of the grid to which the vertex shaders move corners before: `SUBPIXELS` of `shared/clip.wgsl`.
pub const SHADER_BITS: u32 = 8;

/// The most that a corner moves in x or y, in pixels: half a step of each grid.
pub const CORNER: f64 = half_step(RASTERISER_BITS) + half_step(SHADER_BITS);

/// What tests of boxes by numbers allow for, in pixels in x and y: `SNAPPING` of `shared/seen_shape.wgsl`. Only what is in the box is drawn and moves. Nearly twice what that takes.
pub const TESTED: f64 = 1.0 / 16.0;

/// By how many pixels, in every direction, a drawn box is wider than what it holds. The corners of both move, so they may part by two [`CORNER`]s in x and as many in y, which along a
/// diagonal is more by the root of two: 0.094. A third more in reserve.
pub const DRAWN: f64 = 1.0 / 8.0;

/// Pixels by which lines and points may cover what they do not touch, snapping included.
pub const LINES: f64 = 1.5;

const fn half_step(bits: u32) -> f64 {
    0.5 / (1u32 << bits) as f64
}

const _: () = assert!(TESTED > CORNER);
const _: () = assert!(DRAWN > 2.0 * std::f64::consts::SQRT_2 * CORNER);
const _: () = assert!(LINES > DRAWN);

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_shaders::jobs;

    #[test]
    fn shaders_have_the_same_numbers() {
        let tested = format!("const SNAPPING: f32 = {TESTED:?};");
        assert!(
            jobs::test_slots_one::JOB.source.contains(&tested),
            "{tested}"
        );
        let grid = f64::from(1u32 << SHADER_BITS);
        let grid = format!("const SUBPIXELS: f32 = {grid:?};");
        assert!(jobs::boxes::JOB.source.contains(&grid), "{grid}");
    }
}
