//!import view
// From world space relative to the eye to clip space. All passes use this function.

// Most rasterisers snap vertices to 1/256 of a pixel. A rasteriser that computes the slope of depth before it snaps (llvmpipe does) can be wrong by
// metres for a sliver that is seen edge-on, and draw what is far behind it. So vertices are snapped here already.
const SUBPIXELS: f32 = 256.0;

fn clip_position(relative: vec3<f32>) -> vec4<f32> {
    let clip = view.clip_from_relative * vec4<f32>(relative, 1.0);
    let grid = vec2<f32>(view.pixels_wide, view.pixels_high) * (0.5 * SUBPIXELS);
    let on_screen = clip.w > 0.0 && all(abs(clip.xy) < vec2<f32>(2.0 * clip.w));
    let snapped = round(clip.xy / clip.w * grid) / grid * clip.w;
    return vec4<f32>(select(clip.xy, snapped, on_screen), clip.zw);
}
