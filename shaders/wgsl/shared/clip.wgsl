//!import view
// The one way from world space relative to the eye onto the screen.

// Rasterisers snap vertices to 1/256 of a pixel. One that finds depth's slope from what was before the snap (llvmpipe does) may be off by
// metres in a sliver seen on edge, and show what lies far behind: so they come snapped.
const SUBPIXELS: f32 = 256.0;

fn clip_position(relative: vec3<f32>) -> vec4<f32> {
    let clip = view.clip_from_relative * vec4<f32>(relative, 1.0);
    let grid = vec2<f32>(view.pixels_wide, view.pixels_high) * (0.5 * SUBPIXELS);
    let on_screen = clip.w > 0.0 && all(abs(clip.xy) < vec2<f32>(2.0 * clip.w));
    let snapped = round(clip.xy / clip.w * grid) / grid * clip.w;
    return vec4<f32>(select(clip.xy, snapped, on_screen), clip.zw);
}
